# SPDX-License-Identifier: GPL-3.0-or-later
"""The page that `gridcross report` writes, without a browser. usage: test_report.py PROGRAM"""
import base64
import hashlib
import json
import shutil
import subprocess
import sys
import unittest
from html.parser import HTMLParser

import h5py

from studied import PROGRAM, Studied

MEGABYTE = 1000000
VOID = {"meta", "link", "br", "input", "img"}
HOSTILE = "\"'><script>alert(1)</script> & <!-- --> \u2028 \u2029 `$(id)` %s\nsecond line"
SMALL = """title: Two spaces
problem: {name: bar-neo-hookean}
mesh: {cells: [8, 16], particles_per_cell: 2}
method: {space: [standard, moving-mesh], degree: 1}
time: {cfl: 0.4, periods: 0.25}
output: {histories: 2, spectra: 4, snapshots: 3}
"""


class Page(HTMLParser):
    """Elements that open and close in order, with attributes and texts."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.elements, self.texts = [], [], {}
        self.feed(text)
        self.close()
        if self.open:
            raise ValueError(f"not closed: {self.open}")

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append((tag, dict(attrs).get("id") or tag))

    def handle_endtag(self, tag):
        if not self.open or self.open.pop()[0] != tag:
            raise ValueError(f"</{tag}> closes nothing")

    def handle_data(self, text):
        key = self.open[-1][1] if self.open else ""
        self.texts[key] = self.texts.get(key, "") + text

    def every(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]


class Report(Studied):
    study = SMALL

    def report(self, *directories, output="report.html", **more):
        self.call("report", *(directories or ["small.study"]), "-o", output, **more)
        text = (self.dir / output).read_text()
        page = Page(text)
        return text, page, json.loads(page.texts["data"])

    def test_page_needs_nothing_else(self):
        text, page, data = self.report()
        self.assertLess(len(text.encode()), 2 * MEGABYTE)
        self.assertEqual([s.get("type") for s in page.every("script")], ["application/json", None])
        self.assertFalse([a for _, a in page.elements if "src" in a])
        self.assertEqual({a["href"] for a in page.every("link")}, {"data:,"})
        self.assertEqual({a["href"] for a in page.every("a")}, {"#main"})
        self.assertEqual(data["studies"][0]["title"], "Two spaces")
        self.assertEqual(data["studies"][0]["run_file"], SMALL)

    def test_policy_admits_own_script_and_style_alone(self):
        text, page, _ = self.report()
        policy = next(m["content"] for m in page.every("meta") if m.get("http-equiv") == "Content-Security-Policy")
        rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
        self.assertEqual(rules["default-src"], "'none'")
        for rule, key, end in (("script-src", "<script>", "</script>"), ("style-src", "<style>", "</style>")):
            source = text.split(key, 1)[1].split(end, 1)[0]
            digest = base64.b64encode(hashlib.sha256(source.encode()).digest()).decode()
            self.assertEqual(rules[rule], f"'sha256-{digest}'")
        self.assertNotIn("unsafe", policy)
        self.assertNotIn("innerHTML", text)
        self.assertIn("Permission is hereby granted", text)  # the licence of uPlot

    def test_hostile_texts_stay_texts(self):
        run_file = SMALL.replace("title: Two spaces", "title: " + json.dumps(HOSTILE)) + f"# {HOSTILE.splitlines()[0]}\n"
        (self.dir / "hostile.yaml").write_text(run_file)
        self.call("run", "hostile.yaml", "-q", "-o", "a'\"<b>.study")
        text, page, data = self.report("a'\"<b>.study")
        self.assertEqual(len(page.every("script")), 2)
        self.assertEqual(data["studies"][0]["title"], HOSTILE)
        self.assertEqual(data["studies"][0]["run_file"], run_file)
        self.assertEqual(data["studies"][0]["name"], "a'\"<b>")
        self.assertEqual(page.texts["title"], HOSTILE.replace("\n", " "))
        self.assertEqual(page.texts["h1"].strip(), HOSTILE.replace("\n", " "))
        self.assertNotIn("<", text.split('id="data">', 1)[1].split("</script>", 1)[0])

    def test_numbers_are_those_of_the_table(self):
        _, _, data = self.report()
        table = json.loads(self.call("run", "small.yaml", "-q", "--json").stdout)
        self.assertEqual(data["cases"]["total"], len(table))
        columns = [c["name"] for c in data["cases"]["columns"]]
        for row, want in zip(data["cases"]["rows"], table):
            self.assertEqual(row[:2], [want["case"], want["result.status"]])
            self.assertEqual([a["values"][rank] for a, rank in zip(data["axes"], row[3])], [str(want[a["path"]]) for a in data["axes"]])
            for name, value in zip(columns, row[4]):
                if name not in ("result.seconds", "result.ns_per_particle_step"):
                    self.assertEqual(value, float(f"{want[name]:.6g}"), name)
        compared = self.call("compare", "small.study").stdout
        orders = next(o for o in data["compare"]["orders"] if columns[o["result"]] == "result.displacement.max.rms")["order"]
        for order in orders:
            self.assertIn(f"{order[1]:.2f}", compared)

    def test_histories_are_those_of_the_study(self):
        _, _, data = self.report()
        self.assertEqual(data["histories"]["total"], 4)
        for curve in data["histories"]["curves"]:
            row = data["cases"]["rows"][curve["case"]]
            last = dict(zip((c["name"] for c in data["cases"]["columns"]), row[4]))
            self.assertEqual(curve["displacement.rms"][-1], last["result.displacement.final.rms"])
            self.assertEqual(curve["time"][-1], last["result.time"])
        self.assertEqual({len(c["wavenumber"]) for c in data["spectra"]["curves"]}, {8, 16})

    def test_paths_are_those_of_snapshots(self):
        _, _, data = self.report()
        self.assertEqual([data["cases"]["rows"][t["case"]][3][1] for t in data["tracks"]["cases"]], [0, 1, 0, 1])  # pairs of spaces
        for track in data["tracks"]["cases"]:
            row = data["cases"]["rows"][track["case"]]
            with h5py.File(self.dir / "small.study" / f"case-{row[0]}.h5") as file:
                steps = sorted(file["data"], key=int)
                place = [file[f"data/{step}/particles/material_points/position/x"][:] for step in steps]
                time = [file[f"data/{step}"].attrs["time"] for step in steps]
            self.assertEqual(track["time"], [float(f"{t:.6g}") for t in time])
            self.assertEqual(len(track["path"]), len(place[0]))
            for p, path in enumerate(track["path"]):
                for i in range(len(steps)):
                    self.assertAlmostEqual(sum(path[:i + 1]) / data["tracks"]["per_metre"], place[i][p], delta=5.1e-6)
            cells = [8, 16][row[3][0]]
            self.assertEqual((track["cells"], len(track["edge"])), (0 if row[3][1] else cells, cells + 1))

    def test_equal_studies_give_equal_bytes(self):
        pages = []
        for place in ("one", "two"):
            (self.dir / place).mkdir()
            self.call("run", "small.yaml", "-q", "-j", 1 if place == "one" else 2, "-o", f"{place}/small.study")
            (self.dir / place / "small.study" / "timing.csv").unlink()
            subprocess.run([PROGRAM, "report", "small.study"], cwd=self.dir / place, check=True, capture_output=True)
            pages.append((self.dir / place / "report.html").read_bytes())
        self.assertEqual(*pages)

    def test_large_studies_fit(self):
        (self.dir / "large.yaml").write_text("problem: {name: bar-neo-hookean}\nmesh: {cells: [4, 8], particles_per_cell: 2}\n"
                                             "method: {space: [standard, moving-mesh], mass: [lumped, consistent]}\n"
                                             "time: {cfl: {lin: [0.1, 0.4, 300]}, steps: 2}\noutput: {histories: 1}\n")
        self.call("run", "large.yaml", "-q")
        text, _, data = self.report("large.study")
        self.assertLess(len(text.encode()), 2 * MEGABYTE)
        self.assertEqual(data["cases"]["total"], 2400)
        self.assertGreater(len(data["cases"]["rows"]), 400)

    def test_failures_are_told(self):
        (self.dir / "failing.yaml").write_text(SMALL.replace("cfl: 0.4", "cfl: [0.4, 3]"))
        self.call("run", "failing.yaml", "-q")
        _, _, data = self.report("failing.study")
        ended = {row[1]: row[2] for row in data["cases"]["rows"]}
        self.assertGreater(len(ended), 1)
        self.assertTrue(all(reason for status, reason in ended.items() if status != "ok"))

    def test_foreign_files_stay(self):
        (self.dir / "report.html").write_text("<!doctype html>\nmine\n")
        done = self.call("report", "small.study", code=2)
        self.assertIn("report.html: is no report of gridcross and will not be overwritten", done.stderr)
        self.assertEqual((self.dir / "report.html").read_text(), "<!doctype html>\nmine\n")
        (self.dir / "report.html").unlink()
        self.call("report", "small.study")
        self.call("report", "small.study")
        self.assertFalse(list(self.dir.glob("*.partial")))

    def test_studies_side_by_side_and_chosen_cases(self):
        shutil.copytree(self.dir / "small.study", self.dir / "other.study")
        _, _, data = self.report("small.study", "other.study", "--where", "mesh.cells=8")
        self.assertEqual([s["name"] for s in data["studies"]], ["small", "other"])
        self.assertEqual([a["path"] for a in data["axes"]], ["method.space", "study"])
        self.assertEqual(data["cases"]["total"], 4)

    def test_what_is_no_study(self):
        self.assertIn("nowhere", self.call("report", "nowhere", code=2).stderr)
        self.assertIn("names no file", self.call("report", "small.study", "-o", "", code=2).stderr)
        self.assertFalse((self.dir / "report.html").exists())


class Paper(Studied):
    study = SMALL

    def test_items_beside_the_print(self):
        self.call("paper", "steffen2010/fig5", "steffen2010/table1", "-q", "-o", "items")
        self.call("report", "items", "-o", "paper.html")
        data = json.loads(Page((self.dir / "paper.html").read_text()).texts["data"])
        rows = json.loads(self.call("paper", "steffen2010/fig5", "steffen2010/table1", "-q", "--json").stdout)
        self.assertEqual([item["item"] for item in data["paper"]], ["table1", "fig5"])
        shown = [row for item in data["paper"] for row in item["rows"]]
        self.assertEqual([(r["row"], r["quantity"], r["verdict"]) for r in shown], [(r["row"], r["quantity"], r["verdict"]) for r in rows])
        for row, want in zip(shown, rows):
            self.assertEqual(row["ours"], want["ours"] if want["ours"] is None else float(f"{want['ours']:.6g}"))
        self.assertTrue(all(item["figures"] for item in data["paper"] if item["item"].startswith("fig")))
        self.assertNotIn("compare", data)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
