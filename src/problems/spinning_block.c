/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A free body that spins about its centre c and vibrates along its edges L: released from the stretch u_d = A sin(pi (X - c)_d / L_d),
 * whose strain vanishes at the faces of a box, with velocity spin (-y, x) of the arm x - c. Nothing pulls at it from outside, so that
 * its momentum, angular momentum and energy stay. */
#include <math.h>

#include "body.h"

extern const struct gx_material gx_neo_hookean;

/* Width of the body along d. */
static double width(const struct gx_body *body, int d)
{
  return body->shape == GX_SHAPE_BOX ? body->size[d] : 2 * body->radius;
}

static void initial(const struct gx_posed *posed, double *const *u, double *const *v, double *const *F)
{
  const struct gx_problem_options *options = &posed->options;
  const struct gx_body *body = &options->body;
  const int dim = options->dim;
  for (int k = 0; k < dim * dim; k++)
    for (size_t p = 0; p < posed->n; p++) F[k][p] = 0;
  for (int d = 0; d < dim; d++) {
    double wavenumber = M_PI / width(body, d);
    for (size_t p = 0; p < posed->n; p++) {
      double angle = wavenumber * (posed->X[d][p] - body->centre[d]);
      u[d][p] = options->amplitude * sin(angle);
      F[d * dim + d][p] = 1 + options->amplitude * wavenumber * cos(angle);
      v[d][p] = 0;
    }
  }
  for (size_t p = 0; p < posed->n; p++) {
    v[0][p] = -options->spin * (posed->X[1][p] + u[1][p] - body->centre[1]);
    v[1][p] = options->spin * (posed->X[0][p] + u[0][p] - body->centre[0]);
  }
}

static enum gx_status check(const struct gx_problem_options *options, struct gx_outcome *outcome)
{
  if (options->body.shape == GX_SHAPE_POINTS)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "the block vibrates across the width of a shape: give body.shape in place of a list of points");
  GX_TRY(gx_body_check(options, outcome));
  for (int d = 0; d < options->dim; d++) {
    double strain = M_PI * fabs(options->amplitude) / width(&options->body, d);
    if (strain >= 1)
      return gx_status_set(outcome, GX_REFUSED, -1,
                           "the body is tangled at the start: its least F is %.4g; amplitude must stay below %.6g", 1 - strain,
                           fabs(options->amplitude) / strain);
  }
  return GX_OK;
}

const struct gx_problem gx_spinning_block = {
    .name = "spinning-block",
    .help = "a free body that spins and vibrates: what a method keeps of momentum, angular momentum and energy",
    .source = "after Jiang, Schroeder & Teran 2017, whose bodies rotate and collide",
    .material = &gx_neo_hookean,
    .min_dim = 2,
    .max_dim = 3,
    .standard = (const char *const[]){"problem.dimension=2", "problem.amplitude=0.01", "problem.spin=50", NULL},
    .has_amplitude = true,
    .has_poisson = true,
    .has_body = true,
    .has_spin = true,
    .boundaries = 1u << GX_BOUNDARY_PERIODIC | 1u << GX_BOUNDARY_FREE,
    .boundary = GX_BOUNDARY_FREE,
    .end = 0.125, /* one turn */
    .check = check,
    .inside = gx_body_inside,
    .initial = initial,
};
