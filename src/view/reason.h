/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why a case of the front is the cheapest, in what was measured. */
#ifndef GRIDCROSS_VIEW_REASON_H
#define GRIDCROSS_VIEW_REASON_H

#include "front.h"

/* One reason a line, each for an error of at most `bound`; x: times the cost of this case.
 *   cheapest with another method.space: standard (6.31e-6 at best), spline-grid (3.1x)
 *   next cheaper on the front: method.degree 5, error 1.50e-6 (0.60x)
 *   cheaper by one change: mesh.cells 8, error 3.12e-5 (0.41x)
 *   dt is 0.85 of the stable step; above it: time.cfl 0.8, error 9.2e-7 (0.52x)
 *   the step limits the error: 1.01e-8 with time.cfl 0.4
 * axis: [axes] columns that tell cases apart. Owned by the caller; NULL when memory runs out. */
char *gx_reason_text(const struct gx_front *front, size_t axes, const size_t *axis, size_t row, double bound);
/* The cost of the cheapest case with this value in this column and an error of at most `bound`, over that of a row; NaN: no such
 * case. least: the least error of any case with this value, INFINITY: none. */
double gx_reason_cost(const struct gx_front *front, size_t row, size_t column, struct gx_value value, double bound,
                      double *least);

#endif
