# SPDX-License-Identifier: GPL-3.0-or-later
"""Every bad run file gives exactly its expected errors, exit 2 and nothing on stdout. usage: bad_runfiles.py GRIDCROSS [FILE...]"""
import pathlib
import subprocess
import sys

program = str(pathlib.Path(sys.argv[1]).resolve())
folder = pathlib.Path(__file__).parent / "bad"
files = sorted(pathlib.Path(f) for f in sys.argv[2:]) or sorted(folder.glob("*.yaml"))
failed = 0
for file in files:
    expected = file.with_suffix(".expected").read_text()
    done = subprocess.run([program, "check", file.name], cwd=folder, capture_output=True, timeout=600)
    found = done.stderr.decode(errors="replace")
    complaints = []
    if done.returncode != 2:
        complaints.append(f"exit {done.returncode}, not 2")
    if done.stdout:
        complaints.append(f"stdout: {done.stdout[:200]!r}")
    if found != expected:
        complaints += [f"  - {line}" for line in expected.splitlines() if line not in found.splitlines()]
        complaints += [f"  + {line}" for line in found.splitlines() if line not in expected.splitlines()]
        complaints.append("errors differ from those expected (- missing, + unexpected)")
    if complaints:
        failed += 1
        print(file.name, *complaints, sep="\n")
print(f"{len(files)} bad run files, {failed} failed")
sys.exit(failed > 0 or len(files) < 35)
