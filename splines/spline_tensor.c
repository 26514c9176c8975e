/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Product grids: operators of one direction, direction by direction. */
#include <gridcross_splines.h>

#include "spline_lines.h"

/* Entries along a direction before (reached false) and after its operator. */
static size_t length_of(const struct gx_spline_lines *lines, int order, bool reached)
{
  return reached && order >= 0 ? lines->points->count : lines->interpolant->knots->sites;
}

size_t gx_spline_tensor_room(int dim, const struct gx_spline_lines *const *lines)
{
  size_t room = 1;
  for (int d = 0; d < dim; d++) {
    size_t sites = length_of(lines[d], 0, false), count = length_of(lines[d], 0, true);
    room *= sites > count ? sites : count;
  }
  return room;
}

void gx_spline_tensor_apply(int dim, const struct gx_spline_lines *const *lines, const int *order, const double *in, bool add,
                            double *out, double *const *work)
{
  int last = dim - 1;
  while (order[last] < 0) last--;
  for (int d = 0; d <= last; d++) {
    if (order[d] < 0) continue;
    size_t before = 1, after = 1;
    for (int e = 0; e < d; e++) before *= length_of(lines[e], order[e], true);
    for (int e = d + 1; e < dim; e++) after *= length_of(lines[e], order[e], false);
    double *to = d == last ? out : work[d % 2];
    gx_spline_lines_apply(lines[d], order[d], before, after, in, add && d == last, to);
    in = to;
  }
}
