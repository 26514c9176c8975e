/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The consistent mass matrix as a dense one, by loops over pairs of functions, and its solution by GSL's LU. */
#ifndef GRIDCROSS_TESTS_DENSE_MASS_H
#define GRIDCROSS_TESTS_DENSE_MASS_H

#include <gsl/gsl_linalg.h>

#include "check.h"
#include "points.h"

/* Number of the distinct function behind a stored one. */
static inline size_t dense_number(const struct gx_grid *grid, size_t node)
{
  size_t number = 0, stride = 1;
  for (int d = 0; d < grid->dim; d++) {
    number += node / grid->stride[d] % (size_t)grid->axis[d].stored % (size_t)grid->axis[d].functions * stride;
    stride *= (size_t)grid->axis[d].functions;
  }
  return number;
}

/* Whether an end holds a component there. */
static inline bool dense_holds(const struct gx_grid *grid, size_t node, int component)
{
  for (int d = 0; d < grid->dim; d++) {
    const struct gx_axis *axis = &grid->axis[d];
    int k = (int)(node / grid->stride[d] % (size_t)axis->stored);
    if (axis->periodic) continue;
    if (k < axis->edge && axis->held[0] >> component & 1) return true;
    if (k >= axis->functions - axis->edge && axis->held[1] >> component & 1) return true;
  }
  return false;
}

static inline void dense_add(gsl_matrix *M, const struct points *points, size_t p, double m)
{
  enum { MOST = GX_MAX_SUPPORT * GX_MAX_SUPPORT }; /* in 2-D; 3-D is tested to degree 3 */
  const struct gx_weights *w = &points->weights;
  size_t number[MOST];
  double S[MOST];
  int count = 1;
  for (int d = 0; d < w->dim; d++) count *= w->support;
  for (int q = 0; q < count; q++) {
    size_t node = 0;
    S[q] = 1;
    for (int d = 0, rest = q; d < w->dim; d++, rest /= w->support) {
      node += (size_t)(w->first[d][p] + rest % w->support) * w->stride[d];
      S[q] *= w->S[d][(size_t)(rest % w->support) * w->n + p];
    }
    number[q] = dense_number(&points->grid, node);
  }
  for (int q = 0; q < count; q++)
    for (int r = 0; r < count; r++) *gsl_matrix_ptr(M, number[q], number[r]) += m * S[q] * S[r];
}

/* M with rows and columns of held functions, and of those that no point sees, replaced by those of the identity. */
static inline gsl_matrix *dense_mass(const struct points *points, const double *m, int d)
{
  const struct gx_grid *grid = &points->grid;
  size_t unknowns = 1;
  for (int e = 0; e < grid->dim; e++) unknowns *= (size_t)grid->axis[e].functions;
  gsl_matrix *M = gsl_matrix_calloc(unknowns, unknowns);
  for (size_t p = 0; p < points->weights.n; p++) dense_add(M, points, p, m[p]);
  for (size_t node = 0; node < grid->stored; node++) {
    size_t i = dense_number(grid, node);
    if (!dense_holds(grid, node, d) && gsl_matrix_get(M, i, i) > 0) continue;
    for (size_t j = 0; j < unknowns; j++) {
      gsl_matrix_set(M, i, j, 0);
      gsl_matrix_set(M, j, i, 0);
    }
    gsl_matrix_set(M, i, i, 1);
  }
  return M;
}

/* ours must solve the dense system, and agree with the dense solution as far as its condition lets it. */
static inline void dense_compare(const gsl_matrix *M, const gsl_vector *right, const gsl_vector *ours, double residual,
                                 double error)
{
  size_t unknowns = M->size1;
  gsl_vector *solution = gsl_vector_alloc(unknowns);
  gsl_matrix *LU = gsl_matrix_alloc(unknowns, unknowns);
  gsl_matrix_memcpy(LU, M);
  gsl_permutation *permutation = gsl_permutation_alloc(unknowns);
  int sign;
  gsl_linalg_LU_decomp(LU, permutation, &sign);
  gsl_linalg_LU_solve(LU, permutation, right, solution);
  double largest = 0;
  for (size_t i = 0; i < unknowns; i++) largest = fmax(largest, fabs(solution->data[i]));
  for (size_t i = 0; i < unknowns; i++) {
    double product = 0, magnitude = fabs(right->data[i]);
    for (size_t j = 0; j < unknowns; j++) {
      product += gsl_matrix_get(M, i, j) * ours->data[j];
      magnitude += fabs(gsl_matrix_get(M, i, j) * ours->data[j]);
    }
    NEAR(product, right->data[i], residual * magnitude);
    NEAR(ours->data[i], solution->data[i], error * largest);
  }
  gsl_permutation_free(permutation);
  gsl_matrix_free(LU);
  gsl_vector_free(solution);
}

#endif
