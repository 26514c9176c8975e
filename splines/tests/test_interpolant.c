/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Open interpolation: polynomials, orders, refusals, the factors against GSL's pivoting ones, condition numbers. */
#include <gridcross_splines.h>

#include <gsl/gsl_linalg.h>
#include <string.h>

#include "near.h"
#include "sites.h"

enum { MOST = 2000 };

static struct gx_spline_error error;

static struct gx_spline_interpolant *make(enum gx_spline_ends ends, int degree, size_t n)
{
  struct gx_spline_interpolant *s;
  DONE(gx_spline_interpolant_create(&s, ends, degree, n, &error));
  return s;
}

/* Derivative of order d of the interpolant at count points. */
static void sample(const struct gx_spline_interpolant *s, const double *coefficient, int d, size_t count, const double *x,
                   double *out)
{
  struct gx_spline_points *points;
  DONE(gx_spline_points_create(&points, s->knots->degree, 1U << d, count, &error));
  gx_spline_points_set(points, s->knots, x);
  gx_spline_points_evaluate(points, d, coefficient, out);
  gx_spline_points_free(points);
}

/* (2x - 1)^power and its derivatives: every polynomial of degree <= p to 1e-12 at random sites, derivatives to what rounding of
 * the values leaves of them. Beyond the sites too, where the end pieces go on. */
static void polynomials(void **unused)
{
  (void)unused;
  enum { SITES = 30, POINTS = 101 };
  uint64_t state = 3;
  for (int degree = 1; degree <= 9; degree++) {
    struct gx_spline_interpolant *s = make(GX_SPLINE_OPEN, degree, SITES);
    for (int power = 0; power <= degree; power++) {
      double site[SITES], value[SITES], c[SITES], x[POINTS], out[POINTS];
      jittered_sites(SITES, 0, 1, 0.9, &state, site);
      for (size_t i = 0; i < SITES; i++) value[i] = pow(2 * site[i] - 1, power);
      for (size_t i = 0; i < POINTS; i++) x[i] = site[0] + (site[SITES - 1] - site[0]) * (double)i / (POINTS - 1);
      DONE(gx_spline_interpolant_set_sites(s, site, 0, 0, &error));
      gx_spline_interpolant_solve(s, value, c);
      sample(s, c, 0, POINTS, x, out);
      for (size_t i = 0; i < POINTS; i++) NEAR(out[i], pow(2 * x[i] - 1, power), 1e-12);
      sample(s, c, 1, POINTS, x, out);
      for (size_t i = 0; i < POINTS; i++) NEAR(out[i], power ? 2 * power * pow(2 * x[i] - 1, power - 1) : 0, 1e-9);
      const double beyond[] = {site[0] - 0.01, site[SITES - 1] + 0.01};
      sample(s, c, 0, 2, beyond, out);
      for (size_t i = 0; i < 2; i++) NEAR(out[i], pow(2 * beyond[i] - 1, power), 1e-10);
    }
    gx_spline_interpolant_free(s);
  }
}

/* Largest errors of value and two derivatives for exp(-x) sin(w x), sites graded smoothly from 0 to 1. */
static void errors(int degree, size_t n, double w, double error_of[3])
{
  struct gx_spline_interpolant *s = make(GX_SPLINE_OPEN, degree, n);
  double site[MOST], value[MOST], c[MOST], x[MOST], out[MOST];
  for (size_t i = 0; i < n; i++) {
    double z = (double)i / (double)(n - 1);
    site[i] = z + 0.05 * sin(2 * M_PI * z);
    value[i] = exp(-site[i]) * sin(w * site[i]);
  }
  for (size_t i = 0; i < MOST; i++) x[i] = (double)i / (MOST - 1);
  DONE(gx_spline_interpolant_set_sites(s, site, 0, 0, &error));
  gx_spline_interpolant_solve(s, value, c);
  for (int d = 0; d < 3; d++) {
    error_of[d] = 0;
    if (d > degree) continue;
    sample(s, c, d, MOST, x, out);
    for (size_t i = 0; i < MOST; i++) {
      double e = exp(-x[i]), sine = sin(w * x[i]), cosine = cos(w * x[i]);
      double exact = d == 0 ? e * sine : d == 1 ? e * (w * cosine - sine) : e * ((1 - w * w) * sine - 2 * w * cosine);
      error_of[d] = fmax(error_of[d], fabs(out[i] - exact));
    }
  }
  gx_spline_interpolant_free(s);
}

static void orders(void **unused)
{
  (void)unused;
  /* Fine enough for the leading term of the error, coarse enough to see it above rounding. */
  for (int degree = 1; degree <= 9; degree++) {
    const double w = degree < 9 ? 6 : 14;
    const size_t n = degree < 9 ? 480 / (size_t)degree : 100;
    double coarse[3], fine[3];
    errors(degree, n, w, coarse);
    errors(degree, 2 * n, w, fine);
    for (int d = 0; d < 3 && d < degree; d++) {
      double order = log(coarse[d] / fine[d]) / log((double)(2 * n - 1) / (double)(n - 1));
      printf("degree %d, derivative %d: error %.2e, order %.2f\n", degree, d, fine[d], order);
      if (!(order > degree + 1 - d - 0.25))
        fail_msg("degree %d, derivative %d: order %g, due %d", degree, d, order, degree + 1 - d);
    }
  }
}

static void refuses(enum gx_spline_status expected, long site, const char *words, enum gx_spline_status status)
{
  assert_int_equal(status, expected);
  assert_int_equal(error.site, site);
  if (!strstr(error.message, words)) fail_msg("'%s' does not say '%s'", error.message, words);
}

static void refusals(void **unused)
{
  (void)unused;
  struct gx_spline_interpolant *s;
  refuses(GX_SPLINE_TOO_FEW, -1, "needs 4 sites", gx_spline_interpolant_create(&s, GX_SPLINE_OPEN, 3, 3, &error));
  s = make(GX_SPLINE_OPEN, 3, 8);
  DONE(gx_spline_knots_uniform(s->knots, 0, 1, &error));
  /* Function 5 begins at knot 0.4. */
  refuses(GX_SPLINE_SCHOENBERG_WHITNEY, 5, "site 5 at 0.39",
          gx_spline_interpolant_collocate(s, (const double[]){0, 0.1, 0.2, 0.3, 0.35, 0.39, 0.9, 1}, &error));
  /* Function 1 ends at knot 0.4, and vanishes there. */
  refuses(GX_SPLINE_SCHOENBERG_WHITNEY, 1, "between knots 0 and 0.4",
          gx_spline_interpolant_collocate(s, (const double[]){0, s->knots->knot[5], 0.5, 0.6, 0.7, 0.8, 0.9, 1}, &error));
  refuses(GX_SPLINE_SCHOENBERG_WHITNEY, 0, "site 0",
          gx_spline_interpolant_collocate(s, (const double[]){0.21, 0.3, 0.35, 0.5, 0.7, 0.8, 0.9, 1}, &error));
  refuses(GX_SPLINE_NOT_INCREASING, 3, "site 3 at 0.2",
          gx_spline_interpolant_collocate(s, (const double[]){0, 0.1, 0.2, 0.2, 0.7, 0.8, 0.9, 1}, &error));
  refuses(GX_SPLINE_OUTSIDE, 7, "reach beyond",
          gx_spline_interpolant_collocate(s, (const double[]){0, 0.1, 0.2, 0.3, 0.7, 0.8, 0.9, 1.1}, &error));
  refuses(GX_SPLINE_OUTSIDE, 0, "reach beyond",
          gx_spline_interpolant_collocate(s, (const double[]){-0.1, 0.1, 0.2, 0.3, 0.7, 0.8, 0.9, 1}, &error));
  refuses(GX_SPLINE_SINGULAR, 1, "singular to rounding at site 1",
          gx_spline_interpolant_collocate(s, (const double[]){0, 1e-17, 0.2, 0.3, 0.6, 0.7, 0.9, 1}, &error));
  DONE(gx_spline_interpolant_collocate(s, (const double[]){0, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 1}, &error));
  gx_spline_interpolant_free(s);
}

/* The collocation matrix as dense, from weights at the sites; solved by GSL with pivoting. */
static gsl_matrix *collocation(const struct gx_spline_interpolant *s, const double *site)
{
  const size_t n = s->knots->sites, k = (size_t)s->knots->degree + 1;
  gsl_matrix *A = gsl_matrix_calloc(n, n);
  struct gx_spline_points *points;
  DONE(gx_spline_points_create(&points, s->knots->degree, 1, n, &error));
  gx_spline_points_set(points, s->knots, site);
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < k; j++) {
      /* coefficient number first + j is that of site `column` with a sign */
      ptrdiff_t column = (ptrdiff_t)(points->first[i] + j) - (ptrdiff_t)s->knots->ghosts, rows = (ptrdiff_t)n;
      double sign = 1;
      if (s->knots->ends == GX_SPLINE_PERIODIC) column = (column + rows) % rows;
      if ((column < 0 || column >= rows) && s->knots->ends == GX_SPLINE_ODD) sign = -1;
      if (column < 0) column = -1 - column;
      if (column >= rows) column = 2 * rows - 1 - column;
      *gsl_matrix_ptr(A, i, (size_t)column) += sign * points->weight[0][i * k + j];
    }
  gx_spline_points_free(points);
  return A;
}

/* Against the pivoting LU and the explicit inverse, for all ends, at sites far from uniform. */
static void factors(void **unused)
{
  (void)unused;
  enum { SITES = 24 };
  uint64_t state = 5;
  for (int ends = GX_SPLINE_OPEN; ends <= GX_SPLINE_ODD; ends++)
    for (int degree = 1; degree <= 9; degree++) {
      struct gx_spline_interpolant *s = make((enum gx_spline_ends)ends, degree, SITES);
      double site[SITES], value[SITES], c[SITES + 2 * GX_SPLINE_MAX_DEGREE], norm = 0, own_norm = 0;
      jittered_sites(SITES, 0, 1, 0.95, &state, site);
      for (size_t i = 0; i < SITES; i++) value[i] = 2 * random_number(&state) - 1;
      DONE(gx_spline_interpolant_set_sites(s, site, 0, 1, &error));
      gx_spline_interpolant_solve(s, value, c);
      gsl_matrix *A = collocation(s, site), *inverse = gsl_matrix_alloc(SITES, SITES);
      gsl_permutation *order = gsl_permutation_alloc(SITES);
      int sign;
      for (size_t i = 0; i < SITES; i++) {
        double sum = 0;
        for (size_t j = 0; j < SITES; j++) sum += fabs(gsl_matrix_get(A, i, j));
        own_norm = fmax(own_norm, sum);
      }
      gsl_linalg_LU_decomp(A, order, &sign);
      gsl_linalg_LU_invert(A, order, inverse);
      for (size_t i = 0; i < SITES; i++) {
        double x = 0, sum = 0;
        for (size_t j = 0; j < SITES; j++) {
          x += gsl_matrix_get(inverse, i, j) * value[j];
          sum += fabs(gsl_matrix_get(inverse, i, j));
        }
        norm = fmax(norm, sum);
        NEAR(c[s->knots->ghosts + i], x, 1e-12 * fmax(norm, 1));
      }
      NEAR(own_norm, 1, 1e-14);
      NEAR(gx_spline_interpolant_condition(s) / norm, 1, 1e-9);
      gsl_permutation_free(order);
      gsl_matrix_free(A);
      gsl_matrix_free(inverse);
      gx_spline_interpolant_free(s);
    }
}

/* Many at once are the same numbers as one by one. */
static void many(void **unused)
{
  (void)unused;
  enum { SITES = 20, COUNT = 3 };
  uint64_t state = 11;
  for (int ends = GX_SPLINE_OPEN; ends <= GX_SPLINE_ODD; ends++) {
    struct gx_spline_interpolant *s = make((enum gx_spline_ends)ends, 5, SITES);
    const size_t functions = s->knots->functions;
    double site[SITES], all[SITES * COUNT], together[COUNT * (SITES + 18)];
    jittered_sites(SITES, 0, 1, 0.9, &state, site);
    for (size_t i = 0; i < SITES * COUNT; i++) all[i] = random_number(&state);
    DONE(gx_spline_interpolant_set_sites(s, site, 0, 1, &error));
    gx_spline_interpolant_solve_many(s, COUNT, all, together);
    for (size_t r = 0; r < COUNT; r++) {
      double value[SITES], c[SITES + 18];
      for (size_t i = 0; i < SITES; i++) value[i] = all[i * COUNT + r];
      gx_spline_interpolant_solve(s, value, c);
      for (size_t i = 0; i < functions; i++) NEAR(together[i * COUNT + r], c[i], 1e-12);
    }
    gx_spline_interpolant_free(s);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(polynomials), cmocka_unit_test(orders), cmocka_unit_test(refusals),
      cmocka_unit_test(factors),     cmocka_unit_test(many),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
