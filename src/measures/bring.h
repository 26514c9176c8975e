/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brings velocities to the end of step, where they live at another time. */
#ifndef GRIDCROSS_MEASURES_BRING_H
#define GRIDCROSS_MEASURES_BRING_H

#include <stdbool.h>
#include <stddef.h>

/* now = v + ahead a; now may be a */
void gx_bring(size_t n, double ahead, const double *v, const double *a, double *now);

/* One component of [n] particles. */
struct gx_bring_step {
  size_t n;
  const double *m, *held, *a0, *a; /* held: velocities; a0: acceleration at the end of step before */
  double *v;                       /* velocities at the end of step before, v0, then at this one */
};
/* Returns the sum of the terms m (half v0, or a quarter of v - v0) (a - a0) of the step's energy defect, W. */
double gx_bring_on(const struct gx_bring_step *step, double ahead, bool first_order);

#endif
