# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public header compiles alone, and twice. usage: headers.py SOURCE_ROOT COMPILER..."""
import pathlib
import subprocess
import sys

root, compiler = pathlib.Path(sys.argv[1]), sys.argv[2:]
includes = [root / "include", root / "splines" / "include"]
headers = sorted(path for include in includes for path in include.rglob("*.h"))
flags = ["-std=c17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", *(f"-I{i}" for i in includes), "-xc", "-"]
bad = 0
for header in headers:
    source = f"#include <{next(header.relative_to(i) for i in includes if i in header.parents)}>\n" * 2 + "extern int gx_alone;\n"
    done = subprocess.run(compiler + flags, input=source, text=True, capture_output=True)
    if done.returncode:
        bad += 1
        print(f"{header.relative_to(root)}: does not compile alone and twice\n{done.stderr}")
print(f"{len(headers)} headers, {bad} bad")
sys.exit(bad > 0 or not headers)
