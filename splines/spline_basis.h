/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions that do not vanish at a point (Cox-de Boor; de Boor, Practical Guide, ch. IX and X), for a constant degree. */
#ifndef GRIDCROSS_SPLINE_BASIS_H
#define GRIDCROSS_SPLINE_BASIS_H

#include <gridcross_splines.h>

#include <math.h>

#define GX_SPLINE_CORE static inline __attribute__((always_inline))

/* Compiled for several instruction sets; equal bits, since nothing contracts to FMA. */
#if GX_HAVE_CLONES
#define GX_SPLINE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define GX_SPLINE_CLONES
#endif

/* Splines that are solved and evaluated side by side: their sums stay in registers, [rows][GX_SPLINE_LANES] in the first cache. */
typedef double gx_spline_four __attribute__((vector_size(32), aligned(8), may_alias));
enum { GX_SPLINE_FOURS = 4, GX_SPLINE_LANES = 4 * GX_SPLINE_FOURS };
#define GX_SPLINE_EACH_FOUR(k) _Pragma("GCC unroll 4") for (int k = 0; k < GX_SPLINE_FOURS; k++)

/* statement with `degree` a constant */
#define GX_SPLINE_CASE(number, statement)                                                                                        \
  case number: {                                                                                                                 \
    enum { degree = number };                                                                                                    \
    statement;                                                                                                                   \
    break;                                                                                                                       \
  }
#define GX_SPLINE_FOR_DEGREE(value, statement)                                                                                   \
  switch (value) {                                                                                                               \
    GX_SPLINE_CASE(1, statement)                                                                                                 \
    GX_SPLINE_CASE(2, statement)                                                                                                 \
    GX_SPLINE_CASE(3, statement)                                                                                                 \
    GX_SPLINE_CASE(4, statement)                                                                                                 \
    GX_SPLINE_CASE(5, statement)                                                                                                 \
    GX_SPLINE_CASE(6, statement)                                                                                                 \
    GX_SPLINE_CASE(7, statement)                                                                                                 \
    GX_SPLINE_CASE(8, statement)                                                                                                 \
    GX_SPLINE_CASE(9, statement)                                                                                                 \
  }

/* x taken into the period [low, high). */
GX_SPLINE_CORE double gx_spline_basis_reduce(const struct gx_spline_knots *knots, double x)
{
  if (x >= knots->low && x < knots->high) return x;
  double period = knots->high - knots->low;
  x -= period * floor((x - knots->low) / period);
  return x >= knots->low && x < knots->high ? x : knots->low;
}

/* The piece of x: knot[piece] <= x < knot[piece + 1], the end pieces beyond the domain; degree <= piece < functions. hint: any
 * piece, best the last one found. */
GX_SPLINE_CORE size_t gx_spline_basis_locate(const struct gx_spline_knots *knots, double x, size_t hint)
{
  const double *t = knots->knot;
  size_t low = (size_t)knots->degree, high = knots->functions - 1;
  size_t piece = hint;
  for (int step = 0; step < 4; step++) {
    if (piece < high && x >= t[piece + 1])
      piece++;
    else if (piece > low && x < t[piece])
      piece--;
    else
      break;
  }
  if (!((piece == low || x >= t[piece]) && (piece == high || x < t[piece + 1]))) {
    while (low < high) { /* the last piece whose knot is not above x */
      size_t middle = low + (high - low + 1) / 2;
      if (x >= t[middle])
        low = middle;
      else
        high = middle - 1;
    }
    piece = low;
  }
  /* only at the ends can a piece be empty */
  while (piece > (size_t)knots->degree && !(t[piece + 1] > t[piece])) piece--;
  while (piece + 1 < knots->functions && !(t[piece + 1] > t[piece])) piece++;
  return piece;
}

/* left[j] = x - knot[piece - j], right[j] = knot[piece + 1 + j] - x */
GX_SPLINE_CORE void gx_spline_basis_distances(const int degree, const double *t, size_t piece, double x, double *left,
                                              double *right)
{
  for (int j = 0; j < degree; j++) {
    left[j] = x - t[piece - (size_t)j];
    right[j] = t[piece + 1 + (size_t)j] - x;
  }
}

/* Values of degree q - 1 to values of degree q; inverse: of widths q, from knot piece - q + 1 on. */
GX_SPLINE_CORE void gx_spline_basis_raise(const int q, const double *inverse, const double *left, const double *right, double *S)
{
  double carried = 0;
  for (int j = 0; j < q; j++) {
    double share = S[j] * inverse[j];
    S[j] = carried + right[j] * share;
    carried = left[q - 1 - j] * share;
  }
  S[q] = carried;
}

/* Derivatives of order d - 1 of degree q - 1 to derivatives of order d of degree q. */
GX_SPLINE_CORE void gx_spline_basis_differentiate(const int q, const double *inverse, double *D)
{
  double carried = 0;
  for (int j = 0; j < q; j++) {
    double share = q * (D[j] * inverse[j]);
    D[j] = carried - share;
    carried = share;
  }
  D[q] = carried;
}

/* inverse widths q that degree q - 1 to q needs in a piece */
GX_SPLINE_CORE const double *gx_spline_basis_inverse(const int degree, const struct gx_spline_knots *knots, size_t piece,
                                                     const int q)
{
  return knots->inverse + (size_t)(q - 1) * (knots->functions + (size_t)degree + 1) + piece + 1 - (size_t)q;
}

/* The degree + 1 values at x. */
GX_SPLINE_CORE void gx_spline_basis_values(const int degree, const struct gx_spline_knots *knots, size_t piece, double x,
                                           double *S)
{
  double left[GX_SPLINE_MAX_DEGREE], right[GX_SPLINE_MAX_DEGREE];
  gx_spline_basis_distances(degree, knots->knot, piece, x, left, right);
  S[0] = 1;
#pragma GCC unroll 9
  for (int q = 1; q <= degree; q++) gx_spline_basis_raise(q, gx_spline_basis_inverse(degree, knots, piece, q), left, right, S);
}

#endif
