/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bases: weights and gradients of one direction at many points. Directions combine by products (steffen2010 eq. 29). */
#ifndef GRIDCROSS_BASIS_H
#define GRIDCROSS_BASIS_H

#include <gridcross/grid.h>

enum { GX_MAX_DEGREE = 9, GX_MAX_SUPPORT = GX_MAX_DEGREE + 1 };

struct gx_basis {
  const char *name;
  const char *help;
  const char *source; /* paper and equation */
  bool has_degree;    /* method.degree applies */
  bool has_domain;    /* needs half lengths of particle domains */
  bool deforms;       /* those lengths follow F */
  /* Sets degree-dependent counts (support, functions, stored, edge) of an axis whose cells, periodic, h, degree are set. */
  void (*layout)(struct gx_axis *axis);
  /* Where function k sits, in cell widths from the low end: sum_k S_k(x) site(k) = x / h. Nodes for hats and their averages; centres
   * or Greville abscissae for B-splines. On a periodic axis sites go on past the end, as images do. */
  double (*site)(const struct gx_axis *axis, int k);
  /* Weights at n points. x: [n] coordinates inside the domain (periodic: any); half: [n] half lengths, or NULL.
   * first: [n] lowest function met; S, D: [support][n] values and derivatives (1/m) of functions first + k.
   * Returns the index of a point whose domain outgrew its cell, or -1. */
  long (*evaluate)(const struct gx_axis *axis, size_t n, const double *x, const double *half, int *first, double *S, double *D);
};

/* All bases, NULL-ended. */
extern const struct gx_basis *const gx_basis_family[];
const struct gx_basis *gx_basis_find(const char *name); /* NULL: no such basis */

#endif
