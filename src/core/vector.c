/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementwise updates and sums, multiversioned. */
#include "vector.h"

#include <string.h>

#include "kernel.h"

GX_CLONES void gx_vector_add(size_t n, double scale, const double *restrict rate, double *restrict value)
{
  for (size_t i = 0; i < n; i++) value[i] += scale * rate[i];
}

GX_CLONES void gx_vector_line(size_t n, double start, double slope, const double *restrict x, double *restrict value)
{
  for (size_t i = 0; i < n; i++) value[i] = start + slope * x[i];
}

enum { LANES = GX_VECTOR_LANES, HALF = LANES / 2 };

/* Half of the partial sums: four doubles, for which every level has code. */
typedef double half __attribute__((vector_size(HALF * sizeof(double))));

/* Up to HALF entries, at least one, and zeros. */
GX_CORE void load(size_t some, const double *x, half *all)
{
  if (some < HALF)
    *all = (half){x[0], some > 1 ? x[1] : 0, some > 2 ? x[2] : 0, 0};
  else
    memcpy(all, x, sizeof *all);
}

/* sum += a * b * c of some entries from i on; b and c may be NULL: 1 */
GX_CORE void add_some(size_t some, size_t i, const double *a, const double *b, const double *c, half *sum)
{
  half product = {0}, factor = {0};
  load(some, a + i, &product);
  if (b) load(some, b + i, &factor);
  if (b) product *= factor;
  if (c) load(some, c + i, &factor);
  if (c) product *= factor;
  *sum += product;
}

/* sum: [2] partial sums, which stay in registers: through memory they would come in other sizes than they went */
GX_CORE void add_products(size_t n, const double *a, const double *b, const double *c, half *sum)
{
  const size_t whole = n - n % LANES;
  half low = sum[0], high = sum[1];
  for (size_t i = 0; i < whole; i += LANES) {
    add_some(HALF, i, a, b, c, &low);
    add_some(HALF, i + HALF, a, b, c, &high);
  }
  const size_t left = n - whole;
  if (left > 0) add_some(left < HALF ? left : HALF, whole, a, b, c, &low);
  if (left > HALF) add_some(left - HALF, whole + HALF, a, b, c, &high);
  sum[0] = low;
  sum[1] = high;
}

GX_CORE void add_piece(size_t n, const double *a, const double *b, double *parts)
{
  half sum[2];
  memcpy(&sum[0], parts, sizeof *sum);
  memcpy(&sum[1], parts + HALF, sizeof *sum);
  add_products(n, a, b, NULL, sum);
  memcpy(parts, &sum[0], sizeof *sum);
  memcpy(parts + HALF, &sum[1], sizeof *sum);
}

/* sum: [2] */
GX_CORE double total_of(const half *sum)
{
  const half both = sum[0] + sum[1];
  return (both[0] + both[2]) + (both[1] + both[3]);
}

GX_CLONES void gx_vector_sum_piece(size_t n, const double *value, double *parts)
{
  add_piece(n, value, NULL, parts);
}

GX_CLONES void gx_vector_dot_piece(size_t n, const double *a, const double *b, double *parts)
{
  add_piece(n, a, b, parts);
}

double gx_vector_total(const double *parts)
{
  half sum[2];
  memcpy(sum, parts, sizeof sum);
  return total_of(sum);
}

GX_CLONES double gx_vector_sum(size_t n, const double *value)
{
  half sum[2] = {{0}, {0}};
  add_products(n, value, NULL, NULL, sum);
  return total_of(sum);
}

GX_CLONES double gx_vector_dot(size_t n, const double *a, const double *b)
{
  half sum[2] = {{0}, {0}};
  add_products(n, a, b, NULL, sum);
  return total_of(sum);
}

GX_CLONES double gx_vector_weighted(size_t n, const double *weight, const double *a, const double *b)
{
  half sum[2] = {{0}, {0}};
  add_products(n, weight, a, b, sum);
  return total_of(sum);
}

typedef long long truths __attribute__((vector_size(HALF * sizeof(double))));

GX_CORE void keep_larger(size_t some, const double *x, half *most)
{
  half value = {0};
  load(some, x, &value);
  const truths larger = value > *most;
  *most = (half)(((truths)value & larger) | ((truths)*most & ~larger));
}

GX_CLONES double gx_vector_max(size_t n, const double *value)
{
  half low = {0}, high = {0};
  const size_t whole = n - n % LANES, left = n - whole;
  for (size_t i = 0; i < whole; i += LANES) {
    keep_larger(HALF, value + i, &low);
    keep_larger(HALF, value + i + HALF, &high);
  }
  if (left > 0) keep_larger(left < HALF ? left : HALF, value + whole, &low);
  if (left > HALF) keep_larger(left - HALF, value + whole + HALF, &high);
  double most = 0;
  for (int k = 0; k < HALF; k++) {
    most = low[k] > most ? low[k] : most;
    most = high[k] > most ? high[k] : most;
  }
  return most;
}
