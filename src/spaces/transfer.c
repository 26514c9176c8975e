/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cores are written for any dimension and support and inlined with both constant for the common supports. */
#include "transfer.h"

#include "../core/kernel.h"

/* Visits the nodes of particle p: `node` is the index in a nodal field, `k` the slot per direction. */
#define FOR_NODES(dim, s, w, p)                                                                                                  \
  for (int k2 = 0; k2 < ((dim) > 2 ? (s) : 1); k2++)                                                                             \
    for (int k1 = 0; k1 < ((dim) > 1 ? (s) : 1); k1++)                                                                           \
      for (int k0 = 0; k0 < (s); k0++)

struct slots {
  int k[GX_MAX_DIM];
};
#define SLOTS ((struct slots){{k0, k1, k2}})

GX_CORE size_t node_of(const int dim, const struct gx_weights *w, size_t p, struct slots slots)
{
  size_t node = 0;
  for (int d = 0; d < dim; d++) node += (size_t)(w->first[d][p] + slots.k[d]) * (d ? w->stride[d] : 1);
  return node;
}

GX_CORE double weight_of(const int dim, const struct gx_weights *w, size_t p, struct slots slots)
{
  double weight = w->S[0][(size_t)slots.k[0] * w->n + p];
  for (int d = 1; d < dim; d++) weight *= w->S[d][(size_t)slots.k[d] * w->n + p];
  return weight;
}

GX_CORE double slope_of(const int dim, const struct gx_weights *w, size_t p, struct slots slots, int e)
{
  double slope = (e == 0 ? w->D : w->S)[0][(size_t)slots.k[0] * w->n + p];
  for (int d = 1; d < dim; d++) slope *= (e == d ? w->D : w->S)[d][(size_t)slots.k[d] * w->n + p];
  return slope;
}

/* Calls core(dim, support, weights, ...) with constants where the support is a common one. */
#define SPECIALISE(core, weights, ...)                                                                                           \
  do {                                                                                                                           \
    const struct gx_weights w = *(weights);                                                                                      \
    switch (16 * w.dim + w.support) {                                                                                            \
      ONE_CASE(1, 2, core, __VA_ARGS__)                                                                                          \
      ONE_CASE(1, 3, core, __VA_ARGS__)                                                                                          \
      ONE_CASE(1, 4, core, __VA_ARGS__)                                                                                          \
      ONE_CASE(2, 2, core, __VA_ARGS__)                                                                                          \
      ONE_CASE(2, 3, core, __VA_ARGS__)                                                                                          \
      ONE_CASE(2, 4, core, __VA_ARGS__)                                                                                          \
      ONE_CASE(3, 2, core, __VA_ARGS__)                                                                                          \
      ONE_CASE(3, 3, core, __VA_ARGS__)                                                                                          \
      ONE_CASE(3, 4, core, __VA_ARGS__)                                                                                          \
    default:                                                                                                                     \
      GX_FOR_DIM(w.dim, core(dim, w.support, &w, __VA_ARGS__))                                                                   \
    }                                                                                                                            \
  } while (0)
#define ONE_CASE(dim, support, core, ...)                                                                                        \
  case 16 * dim + support:                                                                                                       \
    core(dim, support, &w, __VA_ARGS__);                                                                                         \
    break;

GX_CORE void scatter(const int dim, const int s, const struct gx_weights *w, const double *m, double *const *value,
                     double *restrict total, double *const *moment)
{
  double *out[GX_MAX_DIM];
  const double *in[GX_MAX_DIM];
  for (int d = 0; d < dim; d++) {
    out[d] = value ? moment[d] : total;
    in[d] = value ? value[d] : m;
  }
  for (size_t p = 0; p < w->n; p++) {
    double mass = m[p], momentum[GX_MAX_DIM];
    for (int d = 0; d < dim; d++) momentum[d] = mass * in[d][p];
    FOR_NODES(dim, s, w, p)
    {
      size_t node = node_of(dim, w, p, SLOTS);
      double S = weight_of(dim, w, p, SLOTS);
      if (total) total[node] += mass * S;
      if (value)
        for (int d = 0; d < dim; d++) out[d][node] += momentum[d] * S;
    }
  }
}

void gx_transfer_scatter(const struct gx_weights *weights, const double *m, double *const *value, double *total,
                         double *const *moment)
{
  if (!value)
    SPECIALISE(scatter, weights, m, NULL, total, NULL);
  else if (total)
    SPECIALISE(scatter, weights, m, value, total, moment);
  else
    SPECIALISE(scatter, weights, m, value, NULL, moment);
}

GX_CORE void scatter_force(const int dim, const int s, const struct gx_weights *w, double *const *T, const double *m,
                           double *const *b, double *const *force)
{
  double *out[GX_MAX_DIM];
  const double *stress[GX_MAX_TENSOR];
  for (int d = 0; d < dim; d++) out[d] = force[d];
  for (int k = 0; k < dim * dim; k++) stress[k] = T[k];
  for (size_t p = 0; p < w->n; p++) {
    double load[GX_MAX_DIM], t[GX_MAX_TENSOR];
    for (int d = 0; d < dim; d++) load[d] = b ? m[p] * b[d][p] : 0;
    for (int k = 0; k < dim * dim; k++) t[k] = stress[k][p];
    FOR_NODES(dim, s, w, p)
    {
      size_t node = node_of(dim, w, p, SLOTS);
      double S = b ? weight_of(dim, w, p, SLOTS) : 0;
      double slope[GX_MAX_DIM];
      for (int e = 0; e < dim; e++) slope[e] = slope_of(dim, w, p, SLOTS, e);
      for (int d = 0; d < dim; d++) {
        double f = b ? load[d] * S : 0;
        for (int e = 0; e < dim; e++) f += t[d * dim + e] * slope[e];
        out[d][node] += f;
      }
    }
  }
}

void gx_transfer_scatter_force(const struct gx_weights *weights, double *const *T, const double *m, double *const *b,
                               double *const *force)
{
  if (b)
    SPECIALISE(scatter_force, weights, T, m, b, force);
  else
    SPECIALISE(scatter_force, weights, T, m, NULL, force);
}

/* a, value: S-sums of a; v, velocity: S-sums of v; gradient: D-sums of v. A NULL pair is skipped. */
GX_CORE void gather(const int dim, const int s, const struct gx_weights *w, double *const *a, double *const *acceleration,
                    double *const *v, double *const *velocity, double *const *gradient)
{
  const double *field_a[GX_MAX_DIM], *field_v[GX_MAX_DIM];
  double *out_a[GX_MAX_DIM], *out_v[GX_MAX_DIM], *out_g[GX_MAX_TENSOR];
  for (int d = 0; d < dim; d++) {
    field_a[d] = a ? a[d] : NULL;
    out_a[d] = a ? acceleration[d] : NULL;
    field_v[d] = v ? v[d] : NULL;
    out_v[d] = velocity ? velocity[d] : NULL;
  }
  for (int k = 0; k < dim * dim; k++) out_g[k] = gradient ? gradient[k] : NULL;
  for (size_t p = 0; p < w->n; p++) {
    double sum_a[GX_MAX_DIM] = {0}, sum_v[GX_MAX_DIM] = {0}, sum_g[GX_MAX_TENSOR] = {0};
    FOR_NODES(dim, s, w, p)
    {
      size_t node = node_of(dim, w, p, SLOTS);
      double S = a || velocity ? weight_of(dim, w, p, SLOTS) : 0;
      for (int d = 0; d < dim; d++) {
        if (a) sum_a[d] += S * field_a[d][node];
        if (velocity) sum_v[d] += S * field_v[d][node];
        if (gradient)
          for (int e = 0; e < dim; e++) sum_g[d * dim + e] += field_v[d][node] * slope_of(dim, w, p, SLOTS, e);
      }
    }
    for (int d = 0; d < dim; d++) {
      if (a) out_a[d][p] = sum_a[d];
      if (velocity) out_v[d][p] = sum_v[d];
    }
    if (gradient)
      for (int k = 0; k < dim * dim; k++) out_g[k][p] = sum_g[k];
  }
}

void gx_transfer_gather(const struct gx_weights *weights, double *const *field, double *const *value)
{
  SPECIALISE(gather, weights, field, value, NULL, NULL, NULL);
}

void gx_transfer_gather_gradient(const struct gx_weights *weights, double *const *field, double *const *gradient)
{
  SPECIALISE(gather, weights, NULL, NULL, field, NULL, gradient);
}

void gx_transfer_gather_all(const struct gx_weights *weights, double *const *a, double *const *v, double *const *acceleration,
                            double *const *velocity, double *const *gradient)
{
  SPECIALISE(gather, weights, a, acceleration, v, velocity, gradient);
}
