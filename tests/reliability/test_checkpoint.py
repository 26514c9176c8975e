# SPDX-License-Identifier: GPL-3.0-or-later
"""A case that is killed behind a checkpoint goes on from there to the bytes of an undisturbed run. usage: test_checkpoint.py GRIDCROSS"""
import csv
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # beside the sources
from runs import Runs

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
# one case of many more steps than are taken until it is looked at; its measures and files are those of a short one
STUDY = """problem: {name: bar-neo-hookean}
mesh: {cells: 64}
method: {space: moving-mesh}
time: {cfl: 0.0005}
output: {checkpoint: 32000, histories: 5000, snapshots: 20000, spectra: 50000, frequency: 1000, probe: 0.3}
"""


class Checkpoint(Runs):
    program = PROGRAM

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.dir = pathlib.Path(temporary.name)
        (cls.dir / "study.yaml").write_text(STUDY)
        (cls.dir / "other.yaml").write_text(STUDY.replace("0.3}", "0.6}"))
        cls.call(cls, "run", "study.yaml", "-o", "whole", "-q")
        cls.whole = cls.files_of(cls, "whole")
        cls.kill_behind(cls, "study.yaml", "cut")

    def setUp(self):
        """All in one place."""

    def kill_behind(self, study, directory, *args, by=signal.SIGKILL):
        """Ends a run as soon as there is a checkpoint that was not there. Returns what it said."""
        checkpoint = lambda: {(p, p.stat().st_mtime_ns) for p in (self.dir / directory).glob(".case-*.checkpoint")}
        old = checkpoint()
        process = subprocess.Popen([PROGRAM, "run", study, "-o", directory, *args], cwd=self.dir, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not checkpoint() - old:
            time.sleep(0.001)
        process.send_signal(by)
        out, err = process.communicate()
        if process.returncode == 0:
            raise unittest.SkipTest("the case was done before it could be killed")
        return err

    def copy(self, name):
        shutil.copytree(self.dir / "cut", self.dir / name)
        (path,) = (self.dir / name).glob(".case-*.checkpoint")
        return path

    def resume_ends_whole(self, directory):
        done = self.call("run", "study.yaml", "-o", directory, "--resume")
        now = self.files_of(directory)
        self.assertEqual(sorted(now), sorted(self.whole))
        for name, content in now.items():
            self.assertTrue(content == self.whole[name], f"{name} differs")
        return done.stderr

    def test_killed_again_and_again(self):
        self.copy("killed")
        steps = []
        for by in (signal.SIGKILL, signal.SIGINT):
            said = self.kill_behind("study.yaml", "killed", "--resume", by=by)
            self.assertIn("goes on from step ", said)
            steps.append(int(said.split("goes on from step ")[1].split()[0]))
        said = self.resume_ends_whole("killed")
        steps.append(int(said.split("goes on from step ")[1].split()[0]))
        self.assertEqual(steps, sorted(set(steps)))
        self.assertTrue(all(step > 0 and step % 32000 == 0 for step in steps[:2]), steps)  # the last was interrupted

    def test_a_killed_shard_goes_on(self):
        other = ("--set", "mesh.cells=[64, 8]")
        self.call("run", "study.yaml", "-o", "undivided", "-q", *other)
        self.call("run", "study.yaml", "-o", "second", "-q", "--shard", "2/2", *other)
        self.kill_behind("study.yaml", "first", "--shard", "1/2", *other)
        said = self.call("run", "study.yaml", "-o", "first", "--shard", "1/2", "--resume", *other).stderr
        self.assertIn("goes on from step", said)
        self.call("merge", "first", "second", "-o", "merged")
        self.assertTrue(self.files_of("merged") == self.files_of("undivided"))

    def row_of(self, directory):
        with (self.dir / directory / "table.csv").open() as file:
            (row,) = csv.DictReader(file)
        return {name: value for name, value in row.items() if name not in ("case", "output.checkpoint")}

    def test_an_interrupt_keeps_the_steps_that_are_done(self):
        never = ("run", "study.yaml", "-o", "soon", "--set", "output.checkpoint=1000000000")
        patience = 0.02
        while not list((self.dir / "soon").glob(".case-*.checkpoint")):
            process = subprocess.Popen([PROGRAM, *never], cwd=self.dir, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            time.sleep(patience)
            process.send_signal(signal.SIGINT)
            process.communicate()
            if process.returncode == 0:
                self.fail("no step was kept")
            patience *= 2
        said = self.call(*never, "--resume").stderr
        self.assertGreater(int(said.split("goes on from step ")[1].split()[0]), 0)
        self.assertEqual(self.row_of("soon"), self.row_of("whole"))

    def test_a_run_that_does_not_resume_is_refused(self):
        path = self.copy("kept")
        before = self.files_of("kept")
        self.assertIn("--resume", self.call("run", "study.yaml", "-o", "kept", code=2).stderr)
        kept = self.files_of("kept")
        self.assertEqual(kept[path.name], before[path.name])
        path.unlink()
        self.assertNotIn("goes on", self.kill_behind("study.yaml", "kept"))

    def test_a_checkpoint_of_another_case_is_kept(self):
        path = self.copy("mine")
        before = path.read_bytes()
        err = self.call("run", "study.yaml", "-o", "mine", "--resume", "--set", "output.checkpoint=31000", code=2).stderr
        self.assertIn("holds the checkpoint of a case that is not of this study", err)
        self.assertEqual(path.read_bytes(), before)
        self.assertIn("goes on from step", self.resume_ends_whole("mine"))

    def test_what_is_left_half_written_is_not_read(self):
        path = self.copy("torn")
        path.with_name(path.name + ".partial").write_bytes(path.read_bytes()[:1000])
        (log,) = (self.dir / "torn").glob(".case-*.snapshots.partial")
        with log.open("ab") as file:  # what a run has written since
            file.write(b"x" * 12345)
        self.assertIn("goes on from step", self.resume_ends_whole("torn"))

    def test_a_damaged_checkpoint_is_not_used(self):
        for name, damage in {
            "first": lambda b: bytes([b[0] ^ 1]) + b[1:],
            "image": lambda b: b[:-5000] + bytes([b[-5000] ^ 128]) + b[-4999:],
            "short": lambda b: b[:-8],
            "empty": lambda b: b"",
        }.items():
            with self.subTest(damage=name):
                path = self.copy(f"damaged-{name}")
                path.write_bytes(damage(path.read_bytes()))
                said = self.kill_behind("study.yaml", f"damaged-{name}", "--resume")
                self.assertIn(f"{path.name}: is damaged: the case begins anew", said)

    def test_a_foreign_checkpoint_is_not_used(self):
        path = self.copy("foreign")
        self.kill_behind("other.yaml", "others")
        (other,) = (self.dir / "others").glob(".case-*.checkpoint")
        shutil.copy(other, path)
        said = self.kill_behind("study.yaml", "foreign", "--resume")
        self.assertIn(f"{path.name}: is of another study", said)

    def test_a_checkpoint_without_its_snapshots_is_not_used(self):
        for name, damage in (("short", lambda b: b[:100]), ("flipped", lambda b: b"\1" + b[1:])):
            with self.subTest(damage=name):
                path = self.copy(f"unseen-{name}")
                (log,) = (self.dir / f"unseen-{name}").glob(".case-*.snapshots.partial")
                log.write_bytes(damage(log.read_bytes()))
                said = self.kill_behind("study.yaml", f"unseen-{name}", "--resume")
                self.assertIn(f"{path.name}: has lost its snapshots: the case begins anew", said)


if __name__ == "__main__":
    unittest.main()
