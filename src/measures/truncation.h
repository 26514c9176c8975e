/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One-step errors of grid fields, in L2 over the grid's own coordinate: steffen2010 §6.4. */
#ifndef GRIDCROSS_MEASURES_TRUNCATION_H
#define GRIDCROSS_MEASURES_TRUNCATION_H

#include "integral.h"

struct gx_truncation;

/* On the points of an integral, borrowed. NULL when memory runs out. */
struct gx_truncation *gx_truncation_create(struct gx_integral *integral);
void gx_truncation_free(struct gx_truncation *truncation);
/* A step starts at the time at which the integral's points are. leaves: they will be placed anew before its end. -1 when memory runs
 * out. */
int gx_truncation_open(struct gx_truncation *truncation, bool leaves);
/* Error of a nodal acceleration, while the integral's points are at its time t, m/s^2. */
double gx_truncation_acceleration(struct gx_truncation *truncation, double t, double *const *field);
/* The step adds span times the nodal acceleration that the space has at time t. */
void gx_truncation_add(struct gx_truncation *truncation, const struct gx_space *space, double t, double span);
/* Nodal velocity at the start of the step, while the integral's points are there. */
void gx_truncation_velocity(struct gx_truncation *truncation, double *const *field);

struct gx_truncation_errors {
  double velocity, increment, time; /* of the projected velocity, of its change, of the change by exact accelerations; m/s */
};
/* The step has taken the velocity from time `start` to time `end`. */
struct gx_truncation_errors gx_truncation_close(struct gx_truncation *truncation, double start, double end);

#endif
