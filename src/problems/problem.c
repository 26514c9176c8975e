/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of problems, and posing one at given points. */
#include <gridcross/problem.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/family.h"
#include "../core/large.h"
#include "problem_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_problem gx_##member;
GX_FAMILY(gx_problem, gx_problem, GX_PROBLEM_FAMILY)

const char *const gx_problem_boundary[GX_BOUNDARIES + 1] = {[GX_BOUNDARY_PERIODIC] = "periodic",
                                                            [GX_BOUNDARY_FIXED] = "fixed",
                                                            [GX_BOUNDARY_CLAMPED] = "clamped",
                                                            [GX_BOUNDARY_FREE] = "free"};

static int tabulate(struct gx_posed *posed, int d)
{
  posed->sine[d] = gx_large_zeros((posed->n + 1) * sizeof(double));
  posed->cosine[d] = gx_large_zeros((posed->n + 1) * sizeof(double));
  if (!posed->sine[d] || !posed->cosine[d]) return -1;
  for (size_t p = 0; p < posed->n; p++) {
    double angle = 2 * M_PI * posed->options.mode * posed->X[d][p];
    posed->sine[d][p] = sin(angle);
    posed->cosine[d][p] = cos(angle);
  }
  return 0;
}

struct gx_posed *gx_problem_pose(const struct gx_problem *problem, const struct gx_problem_options *options, size_t n,
                                 double *const *X)
{
  struct gx_posed *posed = calloc(1, sizeof *posed);
  if (!posed) return NULL;
  *posed = (struct gx_posed){.problem = problem, .options = *options, .n = n};
  posed->speed = problem->material->wave_speed(&options->moduli);
  for (int d = 0; d < options->dim; d++) {
    posed->X[d] = gx_large_zeros((n + 1) * sizeof(double));
    if (posed->X[d]) memcpy(posed->X[d], X[d], n * sizeof(double));
    if (!posed->X[d] || (problem->waves && tabulate(posed, d))) {
      gx_problem_free(posed);
      return NULL;
    }
  }
  return posed;
}

void gx_problem_begin(const struct gx_posed *posed, double t, double t_velocity, double *const *u, double *const *v,
                      double *const *F)
{
  const struct gx_problem *problem = posed->problem;
  if (!problem->exact) {
    problem->initial(posed, u, v, F);
    return;
  }
  problem->exact(posed, t, u, NULL, F, NULL);
  problem->exact(posed, t_velocity, NULL, v, NULL, NULL);
}

void gx_problem_free(struct gx_posed *posed)
{
  if (!posed) return;
  for (int d = 0; d < GX_MAX_DIM; d++) {
    free(posed->X[d]);
    free(posed->sine[d]);
    free(posed->cosine[d]);
  }
  free(posed);
}

struct gx_posed gx_problem_part(const struct gx_posed *posed, size_t from, size_t n)
{
  struct gx_posed part = *posed;
  part.n = n;
  for (int d = 0; d < posed->options.dim; d++) {
    part.X[d] += from;
    if (part.sine[d]) part.sine[d] += from;
    if (part.cosine[d]) part.cosine[d] += from;
  }
  return part;
}
