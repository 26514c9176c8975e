# SPDX-License-Identifier: GPL-3.0-or-later
"""Advice: the front beside one computed here from the study's files, its picks run again, messages. usage: test_advise.py GRIDCROSS SOURCE_ROOT"""
import csv
import io
import json
import math
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
from studied import PROGRAM, Studied

PROGRAM, ROOT = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
STUDY = """title: small
problem: {name: bar-neo-hookean}
mesh: {cells: [4, 8, 16], particles_per_cell: 2}
method: {space: [standard, moving-mesh], degree: [1, 2, 3], clock: [central-difference, rk4]}
time: {cfl: [0.4, 0.8, 3], periods: 0.5}
"""
ERROR = "result.displacement.max.rms"


class Case(Studied):
    study = STUDY
    options = ("--repeats", "3")

    def front(self, *args, study="small.study"):
        return json.loads(self.call("advise", study, "--json", *args).stdout)

    def cases(self, study="small.study"):
        """Rows of the study that count, with their seconds: ended ok, at a cost that is known, by a step not above the stable one."""
        with open(self.dir / study / "timing.csv", encoding="utf-8") as file:
            seconds = {row["case"]: float(row["seconds"]) for row in csv.DictReader(file) if row["seconds"]}
        with open(self.dir / study / "table.csv", encoding="utf-8") as file:
            rows = [{**row, "seconds": seconds.get(row["case"])} for row in csv.DictReader(file)]
        return rows, [r for r in rows if r["result.status"] == "ok" and r["seconds"] is not None and
                      float(r["result.dt"]) <= float(r["result.stable_dt"])]


class Front(Case):
    def test_beside_the_studys_files(self):
        rows, counted = self.cases()
        expected, best = [], math.inf
        for row in sorted(counted, key=lambda r: (r["seconds"], float(r[ERROR]))):
            if float(row[ERROR]) < best:
                best = float(row[ERROR])
                expected.append((row["case"], best, row["seconds"]))
        front = self.front()
        self.assertEqual([(one["case"], one[ERROR], one["result.seconds"]) for one in front], expected)
        self.assertGreater(len(front), 2)
        self.assertLess(len(front), len(counted))
        self.assertTrue(all(one["pick"] is None for one in front))
        failed = sum(r["result.status"] != "ok" for r in rows)
        above = len(rows) - len(counted) - failed
        self.assertGreater(min(failed, above), 0)
        notes = self.call("advise", "small.study").stderr
        self.assertIn(f"note: {failed} cases are left out: ", notes)
        self.assertIn(f"note: {above} cases are left out: dt is above the stable step\n", notes)
        self.assertNotIn("--repeats", notes)

    def test_forms_agree(self):
        bounds = ["--error", "1e-2", "--error=1e-3", "--error", "1e-30"]
        front = self.front(*bounds)
        rows = list(csv.DictReader(io.StringIO(self.call("advise", "small.study", "--csv", *bounds).stdout)))
        self.assertEqual(list(rows[0]), list(front[0]))
        self.assertEqual(list(front[0]), ["case", "mesh.cells", "method.space", "method.degree", "method.clock", "time.cfl", ERROR,
                                          "result.seconds", "result.dt", "result.stable_dt", "pick", "why", "run_file"])
        self.assertEqual([r["why"] for r in rows], [one["why"] for one in front])
        text = self.call("advise", "small.study", *bounds).stdout
        for bound in ("0.01", "0.001"):
            pick = next(one for one in front if bound in (one["pick"] or "").split())
            self.assertLessEqual(pick[ERROR], float(bound))
            self.assertIn(f"error at most {bound}: case {pick['case']}, error ", text)
            for line in pick["run_file"].splitlines():
                self.assertIn(f"\n  {line}\n", text)
        self.assertIn(f"error at most 1e-30: no case; the nearest is case {front[-1]['case']}, ", text)
        self.assertTrue(all(line == line.rstrip() and len(line) <= 104 for line in text.split("error at most", 1)[1].splitlines()))

    def test_another_error(self):
        name = "result.velocity.final.inf"
        front = self.front("--value", name)
        _, counted = self.cases()
        self.assertEqual(front[-1][name], min(float(r[name]) for r in counted))

    def test_one_of_every_space(self):
        for space in ("standard", "moving-mesh"):
            front = self.front("--where", f"method.space={space}")
            _, counted = self.cases()
            best = min((r for r in counted if r["method.space"] == space), key=lambda r: float(r[ERROR]))
            self.assertEqual(front[-1]["case"], best["case"])
            self.assertNotIn("method.space", front[0])


class Again(Case):
    """What is advised is run again and meets its error."""

    def again(self, study, *bounds):
        options = [word for bound in bounds for word in ("--error", bound)]
        text = self.call("advise", study, "--yaml", *options).stdout
        rows = json.loads(self.call("run", "-", "-o", "again.study", "-q", "--json", input=text.encode()).stdout)
        picks = [one for one in self.front(*options, study=study) if one["pick"]]
        self.assertEqual({(one["case"], one[ERROR]) for one in rows}, {(one["case"], one[ERROR]) for one in picks})
        for bound in bounds:
            self.assertTrue(any(float(bound) in map(float, one["pick"].split()) and one[ERROR] <= float(bound) for one in picks), bound)
        return picks

    def test_small(self):
        self.again("small.study", "1e-2", "1e-3")
        whole = self.call("advise", "small.study", "--yaml").stdout
        rows = json.loads(self.call("run", "-", "-o", "front.study", "-q", "--json", input=whole.encode()).stdout)
        self.assertEqual([one["case"] for one in rows], [one["case"] for one in self.front()])

    def test_one_run_file(self):
        one = self.front("--error", "1e-3")[-1]
        row, = json.loads(self.call("run", "-", "-o", "one.study", "-q", "--json", input=one["run_file"].encode()).stdout)
        self.assertEqual((row["case"], row[ERROR]), (one["case"], one[ERROR]))

    def test_down_to_a_billionth(self):
        """The run file of the repository on its two coarser meshes, 480 cases."""
        self.call("run", ROOT / "runs" / "choice.yaml", "-q", "--set", "mesh.cells=[8, 16]", "--set", "mesh.particles_per_cell=2")
        self.assertGreater(len(self.cases("choice.study")[0]), 200)
        picks = self.again("choice.study", "1e-3", "1e-6", "1e-9")
        spaces = {one["method.space"] for one in picks if {"1e-6", "1e-9"} & set(one["pick"].split())}
        self.assertFalse("standard" in spaces, spaces)  # at 1e-3 the machine's times decide
        why = next(one["why"] for one in picks if "1e-6" in one["pick"].split())
        self.assertRegex(why, r"cheapest with another method.space: standard \(\d\.\d\de-[2-5] at best\)")


class Messages(Case):
    def test_usage(self):
        for args, hint in [
            ([], "missing"), (["none"], "none"), (["."], "study.h5"), (["small.study", "--error"], "missing"),
            (["small.study", "--error", "0"], "positive number, not '0'"), (["small.study", "--error=-1"], "not '-1'"),
            (["small.study", "--error", "nan"], "not 'nan'"), (["small.study", "--error", "1e-3x"], "not '1e-3x'"),
            (["small.study", "--error", ""], "not ''"), (["small.study", "--error", "1e-400"], "1e-400"),
            (["small.study", "--eror", "1"], "--error"), (["small.study", "--csv", "--json"], "not two"),
            (["small.study", "--yaml", "--json"], "not two"), (["small.study", "small.study/"], "named twice"),
            (["small.study", "--value", "displacement.max.rms"], "did you mean result.displacement.max.rms?"),
            (["small.study", "--value", "result.status"], "not an error"), (["small.study", "--value", "mesh.cells"], "not an error"),
            (["small.study", "--value", "result.seconds"], "not an error"),
            (["small.study", "--value", "result.displacement.reference.rms"], "no case has"),
            (["small.study", "--where", "method.space"], "PATH=VALUE"),
            (["small.study", "--where", "method.spce=standard"], "did you mean method.space?"),
            (["small.study", "--where", "method.space=standart"], "there are: standard moving-mesh"),
            (["small.study", "--where", "mesh.cells=9"], "there are: 4 8 16"),
        ]:
            with self.subTest(args=args):
                done = self.call("advise", *args, code=2)
                self.assertEqual(done.stdout, "")
                self.assertIn(hint, done.stderr)

    def test_without_times(self):
        (self.dir / "small.study/timing.csv").unlink()
        self.assertIn("is timing.csv still beside study.h5?", self.call("advise", "small.study", code=2).stderr)

    def test_damaged_times(self):
        path = self.dir / "small.study/timing.csv"
        lines = path.read_text().splitlines()
        counted = {row["case"] for row in self.cases()[1]}
        spoilt = [i for i, line in enumerate(lines) if line.split(",")[0] in counted][:3]
        for i, time in zip(spoilt, ("nan", "-1", "0"), strict=True):
            lines[i] = ",".join([lines[i].split(",")[0], time, "1", "3"])
        path.write_text("\n".join(lines))
        done = self.call("advise", "small.study", "--json")
        self.assertIn("note: 3 cases have no cost\n", done.stderr)
        self.assertFalse({lines[i].split(",")[0] for i in spoilt} & {one["case"] for one in json.loads(done.stdout)})

    def test_times_with_measures(self):
        self.call("run", "small.yaml", "-q", "-o", "once.study")
        self.assertIn("once.study was timed once", self.call("advise", "once.study").stderr)

    def test_nothing_ends_ok(self):
        self.call("run", "small.yaml", "-q", "-o", "bad.study", "--set", "time.cfl=[3, 4]", "--set", "method.space=standard")
        where = ["bad.study", "--where", "result.status=tangled"]
        done = self.call("advise", *where, "--error", "1e-3")
        self.assertIn("front: 0 of", done.stdout)
        self.assertIn("error at most 0.001: no case\n", done.stdout)
        self.assertEqual(json.loads(self.call("advise", *where, "--json").stdout), [])
        self.assertEqual(self.call("advise", *where, "--yaml").stdout, "")

    def test_unmet_errors_are_told(self):
        for form in ("--json", "--csv", "--yaml"):
            done = self.call("advise", "small.study", form, "--error", "1e-30")
            self.assertIn("no case has an error of at most 1e-30; the nearest, case ", done.stderr)
        self.assertEqual(self.call("advise", "small.study", "--yaml", "--error", "1e-30").stdout, "")

    def test_problems_do_not_mix(self):
        self.call("run", "small.yaml", "-q", "-o", "mixed.study", "--set", "problem.amplitude=[0.01, 0.05]")
        self.assertIn("--where problem.amplitude=VALUE", self.call("advise", "mixed.study", code=2).stderr)
        low, high = (self.front("--where", f"problem.amplitude={a}", study="mixed.study") for a in ("0.01", "0.05"))
        self.assertTrue(all("amplitude: 0.01" in one["run_file"] for one in low))
        self.assertEqual({one["case"] for one in high} - {r["case"] for r in self.cases()[0]}, set())
        self.call("run", "small.yaml", "-q", "-o", "steps.study", "--set", "time.steps=10")
        self.assertIn("time.end in place of time.steps", self.call("advise", "steps.study", code=2).stderr)

    def test_several_studies(self):
        for name, space in (("a", "standard"), ("b", "moving-mesh")):
            self.call("run", "small.yaml", "-q", "-o", f"{name}.study", "--repeats=3", "--set", f"method.space={space}")
        front = json.loads(self.call("advise", "a.study", "b.study", "--json").stdout)
        self.assertEqual(front[-1][ERROR], self.front()[-1][ERROR])
        twice = json.loads(self.call("advise", "small.study", "b.study", "--json").stdout)
        self.assertIn("study", twice[0])
        only = self.call("advise", "small.study", "b.study", "--json", "--where", "study=b").stdout
        self.assertEqual(json.loads(only), json.loads(self.call("advise", "b.study", "--json").stdout))


unittest.main(argv=sys.argv[:1])
