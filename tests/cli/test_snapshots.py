# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of snapshots in a study directory: which there are, and that they outlive --resume. usage: test_snapshots.py GRIDCROSS"""
import csv
import resource
import signal
import sys
import unittest

sys.dont_write_bytecode = True
from studied import Studied

STUDY = """title: small
problem: {name: bar-neo-hookean}
mesh: {cells: [4, 8]}
method: {space: [standard, spline-particle]}
time: {steps: 6}
output: {snapshots: 3}
"""


class Snapshots(Studied):
    study = STUDY

    def ids(self, study="small.study"):
        return [row["case"] for row in csv.DictReader((self.dir / study / "table.csv").read_text().splitlines())]

    def files(self, study="small.study"):
        return {p.name: p.read_bytes() for p in (self.dir / study).glob("*case-*")} | {
            p.name: p.read_bytes() for p in (self.dir / study).glob(".*")}

    def test_a_case_has_its_files(self):
        grid, no_grid = self.ids()[0], self.ids()[1]
        names = set(self.files())
        self.assertEqual(len(names), 4 + 4 + 2)
        self.assertLess({f"case-{grid}.h5", f"case-{grid}.xmf", f"case-{grid}-grid.xmf", f"case-{no_grid}.xmf"}, names)
        self.assertNotIn(f"case-{no_grid}-grid.xmf", names)

    def test_resume_runs_again_what_lacks_its_snapshots(self):
        before, one = self.files(), self.ids()[2]
        (self.dir / f"small.study/case-{one}.h5").unlink()
        done = self.call("run", "small.yaml", "--resume")
        self.assertIn("3 of 4 cases are done already", done.stderr)
        self.assertEqual(self.files(), before)
        self.assertNotIn("done already", self.call("run", "small.yaml", "-o", "fresh").stderr)

    def test_a_new_study_removes_the_snapshots_of_the_old(self):
        old = self.ids()
        (self.dir / f"small.study/.case-{old[0]}.h5.partial").write_text("left by a kill")
        (self.dir / "small.study/case-notes.txt").write_text("mine")
        self.call("run", "small.yaml", "-q", "--set", "mesh.cells=8")
        kept = {name for name in self.files() if name != "case-notes.txt"}
        self.assertEqual({name[5:21] for name in kept}, set(self.ids()))
        self.assertTrue((self.dir / "small.study/case-notes.txt").exists())
        (self.dir / "plain.yaml").write_text(STUDY.partition("output")[0])
        self.call("run", "plain.yaml", "-q", "-o", "small.study")
        self.assertEqual(set(self.files()), {"case-notes.txt"})

    def test_a_disk_that_is_full_ends_the_run_and_is_gone_on_from(self):
        def full():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        whole = self.files()
        done = self.call("run", "small.yaml", "-o", "full", code=1, preexec_fn=full)
        self.assertRegex(done.stderr, r"full/case-[0-9a-f]{16}\.h5: File too large")
        self.assertIn("--resume goes on", done.stderr)
        self.assertFalse(any(name.endswith(".h5") for name in self.files("full")), self.files("full").keys())
        self.call("run", "small.yaml", "-o", "full", "--resume")
        self.assertEqual(self.files("full"), whole)

    def test_what_is_too_much_is_refused(self):
        (self.dir / "large.yaml").write_text(STUDY.replace("steps: 6", "steps: 1000000000").replace("snapshots: 3", "snapshots: 1"))
        done = self.call("check", "large.yaml")
        self.assertIn("GB: make output.snapshots larger", done.stdout + done.stderr)


unittest.main(argv=sys.argv[:1])
