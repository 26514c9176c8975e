# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing is lost: runs that are killed at random instants, interrupted, divided and joined end with the bytes of an undisturbed run.

usage: test_kill.py GRIDCROSS [--kills N] [--seed N] [unittest arguments]"""
import argparse
import io
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.dont_write_bytecode = True  # beside the sources
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from runs import Runs
from seal import seal

try:
    import h5py
except ImportError:  # another Python than the system's
    h5py = None

parser = argparse.ArgumentParser()
parser.add_argument("gridcross", type=pathlib.Path)
parser.add_argument("--kills", type=int, default=24)
parser.add_argument("--seed", type=int, default=random.randrange(10**6))
OPTIONS, REST = parser.parse_known_args()
PROGRAM = OPTIONS.gridcross.resolve()

# Cases of unequal length, with history, spectra, snapshots and checkpoints, that end in several ways.
STUDY = """title: killed
problem: {name: bar-neo-hookean}
mesh: {cells: [4, 8, 12, 16, 24, 32]}
method: {space: [standard, moving-mesh], degree: [1, 2]}
time: {cfl: [0.1, 0.4, 3], periods: 1}
output: {histories: 8, spectra: 64, snapshots: 300, checkpoint: 150}
"""
CASES = 72
LONG = """problem: {name: bar-linear}
mesh: {cells: [4, 5, 200]}
time: {dt: 1e-6, steps: 1000000000000}
output: {measures: final}
"""
# two cases that end at once, one that does not within a year
TWO_SHORT = LONG.replace("steps: 1000000000000", "steps: [10, 1000000000000]").replace("[4, 5, 200]", "[4, 200]")


class Case(Runs):
    program = PROGRAM
    files = {"study.yaml": STUDY}

    def names(self, directory):
        return sorted(p.name for p in (self.dir / directory).iterdir())

    def undisturbed(self, *args):
        start = time.monotonic()
        self.call("run", "study.yaml", "-o", "whole", "-q", *args)
        return self.bytes_of("whole"), time.monotonic() - start


class Kill(Case):
    def test_a_run_killed_at_random_instants_ends_as_an_undisturbed_one(self):
        self.chance = random.Random(OPTIONS.seed)
        self.whole, self.seconds = self.undisturbed("-j", "2")
        for name, content in self.whole.items():
            if name.endswith(".h5"):
                self.open_all(name, content)
        self.kills = dict.fromkeys(("before the first journal", "under way", "while assembling", "after the end"), 0)
        self.kept = 0
        while sum(self.kills.values()) < OPTIONS.kills:
            self.kill_one_study()
        print(f"{OPTIONS.kills} kills, seed {OPTIONS.seed}:", ", ".join(f"{n} {phase}" for phase, n in self.kills.items()))
        print(f"{self.kept} finished cases seen in journals")
        if OPTIONS.kills >= 200:
            self.assertGreater(min(self.kills.values()), 0)

    def open_all(self, name, content):
        """Every file that a kill leaves is one of these, to the byte."""
        if not h5py:
            return
        numbers = []
        with h5py.File(io.BytesIO(content)) as file:
            file.visititems(lambda _, item: numbers.append(item[()]) if isinstance(item, h5py.Dataset) else None)
        self.assertGreater(len(numbers), 0, name)

    def kill_one_study(self):
        """Again and again, until it has ended or is let go on."""
        shutil.rmtree(self.dir / "killed", ignore_errors=True)
        older = None
        if self.chance.random() < 0.3:
            self.call("run", "study.yaml", "-o", "killed", "--set", "mesh.cells=4", "--set", "time.cfl=3", "-q")
            older = self.bytes_of("killed")
        process = self.start("run", "study.yaml", "-o", "killed", "-q", "-j", "2")
        while True:
            self.wait(process)
            process.kill()
            process.communicate()
            phase, before = self.look(process, older)
            self.kills[phase] += 1
            self.kept += before
            if phase == "after the end" or (older and not before):
                return  # there is nothing under way, and --resume refuses the other study
            if sum(self.kills.values()) >= OPTIONS.kills or self.chance.random() < 0.25:
                return self.resume()
            process = self.start("run", "study.yaml", "-o", "killed", "-q", "-j", "2", "--resume")

    def wait(self, process):
        """Up to a random instant of the run, or of its last part, which is short."""
        if self.chance.random() < 0.3:
            while process.poll() is None and not (self.dir / "killed" / ".study.h5.partial").exists():
                time.sleep(0.0005)
            time.sleep(self.chance.uniform(0, 0.1 * self.seconds))
        else:
            time.sleep(self.chance.uniform(0, 1.1 * self.seconds) * self.chance.choice([0.02, 0.3, 1]))

    def look(self, process, older):
        """Which phase a run was killed in, and how many cases its journals have, after all that is there was found whole."""
        place = self.dir / "killed"
        now = self.names("killed") if place.exists() else []
        with self.subTest(seed=OPTIONS.seed, kills=self.kills):
            for name in now:
                if not name.startswith(".") and name not in ("run.json", "timing.csv"):  # the old one or the new one
                    known = [self.whole.get(name), older and older.get(name)]
                    self.assertTrue((place / name).read_bytes() in known, name)
            if "study.h5" in now:
                self.call("compare", "killed")
            before = self.records("killed") if now else 0
            if before:
                self.assertIn("--resume", self.call("run", "study.yaml", "-o", "killed", code=2).stderr)
                self.assertEqual(self.records("killed"), before)
        if process.returncode == 0 or (now and self.bytes_are(self.whole)):
            return "after the end", before
        if not any(name.startswith(".journal") for name in now):
            return "before the first journal", before
        return "while assembling" if before == CASES else "under way", before

    def bytes_are(self, whole):
        return self.is_finished("killed") and self.bytes_of("killed") == whole

    def resume(self):
        self.call("run", "study.yaml", "-o", "killed", "-q", "-j", "2", "--resume")
        self.assertTrue(self.bytes_of("killed") == self.whole, f"seed {OPTIONS.seed}")


class Interrupt(Case):
    def interrupt(self, number, directory, *more):
        """Once two cases are done, as an ear on the journals tells."""
        (self.dir / "long.yaml").write_text(TWO_SHORT)
        process = self.start("run", "long.yaml", "-o", directory, "-j", "4", *more)  # one for each case, as the longest begin first
        deadline = time.monotonic() + 300
        while not (self.dir / directory).exists() or self.records(directory) < 2:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)
        time.sleep(0.1)
        start = time.monotonic()
        process.send_signal(number)
        err = process.communicate(timeout=600)[1]
        return process.returncode, err, time.monotonic() - start

    def test_signals_end_a_run_soon_and_say_how_to_go_on(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number=number):
                directory = f"d{int(number)}"
                code, err, seconds = self.interrupt(number, directory)
                self.assertEqual(code, 128 + number)
                self.assertIn("2 of 4 cases are done and kept in " + directory, err)
                self.assertIn("--resume", err)
                self.assertLess(seconds, 30)  # a tenth of one, and a busy machine
                self.assertEqual(self.records(directory), 2)

    def test_what_is_done_is_not_done_again(self):
        (self.dir / "study.yaml").write_text(STUDY)
        whole, seconds = self.undisturbed()
        process = self.start("run", "study.yaml", "-o", "cut", "-j", "1")
        while not (self.dir / "cut").exists() or self.records("cut") < 5:
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        err = process.communicate()[1]
        if process.returncode == 0:
            self.skipTest("was done before")
        done = int(re.search(rf"(\d+) of {CASES} cases are done and kept", err)[1])
        err = self.call("run", "study.yaml", "-o", "cut", "--resume").stderr
        self.assertIn(f"note: {done} of {CASES} cases are done already", err)
        self.assertEqual(self.bytes_of("cut"), whole)

    def test_nothing_done_leaves_nothing(self):
        (self.dir / "long.yaml").write_text(LONG)
        process = self.start("run", "long.yaml", "-o", "none", "-j", "2")
        while not list(self.dir.glob("none/.journal*")):
            time.sleep(0.01)
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        self.assertIn("0 of 3 cases", process.communicate()[1])
        self.assertEqual(self.names("none"), [])


class Resume(Case):
    def cut(self, *args, file="study.yaml"):
        """A study of which half is there: the journal of a whole run, cut in two."""
        shutil.rmtree(self.dir / "cut", ignore_errors=True)
        process = self.start("run", file, "-o", "cut", "-j", "1", "-q", *args)
        while not (self.dir / "cut").exists() or self.records("cut") < 3:
            self.assertIsNone(process.poll())
            time.sleep(0.005)
        process.kill()
        process.communicate()

    def test_another_study_is_refused_with_what_differs(self):
        self.cut()
        before = {p.name: p.read_bytes() for p in (self.dir / "cut").iterdir()}
        (self.dir / "other.yaml").write_text(STUDY + "# a remark\n")
        for args, words in [(["other.yaml"], ["text of the run file"]), (["study.yaml", "--set", "mesh.cells=4"], ["cases"]),
                            (["study.yaml", "--repeats", "3"], ["repeats (0 there, 3 here)"]),
                            (["study.yaml", "--shard", "1/2"], ["shard (1/1 there, 1/2 here)"])]:
            for resume in ([], ["--resume"]):
                with self.subTest(args=args, resume=resume):
                    err = self.call("run", *args, "-o", "cut", *resume, code=2).stderr
                    for word in ["another study", "-o", *words]:
                        self.assertIn(word, err)
        self.assertIn("add --resume", self.call("run", "study.yaml", "-o", "cut", code=2).stderr)
        self.assertEqual({p.name: p.read_bytes() for p in (self.dir / "cut").iterdir()}, before)

    def test_a_finished_study(self):
        whole, _ = self.undisturbed()
        times = (self.dir / "whole" / "timing.csv").read_bytes()
        done = self.call("run", "study.yaml", "-o", "whole", "--resume")
        self.assertIn(f"{CASES} of {CASES} cases are done already", done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), CASES + 2)
        self.assertEqual((self.dir / "whole" / "timing.csv").read_bytes(), times)
        for args, word in [(["--set", "mesh.cells=4"], "cases"), (["--repeats", "2"], "repeats"), (["--shard", "1/3"], "shard")]:
            err = self.call("run", "study.yaml", "-o", "whole", "--resume", *args, code=2).stderr
            self.assertIn("another study", err)
            self.assertIn(word, err)
        self.assertEqual(self.bytes_of("whole"), whole)
        self.call("run", "study.yaml", "-o", "whole", "-q", "--set", "mesh.cells=4")  # without --resume: replaced
        self.assertNotEqual(self.bytes_of("whole"), whole)

    def test_an_empty_place_is_begun(self):
        whole, _ = self.undisturbed()
        self.call("run", "study.yaml", "-o", "new", "-q", "--resume")
        self.assertEqual(self.bytes_of("new"), whole)

    def test_damaged_and_foreign_journals(self):
        whole, _ = self.undisturbed()
        self.cut()
        path = next((self.dir / "cut").glob(".journal-*.partial"))
        good = path.read_bytes()
        chance = random.Random(OPTIONS.seed)
        first = good.index((0x65736163BEEFCAFE).to_bytes(8, sys.byteorder))
        for trial in range(12):
            bad = bytearray(good)
            for _ in range(chance.choice([1, 3, 40])):
                bad[chance.randrange(first, len(bad))] ^= 1 << chance.randrange(8)
            path.write_bytes(bad[: chance.randrange(first, len(bad) + 1)] if chance.random() < 0.5 else bad)
            with self.subTest(seed=OPTIONS.seed, trial=trial):
                self.call("run", "study.yaml", "-o", "cut", "-q", "--resume")
                self.assertTrue(self.bytes_of("cut") == whole)
        path.write_bytes(b"\0" + good[1:])  # nobody knows whose results these are
        for resume in ([], ["--resume"]):
            self.assertIn("is damaged or no journal", self.call("run", "study.yaml", "-o", "cut", *resume, code=2).stderr)
        self.assertEqual(path.read_bytes(), b"\0" + good[1:])
        path.write_bytes(good[: first // 2])  # what a kill at the very beginning leaves
        self.call("run", "study.yaml", "-o", "cut", "-q")
        self.assertEqual(self.bytes_of("cut"), whole)


class Places(Case):
    def test_two_runs_in_one_place(self):
        (self.dir / "long.yaml").write_text(LONG)
        process = self.start("run", "long.yaml", "-o", "busy", "-j", "1")
        while not list(self.dir.glob("busy/.journal*")):
            time.sleep(0.01)
        for resume in ([], ["--resume"]):
            self.assertIn("another run is under way", self.call("run", "long.yaml", "-o", "busy", *resume, code=2).stderr)
        process.kill()
        process.communicate()

    def test_a_vanished_directory_is_an_error(self):
        (self.dir / "long.yaml").write_text(TWO_SHORT.replace("[10, 1000000000000]", "[10, 20, 30000, 60000]"))
        process = self.start("run", "long.yaml", "-o", "gone", "-j", "1")
        while not (self.dir / "gone").exists() or self.records("gone") < 2:
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        shutil.rmtree(self.dir / "gone")
        err = process.communicate(timeout=600)[1]
        self.assertEqual(process.returncode, 1)
        self.assertIn("gone", err)
        self.assertIn("No such file or directory", err)

    def test_a_full_disk(self):
        probe = subprocess.run(["unshare", "-rm", "true"], capture_output=True)
        if probe.returncode:
            self.skipTest("no disk of one's own to fill")
        whole, _ = self.undisturbed()
        size = sum(p.stat().st_size for p in (self.dir / "whole").iterdir())
        script = f"""set -u; cd "{self.dir}"; mkdir small; mount -t tmpfs -o size=$1 none small
            "{PROGRAM}" run study.yaml -o small/d -q >/dev/null 2>small.err; echo $? >small.code
            mount -o remount,size=100m small; ls -A small/d >small.names
            "{PROGRAM}" run study.yaml -o small/d -q --resume >/dev/null && rm -rf big && cp -r small/d big"""
        for share in (0.05, 0.3, 0.5, 0.8):
            with self.subTest(share=share):
                shutil.rmtree(self.dir / "small", ignore_errors=True)
                done = subprocess.run(["unshare", "-rm", "sh", "-c", script, "sh", str(int(share * size))], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual((self.dir / "small.code").read_text(), "1\n")
                err = (self.dir / "small.err").read_text()
                self.assertIn("No space left on device", err)
                self.assertIn("--resume", err)
                names = (self.dir / "small.names").read_text().split()
                self.assertEqual([n for n in names if not n.startswith((".journal-", ".case-", "case-"))], [])
                self.assertTrue(self.bytes_of("big") == whole)


class Shards(Case):
    def shard(self, *which, shards=3):
        for i in which:
            self.call("run", "study.yaml", "--shard", f"{i}/{shards}", "-q", "-j", "2")

    def place(self, i, shards=3):
        return f"study-{i}-of-{shards}.study"

    def test_shards_joined_are_the_whole(self):
        whole, _ = self.undisturbed("-j", "1")
        for shards in (3, 11):  # few stay open, many do not
            with self.subTest(shards=shards):
                self.shard(*range(1, shards + 1), shards=shards)
                places = [self.place(i, shards) for i in range(1, shards + 1)]
                random.Random(OPTIONS.seed).shuffle(places)
                self.call("merge", *places, places[0], "-o", f"joined{shards}")
                self.assertTrue(self.bytes_of(f"joined{shards}") == whole)
                timing = (self.dir / f"joined{shards}" / "timing.csv").read_text().splitlines()
                table = (self.dir / f"joined{shards}" / "table.csv").read_text().splitlines()
                self.assertEqual([line.split(",")[0] for line in timing], [line.split(",")[0] for line in table])
                self.assertGreater(len([line for line in timing if line.split(",")[1]]), CASES / 2)
        self.call("run", "study.yaml", "-o", "joined3", "--resume", "-q")
        self.call("compare", self.place(1))

    def test_an_interrupted_shard_is_resumed(self):
        whole, _ = self.undisturbed()
        self.shard(1, 3)
        process = self.start("run", "study.yaml", "--shard", "2/3", "-q", "-j", "1")
        while not (self.dir / self.place(2)).exists() or self.records(self.place(2)) < 1:
            time.sleep(0.002)
        process.kill()
        process.communicate()
        if (self.dir / self.place(2) / "study.h5").exists():
            self.skipTest("was done before")
        places = [self.place(i) for i in (1, 2, 3)]
        self.assertIn("holds no finished study", self.call("merge", *places, "-o", "joined", code=2).stderr)
        self.call("run", "study.yaml", "--shard", "2/3", "-q", "--resume")
        self.call("merge", *places, "-o", "joined")
        self.assertTrue(self.bytes_of("joined") == whole)

    def test_what_does_not_belong_together_is_refused(self):
        self.shard(1, 2)
        self.call("run", "study.yaml", "--shard", "3/3", "-q", "--set", "time.periods=2")
        self.call("run", "study.yaml", "--shard", "3/4", "-q")
        self.call("run", "study.yaml", "-o", "whole", "-q")
        (self.dir / "mine").mkdir()
        (self.dir / "mine" / "letter").write_text("dear")
        one, two = self.place(1), self.place(2)
        for args, words in [([one, two, "-o", "out"], ["missing of 3 shards: 3"]), ([two, "-o", "out"], ["missing of 3 shards: 1, 3"]),
                            ([one, two, self.place(3), "-o", "out"], ["another study", "cases"]),
                            ([one, two, self.place(3, 4), "-o", "out"], ["one of 4 shards"]),
                            ([one, two, "whole", "-o", "out"], ["whole: holds a whole study"]),
                            ([one, two, "nowhere", "-o", "out"], ["nowhere"]), ([one, two, "mine", "-o", "out"], ["no finished study"]),
                            ([one, two], ["-o DIR"]), ([one, "-o", one], ["is a shard"])]:
            with self.subTest(args=args):
                err = self.call("merge", *args, code=2).stderr
                for word in words:
                    self.assertIn(word, err)
                self.assertFalse((self.dir / "out").exists())
        shutil.copytree(self.dir / two, self.dir / "twice")
        path = self.dir / "twice" / "study.h5"
        old = path.read_bytes()
        path.write_bytes(old.replace(b"killed", b"kilLed", 1))
        self.assertIn("damaged: copy it again", self.call("merge", one, two, "twice", "-o", "out", code=2).stderr)
        seal(path)
        self.assertIn("its results differ", self.call("merge", one, two, "twice", "-o", "out", code=2).stderr)
        path.write_bytes(old[: len(old) // 2])
        self.assertIn("twice", self.call("merge", one, two, "twice", "-o", "out", code=2).stderr)
        shutil.rmtree(self.dir / self.place(3))
        self.shard(3)
        self.assertIn("letter", self.call("merge", *(self.place(i) for i in (1, 2, 3)), "-o", "mine", code=2).stderr)

    @unittest.skipUnless(h5py, "needs h5py")
    def test_a_column_of_another_type_is_seen(self):
        self.shard(1, 2, 3)
        path = self.dir / self.place(2) / "study.h5"
        with h5py.File(path, "r+") as file:
            rows = len(file["table/case"])
            del file["table/method.basis"]
            file["table"].create_dataset("method.basis", data=[0.5] * rows, dtype="<f8", track_times=False)
        seal(path)
        done = self.call("merge", *(self.place(i) for i in (1, 2, 3)), "-o", "out", code=2)
        self.assertIn(f"{self.place(2)}: its table is damaged", done.stderr)
        self.assertFalse((self.dir / "out" / "study.h5").exists())

    def test_which_shards_there_are(self):
        for text in ("0/3", "4/3", "1", "1/", "/3", "a/3", "1/3x", "-1/3", "1/0", "", " 1/3", "1/ 3", "99999999999999999999/3"):
            with self.subTest(text=text):
                self.assertIn("--shard takes i/n", self.call("run", "study.yaml", "--shard", text, code=2).stderr)
        self.assertIn(f"{CASES} cases", self.call("run", "study.yaml", "--shard", "1/99", code=2).stderr)
        self.call("run", "study.yaml", "--shard", "1/1", "-q", "-o", "one")
        whole, _ = self.undisturbed()
        self.assertEqual(self.bytes_of("one"), whole)


if __name__ == "__main__":
    print(f"seed {OPTIONS.seed}", flush=True)
    unittest.main(argv=[sys.argv[0], *REST])
