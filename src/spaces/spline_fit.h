/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields through the particles of a line by interpolating splines of degree p + 2, periodic, or mirrored at fixed ends. */
#ifndef GRIDCROSS_SPACES_SPLINE_FIT_H
#define GRIDCROSS_SPACES_SPLINE_FIT_H

#include "reconstruction.h"

/* degree: p of the grid's basis. X: [n] reference positions, which order the particles. point: [points], borrowed, ascending within the domain. The particles fill [0, 1]. */
enum gx_status gx_spline_fit_create(struct gx_fit **fit, int degree, bool periodic, size_t n, const double *X, size_t points,
                                    const double *point, struct gx_outcome *outcome);

#endif
