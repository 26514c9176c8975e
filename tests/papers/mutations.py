# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks one coefficient at a time and asserts that at least one gate of the papers fails each time.

usage: mutations.py SOURCE_ROOT [NAME...]
       mutations.py SOURCE_ROOT --texts    only whether each text stands in its file"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

# name: file, text, its replacement, items that must notice. The text must stand exactly once in the file.
MUTATIONS = {
    "an RKN weight by 0.1 %": ("src/clocks/rkn4.c", "0.338978026553643355", "0.339317004580197", ["berzins2021/table3"]),
    "the B-spline centre by h/2": ("src/spaces/line_core.h", "*s = (periodic ? *x - whole : *x) * *cells;",
                                   "*s = (periodic ? *x - whole : *x) * *cells + 0.5;", ["steffen2010/table2", "steffen2010/fig12"]),
    "no F in V = F V0": ("src/spaces/line_core.h", "T = -V0 * (P * F);", "T = -V0 * P;", ["steffen2010/fig13b", "steffen2010/table2"]),
}


def run(*command, cwd):
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True)


def not_source(folder, names):
    return [n for n in names if n == ".git" or n.endswith(".study") or (pathlib.Path(folder) / n / "build.ninja").exists()]


def misplaced(source):
    """Texts that do not stand once."""
    counts = {name: (source / path).read_text().count(text) for name, (path, text, *_) in MUTATIONS.items()}
    return [f"{name}: its text stands {count} times in {MUTATIONS[name][0]}" for name, count in counts.items() if count != 1]


def build(root):
    done = run("ninja", "-C", "build", "src/gridcross", cwd=root)
    if done.returncode:
        sys.exit(f"does not build:\n{done.stdout[-2000:]}")


def missed(root, items):
    """Items whose gate is missed."""
    return [item for item in items if run("build/src/gridcross", "paper", "--quiet", item, cwd=root).returncode == 1]


def main(source, wanted):
    wrong = misplaced(source)
    if wrong or wanted == ["--texts"]:
        sys.exit("\n".join(wrong) or 0)
    unknown = [name for name in wanted if name not in MUTATIONS]
    if unknown:
        sys.exit(f"no mutation {', '.join(unknown)}; there are: {', '.join(MUTATIONS)}")
    with tempfile.TemporaryDirectory() as place:
        root = pathlib.Path(place) / "gridcross"
        shutil.copytree(source, root, ignore=not_source)
        done = run("meson", "setup", "build", "-Dbuildtype=release", "-Dtests=disabled", cwd=root)
        if done.returncode:
            sys.exit(f"cannot be configured:\n{done.stdout[-2000:]}")
        build(root)
        chosen = {name: mutation for name, mutation in MUTATIONS.items() if not wanted or name in wanted}
        every_item = sorted({item for *_, items in chosen.values() for item in items})
        survivors = [f"unbroken: {item} misses a gate" for item in missed(root, every_item)]
        for name, (path, text, replacement, items) in chosen.items():
            file = root / path
            original = file.read_text()
            file.write_text(original.replace(text, replacement))
            build(root)
            noticed = missed(root, items)
            print(f"{'noticed' if noticed else 'SURVIVED'}: {name} ({path}): {', '.join(noticed) or 'no gate is missed'}", flush=True)
            survivors += [] if noticed else [name]
            file.write_text(original)
        sys.exit("\n".join(survivors) or 0)


main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:])
