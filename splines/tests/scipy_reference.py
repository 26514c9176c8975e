#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes scipy_reference.txt: interpolants by scipy.interpolate.make_interp_spline (SciPy 1.10.1, Debian's python3-scipy).
#
# usage: scipy_reference.py > scipy_reference.txt
# A line "ends degree sites points period", then a line each of sites, values, points, and the spline and its first two
# derivatives at the points. Open: on aptknt knots, random sites. Periodic: uniform sites and odd degree, where SciPy's knots
# at sites are ours.
import numpy
from scipy.interpolate import make_interp_spline

SITES, POINTS = 16, 9


def aptknt(x, degree):
    means = [sum(x[j + 1:j + degree + 1]) / degree for j in range(len(x) - degree - 1)]
    return numpy.r_[[x[0]] * (degree + 1), means, [x[-1]] * (degree + 1)]


def put(*rows):
    for row in rows:
        print(" ".join(f"{float(v):.17g}" for v in row))


def case(ends, degree, period, x, y, points, spline):
    print(ends, degree, len(x), len(points), period)
    put(x, y, points, *(spline(points, nu) for nu in range(3)))


random = numpy.random.default_rng(1)
for degree in range(2, 10):
    x = numpy.sort((numpy.arange(SITES) + 0.8 * random.random(SITES)) / SITES)
    y = random.uniform(-1, 1, SITES)
    points = random.uniform(x[0], x[-1], POINTS)
    points[:2] = x[0], x[-1]
    case("open", degree, 0, x, y, points, make_interp_spline(x, y, k=degree, t=aptknt(x, degree)))
for degree in range(3, 10, 2):
    x = numpy.arange(SITES) / 8
    y = random.uniform(-1, 1, SITES)
    points = random.uniform(0, 2, POINTS)
    closed = make_interp_spline(numpy.r_[x, 2.0], numpy.r_[y, y[0]], k=degree, bc_type="periodic")
    case("periodic", degree, 2, x, y, points, closed)
