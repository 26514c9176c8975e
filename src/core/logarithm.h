/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The natural logarithm for loops over particles: without branch or call, so that it is vectorised, and of sums and products alone, so
 * that its bits are those of every instruction set, compiler and C library. */
#ifndef GRIDCROSS_CORE_LOGARITHM_H
#define GRIDCROSS_CORE_LOGARITHM_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "kernel.h"

/* x = 2^k m with m from sqrt(1/2) to sqrt(2), and with s = (m - 1)/(m + 1), log m = 2 s + s R(s^2), by the polynomial and the order of
 * sums of fdlibm's e_log.c (Sun Microsystems, 1993): to less than one unit in the last place. NaN unless x is positive, finite and
 * no less than DBL_MIN. */
GX_CORE double gx_logarithm(double x)
{
  const uint64_t least = UINT64_C(0x3fe6a09e667f3bcd), one = UINT64_C(0x3ff) << 52, fraction = (UINT64_C(1) << 52) - 1;
  uint64_t bits, shifted, whole;
  double m, k;
  memcpy(&bits, &x, sizeof bits);
  shifted = bits + (one - least);
  bits = (shifted & fraction) + least;
  whole = shifted >> 52 | UINT64_C(0x433) << 52; /* 2^52 + k + 1023 */
  memcpy(&m, &bits, sizeof m);
  memcpy(&k, &whole, sizeof k);
  k -= 0x1p52 + 1023;
  const double f = m - 1, s = f / (2 + f), z = s * s, w = z * z, half = 0.5 * f * f;
  const double even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double odd = z * (6.666666666666735130e-01 +
                          w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const double value =
      k * 6.93147180369123816490e-01 - ((half - (s * (half + (odd + even)) + k * 1.90821492927058770002e-10)) - f);
  return x >= DBL_MIN && x <= DBL_MAX ? value : NAN;
}

#endif
