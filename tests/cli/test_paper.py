# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper command: items, streams, what it keeps, messages. usage: test_paper.py GRIDCROSS SOURCE_ROOT"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
ITEM = "berzins2021/table4"
COLUMNS = "paper item row quantity ours printed corrected ratio gate verdict reason".split()


class Paper(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.dir = pathlib.Path(place.name)

    def call(self, *args, code=0):
        done = subprocess.run([PROGRAM, "paper", *args], cwd=self.dir, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, code, f"{args}: {done.stdout[-500:]}\n{done.stderr[-500:]}")
        return done

    def test_every_item_of_the_folder_is_listed(self):
        listed = [line.split()[0] for line in self.call("--list").stdout.splitlines()]
        papers = ROOT / "runs/papers"
        self.assertEqual(sorted(listed), sorted(str(p.relative_to(papers).with_suffix("")) for p in papers.glob("*/*.csv")))
        for item in listed:
            self.assertIn(item, subprocess.run([PROGRAM, "list", "papers"], capture_output=True, text=True).stdout)

    def test_streams_agree_with_the_data(self):
        out = self.call(ITEM, "--csv", "-j", "1").stdout
        rows = list(csv.DictReader(out.splitlines()))
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual(out, self.call(ITEM, "--csv", "-j", "2").stdout)
        data = [line for line in (ROOT / f"runs/papers/{ITEM}.csv").read_text().splitlines() if not line.startswith("#")]
        for row, given in zip(rows, csv.DictReader(data), strict=True):
            self.assertEqual([row["row"], row["quantity"], row["gate"]], [given["row"], given["quantity"], given["gate"]])
            self.assertEqual(float(row["printed"]), float(given["printed"]))
            self.assertAlmostEqual(float(row["ours"]) / float(row["printed"]), float(row["ratio"]), places=12)
        for row, same in zip(json.loads(self.call(ITEM, "--json").stdout), rows, strict=True):
            self.assertEqual(list(row), COLUMNS)
            self.assertEqual(row["ours"], float(same["ours"]))
            self.assertEqual(row["corrected"] is None, same["corrected"] == "")

    def test_table_for_people(self):
        out = self.call(ITEM).stdout
        self.assertIn("matches corrected", out)
        self.assertIn("  1: misprint", out)
        self.assertTrue(out.rstrip().endswith("Every gate is met."), out[-200:])

    def test_studies_are_kept(self):
        self.call(ITEM, "-o", "kept", "-q")
        stem = ITEM.replace("/", "-")
        self.assertTrue((self.dir / f"kept/{stem}.study/table.csv").is_file())
        self.call(ITEM, "-o", "kept", "-q")

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_printed_values_are_drawn_over_ours(self):
        item = "berzins2021/table6"
        rows = list(csv.DictReader(self.call(item, "-o", "kept", "--csv").stdout.splitlines()))
        data = list(csv.DictReader((self.dir / "kept/berzins2021-table6.csv").read_text().splitlines()))
        printed = [point for point in data if point["label"] == "printed"]
        self.assertEqual([float(p["result.displacement.final.inf"]) for p in printed], [float(r["printed"]) for r in rows if r["printed"]])
        self.assertEqual([float(p["time.end"]) for p in printed],
                         [t for t in (1e-3, 1e-2, 2e-2, 0.1, 0.2, 0.5, 1) for column in ("cubic", "quartic")])
        self.assertIn("printed", (self.dir / "kept/berzins2021-table6.svg").read_text())

    def test_messages(self):
        self.assertIn("did you mean berzins2021/table4?", self.call("berzins2021/tabel4", code=2).stderr)
        twice = self.call("nobody1999", "berzins2021/tabel4", code=2).stderr
        self.assertEqual(len(twice.splitlines()), 2)
        self.assertIn("not both", self.call(ITEM, "--csv", "--json", code=2).stderr)
        self.assertIn("from 1 to 4096", self.call(ITEM, "-j", "0", code=2).stderr)
        (self.dir / "file").write_text("")
        self.assertIn("file", self.call(ITEM, "-o", "file", code=1).stderr)


unittest.main(argv=sys.argv[:1])
