/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every cmocka test includes: cmocka with its prerequisites, comparisons that say what they saw, random numbers. */
#ifndef GRIDCROSS_TESTS_CHECK_H
#define GRIDCROSS_TESTS_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

/* |actual - expected| <= tolerance; NaN fails */
#define NEAR(actual, expected, tolerance)                                                                                        \
  do {                                                                                                                           \
    double near_a = (actual), near_e = (expected), near_t = (tolerance);                                                         \
    if (!(fabs(near_a - near_e) <= near_t)) {                                                                                    \
      fprintf(stderr, "%s:%d: %s = %.17g, expected %.17g within %g\n", __FILE__, __LINE__, #actual, near_a, near_e, near_t);     \
      fail();                                                                                                                    \
    }                                                                                                                            \
  } while (0)

/* As NEAR, relative to expected. */
#define CLOSE(actual, expected, relative) NEAR(actual, expected, (relative)*fabs(expected))

/* Fails with a message of what was being checked. */
#define CHECK(condition, ...)                                                                                                    \
  do {                                                                                                                           \
    if (!(condition)) {                                                                                                          \
      print_error("%s: ", #condition);                                                                                           \
      print_error(__VA_ARGS__);                                                                                                  \
      print_error("\n");                                                                                                         \
      _fail(__FILE__, __LINE__);                                                                                                 \
    }                                                                                                                            \
  } while (0)

/* Uniform in [low, high), the same sequence on every machine. */
static inline double check_random(uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * ((double)(*seed >> 11) * 0x1p-53);
}

#endif
