/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Banded systems without pivoting: collocation matrices are totally positive (de Boor and Pinkus 1977), so that elimination in
 * the given order is stable and nothing fills in.
 *
 * Storage: row i holds columns i - degree ... i + degree at band[i * (2 degree + 1)]; entries outside the matrix are zero. After
 * factoring: A = L U with unit U; above the diagonal U, on it 1 / L_ii, below it L_ij / L_ii, so that no division is left. */
#ifndef GRIDCROSS_SPLINE_BAND_H
#define GRIDCROSS_SPLINE_BAND_H

#include <stddef.h>

struct gx_spline_band {
  int degree;       /* room on either side */
  int lower, upper; /* bandwidths in use */
  size_t rows;
  double *entry;
};

/* The first row whose pivot is not above rounding, or -1. */
long gx_spline_band_factor(const struct gx_spline_band *band);

/* b and x may be the same. */
void gx_spline_band_solve(const struct gx_spline_band *band, const double *b, double *x);

/* count right-hand sides at once: [rows][count] */
void gx_spline_band_solve_many(const struct gx_spline_band *band, size_t count, const double *b, double *x);

#endif
