# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: help, exit codes, streams, equal bytes. usage: test_cli.py GRIDCROSS SOURCE_ROOT"""
import csv
import io
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROOT = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
COMMANDS = ["run", "check", "init", "compare", "plot", "advise", "spectrum", "list", "balance", "merge"]
TOPICS = ["spaces", "bases", "clocks", "problems", "materials", "parameters"]
STUDY = """title: small
problem: {name: bar-neo-hookean}
mesh: {cells: [4, 8, 16]}
method: {space: [standard, moving-mesh], degree: [1, 2]}
time: {cfl: 0.4, periods: 0.25}
"""


class Case(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.dir = pathlib.Path(self.place.name)
        (self.dir / "small.yaml").write_text(STUDY)

    def call(self, *args, code=0, **more):
        done = subprocess.run([PROGRAM, *map(str, args)], cwd=self.dir, capture_output=True, timeout=600, **more)
        done.stdout, done.stderr = done.stdout.decode(), done.stderr.decode()
        self.assertEqual(done.returncode, code, f"{args}: {done.stdout[-500:]}\n{done.stderr[-500:]}")
        return done


class Help(Case):
    def test_help_goes_to_stdout(self):
        done = self.call("--help")
        self.assertEqual(done.stderr, "")
        for name in COMMANDS:
            self.assertIn(f"\n  {name} ", done.stdout)
            own = self.call(name, "--help")
            self.assertTrue(own.stdout.startswith(f"usage: gridcross {name}"))
            self.assertEqual(own.stderr, "")
            self.assertEqual(own.stdout, self.call(name, "-h").stdout)

    def test_version_names_libraries(self):
        out = self.call("--version").stdout
        for word in ("gridcross ", "GSL ", "FFTW ", "HDF5 ", "libyaml ", "compiler "):
            self.assertIn(word, out)

    def test_lists(self):
        everything = self.call("list").stdout
        for topic in TOPICS:
            out = self.call("list", topic).stdout
            self.assertTrue(out)
            self.assertIn(out, everything)
        self.assertIn("central-difference", self.call("list", "clocks").stdout)
        self.assertIn("mesh.cells", self.call("list", "parameters").stdout)
        lines = [line for line in self.call("list", "problems").stdout.splitlines() if line[0] != " "]
        for name, dimensions in {"bar-linear": "1 dimension", "axis-aligned": "1 to 3 dimensions", "cantilever": "2 to 3 dimensions"}.items():
            self.assertTrue(any(line.startswith(name + " ") and line.endswith(f", {dimensions})") for line in lines), name)

    def test_starter_is_a_run_file(self):
        problems = [line.split()[0] for line in self.call("list", "problems").stdout.splitlines() if line[0] != " "]
        self.assertIn("bar-linear", problems)
        for problem in problems:
            starter = self.call("init", problem)
            self.assertIn("1 case", self.call("check", "-", input=starter.stdout.encode()).stdout)
            for key in ["frame: reference", "divergence: exact"]:
                self.assertEqual("# " + key in starter.stdout, "\n  cells: " in starter.stdout)
        self.assertIn("cells: 32", self.call("init", "bar-linear").stdout)
        self.assertNotIn("cells: 32", self.call("init", "jump-model").stdout)


class Usage(Case):
    def test_help_of_a_command(self):
        for command in ("report", "run"):
            self.assertEqual(self.call("help", command).stdout, self.call(command, "--help").stdout)
        self.assertIn("did you mean report?", self.call("help", "reprot", code=2).stderr)

    def test_errors_exit_2_with_a_hint_and_no_output(self):
        for args, hint in [
            ([], "usage"), (["rum"], "did you mean run?"), (["--hlep"], "did you mean --help?"), (["xyzzy"], "--help"),
            (["run"], "missing FILE.yaml"), (["run", "a", "b"], "too many"), (["run", "--jsno", "small.yaml"], "--json"),
            (["run", "-x", "small.yaml"], "no option -x"), (["run", "small.yaml", "-j"], "missing"),
            (["run", "small.yaml", "-j", "0"], "-j"), (["run", "small.yaml", "-j", "2x"], "2x"),
            (["run", "small.yaml", "--repeats", "0"], "--repeats"), (["run", "small.yaml", "--repeats=1.5"], "'1.5'"),
            (["run", "small.yaml", "--csv=1"], "--csv=1"), (["run", "small.yaml", "--csv", "--json"], "not both"),
            (["run", "-"], "-o"), (["run", "small.yaml", "-o", ""], "-o"), (["run", "none.yaml"], "none.yaml"),
            (["run", "small.yaml", "--set", "mesh.cell=3"], "mesh.cells"), (["check", "none.yaml"], "none.yaml"),
            (["init", "bar-liner"], "did you mean bar-linear?"), (["list", "clock"], "did you mean clocks?"),
            (["compare"], "missing"), (["compare", ""], "an argument is empty"), (["--xyzzy"], "no option '--xyzzy'"),
            (["--manual", "3"], "not '3'"), (["compare", "none"], "none"), (["compare", "."], "gridcross run writes"), (["compare", "small.yaml"], "gridcross run writes"),
        ]:
            with self.subTest(args=args):
                done = self.call(*args, code=2, stdin=subprocess.DEVNULL)
                self.assertEqual(done.stdout, "")
                self.assertIn(hint, done.stderr)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["small.yaml"])

    def test_names_that_begin_with_a_dash(self):
        (self.dir / "-odd.yaml").write_text(STUDY)
        self.call("check", "--", "-odd.yaml")
        self.call("check", "-odd.yaml", code=2)

    def test_foreign_places_are_left_alone(self):
        (self.dir / "mine").mkdir()
        (self.dir / "mine" / "letter.txt").write_text("dear")
        (self.dir / "file").write_text("text")
        for place in ("mine", "file", "file/below", "/proc/none"):
            done = self.call("run", "small.yaml", "-o", place, code=2)
            self.assertEqual(done.stdout, "")
            self.assertIn(place.split("/")[-1 if place[0] != "/" else 1], done.stderr)
        self.assertEqual([p.name for p in (self.dir / "mine").iterdir()], ["letter.txt"])


class Run(Case):
    def study(self, directory):
        return {name: (self.dir / directory / name).read_bytes() for name in ("study.h5", "table.csv")}

    def test_streams_and_files(self):
        done = self.call("run", "small.yaml")
        self.assertIn("displacement.max.rms", done.stdout)
        self.assertEqual(done.stderr, "study: ./small.study\n")
        self.assertEqual(len(done.stdout.splitlines()), 2 + 12)
        names = sorted(p.name for p in (self.dir / "small.study").iterdir())
        self.assertEqual(names, ["run.json", "study.h5", "table.csv", "timing.csv"])
        about = json.loads((self.dir / "small.study" / "run.json").read_text())
        self.assertEqual(sorted(about), ["command", "date", "host", "seconds"])
        self.assertTrue(about["command"].endswith("run small.yaml"))
        quiet = self.call("run", "-q", "small.yaml")
        self.assertEqual(quiet.stderr, "")

    def test_csv_json_and_disk_agree(self):
        rows = list(csv.DictReader(io.StringIO(self.call("run", "small.yaml", "--csv").stdout)))
        objects = json.loads(self.call("run", "small.yaml", "--json").stdout)
        bare = self.call("run", "small.yaml", "--csv", "--no-timing").stdout
        self.assertEqual(bare.encode(), (self.dir / "small.study" / "table.csv").read_bytes())
        self.assertEqual(list(rows[0]), list(objects[0]))
        self.assertEqual(list(rows[0])[-2:], ["result.seconds", "result.ns_per_particle_step"])
        # dt = 0.4 h/c, end = 0.25 * 2/c: 1.25 steps a cell; each case has its own result
        self.assertEqual([one["result.steps"] for one in objects], [1.25 * one["mesh.cells"] for one in objects])
        for row, one in zip(rows, objects, strict=True):
            for name, text in row.items():
                if name in ("result.seconds", "result.ns_per_particle_step"):
                    continue
                value = one[name]
                self.assertEqual(text, "" if value is None else text if float_equal(text, value) else value)

    def test_equal_bytes_on_repetition_and_for_every_j(self):
        self.call("run", "small.yaml", "-o", "a", "-j", "1", "-q")
        self.call("run", "small.yaml", "-o", "b", "-j8", "-q")
        self.assertEqual(self.study("a"), self.study("b"))
        self.call("run", "small.yaml", "-o", "b", "--jobs=2", "-q")
        self.assertEqual(self.study("a"), self.study("b"))
        plain = [self.call("run", "small.yaml", "--no-timing", f"-j{j}").stdout for j in (1, 3)]
        self.assertEqual(plain[0], plain[1])

    def test_repeats_time_and_change_no_result(self):
        self.call("run", "small.yaml", "-o", "a", "-q")
        self.call("run", "small.yaml", "-o", "b", "-q", "--repeats", "3")
        self.assertEqual(self.study("a"), self.study("b"))
        once, thrice = (list(csv.DictReader((self.dir / d / "timing.csv").read_text().splitlines())) for d in "ab")
        self.assertEqual([r["repeats"] for r in once], ["0"] * 12)
        self.assertEqual([r["repeats"] for r in thrice], ["3"] * 12)
        steps = [int(r["result.steps"]) * int(r["mesh.cells"]) * 4 for r in
                 csv.DictReader((self.dir / "b" / "table.csv").read_text().splitlines())]
        for row, count in zip(thrice, steps, strict=True):
            self.assertAlmostEqual(1e9 * float(row["seconds"]) / count / float(row["ns_per_particle_step"]), 1, 9)
        failing = ["run", "small.yaml", "--set", "time.cfl=3", "--set", "mesh.cells=16", "--no-timing", "-q"]
        self.assertEqual(self.call(*failing).stdout, self.call(*failing, "--repeats=2").stdout)

    def test_standard_input(self):
        self.call("run", "small.yaml", "-o", "a", "-q")
        self.call("run", "-", "-o", "b", "-q", input=STUDY.encode())
        self.assertEqual(self.study("a")["table.csv"], self.study("b")["table.csv"])

    def test_a_method_that_fails_is_a_result(self):
        done = self.call("run", "small.yaml", "--set", "time.cfl=3", "--set", "mesh.cells=16", "--json")
        status = {one["result.status"] for one in json.loads(done.stdout)}
        self.assertTrue(status - {"ok"}, status)
        for one in json.loads(done.stdout):
            if one["result.status"] != "ok":
                self.assertIsNone(one["result.displacement.max.rms"])

    def test_duplicates_are_noted(self):
        done = self.call("run", "small.yaml", "--set", "method.degree=[2, 2]")
        self.assertIn("6 cases are equal", done.stderr)

    def test_a_full_disk_is_an_error(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        with open("/dev/full", "wb") as full:
            for args in (["run", "small.yaml"], ["run", "small.yaml", "--csv"], ["list"], ["--help"], ["check", "small.yaml"]):
                done = subprocess.run([PROGRAM, *args], cwd=self.dir, stdout=full, stderr=subprocess.PIPE, timeout=600)
                self.assertEqual(done.returncode, 1, args)
                self.assertIn(b"standard output", done.stderr)

    def test_files_that_cannot_grow_lose_nothing(self):
        def limit(most):
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))

        self.call("run", "small.yaml", "-o", "whole", "-q")
        err = self.call("run", "small.yaml", code=1, preexec_fn=lambda: limit(4096)).stderr
        self.assertIn(".journal-1.partial: File too large", err)
        kept = int(re.search(r"(\d+) of 12 cases are done and kept", err)[1])
        self.assertGreater(kept, 0)
        err = self.call("run", "small.yaml", "--resume", code=1, preexec_fn=lambda: limit(65536)).stderr
        self.assertIn(f"note: {kept} of 12", err)
        self.assertIn("study.h5.partial: cannot write: File too large", err)
        self.assertIn("12 of 12 cases are done and kept", err)
        names = sorted(p.name for p in (self.dir / "small.study").iterdir())
        self.assertTrue(names and all(re.fullmatch(r"\.journal-\d+\.partial", n) for n in names), names)
        self.call("run", "small.yaml", "--resume")
        self.assertEqual(self.study("small.study"), self.study("whole"))

    def test_a_closed_pipe_ends_quietly(self):
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([PROGRAM, "list"], stdout=write, stderr=subprocess.PIPE, timeout=600)
        os.close(write)
        self.assertIn(done.returncode, (-signal.SIGPIPE, 1))

    def test_results_without_an_exact_solution_are_named(self):
        (self.dir / "disks.yaml").write_text("problem.name: colliding-disks\nmesh: {cells: [8, 10], particles_per_cell: 2}\n")
        out = self.call("run", "-q", "disks.yaml", "--no-timing").stdout
        self.assertIn("restitution", out.splitlines()[0])
        self.assertNotIn("restitution", self.call("run", "-q", "small.yaml", "--no-timing").stdout)
        done = self.call("compare", "disks.study")
        self.assertIn("no case has result.displacement.max.rms; some have ", done.stderr)
        self.assertIn("result.restitution", done.stderr)
        self.assertEqual(self.call("compare", "disks.study", "--value", "result.restitution").stderr, "")
        self.assertIn("result.restitution", self.call("advise", "disks.study", code=2).stderr)

    def test_a_damaged_study_is_refused(self):
        self.call("run", "small.yaml", "-q")
        path = self.dir / "small.study" / "study.h5"
        path.write_bytes(path.read_bytes()[:700])
        for args in (["compare", "small.study"], ["run", "small.yaml"]):
            done = self.call(*args, code=2)
            self.assertIn("damaged", done.stderr)
            self.assertNotIn("HDF5-DIAG", done.stderr)

    def test_h5py_reads_the_study(self):
        script = """
import h5py, sys
f = h5py.File(sys.argv[1])
t = f["table"]
names = list(t)
assert names[0] == "case" and "result.status" in names, names[:3]
assert "result.seconds" not in names
assert [s.decode() for s in t["result.status"]] == ["ok"] * 12
assert list(t["mesh.cells"][:4]) == [4] * 4
assert t["result.dt"].attrs["unit"] == "s" and t["mesh.cells"].attrs["null"] == -2**63
assert t["result.displacement.max.rms"].dtype == "float64"
p = dict(f["provenance"].attrs)
assert p["format"] == 3 and p["title"] == "small" and p["run_file"].startswith("title: small"), p
assert all(p[k] for k in ("version", "git_revision", "compiler", "flags", "gsl", "fftw", "hdf5", "yaml"))
h = f["histories"][t["case"].asstr()[0]]
assert len(h["time"]) > 2 and h["time"].attrs["unit"] == "s" and h["stress.rms"].attrs["unit"] == "Pa"
assert set(h) >= {"displacement.inf", "energy.kinetic", "momentum.x", "energy.kinetic_nodes", "energy.elastic", "energy.work",
                  "energy.defect", "crossings"}
with h5py.File(sys.argv[2], "w") as g:
    g["x"] = 1
"""
        probe = subprocess.run(["/usr/bin/python3", "-c", "import h5py"], capture_output=True)
        if probe.returncode:
            self.skipTest("no h5py")
        self.call("run", "small.yaml", "-q", "--set", "output.histories=1")
        foreign = self.dir / "foreign" / "study.h5"
        foreign.parent.mkdir()
        done = subprocess.run(["/usr/bin/python3", "-c", script, self.dir / "small.study" / "study.h5", foreign],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not a study", self.call("compare", "foreign", code=2).stderr)
        self.assertIn("not a study", self.call("run", "small.yaml", "-o", "foreign", code=2).stderr)

    def test_what_memory_or_digits_cannot_hold_is_refused(self):
        def outcomes(time, output="{}"):
            (self.dir / "far.yaml").write_text(f"problem: {{name: bar-linear}}\nmesh: {{cells: 4}}\ntime: {time}\noutput: {output}\n")
            self.call("run", "far.yaml", "-q")
            rows = csv.DictReader((self.dir / "far.study" / "table.csv").read_text().splitlines())
            return [(row["result.status"], row["result.reason"]) for row in rows]

        for time, output, reason in [("{dt: 1e-12}", "{histories: 1}", "make output.histories or output.budget larger"),
                                     ("{dt: 1e-12}", "{budget: 1}", "make output.histories or output.budget larger"),
                                     ("{start: 1e17, steps: 3}", "{}", "vanish in the digits of time.start")]:
            [(status, said)] = outcomes(time, output)
            self.assertEqual(status, "refused")
            self.assertIn(reason, said)
        self.assertEqual(outcomes("{start: 1e5, steps: 3}"), [("ok", "")])


class Compare(Case):
    def setUp(self):
        super().setUp()
        self.call("run", "small.yaml", "-q")

    def test_pivot(self):
        done = self.call("compare", "small.study/")
        self.assertEqual(done.stderr, "")
        self.assertIn("result.displacement.max.rms [m]", done.stdout)
        self.assertEqual(done.stdout.count("order"), 4)
        self.assertTrue(all(len(line) <= 120 for line in done.stdout.splitlines()))
        two = self.call("compare", "small.study", "--value", "result.crossings", "--value", "result.seconds").stdout
        self.assertNotIn("order", two)
        self.assertIn("result.seconds [s]", two)

    def test_csv_matches_the_table(self):
        rows = list(csv.DictReader(io.StringIO(self.call("compare", "small.study", "--csv").stdout)))
        table = list(csv.DictReader((self.dir / "small.study" / "table.csv").read_text().splitlines()))
        name = "result.displacement.max.rms"
        self.assertEqual(sorted(r[name] for r in rows), sorted(r[name] for r in table))
        self.assertEqual([r["mesh.cells"] for r in rows], sorted((r["mesh.cells"] for r in table), key=int))
        self.assertEqual([bool(r[name + ".order"]) for r in rows], [False] * 4 + [True] * 8)

    def test_studies_side_by_side(self):
        self.call("run", "small.yaml", "-q", "-o", "again.study", "--set", "method.space=standard")
        out = self.call("compare", "small.study", "again.study").stdout
        self.assertIn("again", out)
        self.call("compare", "small.study", "small.study", code=2)

    def test_studies_of_different_problems_are_no_refinement(self):
        for name, modulus, cells in (("soft", "16", "[8, 16]"), ("hard", "1e4", "32"), ("soft-too", "16", "32")):
            text = f"problem: {{name: bar-linear, modulus: {modulus}}}\nmesh: {{cells: {cells}}}\ntime: {{cfl: 0.4, periods: 0.1}}\n"
            (self.dir / f"{name}.yaml").write_text(text)
            self.call("run", f"{name}.yaml", "-q", "-o", f"{name}.study")
        apart = self.call("compare", "soft.study", "hard.study").stdout
        self.assertIn("modulus 16", apart)
        self.assertIn("modulus 10000", apart)
        self.assertNotIn("modulus", self.call("compare", "soft.study", "soft-too.study").stdout)

    def test_questions_that_have_no_answer(self):
        for args, hint in [(["--rows", "mesh.cels"], "mesh.cells"), (["--columns", "x"], "method.space"),
                           (["--value", "crossings"], "result.crossings"), (["--columns", "method.space"], "method.degree")]:
            done = self.call("compare", "small.study", *args, code=2)
            self.assertEqual(done.stdout, "")
            self.assertIn(hint, done.stderr)


class Check(Case):
    def test_cases_and_totals(self):
        out = self.call("check", "small.yaml").stdout
        self.assertIn("12 cases", out)
        self.assertIn("stable_dt", out)
        self.assertNotIn("above", out)
        out = self.call("check", "small.yaml", "--set", "time.cfl=5", "--set", "mesh.cells=16").stdout
        self.assertIn("4 cases, 4 with dt above the stable dt", out)
        out = self.call("check", "small.yaml", "--set", "method.basis=[bspline, cpgimp]").stdout
        self.assertIn("refused", out)
        for key in ("histories", "spectra", "snapshots"):
            out = self.call("check", "small.yaml", "--set", "time.steps=100000000000", "--set", f"output.{key}=1").stdout
            self.assertIn("12 refused", out)
            self.assertIn(f"make output.{key}", out)
        self.assertEqual([p.name for p in self.dir.iterdir()], ["small.yaml"])


def float_equal(text, value):
    try:
        return float(text) == value
    except ValueError:
        return False


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
