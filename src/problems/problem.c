/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of problems, and posing one at given points. */
#include <gridcross/problem.h>

#include <math.h>
#include <stdlib.h>

#include "../core/family.h"
#include "problem_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_problem gx_##member;
GX_FAMILY(gx_problem, gx_problem, GX_PROBLEM_FAMILY)

struct gx_posed *gx_problem_pose(const struct gx_problem *problem, const struct gx_problem_options *options, size_t n,
                                 double *const *X)
{
  struct gx_posed *posed = calloc(1, sizeof *posed);
  if (!posed) return NULL;
  *posed = (struct gx_posed){.problem = problem, .options = *options, .n = n};
  posed->speed = problem->material->wave_speed(&options->moduli);
  for (int d = 0; d < options->dim; d++) {
    posed->sine[d] = malloc((n + 1) * sizeof(double));
    posed->cosine[d] = malloc((n + 1) * sizeof(double));
    if (!posed->sine[d] || !posed->cosine[d]) {
      gx_problem_free(posed);
      return NULL;
    }
    for (size_t p = 0; p < n; p++) {
      double angle = 2 * M_PI * options->mode * X[d][p];
      posed->sine[d][p] = sin(angle);
      posed->cosine[d][p] = cos(angle);
    }
  }
  return posed;
}

void gx_problem_free(struct gx_posed *posed)
{
  if (!posed) return;
  for (int d = 0; d < GX_MAX_DIM; d++) {
    free(posed->sine[d]);
    free(posed->cosine[d]);
  }
  free(posed);
}
