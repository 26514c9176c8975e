# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the page of reports into the program: page.html with styles and scripts in it, cut where the title and the data go.

usage: embed.py OUTPUT.c page.html LICENSE STYLE.css... SCRIPT.js..."""
import base64
import hashlib
import pathlib
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "core"))
from c_text import array

GAPS = {"title": "GX_REPORT_TITLE", "data": "GX_REPORT_DATA"}


def source(text):
    """What a browser lets run or apply by its hash alone, so that nothing else does."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


output, page, licence, *files = map(pathlib.Path, sys.argv[1:])
licence = "\n/* uPlot:\n" + licence.read_text().strip().replace("*/", "") + "\n*/\n"
style = "\n".join(f.read_text().strip() for f in files if f.suffix == ".css") + "\n"
script = licence + "\n".join(f.read_text().strip() for f in files if f.suffix == ".js") + "\n"
if re.search("</(script|style)|<!--", style + script, re.I):
    sys.exit("a style or script holds what would end its element")
fill = {"style": style, "script": script, "style_source": source(style), "script_source": source(script)}
text = re.sub(r"\{\{(\w+)\}\}", lambda m: fill.get(m[1], m[0]), page.read_text())
pieces = re.split(r"\{\{(\w+)\}\}", text)
if set(pieces[1::2]) != set(GAPS):
    sys.exit(f"{page}: has the gaps {pieces[1::2]}; known are {sorted(GAPS)}")
lines = ['#include "view/report_pieces.h"\n']
lines += [f"static const char piece_{i}[] = {array(piece)};" for i, piece in enumerate(pieces[::2])]
rows = [f"{{piece_{i}, {GAPS[gap]}}}" for i, gap in enumerate(pieces[1::2])]
rows += [f"{{piece_{len(rows)}, GX_REPORT_END}}", "{0, GX_REPORT_END}"]
lines.append("const struct gx_report_piece gx_report_pieces[] = {" + ", ".join(rows) + "};")
output.write_text("\n".join(lines) + "\n")
