/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Assertions that print what they saw, to every digit. */
#ifndef GRIDCROSS_SPLINES_TESTS_NEAR_H
#define GRIDCROSS_SPLINES_TESTS_NEAR_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

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

#define DONE(call)                                                                                                               \
  do {                                                                                                                           \
    struct gx_spline_error *done_e = &error;                                                                                     \
    error.message[0] = 0;                                                                                                        \
    if ((call) != GX_SPLINE_OK) fail_msg("%s", done_e->message);                                                                 \
  } while (0)

#endif
