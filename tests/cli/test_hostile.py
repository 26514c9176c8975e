# SPDX-License-Identifier: GPL-3.0-or-later
"""Titles and names of any text reach HDF5, CSV, JSON and XML as what they are, and no shell. usage: test_hostile.py GRIDCROSS"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import h5py

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
TITLE = "a'b \"c\" `touch p1` $(touch p2) %d%n <script>x</script> & ]]> --> # ; \\n ${HOME}\nsecond\tline, \u2028 ä"
STUDY = f"""title: {json.dumps(TITLE)}
problem: {{name: bar-linear}}
mesh: {{cells: [4, 8]}}
method: {{space: [standard, moving-mesh]}}
time: {{cfl: 0.4, steps: 8}}
output: {{snapshots: 4}}
"""
NAMES = ["`touch p3` $(touch p4)", "-x", "--help", "new\nline", "%s%n", "' \" \\ & <b>", "; touch p5 #", "~", "*", os.fsdecode(b"\xff\xfe")]


class Hostile(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.dir = pathlib.Path(temporary.name)

    def call(self, *args):
        done = subprocess.run([PROGRAM, *args], cwd=self.dir, capture_output=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.decode()

    def test_names_and_titles(self):
        for name in NAMES:
            with self.subTest(name=name):
                file, directory = f"{name}.yaml", f"./{name}.d"
                (self.dir / file).write_text(STUDY)
                rows = json.loads(self.call("run", "-q", "--json", "-o", directory, "--", file))
                self.assertEqual(len(rows), 4)
                place = self.dir / directory
                with h5py.File(place / "study.h5") as study:
                    self.assertEqual(study["provenance"].attrs["title"], TITLE)
                    self.assertEqual(study["provenance"].attrs["run_file"], STUDY)
                run = json.loads((place / "run.json").read_bytes())
                self.assertIn(os.fsencode(name).decode(errors="replace"), run["command"].replace("'\\''", "'"))
                with (place / "table.csv").open(newline="") as table:
                    self.assertEqual(len({len(row) for row in csv.reader(table)}), 1)
                files = list(place.glob("*.xmf"))
                self.assertEqual(len(files), 8)
                for each in files:
                    xml.etree.ElementTree.parse(each)
                for command in ("compare", "check"):
                    self.call(command, "--", directory if command == "compare" else file)
        self.assertEqual([p.name for p in self.dir.rglob("p?")], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
