/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decimal digits of a double from one product of 64-bit integers, with bounds on its error that tell when the digits are certain: a
 * large table is mostly numbers, and printf takes a microsecond for each. The idea is that of Grisu (F. Loitsch, Printing
 * floating-point numbers quickly and accurately with integers, PLDI 2010). */
#include "decimal.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { DIGITS = 17, MOST_POWER = 55, FRACTION = 64 };

/* Leading 64 bits of 10^k, cut off: exact up to k = 27. */
static const uint64_t power[MOST_POWER + 1] = {
    0x8000000000000000, 0xa000000000000000, 0xc800000000000000, 0xfa00000000000000, 0x9c40000000000000, 0xc350000000000000,
    0xf424000000000000, 0x9896800000000000, 0xbebc200000000000, 0xee6b280000000000, 0x9502f90000000000, 0xba43b74000000000,
    0xe8d4a51000000000, 0x9184e72a00000000, 0xb5e620f480000000, 0xe35fa931a0000000, 0x8e1bc9bf04000000, 0xb1a2bc2ec5000000,
    0xde0b6b3a76400000, 0x8ac7230489e80000, 0xad78ebc5ac620000, 0xd8d726b7177a8000, 0x878678326eac9000, 0xa968163f0a57b400,
    0xd3c21bcecceda100, 0x84595161401484a0, 0xa56fa5b99019a5c8, 0xcecb8f27f4200f3a, 0x813f3978f8940984, 0xa18f07d736b90be5,
    0xc9f2c9cd04674ede, 0xfc6f7c4045812296, 0x9dc5ada82b70b59d, 0xc5371912364ce305, 0xf684df56c3e01bc6, 0x9a130b963a6c115c,
    0xc097ce7bc90715b3, 0xf0bdc21abb48db20, 0x96769950b50d88f4, 0xbc143fa4e250eb31, 0xeb194f8e1ae525fd, 0x92efd1b8d0cf37be,
    0xb7abc627050305ad, 0xe596b7b0c643c719, 0x8f7e32ce7bea5c6f, 0xb35dbf821ae4f38b, 0xe0352f62a19e306e, 0x8c213d9da502de45,
    0xaf298d050e4395d6, 0xdaf3f04651d47b4c, 0x88d8762bf324cd0f, 0xab0e93b6efee0053, 0xd5d238a4abe98068, 0x85a36366eb71f041,
    0xa70c3c40a64e6c51, 0xd0cf4b50cfe20765,
};

/* floor(log2(10^k)) */
static int power_exponent(int k)
{
  return k * 217706 >> 16;
}

/* The upper half of a 128-bit product. */
static uint64_t multiply_high(uint64_t a, uint64_t b)
{
  const uint64_t low = UINT32_MAX;
  uint64_t a0 = a & low, a1 = a >> 32, b0 = b & low, b1 = b >> 32;
  uint64_t middle = a1 * b0 + (a0 * b0 >> 32), other = a0 * b1 + (middle & low);
  return a1 * b1 + (middle >> 32) + (other >> 32);
}

/* A positive number times 10^(16 - exponent), which has 17 digits before the point, in units of 1/FRACTION: it lies within
 * [scaled, scaled + 2). */
struct scaled {
  int exponent;
  uint64_t scaled, half_gap; /* half_gap: cut off, half the distance to the next double above */
  bool narrow;               /* the next double below is at half the distance */
};

static bool scale(double value, struct scaled *of)
{
  static const uint64_t limit = UINT64_C(100000000000000000) * FRACTION;
  int binary;
  uint64_t mantissa = (uint64_t)ldexp(frexp(value, &binary), 53); /* value = mantissa 2^(binary - 53) */
  of->narrow = mantissa == UINT64_C(1) << 52;
  of->exponent = (int)floor((binary - 1) * 0.30102999566398120); /* right, or one too small */
  for (int tried = 0; tried < 2; tried++, of->exponent++) {
    int k = DIGITS - 1 - of->exponent;
    if (k < 0 || k > MOST_POWER) return false;
    int shift =
        64 - 6 - (binary + power_exponent(k) - 63); /* of the 128-bit product mantissa 2^11 times power, to units of 1/64 */
    if (shift < 64 || shift > 74) continue;
    of->scaled = multiply_high(mantissa << 11, power[k]) >> (shift - 64);
    of->half_gap = power[k] >> (shift - 10);
    if (of->scaled + 2 < limit) return true;
  }
  return false;
}

enum verdict { NO, YES, UNKNOWN };

/* Rounds to fewer digits; whether the result reads back as the same double. */
static enum verdict round_to(const struct scaled *of, uint64_t unit, uint64_t *rounded)
{
  uint64_t shifted = of->scaled + unit / 2, rest = shifted % unit;
  *rounded = shifted / unit;
  if (rest == 0 || rest + 2 >= unit) return UNKNOWN; /* a tie, or just below one */
  uint64_t back = *rounded * unit, off = back > of->scaled ? back - of->scaled : of->scaled - back;
  if (off + 2 < of->half_gap / (of->narrow ? 2 : 1)) return YES;
  return off > of->half_gap + 3 ? NO : UNKNOWN;
}

/* As %g does: trailing zeros go, and the exponent decides on the form. */
static void print_digits(uint64_t number, int digits, int exponent, char *text)
{
  char digit[DIGITS + 1];
  for (int i = digits; i-- > 0; number /= 10) digit[i] = (char)('0' + number % 10);
  int kept = digits;
  while (kept > 1 && digit[kept - 1] == '0') kept--;
  bool scientific = exponent < -4 || exponent >= digits;
  int whole = scientific ? 1 : exponent + 1; /* digits before the point */
  if (whole <= 0) {
    memcpy(text, "0.0000", 6);
    text += 2 - whole;
    whole = kept;
  }
  for (int i = 0; i < kept || i < whole; i++) {
    if (i == whole) *text++ = '.';
    *text++ = i < kept ? digit[i] : '0';
  }
  if (scientific) {
    int size = exponent < 0 ? -exponent : exponent;
    *text++ = 'e';
    *text++ = exponent < 0 ? '-' : '+';
    *text++ = (char)('0' + size / 10);
    *text++ = (char)('0' + size % 10);
  }
  *text = '\0';
}

bool gx_decimal_print(double value, char text[GX_NUMBER_LENGTH])
{
  struct scaled of;
  if (signbit(value)) *text++ = '-';
  value = fabs(value);
  if (value == 0) {
    memcpy(text, "0", 2);
    return true;
  }
  if (!isnormal(value) || !scale(value, &of)) return false;
  uint64_t unit = FRACTION * 100, whole = UINT64_C(1000000000000000), number = 0;
  for (int digits = DIGITS - 2; digits <= DIGITS; digits++, unit /= 10, whole *= 10) {
    enum verdict verdict = round_to(&of, unit, &number);
    if (verdict == UNKNOWN) return false;
    if (verdict == NO) continue;
    bool carried = number == whole;
    print_digits(carried ? number / 10 : number, digits, of.exponent + carried, text);
    return true;
  }
  return false;
}
