/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The logarithm of loops against the C library's, near 1, where it vanishes, and over all that doubles hold. */
#include "core/logarithm.h"

#include "check.h"

/* Within an ulp of the C library's, which is within half an ulp and a little of the true one. */
static void check(double x)
{
  const double value = gx_logarithm(x), expected = log(x);
  CHECK(fabs(value - expected) <= 1.01 * DBL_EPSILON * fabs(expected), "log %.17g is %.17g, not %.17g", x, value, expected);
}

static void it_is_the_logarithm(void **state)
{
  (void)state;
  static const double places[] = {1, 0.5, 2, M_SQRT1_2, M_SQRT2, M_E, 10, DBL_MIN, DBL_MAX / 2};
  uint64_t seed = 12;
  for (size_t i = 0; i < sizeof places / sizeof *places; i++)
    for (int k = -20; k <= 20; k++)
      if (places[i] * (1 + k * DBL_EPSILON) >= DBL_MIN) check(places[i] * (1 + k * DBL_EPSILON));
  check(DBL_MAX);
  for (int i = 0; i < 100000; i++) {
    check(check_random(&seed, 0.5, 2));
    check(1 + check_random(&seed, -1e-6, 1e-6));
    check(ldexp(check_random(&seed, 1, 2), (int)check_random(&seed, -1022, 1023)));
  }
}

static void nothing_else_has_one(void **state)
{
  (void)state;
  static const double none[] = {0, -0.0, -1, -DBL_MAX, 0.5 * DBL_MIN, INFINITY, -INFINITY, NAN, -NAN};
  for (size_t i = 0; i < sizeof none / sizeof *none; i++)
    CHECK(isnan(gx_logarithm(none[i])), "log %g is %g", none[i], gx_logarithm(none[i]));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_is_the_logarithm),
      cmocka_unit_test(nothing_else_has_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
