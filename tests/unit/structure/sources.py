# SPDX-License-Identifier: GPL-3.0-or-later
"""Each source says its licence first, then what it does, and stays under 500 lines; no leftovers of patches and editors lie about.
usage: sources.py SOURCE_ROOT"""
import pathlib
import sys

LICENCE = "SPDX-License-Identifier: GPL-3.0-or-later"
root = pathlib.Path(sys.argv[1])
bad = []
files = sorted(p for top in ("include", "src", "splines", "tests", "runs", ".ci") for p in (root / top).rglob("*") if p.is_file())
count = 0
for path in files:
    if path.suffix in (".orig", ".rej") or path.name.endswith("~"):
        bad.append(f"{path.relative_to(root)}: a leftover")
        continue
    c = path.suffix in (".c", ".h")
    lines = path.read_bytes().decode(errors="replace").splitlines()
    script = path.suffix in (".py", ".sh") or (lines and lines[0].startswith("#!"))
    if not c and not script:
        continue
    count += 1
    name = path.relative_to(root)
    text = lines[1:] if lines and lines[0].startswith("#!") else lines
    first = f"/* {LICENCE} */" if c else f"# {LICENCE}"
    if text[:1] != [first]:
        bad.append(f"{name}: does not begin with {first}")
    elif not text[1:] or not text[1].startswith("/* " if c else ("# ", '"""')):
        bad.append(f"{name}: its second line does not say what it does")
    if len(lines) >= 500:
        bad.append(f"{name}: {len(lines)} lines; keep it under 500")
print("\n".join(bad))
print(f"{count} sources, {len(bad)} violations")
sys.exit(bool(bad) or not count)
