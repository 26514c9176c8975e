/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GIMP: the hat function averaged over a particle domain of half width l <= h/2. A particle meets the three nodes about the
 * nearest one; function i is node i - 1, so that the ghost node behind a fixed end has index 0. */
#ifndef GRIDCROSS_BASES_GIMP_H
#define GRIDCROSS_BASES_GIMP_H

#include <gridcross/basis.h>

#include "../core/kernel.h"
#include "locate.h"

static inline void gx_gimp_layout(struct gx_axis *axis)
{
  axis->support = 3;
  axis->functions = axis->periodic ? axis->cells : axis->cells + 3;
  axis->stored = axis->cells + 3;
  axis->edge = 2;
}

/* A hat averaged over a symmetric domain still reproduces x. */
static inline double gx_gimp_site(const struct gx_axis *axis, int k)
{
  (void)axis;
  return k - 1;
}

/* Position s and half width l in units of h. With t = s - nearest node, the share of the left node is
 * a^2/(4l) + max(-t - l, 0), a = l - t held to [0, 2l]; the right node mirrors it; the middle takes the rest. */
GX_CORE void gx_gimp_weights(int cells, size_t n, size_t p, double s, double l, int *first, double *S, double *D)
{
  int nearest = (int)(s + 0.5);
  double t = s - nearest;
  double a = l - t, b = l + t;
  a = a > 0 ? a : 0;
  b = b > 0 ? b : 0;
  a = a < 2 * l ? a : 2 * l;
  b = b < 2 * l ? b : 2 * l;
  double scale = 0.5 / l;
  double slope_left = a * scale, slope_right = b * scale;
  double beyond_left = -t - l, beyond_right = t - l;
  double left = 0.5 * a * slope_left + (beyond_left > 0 ? beyond_left : 0);
  double right = 0.5 * b * slope_right + (beyond_right > 0 ? beyond_right : 0);
  first[p] = nearest;
  S[p] = left;
  S[n + p] = 1 - left - right;
  S[2 * n + p] = right;
  D[p] = -slope_left * cells;
  D[n + p] = (slope_left - slope_right) * cells;
  D[2 * n + p] = slope_right * cells;
}

static const double gx_gimp_widest = 0.5 * (1 + 1e-12); /* cells */

/* Weights at n points; returns whether a domain is not between 0 and one cell wide. `periodic` is constant for vectorisation. */
GX_CORE bool gx_gimp_points(const bool periodic, int cells, size_t n, const double *restrict x, const double *restrict half,
                            int *restrict first, double *restrict S, double *restrict D)
{
  int outside = 0;
  for (size_t p = 0; p < n; p++) {
    double l = half[p] * cells;
    outside |= !(l > 0) | !(l <= gx_gimp_widest);
    gx_gimp_weights(cells, n, p, gx_locate(periodic, cells, x[p]), l, first, S, D);
  }
  return outside;
}

GX_CORE bool gx_gimp_evaluate(const struct gx_axis *axis, size_t n, const double *restrict x, const double *restrict half,
                              int *restrict first, double *restrict S, double *restrict D)
{
  return axis->periodic ? gx_gimp_points(true, axis->cells, n, x, half, first, S, D)
                        : gx_gimp_points(false, axis->cells, n, x, half, first, S, D);
}

#endif
