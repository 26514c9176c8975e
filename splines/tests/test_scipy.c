/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interpolants of random values against SciPy's, values and two derivatives. usage: test_scipy scipy_reference.txt */
#include <gridcross_splines.h>

#include <string.h>

#include "near.h"

enum { MOST = 64, CASES = 12 };

static struct gx_spline_error error;
static const char *reference;

static void row(FILE *file, size_t count, double *number)
{
  assert_in_range(count, 1, MOST);
  for (size_t i = 0; i < count; i++) assert_int_equal(fscanf(file, "%lf", number + i), 1);
}

static void same(const struct gx_spline_points *points, const double *coefficient, double expected[3][MOST])
{
  for (int d = 0; d <= 2; d++) {
    double out[MOST], largest = 1;
    for (size_t i = 0; i < points->count; i++) largest = fmax(largest, fabs(expected[d][i]));
    gx_spline_points_evaluate(points, d, coefficient, out);
    for (size_t i = 0; i < points->count; i++) NEAR(out[i], expected[d][i], 1e-12 * largest);
  }
}

static void compare(FILE *file, enum gx_spline_ends ends, int degree, size_t sites, size_t count, double period)
{
  double x[MOST], y[MOST], at[MOST], expected[3][MOST], coefficient[MOST];
  row(file, sites, x);
  row(file, sites, y);
  row(file, count, at);
  for (int d = 0; d < 3; d++) row(file, count, expected[d]);
  struct gx_spline_interpolant *s;
  struct gx_spline_points *points;
  DONE(gx_spline_interpolant_create(&s, ends, degree, sites, &error));
  DONE(gx_spline_interpolant_set_sites(s, x, 0, period, &error));
  DONE(gx_spline_points_create(&points, degree, 7, count, &error));
  gx_spline_points_set(points, s->knots, at);
  gx_spline_interpolant_solve(s, y, coefficient);
  same(points, coefficient, expected);
  if (ends == GX_SPLINE_PERIODIC) {
    struct gx_spline_circulant *c;
    DONE(gx_spline_circulant_create(&c, degree, sites, period, &error));
    gx_spline_circulant_solve(c, y, coefficient);
    same(points, coefficient, expected);
    gx_spline_circulant_free(c);
  }
  gx_spline_points_free(points);
  gx_spline_interpolant_free(s);
}

static void scipy(void **state)
{
  (void)state;
  FILE *file = fopen(reference, "r");
  assert_non_null(file);
  char ends[16];
  int degree, cases = 0;
  size_t sites, count;
  double period;
  while (fscanf(file, "%15s %d %zu %zu %lf", ends, &degree, &sites, &count, &period) == 5) {
    compare(file, strcmp(ends, "open") ? GX_SPLINE_PERIODIC : GX_SPLINE_OPEN, degree, sites, count, period);
    cases++;
  }
  fclose(file);
  assert_int_equal(cases, CASES);
}

int main(int count, char **argument)
{
  if (count != 2) return 2;
  reference = argument[1];
  const struct CMUnitTest tests[] = {cmocka_unit_test(scipy)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
