/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Product grids: one-dimensional solves and products, direction by direction. */
#include <gridcross_splines.h>

#include <stdlib.h>
#include <string.h>

struct gx_spline_tensor {
  int dim;
  const struct gx_spline_interpolant *interpolant[GX_SPLINE_MAX_DIM]; /* borrowed */
  const struct gx_spline_points *points[GX_SPLINE_MAX_DIM];           /* borrowed */
  double *work[2];                                                    /* room for what lies between two directions, owned */
};

static size_t larger(size_t a, size_t b)
{
  return a > b ? a : b;
}

enum gx_spline_status gx_spline_tensor_create(struct gx_spline_tensor **tensor, int dim,
                                              const struct gx_spline_interpolant *const *interpolant,
                                              const struct gx_spline_points *const *points, struct gx_spline_error *error)
{
  *tensor = NULL;
  if (dim < 1 || dim > GX_SPLINE_MAX_DIM)
    return gx_spline_error_set(error, GX_SPLINE_DEGREE, -1, "a product of %d directions", dim);
  size_t room = 1;
  for (int d = 0; d < dim; d++) {
    if (interpolant[d]->knots->degree != points[d]->degree)
      return gx_spline_error_set(error, GX_SPLINE_DEGREE, -1, "direction %d: points of degree %d, interpolant of degree %d", d,
                                 points[d]->degree, interpolant[d]->knots->degree);
    room *= larger(interpolant[d]->knots->functions, points[d]->count); /* functions are never fewer than sites */
  }
  struct gx_spline_tensor *t = calloc(1, sizeof *t);
  double *work = calloc(2 * room, sizeof *work);
  if (!t || !work) {
    free(t);
    free(work);
    return gx_spline_error_set(error, GX_SPLINE_MEMORY, -1, "out of memory for a product of splines");
  }
  t->dim = dim;
  t->work[0] = work;
  t->work[1] = work + room;
  for (int d = 0; d < dim; d++) {
    t->interpolant[d] = interpolant[d];
    t->points[d] = points[d];
  }
  *tensor = t;
  return GX_SPLINE_OK;
}

void gx_spline_tensor_free(struct gx_spline_tensor *tensor)
{
  if (!tensor) return;
  free(tensor->work[0]);
  free(tensor);
}

size_t gx_spline_tensor_coefficients(const struct gx_spline_tensor *tensor)
{
  size_t count = 1;
  for (int d = 0; d < tensor->dim; d++) count *= tensor->interpolant[d]->knots->functions;
  return count;
}

/* Directions below d hold coefficients already, those above still values. */
void gx_spline_tensor_solve(struct gx_spline_tensor *tensor, const double *value, double *coefficient)
{
  const double *from = value;
  size_t before = 1;
  for (int d = 0; d < tensor->dim; d++) {
    const struct gx_spline_interpolant *s = tensor->interpolant[d];
    size_t after = 1;
    for (int e = d + 1; e < tensor->dim; e++) after *= tensor->interpolant[e]->knots->sites;
    double *to = d == tensor->dim - 1 ? coefficient : tensor->work[d % 2];
    for (size_t line = 0; line < before; line++) {
      const double *in = from + line * s->knots->sites * after;
      double *out = to + line * s->knots->functions * after;
      if (after == 1)
        gx_spline_interpolant_solve(s, in, out);
      else
        gx_spline_interpolant_solve_many(s, after, in, out);
    }
    before *= s->knots->functions;
    from = to;
  }
}

void gx_spline_tensor_evaluate(struct gx_spline_tensor *tensor, const int *order, const double *coefficient, double *out)
{
  const double *from = coefficient;
  size_t before = 1;
  for (int d = 0; d < tensor->dim; d++) {
    const struct gx_spline_points *points = tensor->points[d];
    const size_t functions = tensor->interpolant[d]->knots->functions;
    size_t after = 1;
    for (int e = d + 1; e < tensor->dim; e++) after *= tensor->interpolant[e]->knots->functions;
    double *to = d == tensor->dim - 1 ? out : tensor->work[d % 2];
    for (size_t line = 0; line < before; line++) {
      const double *in = from + line * functions * after;
      double *sum = to + line * points->count * after;
      if (after == 1)
        gx_spline_points_evaluate(points, order[d], in, sum);
      else
        gx_spline_points_evaluate_many(points, order[d], after, in, sum);
    }
    before *= points->count;
    from = to;
  }
}
