/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Zeroed memory for arrays that kernels stream through, aligned to a cache line. */
#ifndef GRIDCROSS_CORE_ALIGNED_H
#define GRIDCROSS_CORE_ALIGNED_H

#include <stddef.h>
#include <stdint.h>

#include "large.h"

enum { GX_CACHE_LINE = 64 };

/* Sets *block to what free() takes; returns the aligned start of `bytes` zeros, or NULL. */
static inline void *gx_aligned_zeros(size_t bytes, void **block)
{
  *block = bytes <= SIZE_MAX - GX_CACHE_LINE ? gx_large_zeros(bytes + GX_CACHE_LINE) : NULL;
  if (!*block) return NULL;
  size_t past = (uintptr_t)*block % GX_CACHE_LINE;
  return (char *)*block + (past ? GX_CACHE_LINE - past : 0);
}

/* Hands out `count` arrays of `length` doubles from `at`, an aligned start; NULL: only counts. Returns how many doubles they take. A
 * cache line between two arrays keeps arrays whose length is a power of two out of the same cache set. */
static inline size_t gx_aligned_place(double **array, int count, size_t length, double *at)
{
  const size_t line = GX_CACHE_LINE / sizeof(double), stride = (length + line - 1) / line * line + line;
  for (int i = 0; at && i < count; i++) array[i] = at + (size_t)i * stride;
  return (size_t)count * stride;
}

#endif
