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

/* sum += a * b * c of some entries from i on; b and c may be NULL: 1 */
GX_CORE void add_some(size_t some, size_t i, const double *a, const double *b, const double *c, half *sum)
{
  half product = {0}, factor = {0};
  memcpy(&product, a + i, some * sizeof(double));
  if (b) memcpy(&factor, b + i, some * sizeof(double));
  if (b) product *= factor;
  if (c) memcpy(&factor, c + i, some * sizeof(double));
  if (c) product *= factor;
  *sum += product;
}

GX_CORE void add_products(size_t n, const double *a, const double *b, const double *c, double *parts)
{
  half sum[2];
  const size_t whole = n - n % LANES;
  memcpy(sum, parts, sizeof sum);
  for (size_t i = 0; i < whole; i += LANES) {
    add_some(HALF, i, a, b, c, &sum[0]);
    add_some(HALF, i + HALF, a, b, c, &sum[1]);
  }
  for (size_t i = whole, h = 0; i < n; i += HALF, h++) add_some(n - i < HALF ? n - i : HALF, i, a, b, c, &sum[h]);
  memcpy(parts, sum, sizeof sum);
}

GX_CLONES void gx_vector_sum_piece(size_t n, const double *value, double *parts)
{
  add_products(n, value, NULL, NULL, parts);
}

GX_CLONES void gx_vector_dot_piece(size_t n, const double *a, const double *b, double *parts)
{
  add_products(n, a, b, NULL, parts);
}

GX_CLONES double gx_vector_weighted(size_t n, const double *weight, const double *a, const double *b)
{
  double parts[LANES] = {0};
  add_products(n, weight, a, b, parts);
  return gx_vector_total(parts);
}

double gx_vector_total(const double *parts)
{
  double sum = 0;
  for (int k = 0; k < LANES; k++) sum += parts[k];
  return sum;
}

double gx_vector_sum(size_t n, const double *value)
{
  double parts[LANES] = {0};
  gx_vector_sum_piece(n, value, parts);
  return gx_vector_total(parts);
}

double gx_vector_dot(size_t n, const double *a, const double *b)
{
  double parts[LANES] = {0};
  gx_vector_dot_piece(n, a, b, parts);
  return gx_vector_total(parts);
}

GX_CLONES double gx_vector_max(size_t n, const double *restrict value)
{
  double part[LANES] = {0}, most = 0;
  size_t whole = n - n % LANES;
  for (size_t i = 0; i < whole; i += LANES)
    for (size_t k = 0; k < LANES; k++) part[k] = value[i + k] > part[k] ? value[i + k] : part[k];
  for (size_t i = whole; i < n; i++) most = value[i] > most ? value[i] : most;
  for (int k = 0; k < LANES; k++) most = part[k] > most ? part[k] : most;
  return most;
}
