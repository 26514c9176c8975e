# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures: what is drawn, what stays beside it, hostile names, messages. usage: test_plot.py GRIDCROSS"""
import csv
import math
import os
import re
import shutil
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
from studied import PROGRAM, Studied

if not shutil.which("gnuplot"):
    print("skipped: gnuplot is not installed")
    sys.exit(77)
STUDY = """title: small
problem: {name: bar-neo-hookean}
mesh: {cells: [8, 16, 32]}
method: {space: [standard, moving-mesh], degree: [1, 2]}
time: {cfl: 0.4, periods: 0.25}
output: {histories: 2}
"""
HOSTILE = "a'b \"c\" `touch p1` $(touch p2) %d %s @x {/Bold y} z^2_3 \\n ~a{.8b} <i> & # ; system('touch p3')"


class Case(Studied):
    study = STUDY

    def call(self, *args, **more):
        done = super().call(*args, **more)
        self.assertEqual(done.stdout, "")
        return done

    def run_study(self, *args):
        subprocess.run([PROGRAM, "run", "-q", *args], cwd=self.dir, check=True, capture_output=True)

    def plot(self, *args, **more):
        return self.call("plot", "small.study", *args, **more)

    def rows(self, name):
        with open(self.dir / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def table(self):
        return self.rows("small.study/table.csv")

    def texts(self, name):
        """Texts of an SVG, parts of one joined."""
        root = ElementTree.parse(self.dir / name).getroot()
        return ["".join(t.itertext()).strip() for t in root.iter("{http://www.w3.org/2000/svg}text")]


class Lines(Case):
    def test_defaults(self):
        done = self.plot("-o", "fig.svg")
        self.assertEqual(done.stderr, "")
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()),
                         ["fig.csv", "fig.gp", "fig.svg", "small.study", "small.yaml"])
        rows, error = self.rows("fig.csv"), "result.displacement.max.rms"
        self.assertEqual(list(rows[0]), ["line", "mesh.cells", error, "label"])
        cases = {(f"{c['method.space']}, degree {c['method.degree']}", c["mesh.cells"]): c[error] for c in self.table()}
        self.assertEqual({(r["label"], r["mesh.cells"]): r[error] for r in rows}, cases)
        self.assertEqual([r["mesh.cells"] for r in rows], ["8", "16", "32"] * 4)
        texts = self.texts("fig.svg")
        for expected in ("small", "mesh.cells", error + " [m]", "8", "16", "32"):
            self.assertIn(expected, texts)
        for label in {label for label, _ in cases}:
            order = math.log2(float(cases[label, "16"]) / float(cases[label, "32"]))
            self.assertIn(f"{label} (order {order:.1f})", texts)
        marks = re.findall(r"<use xlink:href='#gpPt(\d+)' transform='translate", (self.dir / "fig.svg").read_text())
        shown = [int(m) for m in marks if int(m) != 0]
        self.assertEqual(sorted(set(shown)), [3, 4, 5, 6])  # filled and open circles and squares: one marker a line
        for kind in set(shown):
            self.assertGreaterEqual(shown.count(kind), 3 + 1, kind)  # points, and samples in the legend
        script = (self.dir / "fig.gp").read_text()
        self.assertIn("set logscale x\n", script)
        self.assertIn("set logscale y\n", script)

    def test_equal_bytes(self):
        for ending in ("svg", "pdf", "png"):
            names = [f"fig.{e}" for e in (ending, "csv", "gp")]
            self.plot("-o", f"fig.{ending}")
            first = [(self.dir / name).read_bytes() for name in names]
            time.sleep(1.1)  # a PDF would hold the second at which it was made
            self.plot("-o", f"fig.{ending}", env={**os.environ, "TZ": "Asia/Tokyo", "HOME": str(self.dir)})
            self.assertEqual(first, [(self.dir / name).read_bytes() for name in names], ending)

    def test_triangles_show_the_orders_of_their_lines(self):
        self.run_study("small.yaml", "--set", "method.mass=consistent", "--set", "method.space=moving-mesh", "--set", "method.degree=[1, 3]",
                       "--set", "method.clock=rk4", "-o", "orders.study")
        self.call("plot", "orders.study", "-o", "fig.svg")
        rows, script = self.rows("fig.csv"), (self.dir / "fig.gp").read_text()
        error, measured = "result.displacement.max.rms", {}
        for a, b in zip(rows, rows[1:]):
            if a["line"] == b["line"]:
                slope = -math.log(float(b[error]) / float(a[error])) / math.log(int(b["mesh.cells"]) / int(a["mesh.cells"]))
                measured[a["mesh.cells"], b["mesh.cells"], f"{slope:.1f}"] = slope
        shown = re.findall(r"set label '(\d+\.\d)'", script)
        self.assertEqual(len(shown), 2)  # orders 2 and 4
        block = [[tuple(map(float, p.split(","))) for p in t.split()] for t in
                 re.search(r"triangles << EOD\n(.*?)EOD", script, re.S)[1].split("\n\n")]
        for label, (p, q, corner, again) in zip(shown, block):
            self.assertEqual(p, again)
            self.assertIn(corner, ((p[0], q[1]), (q[0], p[1])))
            drawn = -math.log(q[1] / p[1]) / math.log(q[0] / p[0])
            self.assertEqual(f"{drawn:.1f}", label)
            self.assertTrue([m for m in measured.values() if math.isclose(m, drawn, rel_tol=1e-9)], (label, measured))

    def test_formats(self):
        for ending, magic in (("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
            self.plot("-o", f"fig.{ending}")
            self.assertTrue((self.dir / f"fig.{ending}").read_bytes().startswith(magic))

    def test_script_draws_by_itself(self):
        (self.dir / "figures").mkdir()
        self.plot("-o", "figures/fig.svg")
        drawn = (self.dir / "figures/fig.svg").read_bytes()
        os.rename(self.dir / "figures", self.dir / "moved")
        (self.dir / "moved/fig.svg").unlink()
        subprocess.run(["gnuplot", "-d", "fig.gp"], cwd=self.dir / "moved", check=True, capture_output=True)
        self.assertEqual(drawn, (self.dir / "moved/fig.svg").read_bytes())

    def test_every_line_has_its_legend(self):
        (self.dir / "many.yaml").write_text(
            "problem: {name: bar-neo-hookean}\nmesh: {cells: [4, 8]}\ntime: {cfl: 0.1, periods: 0.02}\n"
            "method: {space: [standard, moving-mesh], degree: [1, 2, 3], mass: [lumped, consistent], "
            "clock: [euler-stress-last, central-difference, rk4, yoshida4, pefrl]}\n")
        self.run_study("many.yaml")
        self.call("plot", "many.study", "-o", "fig.svg")
        self.assertEqual(len([t for t in self.texts("fig.svg") if "degree" in t]), 60)
        styles = re.findall(r"set style line \d+ (.*)", (self.dir / "fig.gp").read_text())
        self.assertEqual(len(set(styles)), 60)

    def test_by_leads_label_and_colour(self):
        self.plot("--by", "method.degree", "-o", "fig.svg")
        rows = self.rows("fig.csv")
        self.assertEqual(rows[0]["label"], "degree 1, standard")
        styles = re.findall(r"linecolor rgb '(\S+)' .*? pointtype (\d+)", (self.dir / "fig.gp").read_text())
        self.assertEqual([s[0] for s in styles], [styles[0][0]] * 2 + [styles[2][0]] * 2)
        self.assertNotEqual(styles[0][0], styles[2][0])
        self.assertNotEqual(styles[0][1], styles[1][1])

    def test_result_as_x(self):
        self.plot("--x", "result.seconds", "--y", "result.crossings", "-o", "fig.svg")
        rows = self.rows("fig.csv")
        self.assertEqual(list(rows[0])[1:3], ["result.seconds", "result.crossings"])
        seconds = sorted(float(r["seconds"]) for r in self.rows("small.study/timing.csv") if r["seconds"])
        self.assertEqual(sorted(float(r["result.seconds"]) for r in rows), seconds)
        self.assertNotIn("(order", (self.dir / "fig.gp").read_text())
        self.assertNotIn("set logscale y", (self.dir / "fig.gp").read_text())  # the moving mesh has no crossings

    def test_linear_axes_show_no_order(self):
        self.run_study("small.yaml", "--set", "mesh.cells=[8, 9]", "-o", "near.study")
        self.call("plot", "near.study", "-o", "fig.svg")
        script = (self.dir / "fig.gp").read_text()
        self.assertNotIn("set logscale x", script)
        self.assertNotIn("(order", script)

    def test_cases_that_failed_are_left_out(self):
        (self.dir / "fast.yaml").write_text(STUDY.replace("cfl: 0.4", "cfl: [0.4, 50]").replace("degree: [1, 2]", "degree: 1"))
        self.run_study("fast.yaml")
        bad = [c["result.status"] for c in self.rows("fast.study/table.csv") if c["result.status"] != "ok"]
        self.assertTrue(bad)
        for kind in ("lines", "history"):
            done = self.call("plot", "fast.study", kind, "-o", f"{kind}.svg")
            self.assertRegex(done.stderr, rf"^note: {len(bad)} cases are left out: ")
            for status in set(bad):
                self.assertIn(f"{bad.count(status)} {status}", done.stderr)
                self.assertTrue([t for t in self.texts(f"{kind}.svg") if "left out" in t and f"{bad.count(status)} {status}" in t])
        drawn = {r["label"] for r in self.rows("history.csv")}
        points = {(f"cells {r['mesh.cells']}, " + r["label"]) for r in self.rows("lines.csv")}
        ok = {f"cells {c['mesh.cells']}, {c['method.space']}, cfl {float(c['time.cfl']):g}"
              for c in self.rows("fast.study/table.csv") if c["result.status"] == "ok"}
        self.assertEqual(drawn, ok)
        self.assertEqual(points, ok)


class History(Case):
    def test_samples_as_stored(self):
        self.plot("history", "--y", "energy.kinetic", "-o", "fig.svg")
        rows = self.rows("fig.csv")
        self.assertEqual(list(rows[0]), ["line", "time", "energy.kinetic", "label"])
        self.assertEqual(len({r["label"] for r in rows}), 12)
        ends = {}
        for row in rows:
            ends[row["label"]] = float(row["time"])
        expected = float(self.table()[0]["result.time"])
        self.assertEqual(set(ends.values()), {expected})
        self.assertIn("time [s]", self.texts("fig.svg"))
        self.assertIn("energy.kinetic [J]", self.texts("fig.svg"))

    def test_last_error_is_the_table_s(self):
        self.plot("history", "-o", "fig.svg", "--by", "method.space")
        last = {r["label"]: r["displacement.rms"] for r in self.rows("fig.csv")}
        for case in self.table():
            label = f"{case['method.space']}, cells {case['mesh.cells']}, degree {case['method.degree']}"
            self.assertEqual(last[label], case["result.displacement.final.rms"])

    def test_none_kept(self):
        self.run_study("small.yaml", "--set", "output.histories=0", "-o", "none.study")
        self.assertIn("set output.histories", self.call("plot", "none.study", "history", "-o", "fig.svg", code=2).stderr)


class Spectrum(Case):
    def test_last_sample_with_the_grid_marked(self):
        self.run_study("small.yaml", "--set", "output.spectra=3")
        self.plot("spectrum", "--y", "stress", "-o", "fig.svg", "--by", "method.space")
        rows = self.rows("fig.csv")
        self.assertEqual(list(rows[0]), ["line", "wavenumber", "stress", "label"])
        for case in self.table():
            label = f"{case['method.space']}, cells {case['mesh.cells']}, degree {case['method.degree']}"
            mine = [r for r in rows if r["label"] == label]
            self.assertEqual([float(r["wavenumber"]) for r in mine], sorted(float(r["wavenumber"]) for r in mine))
            above = sum(float(r["stress"]) ** 2 for r in mine if float(r["wavenumber"]) > int(case["mesh.cells"]) / 2)
            self.assertTrue(math.isclose(above, float(case["result.spectrum.stress.above"]) ** 2, rel_tol=1e-9), label)
        self.assertEqual(self.texts("fig.svg").count("Nyquist wavenumber of the grid"), 1)
        script = (self.dir / "fig.gp").read_text()
        self.assertEqual(script.count("set arrow"), 3)  # of 8, 16 and 32 cells
        for line in ("set logscale x\n", "set logscale y\n", "from first 4,", "from first 8,", "from first 16,"):
            self.assertIn(line, script)
        self.assertNotIn("Nyquist", self.plot("history", "-o", "history.svg").stderr + (self.dir / "history.gp").read_text())


class Hostile(Case):
    def assert_inert(self, *figures):
        found = [p.name for p in self.dir.rglob("*") if re.fullmatch(r"p\d", p.name)]
        self.assertEqual(found, [])
        for figure in figures:
            self.assertTrue((self.dir / figure).read_bytes().startswith(b"<?xml"), figure)

    def test_titles(self):
        for number, title in enumerate((HOSTILE, "one\ntwo\t\x7fthree", "trailing \\", "'", "'; system('touch p4') #", "'' ''",
                                          "\\", "ä → ∂²u", "`", "@", "x ]]> y")):
            quoted = "".join(f"\\x{ord(c):02x}" if ord(c) < 128 and not c.isalnum() else c for c in title)
            (self.dir / "odd.yaml").write_text(STUDY.replace("title: small", f'title: "{quoted}"'), encoding="utf-8")
            self.run_study("odd.yaml")
            self.call("plot", "odd.study", "-o", "fig.svg")
            self.assert_inert("fig.svg")
            expected = re.sub(r"[\n\t\x7f]", " ", title).replace("]]>", "]] >")  # which ends what XML cannot
            self.assertIn(" ".join(expected.split()), " ".join(" ".join(self.texts("fig.svg")).split()))  # of a line or two

    def test_long_titles_take_two_lines(self):
        words = " ".join(f"{i} ä\\`" for i in range(100))
        for title, lines, end in ((words[:120], 2, words[112:120]), (words, 2, "…"), ("ä" * 300, 2, "…")):
            (self.dir / "long.yaml").write_text(STUDY.replace("title: small", f"title: '{title}'"), encoding="utf-8")
            self.run_study("long.yaml")
            self.call("plot", "long.study", "-o", "fig.svg")
            self.assert_inert("fig.svg")
            found = [t for t in self.texts("fig.svg") if "ä" in t]
            self.assertEqual(len(found), lines)
            self.assertTrue(found[-1].endswith(end), found)
            self.assertLess(max(map(len, found)), 75)
            self.assertTrue("".join(title.split()).startswith("".join(" ".join(found).rstrip("…").split())))

    def test_study_names_in_labels(self):
        names = [HOSTILE.replace("/", "|"), "new\nline, comma", os.fsdecode(b"\xff\xfe bad utf-8")]
        for name in names:
            shutil.copytree(self.dir / "small.study", self.dir / name)
        self.call("plot", *names, "-o", "fig.svg")
        self.assert_inert("fig.svg")
        texts = self.texts("fig.svg")
        for name in (names[0], "new line, comma", "?? bad utf-8"):
            self.assertTrue([t for t in texts if name in t], name)
        lines = (self.dir / "fig.csv").read_bytes().count(b"\n")
        self.assertEqual(lines, 1 + 12 * len(names))  # gnuplot reads lines

    def test_figure_names(self):
        names = ["|touch p1;.svg", "< touch p1.svg", "-e.svg", "a'b.svg", "`touch p1`.svg", "$(touch p1).svg", "%d.svg", "@x.svg",
                 "~.svg", "\\.svg", "#.svg", "a.b.svg", '".svg', "{x}^2.svg", "-.svg",
                 "'; system('touch p4') #.svg"]
        folder = "it's `touch p2` \"$(touch p3)\" %s"
        (self.dir / folder).mkdir()
        for name in names:
            self.plot("-o", name)
            self.plot("-o", f"{folder}/{name}")
            self.assert_inert(name, f"{folder}/{name}")
        for folder in ("~", "'", "' x", "`touch p5`", '"', "\\", "-e"):
            (self.dir / folder).mkdir()
            self.plot("-o", f"{folder}/fig.svg")
            self.assert_inert(f"{folder}/fig.svg")
        self.assertIn("control", self.plot("-o", "a\nb.svg", code=2).stderr)
        self.assertEqual([p for p in self.dir.iterdir() if "\n" in p.name], [])

    def test_other_files_are_left_alone(self):
        before = (self.dir / "small.study/table.csv").read_bytes()
        for name in ("table", "timing"):
            self.assertIn(f"{name}.csv", self.plot("-o", f"small.study/{name}.svg", code=2).stderr)
        self.assertEqual((self.dir / "small.study/table.csv").read_bytes(), before)
        (self.dir / "mine.gp").write_text("plot sin(x)\n")
        self.assertIn("mine.gp", self.plot("-o", "mine.svg", code=2).stderr)
        self.assertEqual((self.dir / "mine.gp").read_text(), "plot sin(x)\n")


class Front(Case):
    def test_a_history_or_spectrum_has_no_front(self):
        for kind in ("history", "spectrum"):
            self.assertIn(f"{kind} has no front", self.plot(kind, "--front", "-o", "fig.svg", code=2).stderr)

    def test_every_case_and_the_front(self):
        self.assertRegex(self.plot("--front", "-o", "fig.svg").stderr, r"\A(note: \d+ cases? ha\w+ no cost\n)?\Z")  # lost in noise
        rows, error = self.rows("fig.csv"), "result.displacement.max.rms"
        self.assertEqual(list(rows[0]), ["line", "result.seconds", error, "label"])
        seconds = {r["case"]: r["seconds"] for r in self.rows("small.study/timing.csv")}
        cases = sorted((float(seconds[c["case"]]), float(c[error]), c["method.space"]) for c in self.table() if seconds[c["case"]])
        drawn = [(float(r["result.seconds"]), float(r[error]), r["label"]) for r in rows]
        self.assertEqual(sorted(d for d in drawn if d[2] != "front"), cases)
        front, best = [], math.inf
        for cost, err, _ in cases:
            if err < best:
                best = err
                front.append((cost, err, "front"))
        self.assertEqual([d for d in drawn if d[2] == "front"], front)
        texts = self.texts("fig.svg")
        for expected in ("small", "result.seconds [s]", error + " [m]", "standard", "moving-mesh", "front"):
            self.assertIn(expected, texts)
        script = (self.dir / "fig.gp").read_text()
        self.assertEqual(script.count(" with points "), 2)
        self.assertEqual(script.count(" with steps "), 1)
        for axis in "xy":
            self.assertIn(f"set logscale {axis}\n", script)

    def test_by_y_x_and_where(self):
        self.plot("--front", "--by", "mesh.cells", "--by", "method.degree", "--y", "result.velocity.final.rms", "--x", "result.steps",
                  "--where", "method.space=standard", "-o", "fig.svg")
        rows = self.rows("fig.csv")
        self.assertEqual(list(rows[0])[1:3], ["result.steps", "result.velocity.final.rms"])
        labels = [f"cells {n}, degree {k}" for n in (8, 16, 32) for k in (1, 2)]
        self.assertEqual([r["label"] for r in rows][:6], labels)
        self.assertEqual({r["label"] for r in rows} - set(labels), {"front"})

    def test_cases_left_out_are_counted(self):
        self.run_study("small.yaml", "--set", "time.cfl=[0.4, 1.5, 6]", "-o", "wild.study")
        done = self.call("plot", "wild.study", "--front", "-o", "fig.svg")
        self.assertIn("are left out: ", done.stderr)
        self.assertIn("left out: dt is above the stable step", done.stderr)

    def test_one_case(self):
        self.run_study("small.yaml", "--set", "mesh.cells=8", "--set", "method.space=standard", "--set", "method.degree=2", "-o", "one.study")
        self.assertEqual(self.call("plot", "one.study", "--front", "-o", "fig.svg").stderr, "")
        self.assertEqual([r["label"] for r in self.rows("fig.csv")], ["", "front"])

    def test_refusals(self):
        (self.dir / "small.study/timing.csv").unlink()
        for args, hint in [(["--front"], "timing.csv"), (["--front", "history"], "leave out history or --front"),
                           (["--front", "spectrum"], "leave out spectrum or --front"),
                           (["--front", "--by", "method.spce"], "did you mean method.space?"),
                           (["--front", "--x", "result.status"], "not a number"), (["--front", "--y", "result.stauts"], "result.status"),
                           (["--front", "--where", "mesh.cells=9"], "there are: 8 16 32")]:
            with self.subTest(args=args):
                self.assertIn(hint, self.plot(*args, "-o", "fig.svg", code=2).stderr)
        self.assertFalse((self.dir / "fig.csv").exists())


class Messages(Case):
    def test_usage(self):
        for args, hint in [
            ([], "-o FIGURE.svg"), (["-o", "fig"], ".svg, .png or .pdf"), (["-o", "fig.jpg"], ".svg, .png or .pdf"),
            (["-o", ".svg"], ".svg, .png or .pdf"), (["-o", ""], ".svg, .png or .pdf"),
            (["--y", "result.crosings"], "did you mean result.crossings?"), (["--x", "mesh.cell"], "did you mean mesh.cells?"),
            (["--by", "method.spce"], "did you mean method.space?"), (["--x", "method.space"], "not a number"),
            (["--y", "result.status"], "not a number"), (["--x", "mesh.cells", "--by", "mesh.cells"], "both"),
            (["--y", "result.reason"], "not a number"), (["histry"], "did you mean history?"),
            (["xt"], "set output.snapshots"), (["quiver"], "lines, history, xt, field and spectrum"),
            (["none/"], "none"), (["history", "--x", "time"], "leave out --x"),
            (["spectrum", "--x", "wavenumber"], "leave out --x"), (["spectrum", "--y", "strain"], "no spectrum"),
            (["spectrum"], "set output.spectra"), (["spektrum"], "did you mean spectrum?"), (["history", "--y", "status"], "no history"),
            (["history", "--y", "energy.kinetc"], "did you mean energy.kinetic?"), (["history", "--y", ""], "no history"),
            (["history", "--y", "."], "no history"), (["history", "--y", "/table"], "no history"),
            (["--y", "result.particle"], "no case has"),
        ]:
            with self.subTest(args=args):
                more = [] if not args or "-o" in args else ["-o", "fig.svg"]
                self.assertIn(hint, self.plot(*args, *more, code=2).stderr)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["small.study", "small.yaml"])

    def test_help_names_every_kind(self):
        text = subprocess.run([PROGRAM, "plot", "--help"], check=True, capture_output=True, text=True).stdout
        for kind in ("lines", "history", "spectrum", "xt", "field"):
            self.assertRegex(text, rf"(?m)^  {kind} +\S")
            self.assertRegex(text, rf"gridcross plot FILE.study (?:{kind} |--x)")

    def test_gnuplot_absent(self):
        (self.dir / "fig.svg").write_text("old")
        done = self.plot("-o", "fig.svg", code=1, env={"PATH": str(self.dir)})
        self.assertIn("apt-get install gnuplot-nox", done.stderr)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["fig.csv", "fig.gp", "small.study", "small.yaml"])

    def test_gnuplot_fails(self):
        fake = self.dir / "bin"
        fake.mkdir()
        (fake / "gnuplot").write_text("#!/bin/sh\nexit 3\n")
        (fake / "gnuplot").chmod(0o755)
        self.assertIn("could not draw", self.plot("-o", "fig.svg", code=1, env={"PATH": str(fake)}).stderr)

    def test_an_image_cut_short_is_no_figure(self):
        """gnuplot ends well on a full disk."""
        fake = self.dir / "bin"
        fake.mkdir()
        (fake / "gnuplot").write_text("#!/bin/sh\nfor image in fig.svg fig.png fig.pdf; do echo '<svg><path/>' > $image; done\n")
        (fake / "gnuplot").chmod(0o755)
        for ending in ("svg", "png", "pdf"):
            with self.subTest(ending=ending):
                err = self.plot("-o", f"fig.{ending}", code=1, env={"PATH": f"{fake}:/usr/bin:/bin"}).stderr
                self.assertIn(f"fig.{ending} could not be written whole", err)
                self.assertFalse((self.dir / f"fig.{ending}").exists())

    def test_unwritable(self):
        self.assertIn("cannot write none/fig.gp", self.plot("-o", "none/fig.svg", code=1).stderr)


unittest.main(argv=sys.argv[:1])
