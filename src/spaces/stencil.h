/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nodes of a particle row by row along the first direction, in which nodes are consecutive: what does not change in a row is
 * multiplied once. For cores that are inlined with constant dimension and support. */
#ifndef GRIDCROSS_SPACES_STENCIL_H
#define GRIDCROSS_SPACES_STENCIL_H

#include <stdbool.h>

#include <gridcross/basis.h>

#include "../core/kernel.h"
#include "transfer.h"

/* Weights of one particle. */
struct gx_stencil {
  size_t first; /* node */
  double S[GX_MAX_DIM][GX_MAX_SUPPORT], D[GX_MAX_DIM][GX_MAX_SUPPORT];
};

/* Their products over the directions after the first. */
struct gx_stencil_row {
  size_t node;              /* first node of the row */
  double W;                 /* product of S */
  double slope[GX_MAX_DIM]; /* the same with D along direction e >= 1 */
};

GX_CORE void gx_stencil_load(const int dim, const int s, const struct gx_weights *w, size_t p, const bool slopes,
                             struct gx_stencil *stencil)
{
  stencil->first = 0;
  for (int d = 0; d < dim; d++) {
    stencil->first += (size_t)w->first[d][p] * (d ? w->stride[d] : 1);
    for (int k = 0; k < s; k++) {
      stencil->S[d][k] = w->S[d][(size_t)k * w->n + p];
      if (slopes) stencil->D[d][k] = w->D[d][(size_t)k * w->n + p];
    }
  }
}

GX_CORE struct gx_stencil_row gx_stencil_row(const int dim, const struct gx_weights *w, const struct gx_stencil *stencil, int k1,
                                             int k2, const bool slopes)
{
  const int k[GX_MAX_DIM] = {0, k1, k2};
  struct gx_stencil_row row = {.node = stencil->first, .W = 1, .slope = {1, 1, 1}};
  for (int d = 1; d < dim; d++) {
    row.node += (size_t)k[d] * w->stride[d];
    for (int e = 1; slopes && e < dim; e++) row.slope[e] *= (e == d ? stencil->D : stencil->S)[d][k[d]];
    row.W *= stencil->S[d][k[d]];
  }
  return row;
}

#define GX_STENCIL_ROWS(dim, s)                                                                                                  \
  for (int k2 = 0; k2 < ((dim) > 2 ? (s) : 1); k2++)                                                                             \
    for (int k1 = 0; k1 < ((dim) > 1 ? (s) : 1); k1++)

/* Calls core(dim, support, weights, ...) with both constant where the support is a common one; lines: the cases in 1-D. */
#define GX_STENCIL_CALL(lines, core, weights, ...)                                                                               \
  do {                                                                                                                           \
    const struct gx_weights w = *(weights);                                                                                      \
    switch (16 * w.dim + w.support) {                                                                                            \
      lines(core, __VA_ARGS__) GX_STENCIL_CASE(2, 2, core, __VA_ARGS__) GX_STENCIL_CASE(2, 3, core, __VA_ARGS__)                 \
          GX_STENCIL_CASE(2, 4, core, __VA_ARGS__) GX_STENCIL_CASE(3, 2, core, __VA_ARGS__)                                      \
              GX_STENCIL_CASE(3, 3, core, __VA_ARGS__) GX_STENCIL_CASE(3, 4, core, __VA_ARGS__) default                          \
          : GX_FOR_DIM(w.dim, core(dim, w.support, &w, __VA_ARGS__))                                                             \
    }                                                                                                                            \
  } while (0)
#define GX_STENCIL_CASE(dim, support, core, ...)                                                                                 \
  case 16 * dim + support:                                                                                                       \
    core(dim, support, &w, __VA_ARGS__);                                                                                         \
    break;

#endif
