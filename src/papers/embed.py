# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts run files, expectations and plots of runs/papers into the program.

usage: embed.py OUTPUT.c FOLDER PAPER/ITEM..."""
import csv
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "core"))
from c_text import array, literal

COLUMNS = ["row", "quantity", "value", "printed", "corrected", "gate", "reason"]


def expectations(path):
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    reader = csv.DictReader(lines)
    if reader.fieldnames != COLUMNS:
        sys.exit(f"{path}: columns must be {','.join(COLUMNS)}")
    for number, row in enumerate(reader, 1):
        if None in row or None in row.values():
            sys.exit(f"{path}: row {number} ({row['row']}) has another number of cells than the header")
        if len(row["reason"].encode()) > 700:
            sys.exit(f"{path}: row {number} ({row['row']}) has a reason of over 700 bytes")
        yield row


def plots(path):
    """Options of one figure a line; the command line that they become has room for 24 of them."""
    lines = path.read_text().strip().splitlines() if path.exists() else []
    if any(len(line.split()) > 24 for line in lines):
        sys.exit(f"{path}: over 24 words in a line")
    return "\n".join(lines)


output, folder, items = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
if len(items) > 256:
    sys.exit("the paper command has room for 256 items")
text, table = ["#include <gridcross/paper.h>\n"], []
for index, name in enumerate(items):
    stem = folder / name
    paper, item = name.split("/")
    rows = list(expectations(stem.with_name(item + ".csv")))
    text.append(f"static const char run_file_{index}[] = {array(stem.with_name(item + '.yaml').read_text())};")
    text.append(f"static const struct gx_paper_row row_{index}[] = {{")
    text += ["  {" + ", ".join(literal(row[c].strip()) for c in COLUMNS) + "}," for row in rows]
    text.append("};")
    table.append(f"  {{{literal(paper)}, {literal(item)}, run_file_{index}, {literal(plots(stem.with_name(item + '.plot')))}, row_{index}, {len(rows)}}},")
text.append("const struct gx_paper_item gx_paper_items[] = {\n" + "\n".join(table) + "\n};")
text.append(f"const size_t gx_paper_item_count = {len(items)};")
pathlib.Path(output).write_text("\n".join(text) + "\n")
