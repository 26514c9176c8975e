# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures from snapshots: x-t diagrams and fields of particles. usage: test_plot_snapshots.py GRIDCROSS"""
import csv
import math
import os
import re
import shutil
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
from studied import PROGRAM, Studied

if not shutil.which("gnuplot"):
    print("skipped: gnuplot is not installed")
    sys.exit(77)
AMPLITUDE, MODULUS, CELLS, PER_CELL = 0.05, 1e4, 8, 3
STUDY = f"""title: small
problem: {{name: bar-neo-hookean, amplitude: {AMPLITUDE}, modulus: {MODULUS}, density: 1}}
mesh: {{cells: {CELLS}, particles_per_cell: {PER_CELL}}}
method: {{space: [standard, moving-mesh, spline-particle]}}
time: {{cfl: 0.2, periods: 0.5}}
output: {{snapshots: 1}}
"""
BOX = """title: box
problem: {name: axis-aligned, dimension: 2}
mesh: {cells: 6, particles_per_cell: 2}
method: {space: [standard, moving-mesh]}
time: {cfl: 0.2, periods: 0.2}
output: {snapshots: 3}
"""


class Case(Studied):
    study = STUDY

    def call(self, *args, **more):
        done = super().call(*args, **more)
        self.assertEqual(done.stdout, "")
        return done

    def run_study(self, name, text):
        (self.dir / f"{name}.yaml").write_text(text, encoding="utf-8")
        subprocess.run([PROGRAM, "run", "-q", f"{name}.yaml"], cwd=self.dir, check=True, capture_output=True)

    def plot(self, *args, study="small.study", **more):
        return self.call("plot", study, *args, **more)

    def rows(self, name):
        with open(self.dir / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def lines(self, name="fig.csv"):
        """Rows by the line that they belong to, in its order."""
        found = {}
        for row in self.rows(name):
            found.setdefault(row["label"], []).append(row)
        return found

    def texts(self, name="fig.svg"):
        root = ElementTree.parse(self.dir / name).getroot()
        return ["".join(t.itertext()).strip() for t in root.iter("{http://www.w3.org/2000/svg}text")]


def displacement(X, t):
    return AMPLITUDE * math.sin(2 * math.pi * X) * math.cos(math.sqrt(MODULUS) * math.pi * t)


class Xt(Case):
    def paths(self, panel, what):
        """[(time, x), ...] by number of particle or edge."""
        found = {}
        for label, rows in self.lines().items():
            match = re.fullmatch(rf"{panel}, {what} (\d+)", label)
            if match:
                found[int(match[1])] = [(float(r["time"]), float(r["x"])) for r in rows if r["time"]]
        return found

    def test_paths_start_at_the_exact_places(self):
        self.plot("xt", "-o", "fig.svg")
        n = CELLS * PER_CELL
        smoothed = AMPLITUDE * (2 * math.pi / CELLS) ** 2 * (1 / 6 + 1 / 8)  # lumped projection and interpolation by hats
        for panel, error in (("standard", 1e-14), ("moving-mesh", smoothed), ("spline-particle", 1e-14)):
            paths = self.paths(panel, "particle")
            self.assertEqual(sorted(paths), list(range(1, n + 1)))
            for number, path in paths.items():
                X = (number - 0.5) / n
                self.assertTrue(math.isclose(path[0][1], X + displacement(X, 0), abs_tol=error))
                self.assertEqual(path[0][0], 0)
                self.assertTrue(math.isclose(path[-1][0], 0.5 * 2 / math.sqrt(MODULUS), rel_tol=1e-12))

    def test_crossings_are_the_table_s(self):
        self.plot("xt", "-o", "fig.svg")
        drawn = {}
        for label, rows in self.lines().items():
            match = re.fullmatch(r"(.*), crossing of particle \d+", label)
            if match:
                drawn[match[1]] = drawn.get(match[1], 0) + len(rows)
                for row in rows:
                    self.assertEqual(float(row["x"]) * CELLS % 1, 0)
        expected = {c["method.space"]: int(c["result.crossings"] or 0) for c in self.rows("small.study/table.csv")}
        self.assertGreater(expected["standard"], 10)
        self.assertEqual(drawn, {space: count for space, count in expected.items() if count})

    def test_edges_rest_on_the_grid_and_move_with_the_mesh(self):
        self.plot("xt", "-o", "fig.svg")
        for number, path in self.paths("standard", "cell edge").items():
            self.assertEqual({x for _, x in path}, {(number - 1) / CELLS})
        self.assertEqual(self.paths("spline-particle", "cell edge"), {})
        edges, particles = self.paths("moving-mesh", "cell edge"), self.paths("moving-mesh", "particle")
        self.assertEqual(len(edges), CELLS + 1)
        self.assertGreater(len({x for _, x in edges[3]}), 10)
        for number, path in particles.items():
            cell = (number - 1) // PER_CELL + 1
            for (t, x), (tl, low), (th, high) in zip(path, edges[cell], edges[cell + 1]):
                self.assertTrue(t == tl == th and low < x < high, (number, t))

    def test_seen(self):
        self.assertEqual(self.plot("xt", "-o", "fig.svg").stderr, "")
        texts = self.texts()
        for expected in ("small", "standard", "moving-mesh", "spline-particle", "particles", "cell edges", "crossings", "time [s]"):
            self.assertEqual(texts.count(expected), 1, expected)
        self.assertEqual(texts.count("x [m]"), 3)
        ranges = re.findall(r"set [xy]range .*", (self.dir / "fig.gp").read_text())
        self.assertEqual(len(ranges), 2)  # the same for all panels

    def test_many_particles_are_thinned(self):
        self.run_study("many", STUDY.replace(f"cells: {CELLS}", "cells: 100").replace("periods: 0.5", "periods: 0.01"))
        self.plot("xt", "-o", "fig.svg", study="many.study")
        self.assertEqual(sorted(self.paths("standard", "particle")), list(range(1, 301, 5)))
        self.assertTrue([t for t in self.texts() if "more than 64" in t])

    def test_a_row_of_a_body_in_the_plane(self):
        self.run_study("disks", "problem: {name: colliding-disks}\nmesh: {cells: 10, particles_per_cell: 2}\n"
                                "method: {space: standard}\ntime: {end: 0.3}\noutput: {snapshots: 5}\n")
        self.plot("xt", "-o", "fig.svg", study="disks.study")
        starts = [float(rows[0]["x"]) for label, rows in self.lines().items() if label.startswith("particle ")]
        self.assertGreaterEqual(len(starts), 7)  # the width of a disk, 0.4
        self.assertGreater(max(starts) - min(starts), 0.3)
        gaps = [b - a for a, b in zip(sorted(starts), sorted(starts)[1:])]
        self.assertTrue(all(math.isclose(g, 0.05, rel_tol=1e-9) for g in gaps), gaps)

    def test_failed_cases_are_drawn_as_far_as_they_came(self):
        self.run_study("wild", STUDY.replace("[standard, moving-mesh, spline-particle]", "standard").replace("cfl: 0.2", "cfl: [0.2, 3]"))
        status = [c["result.status"] for c in self.rows("wild.study/table.csv")]
        self.assertEqual(status[0], "ok")
        self.assertNotEqual(status[1], "ok")
        self.plot("xt", "-o", "fig.svg", study="wild.study")
        self.assertIn(f"cfl 3: {status[1]}", self.texts())


class Field(Case):
    def test_exact_solution_and_errors(self):
        end = {c["method.space"]: c for c in self.rows("small.study/table.csv")}
        t = float(end["standard"]["result.time"])
        self.plot("field", "-o", "fig.svg")
        lines = self.lines()
        self.assertEqual(sorted(lines), ["exact", "moving-mesh", "spline-particle", "standard"])
        for row in lines["exact"]:
            X = float(row["x"]) - float(row["displacement"])
            self.assertTrue(math.isclose(float(row["displacement"]), displacement(X, t), abs_tol=1e-13))
        self.assertEqual([float(r["x"]) for r in lines["exact"]], sorted(float(r["x"]) for r in lines["exact"]))
        for quantity, name in (("displacement", "error"), ("velocity", "error.velocity"), ("stress", "error.stress")):
            self.plot("field", "--y", name, "-o", "fig.svg")
            lines = self.lines()
            self.assertEqual(sorted(lines), ["moving-mesh", "spline-particle", "standard"])
            for space, case in end.items():
                rms = math.sqrt(sum(float(r[name]) ** 2 for r in lines[space]) / len(lines[space]))
                self.assertTrue(math.isclose(rms, float(case[f"result.{quantity}.final.rms"]), rel_tol=1e-10), (space, name))

    def test_stress_is_cauchy_s(self):
        self.plot("field", "--y", "stress", "--time", "0", "-o", "fig.svg")
        for row in self.lines()["exact"]:
            low, high = 0.0, 1.0  # X of x, by bisection
            for _ in range(60):
                X = (low + high) / 2
                low, high = (X, high) if X + displacement(X, 0) < float(row["x"]) else (low, X)
            F = 1 + 2 * math.pi * AMPLITUDE * math.cos(2 * math.pi * X)
            self.assertTrue(math.isclose(float(row["stress"]), MODULUS / 2 * (F - 1 / F), rel_tol=1e-9, abs_tol=1e-6))
        self.assertIn("stress [Pa]", self.texts())

    def test_time_chooses_the_nearest_snapshot(self):
        for asked, shown in (("0", "at 0 s"), ("0.00312", "at 0.003125 s"), ("7", "at 0.01 s")):
            self.plot("field", "--time", asked, "-o", "fig.svg")
            dt = 0.2 / CELLS / math.sqrt(MODULUS)
            expected = min(max(round(float(asked) / dt) * dt, 0), 0.01)
            found = [float(t.split()[1]) for t in self.texts() if re.fullmatch(r"at \S+ s", t)]
            self.assertTrue(math.isclose(found[0], expected, rel_tol=1e-4, abs_tol=1e-12), (asked, found, shown))

    def test_in_the_plane(self):
        self.run_study("box", BOX)
        value = {}
        for name in ("error", "error.x", "error.y", "stress.xy"):
            self.assertEqual(self.plot("field", "--y", name, "-o", "fig.svg", study="box.study").stderr, "")
            rows = self.rows("fig.csv")
            self.assertEqual(list(rows[0]), ["line", "x", "y", "label", name])
            value[name] = [float(r[name]) for r in rows]
        for whole, x, y in zip(value["error"], value["error.x"], value["error.y"]):
            self.assertTrue(math.isclose(whole, math.hypot(x, y), rel_tol=1e-14))
        for i, case in enumerate(self.rows("box.study/table.csv")):
            mine = value["error"][i * 144:(i + 1) * 144]
            rms = math.sqrt(sum(e * e for e in mine) / len(mine))
            self.assertTrue(math.isclose(rms, float(case["result.displacement.final.rms"]), rel_tol=1e-10))
        texts, script = self.texts(), (self.dir / "fig.gp").read_text()
        for expected in ("standard", "moving-mesh", "y [m]", "stress.xy [Pa]"):
            self.assertEqual(texts.count(expected), 1, expected)
        margins = [float(m) for m in re.findall(r"margin at screen (\S+)", script)]
        width, height = map(float, re.search(r"svg size (\d+),(\d+)", script).groups())
        spans = [[float(v) for v in re.search(rf"set {a}range \[(.*):(.*)\]", script).groups()] for a in "xy"]
        for left, right, top, bottom in zip(*[iter(margins)] * 4):
            shape = (top - bottom) * height / ((right - left) * width)
            self.assertTrue(math.isclose(shape, (spans[1][1] - spans[1][0]) / (spans[0][1] - spans[0][0]), rel_tol=0.01))

    def test_a_layer_in_space(self):
        self.run_study("cube", BOX.replace("dimension: 2", "dimension: 3").replace("cells: 6", "cells: 4").replace("0.2}", "0.02}"))
        self.plot("field", "--y", "velocity", "-o", "fig.svg", study="cube.study")
        self.assertEqual(len(self.rows("fig.csv")), 2 * 64)
        self.assertTrue([t for t in self.texts() if "the layer of particles that starts at z = 0.4375 m" in t])


class Both(Case):
    def test_equal_bytes(self):
        self.run_study("box", BOX)
        for kind, study in (("xt", "small.study"), ("field", "small.study"), ("field", "box.study")):
            for ending in ("svg", "png", "pdf"):
                names = [f"fig.{e}" for e in (ending, "csv", "gp")]
                self.plot(kind, "-o", names[0], study=study)
                first = [(self.dir / name).read_bytes() for name in names]
                time.sleep(0.1 if ending == "svg" else 1.1)
                self.plot(kind, "-o", names[0], study=study, env={**os.environ, "TZ": "Asia/Tokyo"})
                self.assertEqual(first, [(self.dir / name).read_bytes() for name in names], (kind, study, ending))

    def test_hostile_names(self):
        name = "a'b \"c\" `touch p1` $(touch p2) %d @x {/Bold y} z^2 \\n <script> & # ; system('touch p3')"
        title = "".join(f"\\x{ord(c):02x}" for c in name + "\nnext")
        self.run_study("box", BOX.replace("title: box", f'title: "{title}"'))
        for study in ("small.study", "box.study"):
            hostile = f"{study} {name}".replace("/", "|")
            shutil.copytree(self.dir / study, self.dir / hostile)
            for kind in ("xt", "field"):
                self.call("plot", hostile, kind, "--by", "study", "-o", "fig.svg")
                texts = [" ".join(t.split()) for t in self.texts()]
                if study == "box.study":
                    self.assertIn(" ".join((name + " next").split()), texts)
                shown = [t for t in texts if hostile in t]
                self.assertTrue(shown, texts)
        self.assertEqual([p.name for p in self.dir.rglob("*") if re.fullmatch(r"p\d", p.name)], [])

    def test_messages(self):
        self.run_study("none", STUDY.replace("{snapshots: 1}", "{histories: 5}"))
        self.run_study("wide", STUDY.replace("cfl: 0.2", "cfl: [0.05, 0.1, 0.2, 0.3, 0.4]"))
        self.run_study("disks", "problem: {name: colliding-disks}\nmesh: {cells: 10, particles_per_cell: 2}\n"
                                "method: {space: standard}\ntime: {end: 0.1}\noutput: {snapshots: 5}\n")
        for study, args, hint in [
            ("none", ["xt"], "set output.snapshots"), ("none", ["field"], "set output.snapshots"), ("wide", ["xt"], "--where"),
            ("small", ["xt", "--y", "stress"], "leave out --y"), ("small", ["xt", "--time", "1"], "leave out --time"),
            ("small", ["field", "--x", "x"], "leave out --x"), ("small", ["field", "--front"], "no front"),
            ("small", ["--time", "1"], "leave out --time"), ("small", ["field", "--time", "1x"], "takes seconds"),
            ("small", ["field", "--time", "nan"], "takes seconds"), ("small", ["field", "--y", "strain"], "no field 'strain'"),
            ("small", ["field", "--y", "stress.x"], "no field"), ("small", ["field", "--y", "error.q"], "no field"),
            ("small", ["field", "--y", "displacement.y"], "no such component in 1-D"),
            ("disks", ["field", "--y", "stress.xz"], "no such component in 2-D"),
            ("disks", ["field", "--y", "error"], "no exact solution"),
        ]:
            with self.subTest(study=study, args=args):
                self.assertIn(hint, self.plot(*args, "-o", "fig.svg", study=f"{study}.study", code=2).stderr)
        self.assertFalse((self.dir / "fig.csv").exists())

    def test_damaged_snapshots(self):
        for path in self.dir.glob("small.study/case-*.h5"):
            path.write_bytes(path.read_bytes()[:700])
        for kind in ("xt", "field"):
            self.assertIn("damaged", self.plot(kind, "-o", "fig.svg", code=2).stderr)

    def test_gnuplot_absent(self):
        for kind in ("xt", "field"):
            done = self.plot(kind, "-o", "fig.svg", code=1, env={"PATH": str(self.dir)})
            self.assertIn("fig.gp and fig.csv are written", done.stderr)


unittest.main(argv=sys.argv[:1])
