# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether two studies by different builds are the same: every file but those of times and places, byte for byte; of HDF5 files every
dataset and attribute, but for the compiler and its flags. usage: same_study.py FIRST OTHER"""
import pathlib
import sys

import h5py

APART = {"timing.csv", "run.json"}
BY_BUILD = {"/provenance@compiler", "/provenance@flags"}  # study.h5 says what made it


def contents(path):
    """{name: (type, shape, bytes)} of all groups, datasets and attributes."""
    found = {}

    def plain(value):
        return (str(value.dtype), value.shape, value.tolist() if value.dtype == object else value.tobytes())

    def visit(name, item):
        where = "/" + name
        found[where] = plain(item[()]) if isinstance(item, h5py.Dataset) and item.shape else \
            repr(item[()]) if isinstance(item, h5py.Dataset) else "group"
        for key in item.attrs:
            found[where + "@" + key] = repr(item.attrs[key])

    with h5py.File(path, "r") as file:
        visit("", file)
        file.visititems(visit)
    return found


def main(first, other):
    names = [{p.name for p in place.iterdir()} - APART for place in (first, other)]
    differ = [f"{name}: in one alone" for name in sorted(names[0] ^ names[1])]
    for name in sorted(names[0] & names[1]):
        if (first / name).read_bytes() == (other / name).read_bytes():
            continue
        if not name.endswith(".h5"):
            differ.append(name)
            continue
        one, two = contents(first / name), contents(other / name)
        inner = [key for key in sorted(one.keys() | two.keys()) if one.get(key) != two.get(key)]
        differ += [f"{name}: {key}" for key in inner if key not in BY_BUILD]
        if not inner:
            differ.append(f"{name}: equal contents in other bytes")
    if "table.csv" not in names[0] or "study.h5" not in names[0]:
        differ.append(f"{first} holds no study")
    print(*differ[:20], sep="\n", file=sys.stderr, end="\n" if differ else "")
    return bool(differ)


sys.exit(main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])))
