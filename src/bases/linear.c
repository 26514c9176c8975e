/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Piecewise linear (hat) functions: steffen2010 eqs 28, 29. Function i is the hat at node i. */
#include <gridcross/basis.h>

#include "../core/kernel.h"
#include "locate.h"

static void layout(struct gx_axis *axis)
{
  axis->support = 2;
  axis->functions = axis->periodic ? axis->cells : axis->cells + 1;
  axis->stored = axis->cells + 1;
  axis->edge = 1;
}

static double site(const struct gx_axis *axis, int k)
{
  (void)axis;
  return k;
}

GX_CLONES static long evaluate(const struct gx_axis *axis, size_t n, const double *restrict x, const double *half,
                               int *restrict first, double *restrict S, double *restrict D)
{
  (void)half;
  const bool periodic = axis->periodic;
  const int cells = axis->cells;
  for (size_t p = 0; p < n; p++) {
    double s = gx_locate(periodic, cells, x[p]);
    int cell = gx_locate_cell(cells, s);
    double r = gx_locate_share(s - cell);
    first[p] = cell;
    S[p] = 1 - r;
    S[n + p] = r;
    D[p] = -cells;
    D[n + p] = cells;
  }
  return -1;
}

const struct gx_basis gx_linear = {
    .name = "linear",
    .help = "piecewise linear hat functions; the gradient jumps at cell edges",
    .source = "steffen2010 eqs 28, 29",
    .layout = layout,
    .site = site,
    .evaluate = evaluate,
};
