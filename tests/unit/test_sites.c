/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an error of a spline says of the particles that it was to pass through: which of them, where, and why. */
#include <string.h>

#include "check.h"
#include "spaces/sites.h"

static void reports(enum gx_spline_status spline, bool periodic, bool within, const double *x, size_t n, enum gx_status expected,
                    long particle, const char *words)
{
  struct gx_outcome outcome = {.status = GX_OK, .particle = -2};
  const struct gx_spline_error error = {.status = spline, .site = 7, .message = "as the spline has it"};
  assert_int_equal(gx_sites_report(&outcome, &error, n, x, periodic, within), expected);
  assert_int_equal(outcome.status, expected);
  assert_int_equal(outcome.particle, particle);
  CHECK(strstr(outcome.reason, words), "'%s' does not say '%s'", outcome.reason, words);
}

#define REPORTS(spline, periodic, within, expected, particle, words, ...)                                                        \
  reports(spline, periodic, within, (const double[]){__VA_ARGS__}, sizeof((double[]){__VA_ARGS__}) / sizeof(double), expected,   \
          particle, words)

static void nowhere(void **state)
{
  (void)state;
  REPORTS(GX_SPLINE_NOT_INCREASING, false, false, GX_UNSTABLE, 0, "at nan", NAN, 0.5, 2);
  REPORTS(GX_SPLINE_OUTSIDE, true, false, GX_UNSTABLE, 2, "at inf", 0.1, 0.5, INFINITY);
}

static void past_an_end(void **state)
{
  (void)state;
  REPORTS(GX_SPLINE_OUTSIDE, false, false, GX_LEFT_DOMAIN, 0, "at -0.1, past the fixed end at 0", -0.1, 0.5, 0.7);
  REPORTS(GX_SPLINE_OUTSIDE, false, false, GX_LEFT_DOMAIN, 2, "at 1.25, past the fixed end at 1", 0.1, 0.5, 1.25);
  REPORTS(GX_SPLINE_OUTSIDE, false, true, GX_LEFT_DOMAIN, 0, "at 0, past the fixed end at 0", 0, 0.5, 0.7);
  REPORTS(GX_SPLINE_OUTSIDE, false, true, GX_LEFT_DOMAIN, 2, "at 1, past the fixed end at 1", 0.1, 0.5, 1);
  REPORTS(GX_SPLINE_OUTSIDE, false, false, GX_REFUSED, -1, "as the spline has it", 0, 0.5, 1); /* on the ends */
}

static void met_a_neighbour(void **state)
{
  (void)state;
  REPORTS(GX_SPLINE_NOT_INCREASING, false, true, GX_TANGLED, 1, "at 0.25 has met or passed its neighbour at 0.5", 0.5, 0.25, 0.7);
  REPORTS(GX_SPLINE_NOT_INCREASING, true, false, GX_TANGLED, 3, "neighbour at 1.5", -0.5, 0.25, 1.5, 1.5);
  REPORTS(GX_SPLINE_OUTSIDE, true, false, GX_TANGLED, 2, "at 1.375 has met or passed the first one's image at 1.25", 0.25, 0.5,
          1.375);
}

static void other_reasons(void **state)
{
  (void)state;
  REPORTS(GX_SPLINE_NOT_INCREASING, true, false, GX_REFUSED, -1, "as the spline has it", 0.1, 0.5, 0.7);
  REPORTS(GX_SPLINE_MEMORY, true, false, GX_FAILED, -1, "as the spline has it", 0.5, 0.1);
  REPORTS(GX_SPLINE_SINGULAR, false, false, GX_SINGULAR, -1, "as the spline has it", 0.5, 0.1);
  REPORTS(GX_SPLINE_TOO_FEW, false, false, GX_REFUSED, -1, "as the spline has it", 0.5, 0.1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nowhere),
      cmocka_unit_test(past_an_end),
      cmocka_unit_test(met_a_neighbour),
      cmocka_unit_test(other_reasons),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
