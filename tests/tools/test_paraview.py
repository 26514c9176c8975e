# SPDX-License-Identifier: GPL-3.0-or-later
"""The .xmf files of snapshots, opened by the reader that ParaView picks by default. usage: test_paraview.py GRIDCROSS"""
import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

if not shutil.which("pvbatch"):
    print("skipped: no pvbatch")
    sys.exit(77)

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
STUDY = """title: small
problem: {name: axis-aligned, dimension: [1, 2, 3], amplitude: 0.02}
mesh: {cells: 6, particles_per_cell: 2}
method: {space: [standard, moving-mesh], degree: 3, mass: consistent}
time: {steps: 10}
output: {snapshots: 4}
"""
# Prints of each file its reader, times, and of each time what its pieces hold: class, points, cells, bounds, ranges of arrays.
LOOK = """
import json, sys
from paraview import servermanager
from paraview.simple import OpenDataFile

def pieces(data):
    if data is None:
        return
    if data.IsA("vtkDataObjectTree"):
        each = data.NewTreeIterator()
        each.VisitOnlyLeavesOn()
        while not each.IsDoneWithTraversal():
            yield each.GetCurrentDataObject()
            each.GoToNextItem()
    else:
        yield data

files = {}
for path in sys.argv[1:]:
    reader = OpenDataFile(path)
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    seen = files[path] = {"reader": reader.SMProxy.GetXMLName(), "times": times, "states": []}
    for time in times:
        reader.UpdatePipeline(time)
        seen["states"].append([{
            "class": piece.GetClassName(), "points": piece.GetNumberOfPoints(), "cells": piece.GetNumberOfCells(),
            "bounds": piece.GetBounds(),
            "arrays": {piece.GetPointData().GetArrayName(i): [piece.GetPointData().GetArray(i).GetRange(k)
                       for k in range(piece.GetPointData().GetArray(i).GetNumberOfComponents())]
                       for i in range(piece.GetPointData().GetNumberOfArrays())}
        } for piece in pieces(servermanager.Fetch(reader))])
print("LOOKED" + json.dumps(files))
"""


class ParaView(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.dir = pathlib.Path(place.name)
        (cls.dir / "small.yaml").write_text(STUDY)
        (cls.dir / "look.py").write_text(LOOK)
        subprocess.run([PROGRAM, "run", "small.yaml", "-q"], cwd=cls.dir, check=True, capture_output=True)
        cls.study = cls.dir / "small.study"
        cls.table = list(csv.DictReader((cls.study / "table.csv").read_text().splitlines()))
        paths = sorted(map(str, cls.study.glob("*.xmf")))
        done = subprocess.run(["pvbatch", "look.py", *paths], cwd=cls.dir, capture_output=True, text=True)
        cls.noise = done.stderr
        marked = [line for line in done.stdout.splitlines() if line.startswith("LOOKED")]
        if not marked:
            raise AssertionError(f"pvbatch exited with {done.returncode}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
        cls.seen = {pathlib.Path(path).name: what for path, what in json.loads(marked[0][6:]).items()}

    def each(self, ending, check):
        for case in self.table:
            with self.subTest(ending=ending, space=case["method.space"], dimension=case["problem.dimension"]):
                check(case, int(case["problem.dimension"]), self.seen[f"case-{case['case']}{ending}"])

    def test_nothing_is_said(self):
        self.assertNotIn("rror", self.noise)
        self.assertEqual(len(self.seen), 12)

    def test_times(self):
        def check(case, _, seen):
            self.assertIn("Xdmf", seen["reader"])
            self.assertEqual(seen["times"], [k * float(case["result.dt"]) for k in (0, 4, 8, 10)])

        for ending in (".xmf", "-grid.xmf"):
            self.each(ending, check)

    def piece(self, seen, state):
        self.assertEqual(len(seen["states"][state]), 1)
        return seen["states"][state][0]

    def test_particles(self):
        def check(case, dim, seen):
            X = [(k + 0.5) / 12 for k in range(12)]
            u = [0.02 * math.sin(2 * math.pi * x) for x in X]
            for state in range(4):
                piece = self.piece(seen, state)
                self.assertEqual((piece["points"], piece["cells"]), (12**dim, 12**dim))
                names = {"velocity", "mass", "volume"}
                for record, rank in (("reference_position", 1), ("displacement", 1), ("body_force", 1), ("displacement_error", 1),
                                     ("velocity_error", 1), ("deformation_gradient", 2), ("first_piola_stress", 2),
                                     ("cauchy_stress", 2), ("stress_error", 2)):
                    axes = "xyz"[:dim]
                    names |= {f"{record}_{a}{b}" for a in axes for b in (axes if rank == 2 else [""])}
                self.assertEqual(set(piece["arrays"]), names)
                self.assertEqual(len(piece["arrays"]["velocity"]), 3)
            start = self.piece(seen, 0)  # on a moving mesh particles sample its field
            moved = 0 if case["method.space"] == "standard" else 5 / 384 * 0.02 * (2 * math.pi / 6) ** 4  # cubics through them
            for d in range(dim):
                self.assertAlmostEqual(start["bounds"][2 * d], X[0] + u[0], delta=1e-14 + moved)
                self.assertAlmostEqual(start["bounds"][2 * d + 1], X[-1] + u[-1], delta=1e-14 + moved)
                self.assertAlmostEqual(start["arrays"][f"displacement_{'xyz'[d]}"][0][1], max(u), delta=1e-14 + moved)
            self.assertEqual(start["bounds"][2 * dim:], [0.0] * (6 - 2 * dim))
            v = self.piece(seen, 3)["arrays"]["velocity"]
            self.assertTrue(all(v[d][1] > 1 for d in range(dim)) and all(v[d] == [0, 0] for d in range(dim, 3)), v)

        self.each(".xmf", check)

    def test_grids(self):
        def check(case, dim, seen):
            for state in range(4):
                piece = self.piece(seen, state)
                self.assertEqual(piece["class"], "vtkStructuredGrid")
                self.assertEqual((piece["points"], piece["cells"]), (7**dim, 6**dim))
                names = {"velocity", "density"} | {f"{r}_{a}" for r in ("acceleration", "momentum") for a in "xyz"[:dim]}
                if case["method.space"] == "moving-mesh":
                    names |= {f"displacement_{a}" for a in "xyz"[:dim]}
                self.assertEqual(set(piece["arrays"]), names)
                for bound, expected in zip(piece["bounds"], [0, 1] * dim + [0, 0] * (3 - dim)):
                    self.assertAlmostEqual(bound, expected, delta=1e-12)

        self.each("-grid.xmf", check)


unittest.main()
