/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every cmocka test includes: cmocka with its prerequisites, and comparisons of doubles that print all digits. */
#ifndef GRIDCROSS_TESTS_CHECK_H
#define GRIDCROSS_TESTS_CHECK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

/* cmocka's own comparison of floats casts to float */
static inline void check_near(double actual, double expected, double tolerance, const char *what, const char *file, int line)
{
  if (fabs(actual - expected) <= tolerance) return;
  print_error("%s is %.17g, not %.17g within %.3g (off by %.3g)\n", what, actual, expected, tolerance, actual - expected);
  _fail(file, line);
}

/* |actual - expected| <= tolerance; a NaN fails. */
#define NEAR(actual, expected, tolerance) check_near(actual, expected, tolerance, #actual, __FILE__, __LINE__)
/* The same relative to expected. */
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
