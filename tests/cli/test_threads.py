# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads inside a case change no byte of a table. usage: test_threads.py GRIDCROSS"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
# Particles enough for several parts, slabs that particles cross, and clocks of rows and of rates.
CASE = """problem: {{name: axis-aligned, dimension: {dim}, poisson: 0.3, boundary: {boundary}, amplitude: 0.08}}
mesh: {{cells: {cells}, particles_per_cell: {per_cell}}}
method: {{space: {space}, basis: {basis}, clock: {clock}}}
time: {{cfl: 0.3, steps: 12}}
"""
METHODS = [("standard", "bspline", "central-difference", "periodic"), ("standard", "bspline", "stormer-verlet", "fixed"),
           ("standard", "cpgimp", "euler-stress-first", "periodic"), ("moving-mesh", "bspline", "rk4", "periodic"),
           ("moving-mesh", "linear", "central-difference", "fixed")]


class Threads(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.dir = pathlib.Path(place.name)

    def table(self, text, jobs, *options):
        (self.dir / "case.yaml").write_text(text)
        done = subprocess.run([PROGRAM, "run", "case.yaml", "-q", "-j", str(jobs), "-o", f"j{jobs}", *options], cwd=self.dir,
                              capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.dir / f"j{jobs}" / "table.csv").read_bytes()

    def test_one_case_on_any_number_of_threads(self):
        for dim, cells, per_cell in ((2, 20, 3), (3, 8, 2)):
            for space, basis, clock, boundary in METHODS:
                with self.subTest(dim=dim, space=space, basis=basis, clock=clock, boundary=boundary):
                    text = CASE.format(dim=dim, cells=cells, per_cell=per_cell, space=space, basis=basis, clock=clock,
                                       boundary=boundary)
                    alone = self.table(text, 1)
                    self.assertIn(b",ok,", alone)
                    for jobs in (2, 3, 7):
                        self.assertEqual(self.table(text, jobs), alone, f"-j {jobs}")

    def test_threads_are_shared_between_cases(self):
        text = CASE.format(dim=2, cells="[6, 8, 20]", per_cell=3, space="standard", basis="bspline", clock="central-difference",
                           boundary="periodic")
        alone = self.table(text, 1)
        for jobs in (2, 4, 7):
            self.assertEqual(self.table(text, jobs, "--repeats", "2"), alone, f"-j {jobs}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
