/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Banded systems without pivoting. gsl_linalg_LU_band_svx takes 16 to 19 ns a row on matrices of these widths, this 3 to 4; a
 * step in the reference frame is two solves and little else. The tests hold it against GSL's. */
#include "spline_band.h"
#include "spline_basis.h"

#include <float.h>

/* Rows of collocation matrices sum to one: a pivot at rounding of that has lost every digit. */
static const double SMALLEST_PIVOT = DBL_EPSILON;

GX_SPLINE_CORE long factor(const int width, const struct gx_spline_band *band)
{
  const ptrdiff_t stride = 2 * band->degree + 1;
  double *diagonal = band->entry + band->degree;
  for (ptrdiff_t i = 0; i < (ptrdiff_t)band->rows; i++) {
    double *row = diagonal + i * stride;
    for (int d = i < width ? (int)i : width; d >= 1; d--) {
      const double *above = diagonal + (i - d) * stride, l = row[-d];
      for (int e = 1; e <= width; e++) row[e - d] -= l * above[e];
    }
    if (!(row[0] > SMALLEST_PIVOT)) return (long)i;
    double inverse = 1 / row[0];
    row[0] = inverse;
    for (int e = 1; e <= width; e++) {
      row[-e] *= inverse;
      row[e] *= inverse;
    }
  }
  return -1;
}

long gx_spline_band_factor(const struct gx_spline_band *band)
{
  const int width = band->lower > band->upper ? band->lower : band->upper;
  GX_SPLINE_FOR_DEGREE(width, return factor(degree, band))
  return factor(0, band);
}

/* Sums run from the far end of the band to the diagonal: only the last term waits for the row before, whose result stays in a
 * register. */
GX_SPLINE_CORE void forward(const int lower, const struct gx_spline_band *band, const double *b, double *x)
{
  const ptrdiff_t stride = 2 * band->degree + 1, rows = (ptrdiff_t)band->rows;
  const double *restrict row = band->entry + band->degree;
  double last = 0;
  for (ptrdiff_t i = 0; i < rows; i++, row += stride) {
    double sum = b[i] * row[0];
    if (i >= lower)
      for (int d = lower; d >= 2; d--) sum -= row[-d] * x[i - d];
    else
      for (int d = (int)i; d >= 2; d--) sum -= row[-d] * x[i - d];
    x[i] = last = lower ? sum - row[-1] * last : sum;
  }
}

GX_SPLINE_CORE void backward(const int upper, const struct gx_spline_band *band, double *x)
{
  const ptrdiff_t stride = 2 * band->degree + 1, rows = (ptrdiff_t)band->rows;
  const double *restrict row = band->entry + band->degree + (rows - 1) * stride;
  double last = 0;
  for (ptrdiff_t i = rows - 1; i >= 0; i--, row -= stride) {
    double sum = x[i];
    if (i + upper < rows)
      for (int d = upper; d >= 2; d--) sum -= row[d] * x[i + d];
    else
      for (int d = (int)(rows - 1 - i); d >= 2; d--) sum -= row[d] * x[i + d];
    x[i] = last = upper ? sum - row[1] * last : sum;
  }
}

static void forward_any(const struct gx_spline_band *band, const double *b, double *x)
{
  GX_SPLINE_FOR_DEGREE(band->lower, forward(degree, band, b, x); return )
  forward(0, band, b, x);
}

void gx_spline_band_solve(const struct gx_spline_band *band, const double *b, double *x)
{
  forward_any(band, b, x);
  GX_SPLINE_FOR_DEGREE(band->upper, backward(degree, band, x))
}

/* sum -= row[d step] x of row i + d step, from the far end of the band on; x: row i. */
GX_SPLINE_CORE void eliminate(const int reach, const int step, size_t count, const double *row, gx_spline_four *sum,
                              const double *x)
{
  for (int d = reach; d >= 1; d--) {
    const gx_spline_four *other = (const gx_spline_four *)(x + d * step * (ptrdiff_t)count);
    GX_SPLINE_EACH_FOUR(k) sum[k] -= row[d * step] * other[k];
  }
}

GX_SPLINE_CORE void forward_lanes(const int lower, size_t count, const struct gx_spline_band *band, const double *b, double *x)
{
  const size_t stride = 2 * (size_t)band->degree + 1, rows = band->rows;
  const double *row = band->entry + band->degree;
  for (size_t i = 0; i < rows; i++, row += stride, b += count, x += count) {
    gx_spline_four sum[GX_SPLINE_FOURS];
    GX_SPLINE_EACH_FOUR(k) sum[k] = ((const gx_spline_four *)b)[k] * row[0];
    if (i >= (size_t)lower)
      eliminate(lower, -1, count, row, sum, x);
    else
      eliminate((int)i, -1, count, row, sum, x);
    GX_SPLINE_EACH_FOUR(k)((gx_spline_four *)x)[k] = sum[k];
  }
}

GX_SPLINE_CORE void backward_lanes(const int upper, size_t count, const struct gx_spline_band *band, double *x)
{
  const size_t stride = 2 * (size_t)band->degree + 1, rows = band->rows;
  const double *row = band->entry + band->degree + rows * stride;
  x += rows * count;
  for (size_t i = rows; i-- > 0;) {
    row -= stride;
    x -= count;
    gx_spline_four sum[GX_SPLINE_FOURS];
    GX_SPLINE_EACH_FOUR(k) sum[k] = ((const gx_spline_four *)x)[k];
    if (i + (size_t)upper < rows)
      eliminate(upper, 1, count, row, sum, x);
    else
      eliminate((int)(rows - 1 - i), 1, count, row, sum, x);
    GX_SPLINE_EACH_FOUR(k)((gx_spline_four *)x)[k] = sum[k];
  }
}

GX_SPLINE_CLONES static void solve_lanes(const struct gx_spline_band *band, size_t count, const double *b, double *x)
{
  if (!band->lower) forward_lanes(0, count, band, b, x);
  GX_SPLINE_FOR_DEGREE(band->lower, forward_lanes(degree, count, band, b, x))
  GX_SPLINE_FOR_DEGREE(band->upper, backward_lanes(degree, count, band, x))
}

/* One of count systems. */
static void solve_one(const struct gx_spline_band *band, size_t count, const double *b, double *x)
{
  const ptrdiff_t stride = 2 * band->degree + 1, rows = (ptrdiff_t)band->rows, step = (ptrdiff_t)count;
  const double *row = band->entry + band->degree;
  for (ptrdiff_t i = 0; i < rows; i++, row += stride) {
    double sum = b[i * step] * row[0];
    for (ptrdiff_t d = i < band->lower ? i : band->lower; d >= 1; d--) sum -= row[-d] * x[(i - d) * step];
    x[i * step] = sum;
  }
  for (ptrdiff_t i = rows - 1; i >= 0; i--) {
    row -= stride;
    for (ptrdiff_t d = rows - 1 - i < band->upper ? rows - 1 - i : band->upper; d >= 1; d--)
      x[i * step] -= row[d] * x[(i + d) * step];
  }
}

void gx_spline_band_solve_many(const struct gx_spline_band *band, size_t count, const double *b, double *x)
{
  size_t s = 0;
  for (; s + GX_SPLINE_LANES <= count; s += GX_SPLINE_LANES) solve_lanes(band, count, b + s, x + s);
  for (; s < count; s++) solve_one(band, count, b + s, x + s);
}
