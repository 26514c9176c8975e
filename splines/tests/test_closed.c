/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Periodic and mirrored splines. */
#include <gridcross_splines.h>

#include <string.h>

#include "near.h"
#include "sites.h"

enum { MOST = 400 };

static struct gx_spline_error error;

static struct gx_spline_interpolant *make(enum gx_spline_ends ends, int degree, size_t n, const double *site, double low,
                                          double high)
{
  struct gx_spline_interpolant *s;
  DONE(gx_spline_interpolant_create(&s, ends, degree, n, &error));
  DONE(gx_spline_interpolant_set_sites(s, site, low, high, &error));
  return s;
}

static void sample(const struct gx_spline_knots *knots, const double *coefficient, int d, size_t count, const double *x,
                   double *out)
{
  struct gx_spline_points *points;
  DONE(gx_spline_points_create(&points, knots->degree, 1U << d, count, &error));
  gx_spline_points_set(points, knots, x);
  gx_spline_points_evaluate(points, d, coefficient, out);
  gx_spline_points_free(points);
}

/* One period against an open spline through five of the same values; in the middle the ends are forgotten. */
static void periodic_equals_open(void **unused)
{
  (void)unused;
  enum { SITES = 48, PERIODS = 5, POINTS = 64 };
  uint64_t state = 21;
  for (int degree = 1; degree <= 9; degree++) {
    double site[SITES], value[SITES], c[SITES + 18], x[POINTS], out[POINTS];
    double long_site[SITES * PERIODS], long_value[SITES * PERIODS], long_c[SITES * PERIODS], expected[POINTS];
    jittered_sites(SITES, 0.3, 1.3, 0.8, &state, site);
    for (size_t i = 0; i < SITES; i++) value[i] = random_number(&state);
    for (size_t i = 0; i < SITES * PERIODS; i++) {
      long_site[i] = site[i % SITES] + (double)(i / SITES) - 2;
      long_value[i] = value[i % SITES];
    }
    for (size_t i = 0; i < POINTS; i++) x[i] = 0.3 + random_number(&state);
    struct gx_spline_interpolant *ring = make(GX_SPLINE_PERIODIC, degree, SITES, site, 0, 1);
    struct gx_spline_interpolant *open = make(GX_SPLINE_OPEN, degree, SITES * PERIODS, long_site, 0, 0);
    gx_spline_interpolant_solve(ring, value, c);
    gx_spline_interpolant_solve(open, long_value, long_c);
    for (int d = 0; d <= degree && d <= 2; d++) {
      sample(open->knots, long_c, d, POINTS, x, expected);
      sample(ring->knots, c, d, POINTS, x, out);
      double largest = 1;
      for (size_t i = 0; i < POINTS; i++) largest = fmax(largest, fabs(expected[i]));
      for (size_t i = 0; i < POINTS; i++) NEAR(out[i], expected[i], 1e-11 * largest);
      for (size_t i = 0; i < POINTS; i++) x[i] += i % 2 ? 3 : -2;
      sample(ring->knots, c, d, POINTS, x, out);
      for (size_t i = 0; i < POINTS; i++) NEAR(out[i], expected[i], 1e-11 * largest);
      for (size_t i = 0; i < POINTS; i++) x[i] -= i % 2 ? 3 : -2;
    }
    gx_spline_interpolant_free(ring);
    gx_spline_interpolant_free(open);
  }
}

static double periodic_error(int degree, size_t n, int d)
{
  double site[MOST], value[MOST], c[MOST + 18], x[MOST], out[MOST], largest = 0;
  for (size_t i = 0; i < n; i++) {
    double z = (double)i / (double)n;
    site[i] = z + 0.04 * cos(2 * M_PI * z);
    value[i] = exp(sin(2 * M_PI * site[i]));
  }
  for (size_t i = 0; i < MOST; i++) x[i] = (double)i / MOST;
  struct gx_spline_interpolant *s = make(GX_SPLINE_PERIODIC, degree, n, site, 0, 1);
  gx_spline_interpolant_solve(s, value, c);
  sample(s->knots, c, d, MOST, x, out);
  for (size_t i = 0; i < MOST; i++) {
    double e = exp(sin(2 * M_PI * x[i])), slope = 2 * M_PI * cos(2 * M_PI * x[i]);
    double exact = d == 0 ? e : d == 1 ? e * slope : e * (slope * slope - 4 * M_PI * M_PI * sin(2 * M_PI * x[i]));
    largest = fmax(largest, fabs(out[i] - exact));
  }
  gx_spline_interpolant_free(s);
  return largest;
}

static void periodic_orders(void **unused)
{
  (void)unused;
  for (int degree = 1; degree <= 9; degree++)
    for (int d = 0; d < 3 && d < degree; d++) {
      size_t n = degree < 6 ? 40 : 25;
      double coarse = periodic_error(degree, n, d), fine = periodic_error(degree, 2 * n, d), order = log2(coarse / fine);
      printf("degree %d, derivative %d: error %.2e, order %.2f\n", degree, d, fine, order);
      if (!(order > degree + 1 - d - 0.25))
        fail_msg("degree %d, derivative %d: order %g, due %d", degree, d, order, degree + 1 - d);
    }
}

/* The least number of sites, where a function meets its own images; a constant and the values themselves come back. */
static void smallest_rings(void **unused)
{
  (void)unused;
  uint64_t state = 8;
  for (int degree = 1; degree <= 9; degree++)
    for (size_t n = (size_t)degree + 1; n < 2 * (size_t)degree + 3; n++)
      for (int ends = GX_SPLINE_PERIODIC; ends <= GX_SPLINE_ODD; ends++) {
        double site[32], value[32], c[64], out[32];
        jittered_sites(n, -1, 1, 0.3, &state, site);
        for (size_t i = 0; i < n; i++) value[i] = random_number(&state);
        struct gx_spline_interpolant *s = make((enum gx_spline_ends)ends, degree, n, site, -1, 1);
        gx_spline_interpolant_solve(s, value, c);
        sample(s->knots, c, 0, n, site, out);
        for (size_t i = 0; i < n; i++) NEAR(out[i], value[i], 1e-10);
        gx_spline_interpolant_free(s);
      }
}

/* The spline of period 2 through values mirrored by hand. on[e]: a site lies on end e, and is not doubled. */
static void mirror(int degree, double parity, const bool on[2], uint64_t *state)
{
  enum { SITES = 22, POINTS = 50 };
  double site[SITES], value[SITES], c[SITES + 18], x[POINTS], out[POINTS], expected[POINTS];
  double whole_site[2 * SITES], whole_value[2 * SITES], whole_c[2 * SITES + 18];
  jittered_sites(SITES, 0, 1, 0.8, state, site);
  for (size_t i = 0; i < SITES; i++) value[i] = random_number(state);
  if (on[0]) site[0] = 0;
  if (on[1]) site[SITES - 1] = 1;
  if (on[0] && parity < 0) value[0] = 0;
  if (on[1] && parity < 0) value[SITES - 1] = 0;
  size_t n = 0;
  for (size_t i = SITES - 1; i >= (on[0] ? 1U : 0U) && i < SITES; i--) {
    if (on[1] && i == SITES - 1) continue; /* -1 is 1, a period on */
    whole_site[n] = -site[i];
    whole_value[n++] = parity * value[i];
  }
  for (size_t i = 0; i < SITES; i++) {
    whole_site[n] = site[i];
    whole_value[n++] = value[i];
  }
  struct gx_spline_interpolant *half = make(parity < 0 ? GX_SPLINE_ODD : GX_SPLINE_EVEN, degree, SITES, site, 0, 1);
  struct gx_spline_interpolant *whole = make(GX_SPLINE_PERIODIC, degree, n, whole_site, -1, 1);
  gx_spline_interpolant_solve(half, value, c);
  gx_spline_interpolant_solve(whole, whole_value, whole_c);
  for (size_t i = 0; i < POINTS; i++) x[i] = i < 2 ? (double)i : random_number(state);
  for (int d = 0; d < 3 && d < degree; d++) {
    sample(half->knots, c, d, POINTS, x, out);
    sample(whole->knots, whole_c, d, POINTS, x, expected);
    double largest = 1;
    for (size_t i = 0; i < POINTS; i++) largest = fmax(largest, fabs(expected[i]));
    for (size_t i = 0; i < POINTS; i++) NEAR(out[i], expected[i], 1e-11 * largest);
    if ((parity < 0) == (d % 2 == 0)) /* an odd function is zero at both ends */
      for (size_t i = 0; i < 2; i++) NEAR(out[i], 0, 1e-11 * largest);
  }
  gx_spline_interpolant_free(half);
  gx_spline_interpolant_free(whole);
}

static void mirrored(void **unused)
{
  (void)unused;
  uint64_t state = 31;
  for (int degree = 1; degree <= 9; degree++)
    for (int on = 0; on < 4; on++)
      for (int parity = -1; parity <= 1; parity += 2) mirror(degree, parity, (const bool[]){on & 1, on >> 1}, &state);
}

/* sin(3 pi x) is odd and cos(3 pi x) even across both ends: at cell centres, slopes there to the error of collocation. A spline of
 * odd degree p has slopes of order p + 1 at uniform sites. */
static double mirrored_slope_error(int degree, size_t n, bool odd)
{
  const double wave = 3 * M_PI;
  double site[MOST], value[MOST], c[MOST + 18], out[MOST], largest = 0;
  for (size_t i = 0; i < n; i++) {
    site[i] = ((double)i + 0.5) / (double)n;
    value[i] = odd ? sin(wave * site[i]) : cos(wave * site[i]);
  }
  struct gx_spline_interpolant *s = make(odd ? GX_SPLINE_ODD : GX_SPLINE_EVEN, degree, n, site, 0, 1);
  assert_int_equal(s->lower, degree / 2);
  assert_int_equal(s->upper, degree / 2);
  gx_spline_interpolant_solve(s, value, c);
  sample(s->knots, c, 1, n, site, out);
  for (size_t i = 0; i < n; i++)
    largest = fmax(largest, fabs(out[i] - wave * (odd ? cos(wave * site[i]) : -sin(wave * site[i]))));
  gx_spline_interpolant_free(s);
  return largest;
}

static void mirrored_orders(void **unused)
{
  (void)unused;
  for (int degree = 3; degree <= 9; degree += 2)
    for (int odd = 0; odd < 2; odd++) {
      double coarse = mirrored_slope_error(degree, 18, odd), fine = mirrored_slope_error(degree, 36, odd);
      printf("degree %d, %s: slope error %.2e, order %.2f\n", degree, odd ? "odd" : "even", fine, log2(coarse / fine));
      NEAR(log2(coarse / fine), degree + 1, 0.25);
    }
}

/* Against the banded solve and its slopes. */
static void circulants(void **unused)
{
  (void)unused;
  uint64_t state = 41;
  for (int degree = 1; degree <= 9; degree++)
    for (size_t n = 20; n <= 21; n++) {
      double site[32], value[32], c[64], expected[64], out[32], slope[32];
      for (size_t i = 0; i < n; i++) {
        site[i] = 3 * (double)i / (double)n;
        value[i] = random_number(&state);
      }
      struct gx_spline_interpolant *s = make(GX_SPLINE_PERIODIC, degree, n, site, 0, 3);
      struct gx_spline_circulant *ring;
      DONE(gx_spline_circulant_create(&ring, degree, n, 3, &error));
      gx_spline_interpolant_solve(s, value, expected);
      gx_spline_circulant_solve(ring, value, c);
      for (size_t i = 0; i < s->knots->functions; i++) NEAR(c[i], expected[i], 1e-12);
      for (int d = 0; d < degree; d++) {
        gx_spline_circulant_derivative(ring, d, value, out);
        sample(gx_spline_circulant_knots(ring), c, d, n, site, slope);
        double largest = 1;
        for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(slope[i]));
        for (size_t i = 0; i < n; i++) NEAR(out[i], slope[i], 1e-12 * largest);
      }
      gx_spline_circulant_free(ring);
      gx_spline_interpolant_free(s);
    }
  struct gx_spline_circulant *ring;
  assert_int_equal(gx_spline_circulant_create(&ring, 5, 5, 1, &error), GX_SPLINE_TOO_FEW);
  assert_int_equal(gx_spline_circulant_create(&ring, 0, 5, 1, &error), GX_SPLINE_DEGREE);
  assert_int_equal(gx_spline_circulant_create(&ring, 5, 8, 0, &error), GX_SPLINE_NOT_INCREASING);
  assert_null(ring);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periodic_equals_open), cmocka_unit_test(periodic_orders),
      cmocka_unit_test(smallest_rings),       cmocka_unit_test(mirrored),
      cmocka_unit_test(mirrored_orders),      cmocka_unit_test(circulants),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
