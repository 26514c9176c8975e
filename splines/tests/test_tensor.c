/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Product grids: products of polynomials, and every mix of derivatives, in one to three dimensions. */
#include <gridcross_splines.h>

#include "near.h"
#include "sites.h"

static struct gx_spline_error error;

/* One direction: x^3 - x / 2, even: cos(pi x), odd: sin(pi x), periodic: 2 + sin(2 pi x). */
static double function(enum gx_spline_ends ends, int order, double x)
{
  switch (ends) {
  case GX_SPLINE_OPEN:
    return order ? 3 * x * x - 0.5 : x * x * x - x / 2;
  case GX_SPLINE_PERIODIC:
    return order ? 2 * M_PI * cos(2 * M_PI * x) : 2 + sin(2 * M_PI * x);
  case GX_SPLINE_EVEN:
    return order ? -M_PI * sin(M_PI * x) : cos(M_PI * x);
  default:
    return order ? M_PI * cos(M_PI * x) : sin(M_PI * x);
  }
}

enum { ROOM = 24 };

static const size_t SITES[] = {20, 16, 18}, POINTS[] = {5, 19, 4};

/* Product of the three one-dimensional functions at index i of a grid. */
static double product(int dim, const enum gx_spline_ends *ends, const int *order, const size_t *shape, double (*x)[ROOM],
                      size_t i)
{
  double value = 1;
  for (int d = dim - 1; d >= 0; d--) {
    value *= function(ends[d], order ? order[d] : 0, x[d][i % shape[d]]);
    i /= shape[d];
  }
  return value;
}

static size_t total(int dim, const size_t *shape)
{
  size_t count = 1;
  for (int d = 0; d < dim; d++) count *= shape[d];
  return count;
}

static void grid(int dim, const enum gx_spline_ends *ends, const int *degree, const double *tolerance)
{
  uint64_t state = 17;
  struct gx_spline_interpolant *s[3] = {0};
  struct gx_spline_points *points[3] = {0};
  double site[3][ROOM], x[3][ROOM];
  for (int d = 0; d < dim; d++) {
    jittered_sites(SITES[d], 0, 1, 0.2, &state, site[d]);
    for (size_t i = 0; i < POINTS[d]; i++) x[d][i] = 0.05 + 0.9 * random_number(&state);
    DONE(gx_spline_interpolant_create(&s[d], ends[d], degree[d], SITES[d], &error));
    DONE(gx_spline_interpolant_set_sites(s[d], site[d], 0, 1, &error));
    DONE(gx_spline_points_create(&points[d], degree[d], 3, POINTS[d], &error));
    gx_spline_points_set(points[d], s[d]->knots, x[d]);
  }
  struct gx_spline_tensor *tensor;
  DONE(gx_spline_tensor_create(&tensor, dim, (const struct gx_spline_interpolant *const *)s,
                               (const struct gx_spline_points *const *)points, &error));
  const size_t sites = total(dim, SITES), count = total(dim, POINTS);
  double *value = calloc(sites, sizeof *value), *out = calloc(count, sizeof *out);
  double *coefficient = calloc(gx_spline_tensor_coefficients(tensor), sizeof *coefficient);
  for (size_t i = 0; i < sites; i++) value[i] = product(dim, ends, NULL, SITES, site, i);
  gx_spline_tensor_solve(tensor, value, coefficient);
  for (int mix = 0; mix < 1 << dim; mix++) {
    const int order[] = {mix & 1, mix >> 1 & 1, mix >> 2};
    gx_spline_tensor_evaluate(tensor, order, coefficient, out);
    for (size_t i = 0; i < count; i++)
      NEAR(out[i], product(dim, ends, order, POINTS, x, i), tolerance[order[0] + order[1] + order[2]]);
  }
  gx_spline_tensor_free(tensor);
  for (int d = 0; d < dim; d++) {
    gx_spline_interpolant_free(s[d]);
    gx_spline_points_free(points[d]);
  }
  free(value);
  free(out);
  free(coefficient);
}

static void grids(void **unused)
{
  (void)unused;
  const enum gx_spline_ends open[] = {GX_SPLINE_OPEN, GX_SPLINE_OPEN, GX_SPLINE_OPEN};
  const enum gx_spline_ends mixed[] = {GX_SPLINE_EVEN, GX_SPLINE_PERIODIC, GX_SPLINE_ODD};
  for (int dim = 1; dim <= 3; dim++) {
    grid(dim, open, (const int[]){3, 5, 4}, (const double[]){1e-13, 1e-11, 1e-10, 1e-9});
    grid(dim, mixed, (const int[]){9, 9, 9}, (const double[]){2e-7, 2e-5, 2e-4, 1e-3});
  }
}

static void refusals(void **unused)
{
  (void)unused;
  struct gx_spline_interpolant *s;
  struct gx_spline_points *points;
  struct gx_spline_tensor *tensor;
  DONE(gx_spline_interpolant_create(&s, GX_SPLINE_OPEN, 3, 10, &error));
  DONE(gx_spline_points_create(&points, 5, 1, 4, &error));
  assert_int_equal(gx_spline_tensor_create(&tensor, 1, (const struct gx_spline_interpolant *const[]){s},
                                           (const struct gx_spline_points *const[]){points}, &error),
                   GX_SPLINE_DEGREE);
  assert_int_equal(gx_spline_tensor_create(&tensor, 4, NULL, NULL, &error), GX_SPLINE_DEGREE);
  gx_spline_interpolant_free(s);
  gx_spline_points_free(points);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(grids), cmocka_unit_test(refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
