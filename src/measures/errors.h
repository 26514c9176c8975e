/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of particles against the exact solution, and differences between two runs. What they are made of is evaluated piece by
 * piece and takes no memory of its own. */
#ifndef GRIDCROSS_MEASURES_ERRORS_H
#define GRIDCROSS_MEASURES_ERRORS_H

#include <gridcross/measure.h>

/* Particles at the end of a step, P and F in step with each other. */
struct gx_errors_state {
  const struct gx_space *space;
  double *const *v; /* [dim][n] velocities at that time, which may be half a kick ahead of the particles', m/s */
  double t;         /* s */
};

/* error: against the exact solution, NaN where there is none; of the stress NaN where the material has none. */
void gx_errors_norms(const struct gx_errors_state *state, double error[GX_QUANTITIES][GX_NORMS]);
/* Norms of the difference between two states of the same particles. */
void gx_errors_difference(const struct gx_errors_state *state, const struct gx_errors_state *other,
                          double error[GX_QUANTITIES][GX_NORMS]);
/* As gx_measure_error. */
void gx_errors_component(const struct gx_errors_state *state, enum gx_quantity quantity, int component, double *error);
/* Norms of n errors from the sum and the largest of their squares. error: [GX_NORMS] */
void gx_errors_finish(double square, double most, size_t n, double *error);
/* Norms of n vectors. vector: [dim][n] */
void gx_errors_of_vectors(size_t n, int dim, double *const *vector, double error[GX_NORMS]);

#endif
