/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A beam clamped at the wall x = 0, at rest and undeformed at t = 0, when gravity is switched on along -y: it swings down about the
 * deflection that it would come to rest at, and back. Plane strain in 2-D; in 3-D a beam of square section. Its edges are those of
 * cells where their number is a multiple of 16. No exact solution. */
#include <gridcross/problem.h>

#include <math.h>

extern const struct gx_material gx_neo_hookean;

/* Length from the wall; low and high edge of the section, along y and z. */
static const double length = 0.75, low[] = {0.8125, 0.5}, high[] = {0.875, 0.5625};
static const double edge = 1e-12; /* m: round-off of points that are given in decimals */

static bool inside(const struct gx_problem_options *options, const double *X)
{
  bool within = X[0] <= length + edge;
  for (int d = 1; d < options->dim; d++) within = within && X[d] >= low[d - 1] - edge && X[d] <= high[d - 1] + edge;
  return within;
}

static void initial(const struct gx_posed *posed, double *const *u, double *const *v, double *const *F)
{
  const int dim = posed->options.dim;
  for (int d = 0; d < dim; d++)
    for (size_t p = 0; p < posed->n; p++) {
      u[d][p] = v[d][p] = 0;
      for (int e = 0; e < dim; e++) F[d * dim + e][p] = d == e;
    }
}

static void body(const struct gx_posed *posed, double t, double *const *b)
{
  (void)t;
  for (int d = 0; d < posed->options.dim; d++)
    for (size_t p = 0; p < posed->n; p++) b[d][p] = d == 1 ? -posed->options.gravity : 0;
}

const struct gx_problem gx_cantilever = {
    .name = "cantilever",
    .help = "a beam clamped at a wall that swings down by half its length under gravity",
    .source = "a standard test of large deflection; no exact solution",
    .material = &gx_neo_hookean,
    .min_dim = 2,
    .max_dim = 3,
    .standard =
        (const char *const[]){"problem.dimension=2", "problem.modulus=4e6", "problem.density=1e3", "problem.poisson=0.3", NULL},
    .has_poisson = true,
    .has_gravity = true,
    .boundaries = 1u << GX_BOUNDARY_CLAMPED,
    .boundary = GX_BOUNDARY_CLAMPED,
    .end = 1,
    .inside = inside,
    .initial = initial,
    .body = body,
};
