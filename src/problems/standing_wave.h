/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standing waves along the axes, u_d = A sin(2 pi m X_d) T_d(t): what the bar problems share. */
#ifndef GRIDCROSS_PROBLEMS_STANDING_WAVE_H
#define GRIDCROSS_PROBLEMS_STANDING_WAVE_H

#include <math.h>
#include <string.h>

#include <gridcross/problem.h>

#include "../core/vector.h"

/* u, v, F, a from the factors T_d and dT_d/dt; d2T_d/dt2 = -omega^2 T_d. */
static inline void gx_standing_wave_exact(const struct gx_posed *posed, double omega, const double *factor, const double *rate,
                                          double *const *u, double *const *v, double *const *F, double *const *a)
{
  const int dim = posed->options.dim;
  const size_t n = posed->n;
  for (int d = 0; d < dim; d++) {
    const double A = posed->options.active[d] ? posed->options.amplitude : 0, wave = A * factor[d];
    if (u) gx_vector_line(n, 0, wave, posed->sine[d], u[d]);
    if (v) gx_vector_line(n, 0, A * rate[d], posed->sine[d], v[d]);
    if (a) gx_vector_line(n, 0, -omega * omega * wave, posed->sine[d], a[d]);
    for (int e = 0; F && e < dim; e++)
      if (e == d)
        gx_vector_line(n, 1, 2 * M_PI * posed->options.mode * wave, posed->cosine[d], F[d * dim + d]);
      else
        memset(F[d * dim + e], 0, n * sizeof(double));
  }
}

static inline enum gx_status gx_standing_wave_check(const struct gx_problem_options *options, struct gx_outcome *outcome)
{
  double slope = 2 * M_PI * options->mode * fabs(options->amplitude);
  if (slope < 1) return GX_OK;
  return gx_status_set(outcome, GX_REFUSED, -1,
                       "the exact solution itself tangles: its least F is %.4g; amplitude must stay below %.6g", 1 - slope,
                       1 / (2 * M_PI * options->mode));
}

#endif
