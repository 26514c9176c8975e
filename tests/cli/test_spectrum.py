# SPDX-License-Identifier: GPL-3.0-or-later
"""gridcross spectrum, and spectra in files and figures. usage: test_spectrum.py GRIDCROSS SOURCE_ROOT"""
import csv
import io
import math
import pathlib
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from seal import seal
from studied import PROGRAM, Studied

PROGRAM, ROOT = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
STUDY = """title: small
problem: {name: bar-neo-hookean}
mesh: {cells: [8, 12]}
method: {space: [standard, moving-mesh], degree: 2}
time: {cfl: 0.4, periods: 1}
output: {spectra: 7, frequency: 1}
"""
QUANTITIES = ("displacement", "velocity", "stress")
PYTHON = "/usr/bin/python3"  # of the system: where h5py is


class Case(Studied):
    study = STUDY

    def table(self, study="small.study"):
        return list(csv.DictReader((self.dir / study / "table.csv").read_text().splitlines()))

    def spectra(self, *args):
        return list(csv.DictReader(io.StringIO(self.call("spectrum", "small.study", "--csv", *args).stdout)))


class Spectrum(Case):
    def test_squares_sum_to_the_table_s_errors(self):
        for quantity in QUANTITIES:
            rows = self.spectra("--quantity", quantity)
            self.assertEqual(list(rows[0]), ["case", "time", "wavenumber", quantity])
            for case in self.table():
                mine = [r for r in rows if r["case"] == case["case"]]
                last = [r for r in mine if r["time"] == mine[-1]["time"]]
                self.assertEqual(float(last[0]["time"]), float(case["result.time"]))
                n = 4 * int(case["mesh.cells"])
                self.assertEqual([float(r["wavenumber"]) for r in last], list(range(n // 2 + 1)))
                samples = -(-int(case["result.steps"]) // 7) + 1
                self.assertEqual(len(mine), samples * (n // 2 + 1))
                squares = [float(r[quantity]) ** 2 for r in last]
                error = float(case[f"result.{quantity}.final.rms"])
                self.assertTrue(math.isclose(math.fsum(squares), error**2, rel_tol=1e-12))
                nyquist = int(case["mesh.cells"]) // 2
                for part, some in (("below", squares[:nyquist + 1]), ("above", squares[nyquist + 1:]), ("driven", squares[1:2])):
                    value = float(case[f"result.spectrum.{quantity}.{part}"])
                    self.assertTrue(math.isclose(value**2, math.fsum(some), rel_tol=1e-12), part)

    def test_summary_names_the_cases(self):
        done = self.call("spectrum", "small.study")
        self.assertEqual(done.stderr, "")
        for case in self.table():
            line = next(one for one in done.stdout.splitlines() if one.startswith(case["case"]))
            self.assertIn(f"{float(case['result.spectrum.displacement.above']):.4g}".replace("e-0", "e-"), line)
        self.assertIn("spectrum.stress.above", self.call("spectrum", "small.study", "--quantity", "stress").stdout)

    def test_one_case(self):
        case = self.table()[1]
        out = self.call("spectrum", "small.study", "--case", case["case"]).stdout
        self.assertEqual(out, self.call("spectrum", "small.study", "--case", case["case"][:6]).stdout)
        for word in (f"case {case['case']}", "driven wavenumber 1/m", f"Nyquist wavenumber of the grid {int(case['mesh.cells']) // 2}/m",
                     "displacement.rms", "growth", "share above"):
            self.assertIn(word, out)
        marks = [line.split()[0] for line in out.splitlines() if line.split()[-1:] in (["driven"], ["Nyquist"])]
        self.assertEqual(marks, ["1", str(int(case["mesh.cells"]) // 2)])
        self.assertEqual({r["case"] for r in self.spectra("--case", case["case"][:6])}, {case["case"]})

    def test_a_case_that_failed_shows_how_far_it_came(self):
        self.call("run", "small.yaml", "-q", "-o", "fast.study", "--set", "time.cfl=1.5", "--set", "mesh.cells=32", "--set",
                  "method.space=standard", "--set", "output.spectra=1")
        self.assertNotEqual(self.table("fast.study")[0]["result.status"], "ok")
        self.assertIn("samples", self.call("spectrum", "fast.study").stdout)

    def test_questions_that_have_no_answer(self):
        self.call("run", "small.yaml", "-q", "-o", "none.study", "--set", "output.spectra=0")
        for args, hint in [
            (["small.study", "--quantity", "strss"], "did you mean stress?"), (["small.study", "--quantity", "x"], "there are"),
            (["small.study", "--case", "zz"], "no case"), (["small.study", "--case", ""], "more than one"), ([], "missing"),
            (["none.study"], "set output.spectra"), (["none.study", "--csv"], "set output.spectra"), (["nowhere"], "nowhere"),
            (["none.study", "--case", self.table("none.study")[0]["case"]], "set output.spectra"), (["small.study", "x"], "too many"),
        ]:
            with self.subTest(args=args):
                done = self.call("spectrum", *args, code=2)
                self.assertEqual(done.stdout, "")
                self.assertIn(hint, done.stderr)

    def test_uneven_particles_are_refused(self):
        self.call("run", "small.yaml", "-q", "--set", "mesh.layout=[uniform, gauss]")
        rows = {row["mesh.layout"]: row for row in self.table()}
        self.assertEqual(rows["uniform"]["result.status"], "ok")
        self.assertEqual(rows["gauss"]["result.status"], "refused")
        self.assertIn("uniform", rows["gauss"]["result.reason"])
        self.assertEqual(len({r["case"] for r in self.spectra()}), 4)

    def test_rare_samples_of_the_frequency_are_refused(self):
        self.call("run", "small.yaml", "-q", "--set", "output.frequency=40")
        self.assertEqual({row["result.status"] for row in self.table()}, {"refused"})
        self.assertIn("four times a period", self.table()[0]["result.reason"])


    def test_more_spectra_than_anyone_can_look_at_are_refused(self):
        self.call("run", "small.yaml", "-q", "--set", "time.cfl=1e-6", "--set", "output.spectra=1")
        self.assertEqual({row["result.status"] for row in self.table()}, {"refused"})
        self.assertIn("make output.spectra larger", self.table()[0]["result.reason"])


class Files(Case):
    def test_equal_bytes_for_every_j(self):
        for j, name in ((1, "a"), (8, "b")):
            self.call("run", "small.yaml", "-q", "-o", name, "-j", j, "--set", "mesh.cells=[5, 6, 7, 8, 9, 10, 11]", "--set",
                      "mesh.particles_per_cell=[1, 3]")
        for file in ("study.h5", "table.csv"):
            self.assertEqual((self.dir / "a" / file).read_bytes(), (self.dir / "b" / file).read_bytes())

    def test_damaged_files(self):
        path = self.dir / "small.study" / "study.h5"
        whole = path.read_bytes()
        for cut in (0, 100, 1000, len(whole) // 2, len(whole) - 1):
            path.write_bytes(whole[:cut])
            done = self.call("spectrum", "small.study", code=2)
            self.assertEqual(done.stdout, "")
            self.assertIn("study.h5", done.stderr)
            self.assertNotIn("HDF5-DIAG", done.stderr)

    def test_foreign_spectra(self):
        if subprocess.run([PYTHON, "-c", "import h5py"], capture_output=True).returncode:
            self.skipTest("no h5py")
        path = self.dir / "small.study" / "study.h5"
        whole, case = path.read_bytes(), self.table()[0]["case"]
        for change, hint in [
            ("del g['velocity']", "damaged"), ("g['more'] = g['time'][:]", "damaged"), ("g.move('stress', 'strain')", "damaged"),
            ("g['wavenumber'][3] = 2.5", "damaged"), ("g['time'][1] = 0.5", "damaged"), ("g['stress'][5] = -1", "damaged"),
            ("a = g['time'][:-1]; del g['time']; g['time'] = a", "damaged"), ("del f['spectra']", "output.spectra"),
            ("del g.parent[g.name]", "output.spectra"),
            ("del g['stress']; g.create_group('stress')", "damaged"), ("del f['table']['mesh.cells']", "damaged"),
        ]:
            with self.subTest(change=change):
                path.write_bytes(whole)
                script = f"import h5py\nf = h5py.File({str(path)!r}, 'r+')\ng = f['spectra']['{case}']\n{change}\nf.close()"
                done = subprocess.run([PYTHON, "-c", script], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("changed by another program", self.call("spectrum", "small.study", code=2).stderr)
                seal(path)
                done = self.call("spectrum", "small.study", "--case", case, code=2)
                self.assertEqual(done.stdout, "")
                self.assertIn(hint, done.stderr)


class RunFiles(Case):
    def test_dispersion_orders(self):
        self.call("run", ROOT / "runs" / "dispersion-orders.yaml", "-q", "--set", "mesh.cells=[12, 16]")
        done = self.call("compare", "dispersion-orders.study", "--rows", "mesh.cells", "--columns", "method.degree", "--value",
                         "result.frequency.error", "--csv")
        orders = {int(r["method.degree"]): float(r["result.frequency.error.order"]) for r in
                  csv.DictReader(io.StringIO(done.stdout)) if r["result.frequency.error.order"]}
        for degree, order in orders.items():
            self.assertAlmostEqual(order, 2 * degree, delta=0.6)
        self.assertEqual(sorted(orders), [1, 2, 3, 4, 5])

    def test_dispersion_is_that_of_its_head(self):
        self.call("run", ROOT / "runs" / "dispersion.yaml", "-q")
        seen = 0
        for row in self.table("dispersion.study"):
            self.assertEqual(row["result.status"], "ok")
            if row["method.basis"] != "linear" or not row["result.frequency.ratio"]:
                continue
            t = float(row["result.frequency.kh"])
            self.assertAlmostEqual(t, 2 * math.pi * int(row["problem.mode"]) / 16)
            mass = (2 + math.cos(t)) / 3
            factor = 1 / math.sqrt(mass) if row["method.mass"] == "consistent" else \
                math.sqrt(mass) if row["method.projection"] == "each-step" else 1
            self.assertAlmostEqual(float(row["result.frequency.ratio"]), 2 * math.sin(t / 2) / t * factor, delta=1e-6)
            seen += 1
        self.assertEqual(seen, 3 * 7)

    def test_spectra_are_those_of_its_head(self):
        self.call("run", ROOT / "runs" / "spectra.yaml", "-q")
        value = {}
        for row in self.table("spectra.study"):
            key = row["method.space"], int(row["method.degree"]), int(row["mesh.cells"])
            value[key] = [float(row[f"result.spectrum.{c}"]) for c in ("stress.growth", "stress.above", "displacement.above")]
        for (space, degree, cells), (growth, stress, displacement) in value.items():
            if space == "standard":
                self.assertTrue(4 < growth < 14, growth)
            else:
                self.assertLess(growth, 1.1)
            if cells == 64:
                stress_order = math.log2(value[space, degree, 32][1] / stress)
                displacement_order = math.log2(value[space, degree, 32][2] / displacement)
                if space == "standard":
                    self.assertLess(stress_order, 0.5)
                else:
                    self.assertAlmostEqual(stress_order, degree, delta=0.1)
                    self.assertAlmostEqual(displacement_order, degree + 1, delta=0.1)


unittest.main(argv=sys.argv[:1])
