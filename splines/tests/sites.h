/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sites that tests share: jittered by a generator of their own, so that they are the same everywhere. */
#ifndef GRIDCROSS_SPLINES_TESTS_SITES_H
#define GRIDCROSS_SPLINES_TESTS_SITES_H

#include <stddef.h>
#include <stdint.h>

/* in [0, 1) */
static inline double random_number(uint64_t *state)
{
  *state = *state * 6364136223846793005U + 1442695040888963407U;
  return (double)(*state >> 11) / 9007199254740992.0;
}

/* n increasing sites inside (low, high), one a cell, anywhere in the middle `spread` of it. */
static inline void jittered_sites(size_t n, double low, double high, double spread, uint64_t *state, double *site)
{
  for (size_t i = 0; i < n; i++)
    site[i] = low + (high - low) * ((double)i + 0.5 + spread * (random_number(state) - 0.5)) / (double)n;
}

#endif
