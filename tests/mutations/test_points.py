# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutation points of a source that has one of each thing to find and to leave alone."""
import sys

sys.dont_write_bytecode = True  # beside the sources
from points import points  # noqa: E402

SOURCE = r'''
#define HALF 0.5 /* no statement */
static const double c[2] = {0.25, 1e-12}; // + 1
struct s { int a[3]; };
static double f(const double *x, int n, double y[4])
{
  _Static_assert(sizeof(int) == 4, "a + b");
  double z[8], *w = (double *)x, t = -x[0] * (double)-n;
  for (int i = 0; i < n; i++) t += fmin(*x, sin(t)) - '+';
  return n == 7 && t >= 2.0 ? *w : HALF;
}
'''
EXPECTED = [(3, "0.25", ["0.125"]), (3, "1e-12", ["1e-06"]), (8, "0", ["1"]), (8, "*", ["/"]), (9, "0", ["1"]), (9, "<", ["<="]),
            (9, "+=", ["-="]), (9, "fmin", ["fmax"]), (9, "sin", ["cos"]), (9, "-", ["+"]), (10, "==", ["!="]), (10, "7", ["8"]),
            (10, "&&", ["||"]), (10, ">=", [">"]), (10, "2.0", ["1.0"])]

found = points("f.c", SOURCE)
assert [(p.line, p.text, p.others) for p in found] == EXPECTED, found
for p in found:
    assert SOURCE[p.at:].startswith(p.text) and SOURCE.splitlines()[p.line - 1][p.column - 1:].startswith(p.text), p
