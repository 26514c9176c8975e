# SPDX-License-Identifier: GPL-3.0-or-later
"""gridcross balance, and the budget's line after a run. usage: test_balance.py GRIDCROSS SOURCE_ROOT"""
import csv
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROOT = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
FILE = ROOT / "runs" / "balance.yaml"


class Balance(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)

    def call(self, *args, code=0):
        done = subprocess.run([PROGRAM, *map(str, args)], cwd=self.place.name, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, code, f"{args}: {done.stdout[-500:]}\n{done.stderr[-500:]}")
        return done

    def test_the_four_cases_of_the_paper(self):
        """steffen2010 §6.4: c1, c2 and the transitions, with 2048 cells."""
        rows = json.loads(self.call("balance", FILE, "--json").stdout)
        paper = {("moving-mesh", 1): (1.8764e4, 1.9918e-5), ("moving-mesh", 2): (None, 2.3908e-5),
                 ("standard", 1): (6.0538e1, 5.1195e-5), ("standard", 2): (None, 2.6507e-5)}
        self.assertEqual(len(rows), 4)
        for row in rows:
            c1, dt = paper[row["method.space"], row["method.degree"]]
            self.assertEqual(row["mesh.cells"], 2048)
            self.assertAlmostEqual(row["result.balance.predicted_dt"] / dt, 1, delta=1e-3)
            self.assertAlmostEqual(row["result.balance.c2"] / 1.1277442e7, 1, delta=1e-4)
            self.assertAlmostEqual(row["result.balance.time_order"], 3, delta=0.01)
            if c1:
                self.assertAlmostEqual(row["result.balance.c1"] / c1, 1, delta=1e-4)
            measured = row["result.balance.measured_dt"] / row["result.balance.predicted_dt"]
            self.assertAlmostEqual(measured, 1, delta=0.05)
            self.assertGreater(row["result.balance.predicted_dt"], 3 * row["result.balance.stable_dt"])
            self.assertLess(row["result.balance.time_over_space"], 0.1)
            order = 1.4 if (row["method.space"], row["method.degree"]) == ("standard", 1) else 2
            self.assertAlmostEqual(row["result.balance.space_order"], order, delta=0.1)

    def test_where_the_curves_meet(self):
        """Standard, linear: the error at 2048 cells is 2.72613e-2, below c1 h, and meets c2 dt^2 at 4.917e-5."""
        rows = list(csv.DictReader(io.StringIO(self.call("balance", FILE, "--csv").stdout)))
        row = next(r for r in rows if r["method.space"] == "standard" and r["method.degree"] == "1")
        self.assertAlmostEqual(float(row["result.balance.measured_dt"]) / 4.9167e-5, 1, delta=2e-3)

    def test_advice_is_in_numbers(self):
        """Compressed to F = 0.8, a linear cell is stable to about 0.88 h/c = 4.3e-6; the estimate ends within some per cent."""
        one = ("balance", FILE, "--set", "method.space=moving-mesh", "--set", "method.degree=1")
        row, = csv.DictReader(io.StringIO(self.call(*one, "--csv").stdout))
        stable, balance, share = (float(row[f"result.balance.{name}"]) for name in ("stable_dt", "predicted_dt", "time_over_space"))
        self.assertAlmostEqual(stable / 4.3e-6, 1, delta=0.05)
        self.assertAlmostEqual(share / (stable / balance) ** 2, 1, delta=0.01)
        self.assertIn(f"time error is {100 * share:.2g} % of the space error: run near that step", self.call(*one).stdout)
        euler = self.call("balance", FILE, "--set", "method.space=moving-mesh", "--set", "method.clock=euler-stress-last").stdout
        self.assertIn("take a clock of higher order", euler)

    def test_ends_do_not_matter(self):
        one = self.call("balance", FILE, "--csv").stdout
        self.assertEqual(self.call("balance", FILE, "--csv", "--set", "time.periods=5", "-j", 1).stdout, one)

    def test_what_cannot_be_balanced(self):
        for sets, words in ((["time.dt=1e-4"], "1 time step; give time.dt a list of three or more"),
                            (["mesh.cells=[64, 128]"], "2 meshes and 7 time steps; give mesh.cells a list"),
                            (["time.cfl=0.1"], "time.cfl ties the step to the mesh; give time.dt")):
            done = self.call("balance", FILE, *(a for s in sets for a in ("--set", s)), code=2)
            self.assertIn(words, done.stderr)
            self.assertIn("balance.yaml: ", done.stderr)
            self.assertEqual(done.stdout, "")
        done = self.call("balance", ROOT / "runs" / "spline-orders.yaml", code=2)
        self.assertIn("has no grid", done.stderr)
        self.call("balance", code=2)
        self.call("balance", FILE, "--csv", "--json", code=2)

    def test_a_start_without_acceleration_is_named(self):
        """At time 0 the wave is undeformed: no step from there errs, and it is not the lists that are too short."""
        file = pathlib.Path(self.place.name) / "still.yaml"
        file.write_text("problem: {name: bar-linear}\nmesh: {cells: [4, 8, 16]}\ntime: {dt: [1e-6, 1e-5, 1e-4]}\n")
        told = self.call("balance", file, code=2).stderr
        self.assertIn("time.start", told)
        self.assertNotIn("a list of three", told)
        self.assertNotIn("memory", told)
        self.call("balance", file, "--set", "time.start=2e-3")

    def test_a_run_names_what_dominates(self):
        file = pathlib.Path(self.place.name) / "bar.yaml"
        file.write_text("problem: {name: bar-linear, modulus: 16}\nmesh: {cells: 100, particles_per_cell: 2}\n"
                        "method: {basis: cpgimp, clock: rk4}\ntime: {dt: 1e-4, periods: 0.1}\noutput: {budget: 20}\n")
        out = self.call("run", file, "-q").stdout
        self.assertIn("error of a step: in velocity quadrature dominates, ", out)
        self.assertIn("; in displacement lumping dominates, ", out)
        self.assertEqual(out.count("error of a step"), 1)
        self.assertNotIn("error of a step", self.call("run", file, "-q", "--csv").stdout)
        (file.parent / "plain.yaml").write_text(file.read_text().replace("output: {budget: 20}\n", ""))
        self.assertNotIn("error of a step", self.call("run", "plain.yaml", "-q").stdout)

    def test_budgets_outlive_a_step_that_fails(self):
        """The budget of a step is taken before the run takes it: compare shows it where the case itself tangled."""
        file = pathlib.Path(self.place.name) / "bar.yaml"
        file.write_text("problem: {name: bar-neo-hookean}\nmesh: {cells: [512, 1024]}\nmethod: {basis: linear}\n"
                        "time: {dt: 1e-4, steps: 1, start: 2.122e-3}\noutput: {budget: 1}\n")
        self.assertIn("tangled", self.call("run", file, "-q").stdout)
        out = self.call("compare", "bar.study", "--value", "result.budget.l2.projected").stdout
        self.assertNotIn("tangled", out)
        self.assertIn("5.91e-2", out)
        self.assertIn("1.2", out)  # the order
        self.assertIn("tangled", self.call("compare", "bar.study", "--value", "result.displacement.final.rms").stdout)

    def test_budgets_are_in_histories(self):
        file = pathlib.Path(self.place.name) / "bar.yaml"
        file.write_text("problem: {name: bar-linear, modulus: 16}\nmesh: {cells: 20}\ntime: {dt: 1e-3, steps: 7}\n"
                        "output: {budget: 3, histories: 2}\n")
        self.call("run", file, "-q")
        self.call("plot", "bar.study", "history", "--y", "budget.velocity.quadrature", "-o", "q.svg")
        rows = list(csv.DictReader(io.StringIO((file.parent / "q.csv").read_text())))
        self.assertEqual([round(1e3 * float(r["time"])) for r in rows], [3, 6, 7])  # those of the budget, of 0 2 3 4 6 7
        self.assertTrue(all(float(r["budget.velocity.quadrature"]) > 0 for r in rows))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
