# SPDX-License-Identifier: GPL-3.0-or-later
"""Where nothing can be written a command says why, and what was there stays as it was. usage: test_places.py GRIDCROSS"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.dont_write_bytecode = True  # beside the sources
from runs import Runs

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
STUDY = """title: places
problem: {name: bar-linear}
mesh: {cells: [4, 8]}
method: {space: moving-mesh}
time: {cfl: 0.4, steps: 20}
output: {snapshots: 10, checkpoint: 10}
"""
ENDLESS = STUDY.replace("steps: 20", "steps: 1000000000").replace("snapshots: 10, checkpoint: 10", "measures: final, {}")
# command, and where it writes: a directory or a file
COMMANDS = [(["run", "study.yaml", "-q"], ""), (["run", "study.yaml", "-q", "--resume"], ""), (["merge", "part1", "part2"], ""),
            (["paper", "berzins2021/table1", "-q"], ""), (["report", "older"], ".html"), (["plot", "older"], ".svg")]


class Places(Runs):
    program = PROGRAM
    files = {"study.yaml": STUDY}

    def setUp(self):
        super().setUp()
        for args in (["-o", "older", "--set", "mesh.cells=[6,9]"], ["-o", "part1", "--shard", "1/2"], ["-o", "part2", "--shard", "2/2"]):
            self.call("run", "study.yaml", "-q", *args)

    def content(self, path):
        return {str(p): p.read_bytes() for p in sorted(path.rglob("*")) if p.is_file()}

    def test_read_only(self):
        mount = ["unshare", "-rm", "sh", "-c", 'mount --bind read read && mount -o remount,bind,ro read && exec "$@"', "sh"]
        (self.dir / "read").mkdir()
        if subprocess.run([*mount, "true"], cwd=self.dir, capture_output=True).returncode:
            self.skipTest("no directory of one's own can be made read-only")
        shutil.copytree(self.dir / "older", self.dir / "read/older")
        (self.dir / "read/empty").mkdir()
        before = self.content(self.dir / "read")
        for args, ending in COMMANDS:
            for place in ("read/new", "read/empty/x/y", "read/older", "read/empty"):
                if args[-1] == "--resume" and place == "read/older":
                    continue  # refused for another reason
                with self.subTest(args=args, place=place):
                    err = self.call(*args, "-o", place + ending, code=(1, 2), before=mount).stderr
                    self.assertRegex(err, "Read-only file system" if not ending or "x/y" not in place else "No such file or directory")
                    self.assertIn("read/", err)
        self.assertEqual(self.content(self.dir / "read"), before)
        self.assertEqual(sorted(p.name for p in (self.dir / "read").iterdir()), ["empty", "older"])

    def test_a_file_where_a_directory_should_be(self):
        (self.dir / "file").write_text("mine")
        for args, ending in COMMANDS:
            for place in ["file/x" + ending] + ([] if ending else ["file"]):
                with self.subTest(args=args, place=place):
                    self.assertRegex(self.call(*args, "-o", place, code=(1, 2)).stderr, "file[^\n]*: ([Nn]ot a directory|is not a directory)")
        self.assertEqual((self.dir / "file").read_text(), "mine")
        (self.dir / "blocked" / "study.h5").mkdir(parents=True)
        for args, _ in COMMANDS[:3]:
            self.assertIn("blocked/study.h5", self.call(*args, "-o", "blocked", code=(1, 2)).stderr)

    def test_paper_looks_at_its_places_first(self):
        place = self.dir / "ours" / "berzins2022-table2.study"
        place.mkdir(parents=True)
        (place / "mine.txt").write_text("mine")
        done = self.call("paper", "berzins2021/table1", "berzins2022/table2", "-o", "ours", code=1)
        self.assertEqual(done.stdout, "")
        self.assertIn("is neither a study nor empty", done.stderr)
        self.assertEqual(self.content(self.dir / "ours"), {str(place / "mine.txt"): b"mine"})

    def test_a_directory_that_vanishes(self):
        for what in ("checkpoint: 1000", "snapshots: 1000", "checkpoint: 1000, snapshots: 1000"):
            with self.subTest(what=what):
                (self.dir / "endless.yaml").write_text(ENDLESS.replace("{}", what))
                process = subprocess.Popen([PROGRAM, "run", "endless.yaml", "-o", "gone", "-j", "1", "-q"], cwd=self.dir,
                                           stderr=subprocess.PIPE, text=True)
                try:
                    while not list((self.dir / "gone").glob(".case-*")) and process.poll() is None:
                        time.sleep(0.005)
                    os.rename(self.dir / "gone", self.dir / "elsewhere")
                    if "checkpoint" not in what:  # what is open goes with it
                        process.send_signal(signal.SIGINT)
                    err = process.communicate(timeout=300)[1]
                finally:
                    process.kill()
                    process.wait()
                self.assertIn(process.returncode, (1,) if "checkpoint" in what else (1, 130))
                self.assertIn("No such file or directory" if "checkpoint" in what else "gone", err)
                self.assertFalse((self.dir / "gone").exists())
                shutil.rmtree(self.dir / "elsewhere")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
