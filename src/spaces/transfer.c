/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cores are written for any dimension and support and inlined with both constant for the common supports. */
#include "transfer.h"

#include "stencil.h"

/* Visits all particles; in 1-D from distant parts of the line in turn, so that adding to a node does not wait for the particle
 * before to have done so. */
#define FOR_PARTICLES(dim, n, p)                                                                                                 \
  for (size_t part = (dim) == 1 ? ((n) + 3) / 4 : (n), start = 0; start < part; start++)                                         \
    for (size_t p = start; p < (n); p += part)

#define LINES(core, ...)                                                                                                         \
  GX_STENCIL_CASE(1, 2, core, __VA_ARGS__)                                                                                       \
  GX_STENCIL_CASE(1, 3, core, __VA_ARGS__)                                                                                       \
  GX_STENCIL_CASE(1, 4, core, __VA_ARGS__)                                                                                       \
  GX_STENCIL_CASE(1, 5, core, __VA_ARGS__)                                                                                       \
  GX_STENCIL_CASE(1, 6, core, __VA_ARGS__)                                                                                       \
  GX_STENCIL_CASE(1, 7, core, __VA_ARGS__)                                                                                       \
  GX_STENCIL_CASE(1, 8, core, __VA_ARGS__)                                                                                       \
  GX_STENCIL_CASE(1, 9, core, __VA_ARGS__)                                                                                       \
  GX_STENCIL_CASE(1, 10, core, __VA_ARGS__)

GX_CORE void scatter(const int dim, const int s, const struct gx_weights *w, const double *m, double *const *value,
                     double *restrict total, double *const *moment)
{
  double *out[GX_MAX_DIM];
  const double *in[GX_MAX_DIM];
  for (int d = 0; d < dim; d++) {
    out[d] = value ? moment[d] : total;
    in[d] = value ? value[d] : m;
  }
  FOR_PARTICLES(dim, w->n, p)
  {
    struct gx_stencil stencil;
    gx_stencil_load(dim, s, w, p, false, &stencil);
    double mass = m[p], momentum[GX_MAX_DIM];
    for (int d = 0; d < dim; d++) momentum[d] = mass * in[d][p];
    GX_STENCIL_ROWS(dim, s)
    {
      const struct gx_stencil_row row = gx_stencil_row(dim, w, &stencil, k1, k2, false);
      for (int k = 0; total && k < s; k++) total[row.node + (size_t)k] += mass * row.W * stencil.S[0][k];
      for (int d = 0; value && d < dim; d++)
        for (int k = 0; k < s; k++) out[d][row.node + (size_t)k] += momentum[d] * row.W * stencil.S[0][k];
    }
  }
}

GX_CLONES void gx_transfer_scatter(const struct gx_weights *weights, const double *m, double *const *value, double *total,
                                   double *const *moment)
{
  if (!value)
    GX_STENCIL_CALL(LINES, scatter, weights, m, NULL, total, NULL);
  else if (total)
    GX_STENCIL_CALL(LINES, scatter, weights, m, value, total, moment);
  else
    GX_STENCIL_CALL(LINES, scatter, weights, m, value, NULL, moment);
}

GX_CORE void scatter_force(const int dim, const int s, const struct gx_weights *w, double *const *T, double *const *body,
                           double *const *force)
{
  double *out[GX_MAX_DIM];
  const double *stress[GX_MAX_TENSOR], *in[GX_MAX_DIM];
  for (int d = 0; d < dim; d++) {
    out[d] = force[d];
    in[d] = body ? body[d] : NULL;
  }
  for (int k = 0; k < dim * dim; k++) stress[k] = T[k];
  FOR_PARTICLES(dim, w->n, p)
  {
    struct gx_stencil stencil;
    gx_stencil_load(dim, s, w, p, true, &stencil);
    double load[GX_MAX_DIM], t[GX_MAX_TENSOR];
    for (int d = 0; d < dim; d++) load[d] = body ? in[d][p] : 0;
    for (int k = 0; k < dim * dim; k++) t[k] = stress[k][p];
    GX_STENCIL_ROWS(dim, s)
    {
      const struct gx_stencil_row row = gx_stencil_row(dim, w, &stencil, k1, k2, true);
      for (int d = 0; d < dim; d++) {
        double along = t[d * dim] * row.W, across = load[d] * row.W;
        for (int e = 1; e < dim; e++) across += t[d * dim + e] * row.slope[e];
        for (int k = 0; k < s; k++) {
          double f = along * stencil.D[0][k];
          out[d][row.node + (size_t)k] += body || dim > 1 ? f + across * stencil.S[0][k] : f;
        }
      }
    }
  }
}

GX_CLONES void gx_transfer_scatter_force(const struct gx_weights *weights, double *const *T, double *const *body,
                                         double *const *force)
{
  if (body)
    GX_STENCIL_CALL(LINES, scatter_force, weights, T, body, force);
  else
    GX_STENCIL_CALL(LINES, scatter_force, weights, T, NULL, force);
}

/* The first term of a sum starts it: compilers must not drop an addition to 0, which turns -0 into 0. */
GX_CORE double sum_with(const bool first, double sum, double term)
{
  return first ? term : sum + term;
}

/* take_a: acceleration: S-sums of a; take_v: velocity: S-sums of v; take_slopes: gradient: D-sums of v. */
GX_CORE void gather(const int dim, const int s, const struct gx_weights *w, const bool take_a, double *const *a,
                    double *const *acceleration, const bool take_v, double *const *v, double *const *velocity,
                    const bool take_slopes, double *const *gradient)
{
  const double *field_a[GX_MAX_DIM], *field_v[GX_MAX_DIM];
  double *out_a[GX_MAX_DIM], *out_v[GX_MAX_DIM], *out_g[GX_MAX_TENSOR];
  for (int d = 0; d < dim; d++) {
    field_a[d] = take_a ? a[d] : NULL;
    out_a[d] = take_a ? acceleration[d] : NULL;
    field_v[d] = take_v || take_slopes ? v[d] : NULL;
    out_v[d] = take_v ? velocity[d] : NULL;
  }
  for (int k = 0; k < dim * dim; k++) out_g[k] = take_slopes ? gradient[k] : NULL;
  for (size_t p = 0; p < w->n; p++) {
    struct gx_stencil stencil;
    gx_stencil_load(dim, s, w, p, take_slopes, &stencil);
    double sum_a[GX_MAX_DIM] = {0}, sum_v[GX_MAX_DIM] = {0}, sum_g[GX_MAX_TENSOR] = {0};
    GX_STENCIL_ROWS(dim, s)
    {
      const struct gx_stencil_row row = gx_stencil_row(dim, w, &stencil, k1, k2, take_slopes);
      for (int d = 0; d < dim; d++) {
        double row_a = 0, row_v = 0, row_g = 0;
        for (int k = 0; k < s; k++) {
          size_t node = row.node + (size_t)k;
          if (take_a) row_a = sum_with(!k, row_a, stencil.S[0][k] * field_a[d][node]);
          if (take_v || take_slopes) row_v = sum_with(!k, row_v, stencil.S[0][k] * field_v[d][node]);
          if (take_slopes) row_g = sum_with(!k, row_g, stencil.D[0][k] * field_v[d][node]);
        }
        sum_a[d] = sum_with(dim == 1, sum_a[d], row.W * row_a);
        sum_v[d] = sum_with(dim == 1, sum_v[d], row.W * row_v);
        sum_g[d * dim] = sum_with(dim == 1, sum_g[d * dim], row.W * row_g);
        for (int e = 1; e < dim; e++) sum_g[d * dim + e] += row.slope[e] * row_v;
      }
    }
    for (int d = 0; d < dim; d++) {
      if (take_a) out_a[d][p] = sum_a[d];
      if (take_v) out_v[d][p] = sum_v[d];
    }
    for (int k = 0; take_slopes && k < dim * dim; k++) out_g[k][p] = sum_g[k];
  }
}

GX_CLONES void gx_transfer_gather(const struct gx_weights *weights, double *const *field, double *const *value)
{
  GX_STENCIL_CALL(LINES, gather, weights, false, NULL, NULL, true, field, value, false, NULL);
}

GX_CLONES void gx_transfer_gather_gradient(const struct gx_weights *weights, double *const *field, double *const *gradient)
{
  GX_STENCIL_CALL(LINES, gather, weights, false, NULL, NULL, false, field, NULL, true, gradient);
}

GX_CLONES void gx_transfer_gather_all(const struct gx_weights *weights, double *const *a, double *const *v,
                                      double *const *acceleration, double *const *velocity, double *const *gradient)
{
  GX_STENCIL_CALL(LINES, gather, weights, true, a, acceleration, true, v, velocity, true, gradient);
}
