/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields through the particles of a line by interpolating splines of degree p + 2, periodic, or mirrored at fixed ends. */
#ifndef GRIDCROSS_SPACES_SPLINE_FIT_H
#define GRIDCROSS_SPACES_SPLINE_FIT_H

#include "reconstruction.h"

/* degree: p of the grid's basis. X: [n] reference positions, m, which order the particles; these fill [0, 1]. point: [points], m,
 * borrowed, ascending within the domain. Fails as splines do: when no spline passes through the particles, or memory runs out. */
enum gx_status gx_spline_fit_create(struct gx_fit **fit, int degree, bool periodic, size_t n, const double *X, size_t points,
                                    const double *point, struct gx_outcome *outcome);

#endif
