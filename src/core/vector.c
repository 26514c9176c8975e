/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementwise updates, multiversioned. */
#include "vector.h"

#include "kernel.h"

GX_CLONES static void vector_add(size_t n, double scale, const double *restrict rate, double *restrict value)
{
  for (size_t i = 0; i < n; i++) value[i] += scale * rate[i];
}

void gx_vector_add(size_t n, double scale, const double *rate, double *value)
{
  vector_add(n, scale, rate, value);
}
