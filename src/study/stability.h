/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest stable time step, estimated. */
#ifndef GRIDCROSS_STUDY_STABILITY_H
#define GRIDCROSS_STUDY_STABILITY_H

#include <gridcross/clock.h>

/* Highest angular frequency of the space linearised at its present state, by power iteration, rad/s; NaN when the iteration
 * fails. From below: usually within a per cent. The state is restored, weights and forces are not. */
double gx_stability_frequency(struct gx_space *space);

#endif
