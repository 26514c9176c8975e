/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standing waves along the axes, u_d = A sin(2 pi m X_d) T_d(t): what the bar problems share. */
#ifndef GRIDCROSS_PROBLEMS_STANDING_WAVE_H
#define GRIDCROSS_PROBLEMS_STANDING_WAVE_H

#include <math.h>

#include <gridcross/problem.h>

/* u, v, F, a from the factors T_d and dT_d/dt; d2T_d/dt2 = -omega^2 T_d. */
static inline void gx_standing_wave_exact(const struct gx_posed *posed, double omega, const double *factor, const double *rate,
                                          double *const *u, double *const *v, double *const *F, double *const *a)
{
  int dim = posed->options.dim;
  double wavenumber = 2 * M_PI * posed->options.mode;
  for (int d = 0; d < dim; d++) {
    double A = posed->options.active[d] ? posed->options.amplitude : 0;
    const double *sine = posed->sine[d], *cosine = posed->cosine[d];
    if (u)
      for (size_t p = 0; p < posed->n; p++) u[d][p] = A * factor[d] * sine[p];
    if (v)
      for (size_t p = 0; p < posed->n; p++) v[d][p] = A * rate[d] * sine[p];
    if (a)
      for (size_t p = 0; p < posed->n; p++) a[d][p] = -omega * omega * A * factor[d] * sine[p];
    for (int e = 0; F && e < dim; e++)
      for (size_t p = 0; p < posed->n; p++) F[d * dim + e][p] = d == e ? 1 + wavenumber * A * factor[d] * cosine[p] : 0;
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
