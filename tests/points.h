/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A grid and the weights of its basis at given points, for tests below the level of a space. */
#ifndef GRIDCROSS_TESTS_POINTS_H
#define GRIDCROSS_TESTS_POINTS_H

#include <stdlib.h>

#include <gridcross/basis.h>

#include "check.h"
#include "spaces/transfer.h"

struct points {
  struct gx_grid grid;
  struct gx_weights weights;
};

static inline void points_free(struct points *points)
{
  for (int d = 0; d < points->weights.dim; d++) {
    free(points->weights.first[d]);
    free(points->weights.S[d]);
    free(points->weights.D[d]);
  }
}

/* x, half: [dim][n]. Direction d has cells + d cells, so that no two are alike. */
static inline struct points points_at(const struct gx_basis *basis, int dim, int cells, bool periodic, int degree, size_t n,
                                      double *const *x, double *const *half)
{
  struct points points = {.grid = {.dim = dim, .stored = 1}, .weights = {.dim = dim, .n = n}};
  struct gx_grid *grid = &points.grid;
  struct gx_weights *weights = &points.weights;
  for (int d = 0; d < dim; d++) {
    grid->axis[d] = (struct gx_axis){
        .cells = cells + d,
        .periodic = periodic,
        .h = 1.0 / (cells + d),
        .degree = basis->has_degree ? degree : 1,
        .held = {1u << d, 1u << d},
    };
    basis->layout(&grid->axis[d]);
    grid->stride[d] = weights->stride[d] = grid->stored;
    grid->stored *= (size_t)grid->axis[d].stored;
    size_t support = (size_t)grid->axis[d].support;
    weights->support = (int)support;
    weights->first[d] = malloc(n * sizeof(int));
    weights->S[d] = malloc(n * support * sizeof(double));
    weights->D[d] = malloc(n * support * sizeof(double));
    assert_int_equal(basis->evaluate(&grid->axis[d], n, x[d], half[d], weights->first[d], weights->S[d], weights->D[d]), -1);
  }
  return points;
}

/* [count][length] zeros. */
static inline double **fields(int count, size_t length)
{
  double **field = calloc((size_t)count, sizeof *field);
  for (int i = 0; i < count; i++) field[i] = calloc(length, sizeof **field);
  return field;
}

static inline void fields_free(double **field, int count)
{
  for (int i = 0; i < count; i++) free(field[i]);
  free(field);
}

#endif
