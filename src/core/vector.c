/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementwise updates and sums, multiversioned. */
#include "vector.h"

#include <string.h>

#include "kernel.h"

GX_CLONES void gx_vector_add(size_t n, double scale, const double *restrict rate, double *restrict value)
{
  for (size_t i = 0; i < n; i++) value[i] += scale * rate[i];
}

enum { LANES = GX_VECTOR_LANES };

GX_CLONES void gx_vector_sum_piece(size_t n, const double *restrict value, double *restrict parts)
{
  double part[LANES];
  size_t whole = n - n % LANES;
  memcpy(part, parts, sizeof part);
  for (size_t i = 0; i < whole; i += LANES)
    for (size_t k = 0; k < LANES; k++) part[k] += value[i + k];
  for (size_t i = whole; i < n; i++) part[i - whole] += value[i];
  memcpy(parts, part, sizeof part);
}

GX_CLONES void gx_vector_dot_piece(size_t n, const double *a, const double *b, double *restrict parts)
{
  double part[LANES];
  size_t whole = n - n % LANES;
  memcpy(part, parts, sizeof part);
  for (size_t i = 0; i < whole; i += LANES)
    for (size_t k = 0; k < LANES; k++) part[k] += a[i + k] * b[i + k];
  for (size_t i = whole; i < n; i++) part[i - whole] += a[i] * b[i];
  memcpy(parts, part, sizeof part);
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

GX_CLONES double gx_vector_square(size_t n, const double *restrict weight, const double *restrict value)
{
  double part[LANES] = {0};
  size_t whole = n - n % LANES;
  for (size_t i = 0; i < whole; i += LANES)
    for (size_t k = 0; k < LANES; k++) part[k] += weight[i + k] * value[i + k] * value[i + k];
  for (size_t i = whole; i < n; i++) part[i - whole] += weight[i] * value[i] * value[i];
  return gx_vector_total(part);
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
