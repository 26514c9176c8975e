/* SPDX-License-Identifier: GPL-3.0-or-later */
/* B-splines of degree 1 to 9: uniform knots when periodic, open (clamped) knots between fixed ends (steffen2010 eqs 30-34).
 * In cell c the functions c ... c + degree are non-zero. */
#include <gridcross/basis.h>

#include "../core/kernel.h"
#include "locate.h"

static void layout(struct gx_axis *axis)
{
  axis->support = axis->degree + 1;
  axis->functions = axis->periodic ? axis->cells : axis->cells + axis->degree;
  axis->stored = axis->cells + axis->degree;
  axis->edge = 1;
}

/* Degree q - 1 to q at place r of a cell of uniform knots: B_j^q = ((r + q - j) B_{j-1}^{q-1} + (j + 1 - r) B_j^{q-1}) / q. */
GX_CORE void raise_degree(const int q, double r, double *S)
{
  const double share = 1.0 / q;
  S[q] = r * S[q - 1] * share;
  for (int j = q - 1; j >= 1; j--) S[j] = ((r + (q - j)) * S[j - 1] + (j + 1 - r) * S[j]) * share;
  S[0] = (1 - r) * S[0] * share;
}

/* Values, and derivatives per cell width. */
GX_CORE void uniform_cell(const int degree, double r, double *S, double *D)
{
  S[0] = 1;
  for (int q = 1; q < degree; q++) raise_degree(q, r, S);
  D[0] = -S[0];
  for (int j = 1; j < degree; j++) D[j] = S[j - 1] - S[j];
  D[degree] = S[degree - 1];
  raise_degree(degree, r, S);
}

/* The same in a cell that sees the repeated end knots (Cox-de Boor). Knot i of the open sequence is i - degree held to
 * [0, cells]; function `cell + j` starts at knot cell + j. */
static double knot(int degree, int cells, int i)
{
  int k = i - degree;
  return k < 0 ? 0 : k > cells ? cells : k;
}

/* The mean of the knots inside its support (Greville): the centre where knots are uniform. */
static double site(const struct gx_axis *axis, int k)
{
  double sum = 0;
  for (int i = k + 1; i <= k + axis->degree; i++) sum += axis->periodic ? i - axis->degree : knot(axis->degree, axis->cells, i);
  return sum / axis->degree;
}

static void open_cell(int degree, int cells, int cell, double s, double *S, double *D)
{
  S[0] = 1;
  for (int q = 1; q <= degree; q++) {
    double previous[GX_MAX_SUPPORT];
    previous[0] = 0;
    for (int j = 0; j < q; j++) previous[j + 1] = S[j];
    /* functions of degree q non-zero here start at knots cell + degree - q + j, j = 0..q */
    for (int j = 0; j <= q; j++) {
      int start = cell + degree - q + j;
      double low = knot(degree, cells, start), low_end = knot(degree, cells, start + q);
      double high = knot(degree, cells, start + q + 1), high_start = knot(degree, cells, start + 1);
      double rising = j > 0 ? previous[j] / (low_end - low) : 0;
      double falling = j < q ? previous[j + 1] / (high - high_start) : 0;
      S[j] = (s - low) * rising + (high - s) * falling;
      D[j] = q * (rising - falling); /* the last degree's stays */
    }
  }
}

GX_CORE void periodic_points(const int degree, const struct gx_axis *axis, size_t n, const double *restrict x,
                             int *restrict first, double *restrict S, double *restrict D)
{
  const int cells = axis->cells;
  for (size_t p = 0; p < n; p++) {
    double s = gx_locate(true, cells, x[p]);
    int cell = gx_locate_cell(cells, s);
    double value[GX_MAX_SUPPORT], slope[GX_MAX_SUPPORT];
    uniform_cell(degree, degree > 1 ? s - cell : gx_locate_share(s - cell), value, slope);
    first[p] = cell;
    for (int k = 0; k <= degree; k++) {
      S[k * n + p] = value[k];
      D[k * n + p] = slope[k] * cells;
    }
  }
}

GX_CORE void bounded_points(const int degree, const struct gx_axis *axis, size_t n, const double *restrict x, int *restrict first,
                            double *restrict S, double *restrict D)
{
  const int cells = axis->cells;
  for (size_t p = 0; p < n; p++) {
    double s = gx_locate(false, cells, x[p]);
    int cell = gx_locate_cell(cells, s);
    double value[GX_MAX_SUPPORT], slope[GX_MAX_SUPPORT];
    if (cell >= degree - 1 && cell <= cells - degree)
      uniform_cell(degree, degree > 1 ? s - cell : gx_locate_share(s - cell), value, slope);
    else
      open_cell(degree, cells, cell, s, value, slope);
    first[p] = cell;
    for (int k = 0; k <= degree; k++) {
      S[k * n + p] = value[k];
      D[k * n + p] = slope[k] * cells;
    }
  }
}

GX_CORE void points(const int degree, const struct gx_axis *axis, size_t n, const double *restrict x, int *restrict first,
                    double *restrict S, double *restrict D)
{
  if (axis->periodic)
    periodic_points(degree, axis, n, x, first, S, D);
  else
    bounded_points(degree, axis, n, x, first, S, D);
}

#define OF_DEGREE(value)                                                                                                         \
  case value:                                                                                                                    \
    points(value, axis, n, x, first, S, D);                                                                                      \
    break;

GX_CLONES static long evaluate(const struct gx_axis *axis, size_t n, const double *restrict x, const double *half,
                               int *restrict first, double *restrict S, double *restrict D)
{
  (void)half;
  switch (axis->degree) {
    OF_DEGREE(1)
    OF_DEGREE(2)
    OF_DEGREE(3)
    OF_DEGREE(4)
    OF_DEGREE(5)
    OF_DEGREE(6)
    OF_DEGREE(7)
    OF_DEGREE(8)
    OF_DEGREE(9)
  }
  return -1;
}

const struct gx_basis gx_bspline = {
    .name = "bspline",
    .help = "B-splines of method.degree; open knots between fixed ends",
    .source = "steffen2010 eqs 30-34; de Boor 1978",
    .has_degree = true,
    .layout = layout,
    .site = site,
    .evaluate = evaluate,
};
