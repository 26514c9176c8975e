/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cores are written for any dimension and support and inlined with both constant for the common supports. */
#include "packed.h"

#include "stencil.h"

/* Vectors of one node; two of half the size where the machine has none. */
typedef double quad __attribute__((vector_size(32)));
typedef quad node __attribute__((may_alias)); /* in memory that is doubles elsewhere */

#define NO_LINES(core, ...) /* in 1-D nothing is packed */

/* Components of particle p. Not a function: functions do not return vectors that some machines lack. */
#define LOAD(count, component, p)                                                                                                \
  ((quad){(component)[0][p], (count) > 1 ? (component)[1][p] : 0, (count) > 2 ? (component)[2][p] : 0, 0})

GX_CORE void store_quad(const int count, double *const *component, size_t p, const quad *in)
{
  for (int d = 0; d < count; d++) component[d][p] = (*in)[d];
}

GX_CORE void scatter(const int dim, const int s, const struct gx_weights *w, const bool carry, const double *m, double *const *v,
                     double *momentum, const bool push, double *const *T, double *const *body, double *force)
{
  node *const out_momentum = (node *)momentum, *const out_force = (node *)force;
  const double *velocity[GX_MAX_DIM], *load[GX_MAX_DIM], *column[GX_MAX_DIM][GX_MAX_DIM];
  for (int d = 0; d < dim; d++) {
    velocity[d] = v ? v[d] : NULL;
    load[d] = body ? body[d] : NULL;
    for (int e = 0; push && e < dim; e++) column[e][d] = T[d * dim + e];
  }
  for (size_t p = 0; p < w->n; p++) {
    struct gx_stencil stencil;
    gx_stencil_load(dim, s, w, p, push, &stencil);
    quad carried = {0}, loaded = {0}, t0 = {0}, t1 = {0}, t2 = {0}; /* in an array they would go through memory */
    if (carry) {
      carried = (quad){1, v ? velocity[0][p] : 0, v && dim > 1 ? velocity[1][p] : 0, v && dim > 2 ? velocity[2][p] : 0};
      carried *= m[p];
    }
    if (push && body) loaded = LOAD(dim, load, p);
    if (push) t0 = LOAD(dim, column[0], p);
    if (push && dim > 1) t1 = LOAD(dim, column[1], p);
    if (push && dim > 2) t2 = LOAD(dim, column[2], p);
    GX_STENCIL_ROWS(dim, s)
    {
      const struct gx_stencil_row row = gx_stencil_row(dim, w, &stencil, k1, k2, push);
      quad row_carried = carried * row.W, along = t0 * row.W, across = loaded * row.W;
      if (dim > 1) across += t1 * row.slope[1];
      if (dim > 2) across += t2 * row.slope[2];
      for (int k = 0; k < s; k++) {
        if (carry) out_momentum[row.node + (size_t)k] += row_carried * stencil.S[0][k];
        if (push) out_force[row.node + (size_t)k] += along * stencil.D[0][k] + across * stencil.S[0][k];
      }
    }
  }
}

GX_CLONES void gx_packed_scatter(const struct gx_weights *weights, const double *m, double *const *v, double *momentum,
                                 double *const *T, double *const *body, double *force)
{
  if (!force)
    GX_STENCIL_CALL(NO_LINES, scatter, weights, true, m, v, momentum, false, NULL, NULL, NULL);
  else if (!momentum)
    GX_STENCIL_CALL(NO_LINES, scatter, weights, false, NULL, NULL, NULL, true, T, body, force);
  else
    GX_STENCIL_CALL(NO_LINES, scatter, weights, true, m, v, momentum, true, T, body, force);
}

/* take_a: acceleration: S-sums of a; take_v: velocity: S-sums of v; take_slopes: gradient: D-sums of v. */
GX_CORE void gather(const int dim, const int s, const struct gx_weights *w, const bool take_a, const double *a,
                    double *const *acceleration, const bool take_v, const double *v, double *const *velocity,
                    const bool take_slopes, double *const *gradient)
{
  const node *const field_a = (const node *)a, *const field_v = (const node *)v;
  double *out_a[GX_MAX_DIM], *out_v[GX_MAX_DIM], *out_g[GX_MAX_DIM][GX_MAX_DIM];
  for (int d = 0; d < dim; d++) {
    out_a[d] = take_a ? acceleration[d] : NULL;
    out_v[d] = take_v ? velocity[d] : NULL;
    for (int e = 0; e < dim; e++) out_g[e][d] = take_slopes ? gradient[d * dim + e] : NULL;
  }
  for (size_t p = 0; p < w->n; p++) {
    struct gx_stencil stencil;
    gx_stencil_load(dim, s, w, p, take_slopes, &stencil);
    quad sum_a = {0}, sum_v = {0}, sum_g[GX_MAX_DIM] = {{0}};
    GX_STENCIL_ROWS(dim, s)
    {
      const struct gx_stencil_row row = gx_stencil_row(dim, w, &stencil, k1, k2, take_slopes);
      quad row_a = {0}, row_v = {0}, row_g = {0};
      for (int k = 0; k < s; k++) {
        const size_t i = row.node + (size_t)k;
        const quad v_i = field_v[i], term_a = take_a ? (quad)field_a[i] * stencil.S[0][k] : (quad){0};
        const quad term_v = v_i * stencil.S[0][k], term_g = v_i * stencil.D[0][k];
        row_a = k ? row_a + term_a : term_a;
        row_v = k ? row_v + term_v : term_v;
        if (take_slopes) row_g = k ? row_g + term_g : term_g;
      }
      if (take_a) sum_a += row_a * row.W;
      if (take_v) sum_v += row_v * row.W;
      if (take_slopes) sum_g[0] += row_g * row.W;
      for (int e = 1; take_slopes && e < dim; e++) sum_g[e] += row_v * row.slope[e];
    }
    if (take_a) store_quad(dim, out_a, p, &sum_a);
    if (take_v) store_quad(dim, out_v, p, &sum_v);
    for (int e = 0; take_slopes && e < dim; e++) store_quad(dim, out_g[e], p, &sum_g[e]);
  }
}

GX_CLONES void gx_packed_gather(const struct gx_weights *weights, const double *nodes, double *const *value)
{
  GX_STENCIL_CALL(NO_LINES, gather, weights, false, NULL, NULL, true, nodes, value, false, NULL);
}

GX_CLONES void gx_packed_gather_gradient(const struct gx_weights *weights, const double *nodes, double *const *gradient)
{
  GX_STENCIL_CALL(NO_LINES, gather, weights, false, NULL, NULL, false, nodes, NULL, true, gradient);
}

GX_CLONES void gx_packed_gather_all(const struct gx_weights *weights, const double *a, const double *v,
                                    double *const *acceleration, double *const *velocity, double *const *gradient)
{
  GX_STENCIL_CALL(NO_LINES, gather, weights, true, a, acceleration, true, v, velocity, true, gradient);
}

void gx_packed_pack(int count, size_t nodes, const double *const *field, double *packed)
{
  for (size_t i = 0; i < nodes; i++)
    for (int k = 0; k < GX_PACKED; k++) packed[i * GX_PACKED + (size_t)k] = k < count ? field[k][i] : 0;
}

void gx_packed_unpack(int count, size_t nodes, const double *packed, double *const *field)
{
  for (int k = 0; k < count; k++)
    for (size_t i = 0; field[k] && i < nodes; i++) field[k][i] = packed[i * GX_PACKED + (size_t)k];
}
