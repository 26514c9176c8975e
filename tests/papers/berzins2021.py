#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# berzins2021 Tables 3 to 6: runs their run files and holds every cell against its figure.
# Usage: berzins2021.py GRIDCROSS SOURCE_ROOT
import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path


def run(program, run_file):
    with tempfile.TemporaryDirectory() as directory:
        command = [program, "run", run_file, "--csv", "--no-timing", "-q", "-o", directory + "/study"]
        return list(csv.DictReader(subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()))


def measured(row, quantity):
    if quantity == "displacement":
        return float(row["result.displacement.final.inf"])
    if quantity == "velocity":
        return float(row["result.velocity.max.inf"])
    return float(row["result.energy.drift"]) * float(row["problem.modulus"]) * math.pi**2  # H = E pi^2 at the start


def meets(ours, figure, gate):
    if gate == "2x":
        return figure / 2 <= ours <= 2 * figure
    return abs(ours - figure) <= float(gate) * figure


def check(program, folder, table, key, column):
    rows = run(program, folder / f"{table}.yaml")
    lines = [line for line in (folder / f"{table}.csv").read_text().splitlines() if not line.startswith("#")]
    missed = 0
    print(f"{table}: {key}, clock, quantity, ours, printed, ours/printed, figure, verdict")
    for cell in csv.DictReader(lines):
        [row] = [r for r in rows if float(r[column]) == float(cell[key]) and r["method.clock"] == cell["clock"]
                 and r["method.divergence"] != "exact"]
        ours, printed, figure = measured(row, cell["quantity"]), float(cell["printed"]), float(cell["figure"])
        met = meets(ours, figure, cell["gate"])
        missed += not met
        print(f"  {cell[key]:6} {cell['clock']:18} {cell['quantity']:12} {ours:.4g}  {cell['printed']}  {ours / printed:.3g}  "
              f"{cell['figure']}  {'ok' if met else 'MISSED'}  {cell['reason']}")
    return missed


if __name__ == "__main__":
    program, folder = sys.argv[1], Path(sys.argv[2]) / "runs/papers/berzins2021"
    missed = check(program, folder, "table3", "dt", "time.dt")
    missed += check(program, folder, "table4", "interpolation_error", "problem.interpolation_error")
    missed += check(program, folder, "table5", "end", "time.end")
    missed += check(program, folder, "table6", "end", "time.end")
    sys.exit(f"{missed} cells missed their gate" if missed else 0)
