# SPDX-License-Identifier: GPL-3.0-or-later
"""mpirun: ranks share the cases of one study, which ends with the bytes of a run by one process.

usage: test_ranks.py GRIDCROSS [unittest arguments]"""
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
HAS_MPI = "no MPI" not in subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout
# More ranks than processors, also as root; what MPI itself leaks is not ours to tell.
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                   ASAN_OPTIONS=os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0")

STUDY = """title: ranks
problem: {name: bar-neo-hookean}
mesh: {cells: [4, 8, 16]}
method: {space: [standard, moving-mesh], degree: [1, 2]}
time: {cfl: [0.2, 0.4, 3], periods: 1}
output: {histories: 8, snapshots: 300}
"""
# two that never end, and short ones
ENDLESS = """problem: {name: bar-linear}
mesh: {cells: [4, 200]}
time: {dt: 1e-6, steps: [10, 1000000000000]}
output: {measures: final}
"""

# a case for each of two ranks, of many more steps than are taken until they are looked at
LONG = """problem: {name: bar-neo-hookean}
mesh: {cells: [64, 65]}
method: {space: moving-mesh}
time: {cfl: 0.0005}
output: {checkpoint: 20000, histories: 5000, snapshots: 20000}
"""


def children(parent):
    """Processes that `parent` has started and not yet waited for."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # it has ended
            continue
        if int(fields[1]) == parent:
            found.append(int(stat.parent.name))
    return found


class Case(Runs):
    program = PROGRAM
    files = {"study.yaml": STUDY, "endless.yaml": ENDLESS, "long.yaml": LONG}

    def start(self, *args, environment=ENVIRONMENT, **more):
        return super().start(*args, env=environment, stdin=subprocess.DEVNULL, **more)

    def stop(self, process):
        """mpirun ends its ranks when it is asked to, and not when it is killed."""
        if process.poll() is None:
            process.terminate()
            process.communicate()

    def end(self, process):
        err = process.communicate(timeout=200)[1]
        return process.returncode, err

    def call(self, *args, ranks=0, code=0, **more):
        result, err = self.end(self.start(*args, before=["mpirun", "-n", str(ranks)] if ranks else [], **more))
        self.assertEqual(result, code, err)
        return err

    def wait_for(self, process, directory, records, journals):
        while process.poll() is None:
            now = self.journals(directory)
            if sum(now) >= records and len(now) >= journals:
                return
            time.sleep(0.01)


@unittest.skipIf(HAS_MPI, "built with MPI")
class Alone(Case):
    def test_processes_of_one_run_are_noticed(self):
        for rank in "01":
            environment = dict(ENVIRONMENT, OMPI_COMM_WORLD_SIZE="2", OMPI_COMM_WORLD_RANK=rank)
            err = self.call("run", "study.yaml", "-o", "d", code=2, environment=environment)
            self.assertEqual("-Dmpi=enabled" in err, rank == "0")  # once is enough
            self.assertFalse((self.dir / "d").exists())
            self.call("run", "study.yaml", "--shard", f"{int(rank) + 1}/2", "-o", f"part{rank}", "-q", environment=environment)


@unittest.skipUnless(HAS_MPI, "built without MPI")
class Ranks(Case):
    def test_bytes_are_those_of_one_process(self):
        self.call("run", "study.yaml", "-o", "one", "-q", "-j", "1")
        whole = self.bytes_of("one")
        err = self.call("run", "study.yaml", "-o", "three", ranks=3)
        self.assertEqual(err.count("study: three"), 1, err)
        self.assertTrue(self.bytes_of("three") == whole)
        for path in (self.dir / "three").glob("case-*.h5"):
            path.unlink()
        self.call("run", "study.yaml", "-o", "three", "-q", "--resume", ranks=2)  # for the snapshots
        self.assertTrue(self.bytes_of("three") == whole)

    def test_an_interrupted_run_goes_on(self):
        self.call("run", "study.yaml", "-o", "one", "-q")
        process = self.start("run", "study.yaml", "-o", "cut", "-q", "-j", "1", before=["mpirun", "-n", "3"])
        self.wait_for(process, "cut", 4, 0)
        process.send_signal(signal.SIGTERM)
        self.end(process)
        if not (self.dir / "cut" / "study.h5").exists():
            self.assertGreaterEqual(self.records("cut"), 4)
            self.assertIn("--resume", self.call("run", "study.yaml", "-o", "cut", "-q", ranks=2, code=2))
        self.call("run", "study.yaml", "-o", "cut", "-q", "--resume", ranks=2)
        self.assertTrue(self.bytes_of("cut") == self.bytes_of("one"))

    def test_each_rank_takes_what_it_can_and_a_signal_ends_all(self):
        process = self.start("run", "endless.yaml", "-o", "d", "-j", "1", before=["mpirun", "-n", "3"])
        self.wait_for(process, "d", 2, 3)  # two ranks are in cases that do not end: the third does the others
        self.assertEqual(sorted(self.journals("d")), [0, 0, 2])
        process.send_signal(signal.SIGINT)
        code, err = self.end(process)
        self.assertNotEqual(code, 0)
        self.assertEqual(err.count("interrupted; what is done is kept"), 1, err)
        self.assertEqual(self.records("d"), 2)

    def test_checkpoints_of_killed_ranks_are_used(self):
        self.call("run", "long.yaml", "-o", "one", "-q")
        for number in (signal.SIGKILL, signal.SIGTERM):
            with self.subTest(number.name):
                process = self.start("run", "long.yaml", "-o", number.name, "-j", "1", before=["mpirun", "-n", "2"])
                while process.poll() is None and len(list((self.dir / number.name).glob(".case-*.checkpoint"))) < 2:
                    time.sleep(0.001)
                for pid in children(process.pid):
                    os.kill(pid, number)
                if self.end(process)[0] == 0:
                    self.skipTest("the cases were done before they could be ended")
                err = self.call("run", "long.yaml", "-o", number.name, "--resume", "-j", "1", ranks=2)
                self.assertIn("goes on from step", err)
                self.assertTrue(self.bytes_of(number.name) == self.bytes_of("one"))

    def test_an_error_of_one_ends_all(self):
        limit = "trap '' XFSZ; ulimit -f 1; exec \"$@\""  # room for a journal's head alone
        process = self.start("run", "endless.yaml", "-o", "d", "-j", "1",
                             before=["mpirun", "--mca", "btl", "self,tcp", "-n", "3", "sh", "-c", limit, "sh"])
        code, err = self.end(process)
        self.assertNotEqual(code, 0)
        self.assertEqual(err.count("File too large"), 1, err)
        self.assertEqual(self.records("d"), 0)

    def test_errors_are_told_once(self):
        (self.dir / "bad.yaml").write_text(STUDY.replace("standard", "standart"))
        self.assertEqual(self.call("run", "bad.yaml", "-o", "d", ranks=3, code=2).count("standart"), 1)
        self.assertEqual(self.call("run", "-", "-o", "d", ranks=3, code=2).count("standard input"), 1)
        other = [":", "-n", "2", str(PROGRAM), "run", "study.yaml", "-o", "d", "--set", "mesh.cells=5"]
        err = self.call("run", "study.yaml", "-o", "d", *other, ranks=1, code=2)
        self.assertEqual(err.count("another study"), 1, err)
        self.assertEqual(list((self.dir / "d").iterdir()), [])

    def test_alone_it_is_as_ever(self):
        self.call("run", "study.yaml", "-o", "d", "-q", "--set", "mesh.cells=4", ranks=1)
        self.assertTrue((self.dir / "d" / "study.h5").exists())


if __name__ == "__main__":
    if HAS_MPI and not (shutil.which("mpirun") and subprocess.run(["mpirun", "-n", "3", "true"], env=ENVIRONMENT, capture_output=True).returncode == 0):
        print("mpirun is not there, or cannot start processes here")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
