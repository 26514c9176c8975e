/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Knots by hand, and the evaluation loop against gsl_bspline. */
#include <gridcross_splines.h>

#include <gsl/gsl_bspline.h>
#include <string.h>

#include "near.h"
#include "sites.h"

static struct gx_spline_error error;

static struct gx_spline_knots *make(enum gx_spline_ends ends, int degree, size_t sites)
{
  struct gx_spline_knots *knots;
  DONE(gx_spline_knots_create(&knots, ends, degree, sites, &error));
  return knots;
}

static void expect(struct gx_spline_knots *knots, size_t count, const double *knot)
{
  assert_int_equal(count, knots->functions + (size_t)knots->degree + 1);
  for (size_t i = 0; i < count; i++) NEAR(knots->knot[i], knot[i], 1e-15);
  gx_spline_knots_free(knots);
}

/* aptknt of the sites 0 1 3 4 8 16, order 4: inner knots (1 + 3 + 4) / 3 and (3 + 4 + 8) / 3 */
static void open_averages(void **state)
{
  (void)state;
  const double site[] = {0, 1, 3, 4, 8, 16}, knot[] = {0, 0, 0, 0, 8.0 / 3, 5, 16, 16, 16, 16};
  struct gx_spline_knots *knots = make(GX_SPLINE_OPEN, 3, 6);
  DONE(gx_spline_knots_average(knots, site, 0, 0, &error));
  expect(knots, 10, knot);
  const double even[] = {0, 0, 0, 2, 3.5, 6, 16, 16, 16};
  knots = make(GX_SPLINE_OPEN, 2, 6);
  DONE(gx_spline_knots_average(knots, site, 0, 0, &error));
  expect(knots, 9, even);
}

static void uniform(void **state)
{
  (void)state;
  struct gx_spline_knots *knots = make(GX_SPLINE_OPEN, 2, 6);
  DONE(gx_spline_knots_uniform(knots, 1, 3, &error));
  expect(knots, 9, (const double[]){1, 1, 1, 1.5, 2, 2.5, 3, 3, 3});
  /* Uniform periodic sites: knots at sites for odd degree, half-way for even; function i is centred on site i. */
  const double site[] = {0, 1, 2, 3};
  knots = make(GX_SPLINE_PERIODIC, 3, 4);
  DONE(gx_spline_knots_average(knots, site, 0, 4, &error));
  expect(knots, 14, (const double[]){-5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8});
  knots = make(GX_SPLINE_PERIODIC, 2, 4);
  DONE(gx_spline_knots_average(knots, site, 0, 4, &error));
  expect(knots, 11, (const double[]){-3.5, -2.5, -1.5, -0.5, 0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5});
}

/* Knots as given, some of them more than once: the domain lies between the knots number degree and number sites. */
static void given(void **state)
{
  (void)state;
  const double knot[] = {-1, 0, 0.5, 2, 2, 3, 5, 5};
  struct gx_spline_knots *knots = make(GX_SPLINE_OPEN, 2, 5);
  DONE(gx_spline_knots_given(knots, knot, &error));
  NEAR(knots->low, 0.5, 0);
  NEAR(knots->high, 3, 0);
  expect(knots, 8, knot);
}

/* Images of 0.5 2 2.5 at mirrors 0 and 4: ... -2 -0.5 | 0.5 2 2.5 | 5.5 6 ...; of 0 1 4, on the mirrors: -4 -1 | 0 1 4 | 7 8 */
static void mirrors(void **state)
{
  (void)state;
  struct gx_spline_knots *knots = make(GX_SPLINE_EVEN, 1, 3);
  DONE(gx_spline_knots_average(knots, (const double[]){0.5, 2, 2.5}, 0, 4, &error));
  expect(knots, 7, (const double[]){-2, -0.5, 0.5, 2, 2.5, 5.5, 6});
  knots = make(GX_SPLINE_ODD, 1, 3);
  DONE(gx_spline_knots_average(knots, (const double[]){0, 1, 4}, 0, 4, &error));
  expect(knots, 7, (const double[]){-4, -1, 0, 1, 4, 7, 8});
}

static void refuses(enum gx_spline_status expected, long site, const char *words, enum gx_spline_status status)
{
  assert_int_equal(status, expected);
  assert_int_equal(error.status, expected);
  assert_int_equal(error.site, site);
  if (!strstr(error.message, words)) fail_msg("'%s' does not say '%s'", error.message, words);
}

static void refusals(void **state)
{
  (void)state;
  struct gx_spline_knots *k;
  refuses(GX_SPLINE_DEGREE, -1, "degree 0", gx_spline_knots_create(&k, GX_SPLINE_OPEN, 0, 20, &error));
  refuses(GX_SPLINE_DEGREE, -1, "degree 10", gx_spline_knots_create(&k, GX_SPLINE_OPEN, 10, 20, &error));
  refuses(GX_SPLINE_TOO_FEW, -1, "needs 6 sites or more, and has 5", gx_spline_knots_create(&k, GX_SPLINE_ODD, 5, 5, &error));
  assert_null(k);
  k = make(GX_SPLINE_OPEN, 2, 4);
  refuses(GX_SPLINE_NOT_INCREASING, 2, "site 2 at 1 follows one at 1",
          gx_spline_knots_average(k, (const double[]){0, 1, 1, 2}, 0, 0, &error));
  refuses(GX_SPLINE_NOT_INCREASING, 1, "site 1", gx_spline_knots_average(k, (const double[]){0, NAN, 1, 2}, 0, 0, &error));
  refuses(GX_SPLINE_NOT_INCREASING, 0, "finite", gx_spline_knots_average(k, (const double[]){NAN, 0, 1, 2}, 0, 0, &error));
  refuses(GX_SPLINE_NOT_INCREASING, 3, "inf", gx_spline_knots_average(k, (const double[]){0, 1, 2, HUGE_VAL}, 0, 0, &error));
  refuses(GX_SPLINE_NOT_INCREASING, -1, "more than degree + 1 times",
          gx_spline_knots_given(k, (const double[]){0, 0, 0, 0, 1, 1, 1}, &error));
  refuses(GX_SPLINE_NOT_INCREASING, -1, "must not decrease",
          gx_spline_knots_given(k, (const double[]){0, 0, 0, 2, 1.5, 3, 4}, &error));
  refuses(GX_SPLINE_NOT_INCREASING, -1, "finite", gx_spline_knots_given(k, (const double[]){0, 0, 0, 1, 2, 2, INFINITY}, &error));
  refuses(GX_SPLINE_OUTSIDE, -1, "low < high", gx_spline_knots_uniform(k, 1, 1, &error));
  gx_spline_knots_free(k);
  k = make(GX_SPLINE_PERIODIC, 2, 4);
  refuses(GX_SPLINE_OUTSIDE, 3, "period of 3", gx_spline_knots_average(k, (const double[]){0, 1, 2, 3}, 0, 3, &error));
  refuses(GX_SPLINE_OUTSIDE, -1, "open splines only",
          gx_spline_knots_given(k, (const double[]){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, &error));
  refuses(GX_SPLINE_OUTSIDE, -1, "ends 1 and 1", gx_spline_knots_average(k, (const double[]){0, 1, 2, 3}, 1, 1, &error));
  gx_spline_knots_free(k);
  k = make(GX_SPLINE_EVEN, 2, 4);
  refuses(GX_SPLINE_OUTSIDE, 0, "site 0 at 0 lies outside the ends 0.5 and 4",
          gx_spline_knots_average(k, (const double[]){0, 1, 2, 3}, 0.5, 4, &error));
  refuses(GX_SPLINE_OUTSIDE, 3, "site 3 at 3", gx_spline_knots_average(k, (const double[]){0, 1, 2, 3}, 0, 2.5, &error));
  gx_spline_knots_free(k);
  struct gx_spline_points *points;
  refuses(GX_SPLINE_DEGREE, -1, "degree 3", gx_spline_points_create(&points, 3, 1U << 4, 5, &error));
  refuses(GX_SPLINE_DEGREE, -1, "degree 3", gx_spline_points_create(&points, 3, 0, 5, &error));
  for (int s = 0; s < GX_SPLINE_STATUSES; s++) assert_non_null(gx_spline_error_name((enum gx_spline_status)s));
}

/* Every order of derivative at random points, at knots and at both ends; to 1e-13 of the largest of its order. */
static void against_gsl(const struct gx_spline_knots *knots, size_t count, const double *x)
{
  const size_t p = (size_t)knots->degree;
  gsl_bspline_workspace *w = gsl_bspline_alloc(p + 1, knots->sites - p + 1);
  assert_int_equal(w->knots->size, knots->sites + p + 1);
  for (size_t i = 0; i < w->knots->size; i++) gsl_vector_set(w->knots, i, knots->knot[i]);
  gsl_matrix *dB = gsl_matrix_alloc(p + 1, p + 1);
  struct gx_spline_points *points;
  DONE(gx_spline_points_create(&points, (int)p, (2U << p) - 1, count, &error));
  gx_spline_points_set(points, knots, x);
  for (size_t i = 0; i < count; i++) {
    size_t first, last;
    gsl_bspline_deriv_eval_nonzero(x[i], p, dB, &first, &last, w);
    assert_int_equal(points->first[i], first);
    for (size_t d = 0; d <= p; d++) {
      double largest = 0;
      for (size_t j = 0; j <= p; j++) largest = fmax(largest, fabs(gsl_matrix_get(dB, j, d)));
      for (size_t j = 0; j <= p; j++)
        NEAR(points->weight[d][i * (p + 1) + j], gsl_matrix_get(dB, j, d), 1e-13 * fmax(largest, 1));
    }
  }
  gx_spline_points_free(points);
  gsl_matrix_free(dB);
  gsl_bspline_free(w);
}

static void evaluation(void **unused)
{
  (void)unused;
  enum { SITES = 25, POINTS = 200 };
  uint64_t state = 7;
  for (int degree = 1; degree <= 9; degree++) {
    double site[SITES], x[POINTS];
    jittered_sites(SITES, -1, 2, 0.9, &state, site);
    struct gx_spline_knots *knots = make(GX_SPLINE_OPEN, degree, SITES);
    DONE(gx_spline_knots_average(knots, site, 0, 0, &error));
    for (size_t i = 0; i < POINTS; i++) x[i] = site[0] + (site[SITES - 1] - site[0]) * random_number(&state);
    x[1] = site[0];
    x[2] = site[SITES - 1];
    x[3] = knots->knot[degree + 1];
    against_gsl(knots, POINTS, x);
    DONE(gx_spline_knots_uniform(knots, site[0], site[SITES - 1], &error));
    against_gsl(knots, POINTS, x);
    gx_spline_knots_free(knots);
  }
}

/* Orders asked for one by one are those of all at once. */
static void orders_apart(void **unused)
{
  (void)unused;
  struct gx_spline_knots *knots = make(GX_SPLINE_OPEN, 5, 20);
  DONE(gx_spline_knots_uniform(knots, 0, 1, &error));
  const double x[] = {0.3, 0.9, 0.05, 1.1, -0.2};
  struct gx_spline_points *all, *one;
  DONE(gx_spline_points_create(&all, 5, 63, 5, &error));
  gx_spline_points_set(all, knots, x);
  for (int d = 0; d <= 5; d++) {
    DONE(gx_spline_points_create(&one, 5, 1U << d, 5, &error));
    gx_spline_points_set(one, knots, x);
    assert_memory_equal(one->weight[d], all->weight[d], 30 * sizeof(double));
    gx_spline_points_free(one);
  }
  gx_spline_points_free(all);
  gx_spline_knots_free(knots);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(open_averages), cmocka_unit_test(uniform),    cmocka_unit_test(given),        cmocka_unit_test(mirrors),
      cmocka_unit_test(refusals),      cmocka_unit_test(evaluation), cmocka_unit_test(orders_apart),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
