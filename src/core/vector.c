/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementwise updates, multiversioned. */
#include "vector.h"

#include "kernel.h"

GX_CLONES void gx_vector_add(size_t n, double scale, const double *restrict rate, double *restrict value)
{
  for (size_t i = 0; i < n; i++) value[i] += scale * rate[i];
}
