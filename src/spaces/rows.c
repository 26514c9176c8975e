/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cores are inlined with the number of rows constant, so that the sum over rows stays in registers. */
#include "rows.h"

#include <stdbool.h>

#include <gridcross/basis.h>

#include "../core/kernel.h"

/* Runs core(rows, ...) with `rows` a constant. */
#define FOR_ROWS(rows, core, ...)                                                                                                \
  switch (rows) {                                                                                                                \
    ONE_CASE(1, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(2, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(3, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(4, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(5, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(6, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(7, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(8, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(9, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(10, core, __VA_ARGS__)                                                                                              \
  }
#define ONE_CASE(rows, core, ...)                                                                                                \
  case rows:                                                                                                                     \
    core(rows, __VA_ARGS__);                                                                                                     \
    break;

GX_CORE void combine(const int rows, const double *w, double *const *in, size_t n, double *restrict out)
{
  const double *row[GX_MAX_SUPPORT];
  double weight[GX_MAX_SUPPORT];
  for (int j = 0; j < rows; j++) {
    row[j] = in[j];
    weight[j] = w[j];
  }
  for (size_t i = 0; i < n; i++) {
    double sum = weight[0] * row[0][i];
    for (int j = 1; j < rows; j++) sum += weight[j] * row[j][i];
    out[i] = sum;
  }
}

GX_CLONES void gx_rows_combine(int rows, const double *w, double *const *in, size_t n,
                               double *out){FOR_ROWS(rows, combine, w, in, n, out)}

GX_CORE void spread(const int rows, const double *w, const double *restrict in, const double *w_more, const double *restrict more,
                    size_t n, double *const *out)
{
  double *row[GX_MAX_SUPPORT], weight[GX_MAX_SUPPORT], weight_more[GX_MAX_SUPPORT];
  for (int j = 0; j < rows; j++) {
    row[j] = out[j];
    weight[j] = w[j];
    weight_more[j] = more ? w_more[j] : 0;
  }
  GX_APART
  for (size_t i = 0; i < n; i++)
    for (int j = 0; j < rows; j++) row[j][i] += more ? weight[j] * in[i] + weight_more[j] * more[i] : weight[j] * in[i];
}

GX_CLONES void gx_rows_spread(int rows, const double *w, const double *in, const double *w_more, const double *more, size_t n,
                              double *const *out)
{
  if (more) {
    FOR_ROWS(rows, spread, w, in, w_more, more, n, out)
  } else {
    FOR_ROWS(rows, spread, w, in, NULL, NULL, n, out)
  }
}

GX_CORE void gather(const int rows, size_t apart, const double *restrict w, const double *restrict nodes, size_t n,
                    double *restrict out)
{
  for (size_t i = 0; i < n; i++) {
    double sum = w[i] * nodes[i];
    for (int j = 1; j < rows; j++) sum += w[(size_t)j * n + i] * nodes[i + (size_t)j * apart];
    out[i] = sum;
  }
}

GX_CLONES void gx_rows_gather(int rows, size_t apart, const double *w, const double *nodes, size_t n,
                              double *out){FOR_ROWS(rows, gather, apart, w, nodes, n, out)}

GX_CORE void set_both(const double *restrict w, const double *restrict in, const double *restrict w_more,
                      const double *restrict more, size_t n, const bool add, double *restrict out)
{
  for (size_t i = 0; i < n; i++) {
    double sum = more ? w[i] * in[i] + w_more[i] * more[i] : w[i] * in[i];
    out[i] = add ? out[i] + sum : sum;
  }
}

GX_CLONES void gx_rows_scatter(int rows, size_t apart, const double *w, const double *in, const double *w_more,
                               const double *more, size_t n, double *nodes)
{
  for (size_t i = n; i < n + (size_t)(rows - 1) * apart; i++) nodes[i] = 0;
  for (size_t j = 0; j < (size_t)rows; j++)
    if (more)
      set_both(w + j * n, in, w_more + j * n, more, n, j > 0, nodes + j * apart);
    else
      set_both(w + j * n, in, NULL, NULL, n, j > 0, nodes + j * apart);
}

GX_CORE void expand(const int period, int count, const int *first, const double *restrict row, double *restrict nodes)
{
  for (int c = 0; c < count; c++)
    for (int r = 0; r < period; r++) nodes[c * period + r] = row[first[r] + c];
}

GX_CORE void fold(const int period, int count, const int *first, const double *restrict nodes, double *restrict row)
{
  for (int r = 0; r < period; r++)
    for (int c = 0; c < count; c++) row[first[r] + c] += nodes[c * period + r];
}

#define FOR_PERIOD(period, core, ...)                                                                                            \
  switch (period) {                                                                                                              \
    ONE_CASE(1, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(2, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(3, core, __VA_ARGS__)                                                                                               \
    ONE_CASE(4, core, __VA_ARGS__)                                                                                               \
  default:                                                                                                                       \
    core(period, __VA_ARGS__);                                                                                                   \
  }

GX_CLONES void gx_rows_expand(int period, int count, const int *first, const double *row,
                              double *nodes){FOR_PERIOD(period, expand, count, first, row, nodes)}

GX_CLONES void gx_rows_fold(int period, int count, const int *first, const double *nodes, double *row)
{
  FOR_PERIOD(period, fold, count, first, nodes, row)
}
