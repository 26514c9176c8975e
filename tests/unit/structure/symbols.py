# SPDX-License-Identifier: GPL-3.0-or-later
"""What the object files of src/ and splines/ export, keep and call. usage: symbols.py SOURCE_ROOT BUILD_ROOT

An exported symbol of src/<folder>/<stem>.c or splines/<stem>.c is gx_<stem>... ; no object holds writable data, thread-local
included; only the command line exits, aborts, or knows the standard streams."""
import pathlib
import re
import subprocess
import sys

PROCESS = {"exit", "_exit", "_Exit", "abort", "quick_exit", "stdout", "stderr", "printf", "__printf_chk", "vprintf",
           "__vprintf_chk", "puts", "putchar", "perror"}
CONSTANT = (".text", ".rodata", ".data.rel.ro", ".init_array", ".fini_array", ".eh_frame")

root, build = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
bad = []


def symbols(path):
    """(name, class, section) of each symbol; class U: undefined, lower case: local."""
    text = subprocess.run(["nm", "--format=sysv", str(path)], text=True, capture_output=True, check=True).stdout
    for line in text.splitlines():
        field = [f.strip() for f in line.split("|")]
        if len(field) == 7 and field[0] != "Name":
            yield field[0], field[2], field[6]


objects = {}
for path in [*build.glob("src/**/*.o"), *build.glob("splines/*.a.p/*.o")]:
    objects.setdefault(path.name, []).append(path)
sources = sorted([*(root / "src").glob("*/*.c"), *(root / "splines").glob("*.c")])
for source in sources:
    folder, where = source.parent.name, str(source.relative_to(root))
    compiled = objects.get(source.name + ".o" if folder == "splines" else f"{folder}_{source.name}.o", [])
    if not compiled:
        bad.append(f"{where}: no object file; is it in a meson.build?")
    owned = re.compile(rf"gx_{source.stem}(s?$|_)")
    for name, kind, section in {s for path in compiled for s in symbols(path)}:
        plain = name.split(".")[0]  # compilers add .avx2, .resolver, .part.0 to clones of a function
        if kind == "U":
            if plain in PROCESS and folder != "cli":
                bad.append(f"{where}: uses {plain}, which belongs to the command line")
            continue
        if kind.isupper() and not owned.match(plain) and not (folder == "cli" and plain == "main"):
            local_clone = "." in name and not plain.startswith("gx_")
            if not local_clone:
                bad.append(f"{where}: exports {name}, which does not begin with gx_{source.stem}; rename it or make it static")
        if section and not section.startswith(CONSTANT) and section != "*ABS*":
            bad.append(f"{where}: {name} is writable data ({section}); pass a context instead, or make it const")
print("\n".join(sorted(bad)))
print(f"{len(sources)} sources, {len(bad)} violations")
sys.exit(bool(bad) or not sources)
