/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest stable time step, estimated. */
#ifndef GRIDCROSS_STUDY_STABILITY_H
#define GRIDCROSS_STUDY_STABILITY_H

#include <gridcross/clock.h>

enum { GX_STABILITY_LEAST = 21, GX_STABILITY_EVALUATIONS = 201 }; /* of the rates: at least and at most */

/* Highest angular frequency of the space linearised at its present state, by power iteration, rad/s; NaN when the iteration
 * fails. From below: usually within a per cent. The state is restored, weights and forces are not. */
double gx_stability_frequency(struct gx_space *space);

/* Largest real part of the eigenvalues of the same linearisation, 1/s: how fast the space itself grows, whatever the clock. NaN
 * when the state has over 200 numbers, memory runs out or the rates fail. The state is restored. */
double gx_stability_growth(struct gx_space *space);

#endif
