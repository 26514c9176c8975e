/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields through particles by a polynomial a cell, in any dimension: least squares over the particles of the cell and of those beside
 * it, weighted by the quadratic B-spline about the cell's centre, so that particles enter and leave smoothly. It reproduces polynomials
 * up to its degree wherever the particles are. Cells without enough particles around them are left to sums over their particles. */
#ifndef GRIDCROSS_SPACES_LEAST_SQUARES_H
#define GRIDCROSS_SPACES_LEAST_SQUARES_H

#include "reconstruction.h"

/* The least share that a monomial may have of its own, beyond those before it; below, it and all of its degree are left out. The square
 * of a fit's condition, which normal equations lose, is about the inverse of this at most. */
#define GX_LEAST_SQUARES_PIVOT 1e-7

/* degree: of the polynomials, 1 to GX_LEAST_SQUARES_DEGREE. points: per_cell Gauss points a cell and direction of the grid, on a
 * lattice, borrowed. n: number of particles. */
enum { GX_LEAST_SQUARES_DEGREE = 5 };
enum gx_status gx_least_squares_create(struct gx_fit **fit, const struct gx_grid *grid, int degree, int per_cell,
                                       const struct gx_particles *points, size_t n, struct gx_outcome *outcome);

#endif
