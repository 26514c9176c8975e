# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshots against openPMD 1.1.0, rule by rule, and against the problem's own formulas, by h5py. usage: test_openpmd.py GRIDCROSS"""
import csv
import hashlib
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError:
    system = "/usr/bin/python3"  # where Debian puts h5py
    if sys.executable == system or subprocess.run([system, "-c", "import h5py"], capture_output=True).returncode:
        print("skipped: no h5py")
        sys.exit(77)
    sys.exit(subprocess.run([system, *sys.argv]).returncode)
import numpy as np

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
STUDY = """title: small
problem: {name: axis-aligned, dimension: [1, 2, 3], amplitude: 0.02}
mesh: {cells: 6, particles_per_cell: 2}
method: {space: [standard, moving-mesh, spline-particle], degree: 3, mass: consistent}
time: {periods: 0.1}
output: {snapshots: 4}
"""


class Standard:
    """Collects every breach of the standard's rules for its base layout."""

    def __init__(self, file):
        self.file, self.wrong = file, []
        self.root()
        for name, iteration in file["data"].items():
            self.iteration(name, iteration)

    def say(self, what, where):
        self.wrong.append(f"{where.name}: {what}")

    def text(self, where, name, pattern=".+"):
        value = where.attrs.get(name)
        if not isinstance(value, np.bytes_):
            self.say(f"{name} is not a text of fixed length", where)
        elif not re.fullmatch(pattern, value.decode("ascii")):
            self.say(f"{name} is {value}", where)

    def real(self, where, name):
        if not isinstance(where.attrs.get(name), np.float64):
            self.say(f"{name} is not a float64", where)

    def reals(self, where, name, count):
        value = where.attrs.get(name)
        if not (isinstance(value, np.ndarray) and value.dtype == np.float64 and value.shape == (count,)):
            self.say(f"{name} is not {count} float64", where)

    def root(self):
        root = self.file
        self.text(root, "openPMD", r"1\.1\.0")
        if root.attrs.get("openPMDextension") != 0 or root.attrs["openPMDextension"].dtype != np.uint32:
            self.say("openPMDextension is not uint32 0", root)
        self.text(root, "basePath", "/data/%T/")
        self.text(root, "iterationEncoding", "groupBased")
        self.text(root, "iterationFormat", "/data/%T/")
        self.text(root, "particlesPath", r"\w+/")
        self.text(root, "software")
        self.text(root, "softwareVersion")

    def iteration(self, name, group):
        if not re.fullmatch("[0-9]+", name):
            self.say("is no iteration", group)
        for attribute in ("time", "dt", "timeUnitSI"):
            self.real(group, attribute)
        if "meshesPath" in self.file.attrs:
            self.text(self.file, "meshesPath", r"\w+/")
            for record in group[self.file.attrs["meshesPath"].decode()].values():
                self.record(record, True)
        for species in group[self.file.attrs["particlesPath"].decode()].values():
            for required in ("position", "positionOffset"):
                if required not in species:
                    self.say(f"has no {required}", species)
            for record in species.values():
                self.record(record, False)
            self.lengths(species)

    def record(self, record, mesh):
        if not re.fullmatch(r"\w+", record.name.split("/")[-1]):
            self.say("bad name", record)
        self.reals(record, "unitDimension", 7)
        self.real(record, "timeOffset")
        scalar = isinstance(record, h5py.Dataset) or "value" in record.attrs
        components = [record] if scalar else list(record.values())
        if not components:
            self.say("has no component", record)
        if mesh:
            self.mesh(record, components)
        for component in components:
            self.component(component, mesh)

    def mesh(self, record, components):
        rank = components[0].ndim
        self.text(record, "geometry", "cartesian")
        self.text(record, "dataOrder", "C")
        labels = record.attrs.get("axisLabels")
        if list(labels) != [b"z", b"y", b"x"][3 - rank:]:
            self.say(f"axisLabels are {labels}", record)
        self.reals(record, "gridSpacing", rank)
        self.reals(record, "gridGlobalOffset", rank)
        self.real(record, "gridUnitSI")

    def component(self, component, mesh):
        if not re.fullmatch(r"\w+", component.name.split("/")[-1]):
            self.say("bad name", component)
        self.real(component, "unitSI")
        if isinstance(component, h5py.Group):
            if "value" not in component.attrs or component.attrs["shape"].dtype != np.uint64 or len(component):
                self.say("is no constant component", component)
        if mesh:
            self.reals(component, "position", component.ndim)
            if not (0 <= component.attrs["position"]).all() or not (component.attrs["position"] < 1).all():
                self.say("position is not in [0, 1)", component)

    def lengths(self, species):
        lengths = set()

        def note(_, thing):
            if isinstance(thing, h5py.Dataset):
                lengths.add(thing.shape)
            elif "shape" in thing.attrs:
                lengths.add(tuple(thing.attrs["shape"]))

        species.visititems(note)
        if len(lengths) != 1 or len(next(iter(lengths))) != 1:
            self.say(f"records have shapes {lengths}", species)


def vector(group):
    return np.array([group[c] for c in "xyz" if c in group])


def tensor(group, dim):
    return np.array([[group[a + b] for b in "xyz"[:dim]] for a in "xyz"[:dim]])


def rms(error):
    return np.sqrt(np.mean(np.sum(error**2, axis=tuple(range(error.ndim - 1)))))


class Snapshots(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.dir = pathlib.Path(place.name)
        (cls.dir / "small.yaml").write_text(STUDY)
        for jobs in ("1", "2"):
            subprocess.run([PROGRAM, "run", "small.yaml", "-q", "-j", jobs, "-o", jobs], cwd=cls.dir, check=True, capture_output=True)
        cls.table = list(csv.DictReader((cls.dir / "1/table.csv").read_text().splitlines()))

    def each(self, check):
        for case in self.table:
            with self.subTest(space=case["method.space"], dimension=case["problem.dimension"]):
                with h5py.File(self.dir / f"1/case-{case['case']}.h5") as file:
                    check(case, int(case["problem.dimension"]), file)

    def test_the_standard_is_kept(self):
        def check(case, dim, file):
            self.assertEqual(Standard(file).wrong, [])
            self.assertEqual("meshesPath" in file.attrs, case["method.space"] != "spline-particle")

        self.each(check)

    def test_two_lines_read_it(self):
        name = f"case-{self.table[0]['case']}.h5"
        script = f"import h5py\nprint(h5py.File('{name}')['data/0/particles/material_points/position/x'][:].tolist())\n"
        done = subprocess.run([sys.executable, "-c", script], cwd=self.dir / "1", capture_output=True, text=True, check=True)
        X = (np.arange(12) + 0.5) / 12
        np.testing.assert_allclose(eval(done.stdout), X + 0.02 * np.sin(2 * np.pi * X), rtol=1e-14)

    def test_steps_and_times(self):
        def check(case, dim, file):
            steps, dt = int(case["result.steps"]), float(case["result.dt"])
            names = sorted(file["data"], key=int)
            self.assertEqual([int(n) for n in names], sorted({*range(0, steps + 1, 4), steps}))
            self.assertEqual([file["data"][n].attrs["time"] for n in names], [int(n) * dt for n in names])

        self.each(check)

    def test_particles_hold_what_they_say(self):
        def check(case, dim, file):
            for iteration in file["data"].values():
                p = iteration["particles/material_points"]
                self.assertEqual(list(p["id"]), list(range(12**dim)))
                np.testing.assert_array_equal(vector(p["position"]), vector(p["reference_position"]) + vector(p["displacement"]))
                F, P, sigma = (tensor(p[name], dim) for name in ("deformation_gradient", "first_piola_stress", "cauchy_stress"))
                J = np.linalg.det(F.transpose(2, 0, 1))
                np.testing.assert_allclose(sigma, np.einsum("ikp,jkp->ijp", P, F) / J, rtol=1e-12, atol=1e-9)
                np.testing.assert_allclose(p["volume"], J / 12**dim, rtol=1e-12)
                np.testing.assert_allclose(p["mass"], 1 / 12**dim, rtol=1e-14)
            last = file["data"][str(case["result.steps"])]["particles/material_points"]
            for name, of in (("displacement", vector), ("velocity", vector), ("stress", lambda g: tensor(g, dim))):
                error = float(case[f"result.{name}.final.rms"])
                self.assertAlmostEqual(rms(of(last[f"{name}_error"])) / error, 1, delta=1e-12)

        self.each(check)

    def test_velocities_live_where_timeOffset_says(self):
        """u = A sin(2 pi X) cos(pi c t): of the exact velocity at that time, and not of that of the snapshot's own."""

        def check(case, dim, file):
            if case["method.space"] == "standard":
                return
            c, A = np.sqrt(1e4), 0.02  # the modulus; Poisson's ratio and phases are 0
            for name in sorted(file["data"], key=int)[:2]:
                p, t = file["data"][name]["particles/material_points"], file["data"][name].attrs["time"]
                X, v, offset = vector(p["reference_position"]), vector(p["velocity"]), p["velocity"].attrs["timeOffset"]
                self.assertEqual(offset, -0.5 * float(case["result.dt"]))
                exact = [-A * np.pi * c * np.sin(2 * np.pi * X) * np.sin(np.pi * c * (t + o)) for o in (0, offset)]
                self.assertLess(rms(v - exact[1]), 0.1 * rms(v - exact[0]))

        self.each(check)

    def test_grids_hold_what_they_say(self):
        """Weight, momentum and, where vertices move with it, the motion of the material at them."""
        def check(case, dim, file):
            if "meshesPath" not in file.attrs:
                return
            A = 0.02
            inner = (slice(0, -1),) * dim  # of a periodic grid: each vertex once
            for iteration in file["data"].values():
                grid, p = iteration["meshes"], iteration["particles/material_points"]
                self.assertEqual(grid["density"].shape, (7,) * dim)
                np.testing.assert_allclose(grid["density"].attrs["gridSpacing"], [1 / 6] * dim, rtol=1e-15)
                self.assertAlmostEqual(np.mean(grid["density"][inner]), 1, delta=1e-12)
                for d in range(dim):
                    momentum = np.sum(p["mass"][:] * p["velocity"]["xyz"[d]][:])
                    self.assertAlmostEqual(np.mean(grid["momentum"]["xyz"[d]][inner]), momentum, delta=1e-10)
                self.assertEqual("displacement" in grid, case["method.space"] == "moving-mesh")
                if "displacement" not in grid:
                    continue
                t = iteration.attrs["time"]
                X = np.meshgrid(*[np.arange(7) / 6] * dim, indexing="ij")
                for d in range(dim):  # x varies fastest
                    u = A * np.sin(2 * np.pi * X[dim - 1 - d]) * np.cos(100 * np.pi * t)
                    self.assertLess(np.abs(grid["displacement"]["xyz"[d]] - u).max(), 0.01 * A)
                    a = -(100 * np.pi) ** 2 * u
                    self.assertLess(np.abs(grid["acceleration"]["xyz"[d]] - a).max(), 0.05 * A * (100 * np.pi) ** 2)

        self.each(check)

    def test_equal_bytes_for_any_number_of_threads(self):
        def sums(jobs):
            return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in (self.dir / jobs).glob("case-*")}

        self.assertEqual(len(sums("1")), 9 + 9 + 6)
        self.assertEqual(sums("1"), sums("2"))


unittest.main()
