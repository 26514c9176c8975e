/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementwise, and the terms of a sum piece by piece. */
#include "bring.h"

#include "../core/kernel.h"
#include "../core/vector.h"

GX_CLONES void gx_bring(size_t n, double ahead, const double *v, const double *a, double *now)
{
  GX_APART for (size_t p = 0; p < n; p++) now[p] = v[p] + ahead * a[p];
}

GX_CLONES static void bring_with_terms(size_t n, bool first_order, double ahead, const double *restrict m,
                                       const double *restrict held, const double *restrict a0, const double *restrict a,
                                       double *restrict v, double *restrict term)
{
  for (size_t p = 0; p < n; p++) {
    double now = held[p] + ahead * a[p];
    term[p] = m[p] * (first_order ? 0.5 * v[p] : 0.25 * (now - v[p])) * (a[p] - a0[p]);
    v[p] = now;
  }
}

double gx_bring_on(const struct gx_bring_step *step, double ahead, bool first_order)
{
  double term[GX_VECTOR_PIECE], parts[GX_VECTOR_LANES] = {0};
  for (size_t from = 0; from < step->n; from += GX_VECTOR_PIECE) {
    const size_t n = gx_vector_piece(step->n, from);
    bring_with_terms(n, first_order, ahead, step->m + from, step->held + from, step->a0 + from, step->a + from, step->v + from,
                     term);
    gx_vector_sum_piece(n, term, parts);
  }
  return gx_vector_total(parts);
}
