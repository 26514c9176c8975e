/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eight doubles at once: where the processor permutes them across a whole vector (AVX-512). */
#include "line_pass.h"

#include "../core/kernel.h"

#if GX_HAVE_CLONES > 1

#define WIDTH 8
#define PASS

typedef double vec __attribute__((vector_size(64)));
typedef long long ints __attribute__((vector_size(64)));
typedef int indices __attribute__((vector_size(32)));

/* Of whole numbers. */
#define TO_INDICES(vector) ((indices)_mm512_cvttpd_epi32(vector))
/* As a > b ? a : b and a < b ? a : b. */
#define LARGEST(a, b) _mm512_max_pd(a, b)
#define LEAST(a, b)   _mm512_min_pd(a, b)

#include <immintrin.h>
#include <string.h>

#include "../bases/gimp.h"

#pragma GCC target("arch=x86-64-v4")

GX_CORE void whole_below(const vec *x, vec *whole)
{
  *whole = _mm512_roundscale_pd(*x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}

/* Row s of [m v f f] of particles 0, 2, 4, 6, then 1, 3, 5, 7. */
GX_CORE void interleave(const vec *mass, const vec *moment, const vec *force, size_t h, double *records)
{
  (void)h;
  const vec even = __builtin_shufflevector(*mass, *moment, 0, 8, 2, 10, 4, 12, 6, 14);
  const vec odd = __builtin_shufflevector(*mass, *moment, 1, 9, 3, 11, 5, 13, 7, 15);
  const vec row0 = __builtin_shufflevector(even, *force, 0, 1, 8, 8, 2, 3, 10, 10);
  const vec row1 = __builtin_shufflevector(even, *force, 4, 5, 12, 12, 6, 7, 14, 14);
  const vec row2 = __builtin_shufflevector(odd, *force, 0, 1, 9, 9, 2, 3, 11, 11);
  const vec row3 = __builtin_shufflevector(odd, *force, 4, 5, 13, 13, 6, 7, 15, 15);
  memcpy(records, &row0, sizeof row0);
  memcpy(records + WIDTH, &row1, sizeof row1);
  memcpy(records + 2 * WIDTH, &row2, sizeof row2);
  memcpy(records + 3 * WIDTH, &row3, sizeof row3);
}

GX_CORE void deinterleave(const double *records, vec *mass, vec *moment, vec *force)
{
  vec row0, row1, row2, row3;
  memcpy(&row0, records, sizeof row0);
  memcpy(&row1, records + WIDTH, sizeof row1);
  memcpy(&row2, records + 2 * WIDTH, sizeof row2);
  memcpy(&row3, records + 3 * WIDTH, sizeof row3);
  const vec low = __builtin_shufflevector(row0, row1, 0, 4, 8, 12, 1, 5, 9, 13);
  const vec high = __builtin_shufflevector(row2, row3, 0, 4, 8, 12, 1, 5, 9, 13);
  const vec low_force = __builtin_shufflevector(row0, row1, 2, 6, 10, 14, 2, 6, 10, 14);
  const vec high_force = __builtin_shufflevector(row2, row3, 2, 6, 10, 14, 2, 6, 10, 14);
  *mass = __builtin_shufflevector(low, high, 0, 1, 2, 3, 8, 9, 10, 11);
  *moment = __builtin_shufflevector(low, high, 4, 5, 6, 7, 12, 13, 14, 15);
  *force = __builtin_shufflevector(low_force, high_force, 0, 1, 2, 3, 8, 9, 10, 11);
}

/* Whether a window of nodes holds all that the block meets. */
GX_CORE bool is_within(const int *first, const int support)
{
  indices index;
  memcpy(&index, first, sizeof index);
  index = index - *first;
  const indices last = index + (support - 1), beyond = (indices){0} + ~(GX_LINE_WINDOW - 1);
  return _mm256_testz_si256((__m256i)(index | last), (__m256i)beyond);
}

/* value[k] = field[first[k] + s] */
GX_CORE void look_up(const int *first, const bool within, int s, const double *field, vec *value)
{
  if (!within) {
    double each[WIDTH];
    for (int k = 0; k < WIDTH; k++) each[k] = field[first[k] + s];
    memcpy(value, each, sizeof each);
    return;
  }
  const int base = *first;
  indices index;
  vec low, high;
  memcpy(&index, first, sizeof index);
  index = index - base + s;
  memcpy(&low, field + base, sizeof low);
  memcpy(&high, field + base + WIDTH, sizeof high);
  *value = __builtin_shuffle(low, high, (ints)_mm512_cvtepi32_epi64((__m256i)index));
}

#include "line_core.h"

const struct gx_line_passes gx_line_wide_passes = {weigh, scatter, divide, advance, gather};

bool gx_line_wide_supported(void)
{
  __builtin_cpu_init();
  return __builtin_cpu_supports("x86-64-v4");
}

#else

const struct gx_line_passes gx_line_wide_passes;

bool gx_line_wide_supported(void)
{
  return false;
}

#endif
