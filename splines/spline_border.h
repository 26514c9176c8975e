/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cyclic banded systems: the last `width` rows and columns border a band, which is again a collocation matrix of B-splines and so
 * needs no pivoting; the small Schur complement is solved by Householder QR.
 *
 * A = [B V; W C], x_2 = S^-1 (b_2 - W B^-1 b_1), x_1 = B^-1 b_1 - (B^-1 V) x_2, S = C - W B^-1 V. */
#ifndef GRIDCROSS_SPLINE_BORDER_H
#define GRIDCROSS_SPLINE_BORDER_H

#include <gridcross_splines.h>

#include "spline_band.h"

struct gx_spline_border;

struct gx_spline_border *gx_spline_border_create(int degree, size_t rows);
void gx_spline_border_free(struct gx_spline_border *border);

/* Cuts the border out of a cyclic band of all rows, whose columns wrap, and factors. The first row at fault, or -1. */
long gx_spline_border_factor(struct gx_spline_border *border, const struct gx_spline_band *band);

/* Solves for count right-hand sides, [rows][count], count > 0; b and x do not overlap. */
void gx_spline_border_solve(const struct gx_spline_border *border, const struct gx_spline_band *band, size_t count,
                            const double *b, double *x);

#endif
