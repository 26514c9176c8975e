/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cyclic banded systems by a border of the band. */
#include "spline_border.h"
#include "spline_basis.h"

#include <float.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct gx_spline_border {
  size_t rows, width;
  double *tail;                                                /* [width][2 degree + 1], rows of [W C], columns wrapping */
  double *right;                                               /* [rows - width][width], B^-1 V */
  double inverse[GX_SPLINE_MAX_DEGREE * GX_SPLINE_MAX_DEGREE]; /* [width][width], S^-1 */
};

struct gx_spline_border *gx_spline_border_create(int degree, size_t rows)
{
  const size_t p = (size_t)degree;
  struct gx_spline_border *border = calloc(1, sizeof *border);
  double *memory = calloc(p * (2 * p + 1) + rows * p, sizeof *memory);
  if (!border || !memory) {
    free(border);
    free(memory);
    return NULL;
  }
  border->rows = rows;
  border->tail = memory;
  border->right = memory + p * (2 * p + 1);
  return border;
}

void gx_spline_border_free(struct gx_spline_border *border)
{
  if (!border) return;
  free(border->tail);
  free(border);
}

/* offset: less than rows in magnitude */
static size_t column(const struct gx_spline_border *border, size_t row, int offset)
{
  ptrdiff_t at = (ptrdiff_t)row + offset, rows = (ptrdiff_t)border->rows;
  return (size_t)(at < 0 ? at + rows : at >= rows ? at - rows : at);
}

static struct gx_spline_band inner(const struct gx_spline_border *border, const struct gx_spline_band *band)
{
  struct gx_spline_band B = *band;
  B.rows = border->rows - border->width;
  return B;
}

/* V into right; B keeps what lies in it. */
static void cut_columns(struct gx_spline_border *border, const struct gx_spline_band *band)
{
  const size_t w = border->width, m = border->rows - w, stride = 2 * (size_t)band->degree + 1;
  memset(border->right, 0, m * w * sizeof *border->right);
  for (size_t i = 0; i < m; i++) {
    if (i >= (size_t)band->lower && i + (size_t)band->upper < m) continue;
    double *row = band->entry + i * stride + band->degree;
    for (int d = -band->lower; d <= band->upper; d++) {
      size_t j = column(border, i, d);
      if (j < m && (ptrdiff_t)j - (ptrdiff_t)i == d) continue;
      if (j >= m) border->right[i * w + j - m] += row[d];
      row[d] = 0;
    }
  }
}

/* By Householder QR; schur is overwritten. Returns -1 when it is singular to rounding. */
static int invert(double *schur, size_t w, double *inverse)
{
  double tau[GX_SPLINE_MAX_DEGREE];
  gsl_matrix_view S = gsl_matrix_view_array(schur, w, w);
  gsl_vector_view t = gsl_vector_view_array(tau, w);
  gsl_linalg_QR_decomp(&S.matrix, &t.vector);
  for (size_t r = 0; r < w; r++)
    if (!(fabs(schur[r * w + r]) > DBL_EPSILON)) return -1;
  for (size_t c = 0; c < w; c++) {
    double unit[GX_SPLINE_MAX_DEGREE] = {0};
    unit[c] = 1;
    gsl_vector_view e = gsl_vector_view_array(unit, w);
    gsl_linalg_QR_svx(&S.matrix, &t.vector, &e.vector);
    for (size_t r = 0; r < w; r++) inverse[r * w + c] = unit[r];
  }
  return 0;
}

long gx_spline_border_factor(struct gx_spline_border *border, const struct gx_spline_band *band)
{
  const size_t stride = 2 * (size_t)band->degree + 1;
  const size_t w = border->width = (size_t)(band->lower > band->upper ? band->lower : band->upper), m = border->rows - w;
  memcpy(border->tail, band->entry + m * stride, w * stride * sizeof *border->tail);
  cut_columns(border, band);
  const struct gx_spline_band B = inner(border, band);
  long fault = gx_spline_band_factor(&B);
  if (fault >= 0 || !w) return fault;
  gx_spline_band_solve_many(&B, w, border->right, border->right);
  double schur[GX_SPLINE_MAX_DEGREE * GX_SPLINE_MAX_DEGREE] = {0};
  for (size_t r = 0; r < w; r++) {
    const double *row = border->tail + r * stride + band->degree;
    double *sum = schur + r * w;
    for (int d = -band->lower; d <= band->upper; d++) {
      size_t j = column(border, m + r, d);
      if (j >= m)
        sum[j - m] += row[d];
      else
        for (size_t c = 0; c < w; c++) sum[c] -= row[d] * border->right[j * w + c];
    }
  }
  return invert(schur, w, border->inverse) ? (long)m : -1;
}

/* x_1 -= (B^-1 V) x_2 */
GX_SPLINE_CORE void subtract(const int width, size_t m, const double *restrict right, const double *restrict end,
                             double *restrict x)
{
  for (size_t i = 0; i < m; i++) {
    double sum = 0;
    for (int r = 0; r < width; r++) sum += right[i * (size_t)width + (size_t)r] * end[r];
    x[i] -= sum;
  }
}

/* x_2 = S^-1 (b_2 - W x_1), then x_1 -= (B^-1 V) x_2, for one of count systems */
static void close_one(const struct gx_spline_border *border, const struct gx_spline_band *band, size_t count, const double *b,
                      double *x)
{
  const size_t w = border->width, m = border->rows - w, stride = 2 * (size_t)band->degree + 1;
  double end[GX_SPLINE_MAX_DEGREE], last[GX_SPLINE_MAX_DEGREE];
  for (size_t r = 0; r < w; r++) {
    const double *row = border->tail + r * stride + band->degree;
    end[r] = b[(m + r) * count];
    for (int d = -band->lower; d <= band->upper; d++) {
      size_t j = column(border, m + r, d);
      if (j < m) end[r] -= row[d] * x[j * count];
    }
  }
  for (size_t r = 0; r < w; r++) {
    double sum = 0;
    for (size_t c = 0; c < w; c++) sum += border->inverse[r * w + c] * end[c];
    x[(m + r) * count] = last[r] = sum;
  }
  if (count == 1)
    GX_SPLINE_FOR_DEGREE((int)w, subtract(degree, m, border->right, last, x))
  else
    for (size_t i = 0; i < m; i++) {
      double sum = 0;
      for (size_t r = 0; r < w; r++) sum += border->right[i * w + r] * last[r];
      x[i * count] -= sum;
    }
}

/* The same for GX_SPLINE_LANES of them. */
GX_SPLINE_CORE void close_lanes(const int width, const struct gx_spline_border *border, const struct gx_spline_band *band,
                                size_t count, const double *b, double *x)
{
  const size_t w = (size_t)width, m = border->rows - w, stride = 2 * (size_t)band->degree + 1;
  gx_spline_four end[GX_SPLINE_MAX_DEGREE][GX_SPLINE_FOURS], last[GX_SPLINE_MAX_DEGREE][GX_SPLINE_FOURS];
  for (size_t r = 0; r < w; r++) {
    const double *row = border->tail + r * stride + band->degree;
    GX_SPLINE_EACH_FOUR(k) end[r][k] = ((const gx_spline_four *)(b + (m + r) * count))[k];
    for (int d = -band->lower; d <= band->upper; d++) {
      size_t j = column(border, m + r, d);
      if (j >= m) continue;
      GX_SPLINE_EACH_FOUR(k) end[r][k] -= row[d] * ((const gx_spline_four *)(x + j * count))[k];
    }
  }
  for (size_t r = 0; r < w; r++) {
    GX_SPLINE_EACH_FOUR(k) last[r][k] = (gx_spline_four){0};
    for (size_t c = 0; c < w; c++) GX_SPLINE_EACH_FOUR(k) last[r][k] += border->inverse[r * w + c] * end[c][k];
    GX_SPLINE_EACH_FOUR(k)((gx_spline_four *)(x + (m + r) * count))[k] = last[r][k];
  }
  const double *right = border->right;
  for (size_t i = 0; i < m; i++, right += w, x += count) {
    gx_spline_four sum[GX_SPLINE_FOURS] = {{0}};
    for (size_t r = 0; r < w; r++) GX_SPLINE_EACH_FOUR(k) sum[k] += right[r] * last[r][k];
    GX_SPLINE_EACH_FOUR(k)((gx_spline_four *)x)[k] -= sum[k];
  }
}

GX_SPLINE_CLONES static void close_many(const struct gx_spline_border *border, const struct gx_spline_band *band, size_t count,
                                        const double *b, double *x)
{
  GX_SPLINE_FOR_DEGREE((int)border->width, close_lanes(degree, border, band, count, b, x))
}

void gx_spline_border_solve(const struct gx_spline_border *border, const struct gx_spline_band *band, size_t count,
                            const double *b, double *x)
{
  const struct gx_spline_band B = inner(border, band);
  if (count == 1)
    gx_spline_band_solve(&B, b, x);
  else
    gx_spline_band_solve_many(&B, count, b, x);
  if (!border->width) return;
  size_t s = 0;
  for (; s + GX_SPLINE_LANES <= count; s += GX_SPLINE_LANES) close_many(border, band, count, b + s, x + s);
  for (; s < count; s++) close_one(border, band, count, b + s, x + s);
}
