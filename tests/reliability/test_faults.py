# SPDX-License-Identifier: GPL-3.0-or-later
"""A disk that fails at a chosen call: nothing that was there is lost, what failed is said, and the same command ends the work.

usage: test_faults.py GRIDCROSS FAULTS.so [--all] [unittest arguments]
--all: at every call in every way; else at the first and the last of each kind, in one way each"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True  # beside the sources
from runs import UNLIKE, Runs

ALL = "--all" in sys.argv and not sys.argv.remove("--all")
PROGRAM, FAULTS = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
STUDY = """title: faults
problem: {name: bar-neo-hookean}
mesh: {cells: [4, 6]}
method: {space: moving-mesh}
time: {cfl: 0.2, periods: 0.5}
output: {histories: 8, spectra: 16, snapshots: 20, checkpoint: 30}
"""
KILLED = ("kill", "torn")
SAID = {"full": "No space left on device", "once": "Input/output error"}


class Faults(Runs):
    program = PROGRAM
    files = {"study.yaml": STUDY}

    def setUp(self):
        super().setUp()
        self.faults = shutil.copy(FAULTS, self.dir)  # a blank in its path would end it

    def run_program(self, *args, **faults):
        environment = dict(os.environ)
        if faults:  # a sanitizer wants to be the first that is preloaded
            environment["ASAN_OPTIONS"] = environment.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"
            environment["LD_PRELOAD"] = str(self.faults)
            environment.update((f"FAULTS_{name.upper()}", str(value)) for name, value in faults.items())
        return subprocess.run([PROGRAM, *args], cwd=self.dir, env=environment, capture_output=True, text=True, timeout=300)

    def seen_in(self, directory):
        """What is seen in a directory; not: hidden files."""
        paths = (self.dir / directory).iterdir() if (self.dir / directory).is_dir() else []
        return {p.name: p.read_bytes() for p in paths if not p.name.startswith(".")}

    def alike(self, directory):
        return {name: content for name, content in self.seen_in(directory).items() if name not in UNLIKE}

    def chosen(self, *args):
        """The numbers of calls that are to fail."""
        list_of = self.dir / "list"
        self.assertEqual(self.run_program(*args, list=list_of).returncode, 0)
        names = list_of.read_text().split()
        list_of.unlink()
        self.assertGreater(len(names), 2)
        if ALL:
            return range(1, len(names) + 1)
        places = {name: [i for i, other in enumerate(names, 1) if other == name] for name in names}
        return sorted({i for of in places.values() for i in (of[0], of[-1])})

    def fail_at(self, calls, begin, args, ended, after, share=0):
        """begin(): the disk before. ended(): whether the command did its work all the same. after(how): looks, and ends the work.
        share: 0 to 3, of the calls and ways."""
        failures = 0
        for i, how in enumerate((*KILLED, *SAID)):
            for j, at in enumerate(calls):
                if not ALL and (i + j) % 4 != share:
                    continue
                with self.subTest(how=how, at=at):
                    begin()
                    done = self.run_program(*args, at=at, how=how)
                    failures += done.returncode != 0
                    if done.returncode == 0:
                        self.assertTrue(ended())
                    elif how in KILLED:
                        self.assertEqual(done.returncode, -signal.SIGKILL, done.stderr)
                    else:
                        self.assertIn(done.returncode, (1, 2), done.stderr)
                        self.assertIn(SAID[how], done.stderr)
                    after(how)
        self.assertGreater(failures, len(calls) / 4)

    def test_run(self):
        args = ("run", "study.yaml", "-o", "d", "-q", "-j", "1")
        self.call("run", "study.yaml", "-o", "whole", "-q", "-j", "1")
        self.call("run", "study.yaml", "-o", "older", "-q", "--set", "mesh.cells=8")
        whole, older = self.alike("whole"), self.alike("older")
        self.assertEqual(len(whole), 8)
        calls = self.chosen(*args)
        for old in (False, True):

            def begin():
                shutil.rmtree(self.dir / "d", ignore_errors=True)
                if old:
                    shutil.copytree(self.dir / "older", self.dir / "d")

            def after(how):
                for name, content in self.alike("d").items():
                    self.assertTrue(content in (whole.get(name), old and older.get(name)), name)
                resumed = self.run_program(*args, "--resume")
                if resumed.returncode == 2 and old:  # nothing is under way there
                    self.assertIn("holds another study", resumed.stderr)
                    self.assertTrue(older.items() <= self.alike("d").items())
                    resumed = self.run_program(*args)
                self.assertEqual(resumed.returncode, 0, resumed.stderr)
                self.assertTrue(self.alike("d") == whole)
                self.assertEqual([p.name for p in (self.dir / "d").glob(".*")], [])

            with self.subTest(old=old):
                self.fail_at(calls, begin, args, lambda: self.alike("d") == whole, after, share=2 if old else 0)

    def test_merge(self):
        self.call("run", "study.yaml", "-o", "whole", "-q")
        for i in "12":
            self.call("run", "study.yaml", "--shard", f"{i}/2", "-o", f"part{i}", "-q")
        whole, parts = self.alike("whole"), [self.seen_in(f"part{i}") for i in "12"]
        args = ("merge", "part1", "part2", "-o", "d")
        calls = self.chosen(*args)

        def begin():
            shutil.rmtree(self.dir / "d", ignore_errors=True)

        def after(how):
            for name, content in self.alike("d").items():
                self.assertEqual(content, whole[name], name)
            self.assertEqual([self.seen_in(f"part{i}") for i in "12"], parts)
            self.call(*args)
            self.assertTrue(self.alike("d") == whole)
            self.assertEqual([p.name for p in (self.dir / "d").glob(".*")], [])

        self.fail_at(calls, begin, args, lambda: self.alike("d") == whole, after)

    def check_file(self, command, name):
        """A command that writes a file, over what it wrote of another study."""
        self.call("run", "study.yaml", "-o", "whole", "-q")
        self.call("run", "study.yaml", "-o", "other", "-q", "--set", "mesh.cells=[8,9]")
        study = self.seen_in("whole")
        (self.dir / "place").mkdir()
        self.call(command, "other", "-o", f"place/{name}")
        older = self.seen_in("place")
        self.call(command, "whole", "-o", f"place/{name}")
        whole = self.seen_in("place")
        self.assertTrue(sorted(older) == sorted(whole) and older != whole)
        args = (command, "whole", "-o", f"place/{name}")

        def begin():
            shutil.rmtree(self.dir / "place")
            (self.dir / "place").mkdir()
            for each, content in older.items():
                (self.dir / "place" / each).write_bytes(content)

        def after(how):
            for each, content in self.seen_in("place").items():
                if not each.endswith(".partial"):
                    self.assertTrue(content in (older[each], whole[each]), each)
                else:
                    self.assertIn(how, KILLED)
            self.call(*args)
            self.assertTrue({each: self.seen_in("place")[each] for each in whole} == whole)
            self.assertEqual(self.seen_in("whole"), study)

        begin()
        calls = self.chosen(*args)
        self.fail_at(calls, begin, args, lambda: self.seen_in("place") == whole, after)

    def test_report(self):
        self.check_file("report", "page.html")

    @unittest.skipUnless(shutil.which("gnuplot"), "there is no gnuplot")
    def test_plot(self):
        self.check_file("plot", "figure.svg")


if __name__ == "__main__":
    unittest.main()
