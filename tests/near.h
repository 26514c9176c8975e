/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Assertions on doubles that print what they saw; cmocka's own cast to float. */
#ifndef GRIDCROSS_TESTS_NEAR_H
#define GRIDCROSS_TESTS_NEAR_H

#include <math.h>
#include <stdio.h>

/* |actual - expected| <= tolerance; NaN fails */
#define NEAR(actual, expected, tolerance)                                                                                        \
  do {                                                                                                                           \
    double near_a = (actual), near_e = (expected), near_t = (tolerance);                                                         \
    if (!(fabs(near_a - near_e) <= near_t)) {                                                                                    \
      fprintf(stderr, "%s:%d: %s = %.17g, expected %.17g within %g\n", __FILE__, __LINE__, #actual, near_a, near_e, near_t);     \
      fail();                                                                                                                    \
    }                                                                                                                            \
  } while (0)

#endif
