/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Four doubles at once: everywhere. */
#include "line_pass.h"

#include "../core/kernel.h"

#define WIDTH 4
#define PASS  GX_CLONES

typedef double vec __attribute__((vector_size(32)));
typedef long long ints __attribute__((vector_size(32)));
typedef int indices __attribute__((vector_size(16)));

#define TO_INDICES(vector) __builtin_convertvector(vector, indices)
/* a > b ? a : b and a < b ? a : b */
#define LARGEST(a, b) ((vec)(((ints)(a) & ((a) > (b))) | ((ints)(b) & ~((a) > (b)))))
#define LEAST(a, b)   ((vec)(((ints)(a) & ((a) < (b))) | ((ints)(b) & ~((a) < (b)))))

#include <string.h>

GX_CORE void whole_below(const vec *x, vec *whole)
{
  const vec near = __builtin_convertvector(TO_INDICES(*x), vec), one = (vec){0} + 1;
  const ints above = near > *x;
  *whole = near - (vec)((ints)one & above);
}

/* Of particles h, h + 2, then h + 1, h + 3; each half of a block where the whole has them. */
GX_CORE void interleave(const vec *mass, const vec *moment, const vec *force, size_t h, double *records)
{
  const vec even = __builtin_shufflevector(*mass, *moment, 0, 4, 2, 6);
  const vec odd = __builtin_shufflevector(*mass, *moment, 1, 5, 3, 7);
  const vec row0 = __builtin_shufflevector(even, *force, 0, 1, 4, 4), row1 = __builtin_shufflevector(even, *force, 2, 3, 6, 6);
  const vec row2 = __builtin_shufflevector(odd, *force, 0, 1, 5, 5), row3 = __builtin_shufflevector(odd, *force, 2, 3, 7, 7);
  records += h / 2 * WIDTH;
  memcpy(records, &row0, sizeof row0);
  memcpy(records + WIDTH, &row1, sizeof row1);
  memcpy(records + 4 * WIDTH, &row2, sizeof row2);
  memcpy(records + 5 * WIDTH, &row3, sizeof row3);
}

GX_CORE void deinterleave(const double *records, vec *mass, vec *moment, vec *force)
{
  vec row0, row1, row2, row3;
  memcpy(&row0, records, sizeof row0);
  memcpy(&row1, records + WIDTH, sizeof row1);
  memcpy(&row2, records + 2 * WIDTH, sizeof row2);
  memcpy(&row3, records + 3 * WIDTH, sizeof row3);
  const vec a = __builtin_shufflevector(row0, row1, 0, 4, 1, 5), b = __builtin_shufflevector(row2, row3, 0, 4, 1, 5);
  *mass = __builtin_shufflevector(a, b, 0, 1, 4, 5);
  *moment = __builtin_shufflevector(a, b, 2, 3, 6, 7);
  const vec c = __builtin_shufflevector(row0, row1, 2, 6, 2, 6), d = __builtin_shufflevector(row2, row3, 2, 6, 2, 6);
  *force = __builtin_shufflevector(c, d, 0, 1, 4, 5);
}

GX_CORE bool is_within(const int *first, const int support)
{
  (void)first;
  (void)support;
  return true;
}

/* value[k] = field[first[k] + s] */
GX_CORE void look_up(const int *first, const bool within, int s, const double *field, vec *value)
{
  (void)within;
  *value = (vec){field[first[0] + s], field[first[1] + s], field[first[2] + s], field[first[3] + s]};
}

#include "line_core.h"

const struct gx_line_passes gx_line_narrow_passes = {weigh, scatter, divide, advance, gather};
