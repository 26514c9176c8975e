/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Zeroed memory for arrays that kernels stream through, aligned to a cache line. Pages that nobody touches cost nothing. */
#ifndef GRIDCROSS_CORE_ALIGNED_H
#define GRIDCROSS_CORE_ALIGNED_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

enum { GX_CACHE_LINE = 64 };

/* Sets *block to what free() takes; returns the aligned start of `bytes` zeros, or NULL. */
static inline void *gx_aligned_zeros(size_t bytes, void **block)
{
  *block = bytes <= SIZE_MAX - GX_CACHE_LINE ? calloc(bytes + GX_CACHE_LINE, 1) : NULL;
  if (!*block) return NULL;
  size_t past = (uintptr_t)*block % GX_CACHE_LINE;
  return (char *)*block + (past ? GX_CACHE_LINE - past : 0);
}

#endif
