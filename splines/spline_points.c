/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values and derivatives at fixed points as banded products. */
#include <gridcross_splines.h>

#include "spline_basis.h"

#include <stdlib.h>
#include <string.h>

enum gx_spline_status gx_spline_points_create(struct gx_spline_points **points, int degree, unsigned orders, size_t count,
                                              struct gx_spline_error *error)
{
  *points = NULL;
  if (degree < 1 || degree > GX_SPLINE_MAX_DEGREE || !orders || orders >> (degree + 1))
    return gx_spline_error_set(error, GX_SPLINE_DEGREE, -1, "derivatives (bits %#x) of a spline of degree %d", orders, degree);
  size_t held = 0;
  for (int d = 0; d <= degree; d++) held += orders >> d & 1;
  const size_t row = (size_t)degree + 1;
  struct gx_spline_points *made = calloc(1, sizeof *made);
  double *memory = calloc(held * row * count + 1, sizeof *memory);
  size_t *first = calloc(count + 1, sizeof *first);
  if (!made || !memory || !first) {
    free(made);
    free(memory);
    free(first);
    return gx_spline_error_set(error, GX_SPLINE_MEMORY, -1, "out of memory for %zu points of a spline", count);
  }
  *made = (struct gx_spline_points){.degree = degree, .orders = orders, .count = count, .first = first};
  for (int d = 0; d <= degree; d++) {
    if (!(orders >> d & 1)) continue;
    made->weight[d] = memory;
    memory += row * count;
  }
  *points = made;
  return GX_SPLINE_OK;
}

void gx_spline_points_free(struct gx_spline_points *points)
{
  if (!points) return;
  for (int d = 0; d <= points->degree; d++)
    if (points->weight[d]) {
      free(points->weight[d]); /* the first one begins the block */
      break;
    }
  free(points->first);
  free(points);
}

/* Derivatives of order d = degree - q from values S of degree q. */
GX_SPLINE_CORE void derive(const int degree, const int q, const struct gx_spline_knots *knots, size_t piece, const double *S,
                           double *out)
{
  double D[GX_SPLINE_MAX_DEGREE + 1];
  for (int j = 0; j <= q; j++) D[j] = S[j];
#pragma GCC unroll 9
  for (int r = q + 1; r <= degree; r++) gx_spline_basis_differentiate(r, gx_spline_basis_inverse(degree, knots, piece, r), D);
  for (int j = 0; j <= degree; j++) out[j] = D[j];
}

GX_SPLINE_CORE void set(const int degree, struct gx_spline_points *points, const struct gx_spline_knots *knots, const double *x)
{
  const bool periodic = knots->ends == GX_SPLINE_PERIODIC;
  const unsigned orders = points->orders;
  int lowest = 0; /* values of degree - lowest are the last needed */
  while (!(orders >> lowest & 1)) lowest++;
  size_t piece = (size_t)degree;
  for (size_t i = 0; i < points->count; i++) {
    double left[GX_SPLINE_MAX_DEGREE], right[GX_SPLINE_MAX_DEGREE], S[GX_SPLINE_MAX_DEGREE + 1];
    double place = periodic ? gx_spline_basis_reduce(knots, x[i]) : x[i];
    piece = gx_spline_basis_locate(knots, place, piece);
    points->first[i] = piece - (size_t)degree;
    gx_spline_basis_distances(degree, knots->knot, piece, place, left, right);
    S[0] = 1;
#pragma GCC unroll 10
    for (int q = 0; q <= degree; q++) {
      if (q) gx_spline_basis_raise(q, gx_spline_basis_inverse(degree, knots, piece, q), left, right, S);
      if (orders >> (degree - q) & 1) derive(degree, q, knots, piece, S, points->weight[degree - q] + i * (size_t)(degree + 1));
      if (degree - q == lowest) break;
    }
  }
}

void gx_spline_points_set(struct gx_spline_points *points, const struct gx_spline_knots *knots,
                          const double *x){GX_SPLINE_FOR_DEGREE(points->degree, set(degree, points, knots, x))}

GX_SPLINE_CORE void evaluate(const int degree, const struct gx_spline_points *points, const double *restrict weight,
                             const double *restrict coefficient, double *restrict out)
{
  for (size_t i = 0; i < points->count; i++) {
    const double *c = coefficient + points->first[i], *w = weight + i * (size_t)(degree + 1);
    double sum = w[0] * c[0];
    for (int j = 1; j <= degree; j++) sum += w[j] * c[j];
    out[i] = sum;
  }
}

void gx_spline_points_evaluate(const struct gx_spline_points *points, int order, const double *coefficient, double *out){
    GX_SPLINE_FOR_DEGREE(points->degree, evaluate(degree, points, points->weight[order], coefficient, out))}

GX_SPLINE_CORE void evaluate_lanes(const int degree, const struct gx_spline_points *points, const double *weight, size_t splines,
                                   const double *coefficient, double *out)
{
  for (size_t i = 0; i < points->count; i++, weight += degree + 1, out += splines) {
    const double *c = coefficient + points->first[i] * splines;
    gx_spline_four sum[GX_SPLINE_FOURS];
    GX_SPLINE_EACH_FOUR(k) sum[k] = weight[0] * ((const gx_spline_four *)c)[k];
    for (int j = 1; j <= degree; j++)
      GX_SPLINE_EACH_FOUR(k) sum[k] += weight[j] * ((const gx_spline_four *)(c + (size_t)j * splines))[k];
    GX_SPLINE_EACH_FOUR(k)((gx_spline_four *)out)[k] = sum[k];
  }
}

GX_SPLINE_CLONES static void evaluate_sixteen(const struct gx_spline_points *points, const double *weight, size_t splines,
                                              const double *coefficient, double *out)
{
  GX_SPLINE_FOR_DEGREE(points->degree, evaluate_lanes(degree, points, weight, splines, coefficient, out))
}

/* One of many splines. */
static void evaluate_one(const struct gx_spline_points *points, const double *weight, size_t splines, const double *coefficient,
                         double *out)
{
  const size_t row = (size_t)points->degree + 1;
  for (size_t i = 0; i < points->count; i++, weight += row) {
    const double *c = coefficient + points->first[i] * splines;
    double sum = weight[0] * c[0];
    for (size_t j = 1; j < row; j++) sum += weight[j] * c[j * splines];
    out[i * splines] = sum;
  }
}

void gx_spline_points_evaluate_many(const struct gx_spline_points *points, int order, size_t splines, const double *coefficient,
                                    double *out)
{
  const double *weight = points->weight[order];
  size_t s = 0;
  for (; s + GX_SPLINE_LANES <= splines; s += GX_SPLINE_LANES)
    evaluate_sixteen(points, weight, splines, coefficient + s, out + s);
  for (; s < splines; s++) evaluate_one(points, weight, splines, coefficient + s, out + s);
}
