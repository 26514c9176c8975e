# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes point one way: core <- bases, materials, problems <- spaces <- clocks <- measures <- study <- papers, store, view <- cli.

usage: layers.py SOURCE_ROOT"""
import pathlib
import re
import sys

LAYERS = [["core"], ["bases", "materials", "problems"], ["spaces"], ["clocks"], ["measures"], ["study"], ["papers", "store", "view"], ["cli"]]
RANK = {folder: rank for rank, folders in enumerate(LAYERS) for folder in folders}
# The folder that implements each public header.
HOME = {
    "status": "core", "particles": "core", "grid": "core", "value": "core", "table": "core", "page": "core", "image": "core", "build": "core",
    "basis": "bases", "material": "materials", "problem": "problems", "space": "spaces", "clock": "clocks",
    "measure": "measures", "snapshot": "measures", "spectrum": "measures", "frequency": "measures", "budget": "measures", "paper": "papers", "parameter": "study", "simulation": "study", "study": "study", "store": "store", "recorder": "store", "series": "store", "advise": "view", "balance": "view", "compare": "view", "plot": "view", "report": "view", "starter": "view", "spectra": "view",
}
# Libraries that one file each may see.
ONCE = {"yaml.h": [], "hdf5.h": [], "fftw3.h": [], "mpi.h": []}

root = pathlib.Path(sys.argv[1]).resolve()
source_root = root / "src"
bad = []


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
        if found:
            yield f"{path.relative_to(root)}:{number}", found[1] == "<", found[2]


def public(where, name, rank):
    stem = name.removeprefix("gridcross/").removesuffix(".h")
    if stem not in HOME:
        bad.append(f"{where}: <{name}> has no layer; give it one in {pathlib.Path(__file__).name}")
    elif RANK[HOME[stem]] > rank:
        bad.append(f"{where}: <{name}> belongs to {HOME[stem]}, a higher layer")


def private(where, path, name, folder):
    target = next((p for p in ((path.parent / name).resolve(), source_root / name) if p.exists()), None)
    if target is None:
        if "/" in name:
            bad.append(f'{where}: "{name}" is not a file of the source')
        return  # made by the build
    if not target.is_relative_to(source_root):
        bad.append(f'{where}: "{name}" lies outside src')
        return
    other = target.relative_to(source_root).parts[0]
    if target == source_root / "store" / "handle.h" and folder != "store":
        bad.append(f'{where}: "{name}" is HDF5, which store alone sees')
    if other == folder:
        return
    if RANK.get(other, len(LAYERS)) >= RANK[folder]:
        bad.append(f'{where}: "{name}" belongs to {other}, which {folder} may not see')
    elif (folder, other) == ("clocks", "spaces"):
        bad.append(f'{where}: clocks see spaces by <gridcross/space.h> alone, not "{name}"')


files = sorted(p for p in source_root.rglob("*.[ch]"))
for path in files:
    folder = path.relative_to(source_root).parts[0]
    if folder not in RANK:
        bad.append(f"{path.relative_to(root)}: folder {folder} has no layer")
        continue
    for where, angle, name in includes(path):
        if name.startswith("gridcross/"):
            public(where, name, RANK[folder])
        elif not angle:
            private(where, path, name, folder)
        elif name == "gridcross_splines.h" and folder != "spaces":
            bad.append(f"{where}: only spaces/ uses splines")
        elif name == "gsl/gsl_bspline.h":
            bad.append(f"{where}: only splines/ sees gsl_bspline")
        elif name in ONCE:
            ONCE[name].append(where)
for path in sorted((root / "include" / "gridcross").glob("*.h")):
    home = HOME.get(path.stem)
    if not home:
        bad.append(f"{path.relative_to(root)}: has no layer; give it one in {pathlib.Path(__file__).name}")
        continue
    for where, angle, name in includes(path):
        if name.startswith("gridcross/"):
            public(where, name, RANK[home])
        elif not angle:
            bad.append(f'{where}: a public header includes a private one, "{name}"')
for path in sorted((root / "splines").rglob("*.[ch]")):
    for where, angle, name in includes(path):
        if name.startswith("gridcross/") or (not angle and root / "splines" not in (path.parent / name).resolve().parents):
            bad.append(f"{where}: splines/ knows nothing of gridcross")
for name, seen in ONCE.items():
    if len({w.split(":")[0] for w in seen}) > 1:
        bad.append(f"<{name}> is seen by more than one file: {', '.join(seen)}")
print("\n".join(bad))
print(f"{len(files)} files, {len(bad)} violations")
sys.exit(bool(bad) or not files)
