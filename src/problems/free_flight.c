/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A body that flies without stress: with its centre c at X = c0, x = c0 + V t + R(t) (X - c0), R the rotation by spin t about z. F = R
 * is a rotation, so that P = 0. A spinning body needs a pull to the axis at every point, without which it would be stressed: the body
 * force b = d2x/dt2 = -spin^2 (x - c), c = c0 + V t, along x and y. */
#include <math.h>

#include "body.h"

extern const struct gx_material gx_neo_hookean;

/* Arm of a point, R(t) (X - c0), along d; spin acts in the plane of x and y. */
static double arm(const struct gx_posed *posed, int d, size_t p, double cosine, double sine)
{
  const double *centre = posed->options.body.centre;
  if (d > 1 || posed->options.dim < 2) return posed->X[d][p] - centre[d];
  double x = posed->X[0][p] - centre[0], y = posed->X[1][p] - centre[1];
  return d == 0 ? cosine * x - sine * y : sine * x + cosine * y;
}

static void accelerate(const struct gx_posed *posed, double t, double *const *a)
{
  double spin = posed->options.spin, cosine = cos(spin * t), sine = sin(spin * t);
  for (int d = 0; d < posed->options.dim; d++)
    for (size_t p = 0; p < posed->n; p++) a[d][p] = d < 2 && spin != 0 ? -spin * spin * arm(posed, d, p, cosine, sine) : 0;
}

/* dx/dt = V + spin (-y, x) of the arm */
static void velocity(const struct gx_posed *posed, double cosine, double sine, double *const *v)
{
  const struct gx_problem_options *options = &posed->options;
  for (int d = 0; d < options->dim; d++)
    for (size_t p = 0; p < posed->n; p++) {
      v[d][p] = options->velocity[d];
      if (d < 2 && options->spin != 0) v[d][p] += (d ? options->spin : -options->spin) * arm(posed, !d, p, cosine, sine);
    }
}

static void exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F, double *const *a)
{
  const struct gx_problem_options *options = &posed->options;
  const int dim = options->dim;
  double cosine = cos(options->spin * t), sine = sin(options->spin * t);
  for (int d = 0; d < dim && u; d++)
    for (size_t p = 0; p < posed->n; p++)
      u[d][p] = options->velocity[d] * t + arm(posed, d, p, cosine, sine) - (posed->X[d][p] - options->body.centre[d]);
  if (v) velocity(posed, cosine, sine, v);
  if (a) accelerate(posed, t, a);
  for (int k = 0; k < dim * dim && F; k++) {
    int i = k / dim, j = k % dim;
    double entry = i != j ? (i < 2 && j < 2 ? (i < j ? -sine : sine) : 0) : i < 2 ? cosine : 1;
    for (size_t p = 0; p < posed->n; p++) F[k][p] = entry;
  }
}

const struct gx_problem gx_free_flight = {
    .name = "free-flight",
    .help = "a body of any shape that translates and spins without stress",
    .source = "rigid motion; the body force of a spin is the acceleration to its axis",
    .material = &gx_neo_hookean,
    .max_dim = 3,
    .has_poisson = true,
    .has_body = true,
    .has_flight = true,
    .has_spin = true,
    .boundaries = 1u << GX_BOUNDARY_PERIODIC | 1u << GX_BOUNDARY_FREE,
    .boundary = GX_BOUNDARY_PERIODIC,
    .end = 1,
    .check = gx_body_check,
    .inside = gx_body_inside,
    .exact = exact,
    .body = accelerate,
};
