/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error-cost front of a table: the cases than which none is both cheaper and more accurate. */
#ifndef GRIDCROSS_VIEW_FRONT_H
#define GRIDCROSS_VIEW_FRONT_H

#include <stdio.h>

#include <gridcross/table.h>

#include "left_out.h"

struct gx_front {
  const struct gx_table *table; /* borrowed */
  size_t error, cost;           /* columns */
  size_t cases, *row;           /* rows that count: ended ok, of a stable step, with an error and a cost; cheapest first; owned */
  size_t members, *member;      /* those of the front, so in order of rising cost and falling error; owned */
  size_t above, *above_row;     /* rows whose step is above the stable one: what has not grown yet may; cheapest first; owned */
  struct gx_left_out left_out;  /* the others; empty: no error */
  size_t untimed;               /* no cost */
};

/* error, cost: names of columns. Returns 0, or -1 after a message; to be freed in either case. */
int gx_front_find(struct gx_front *front, const struct gx_table *table, const char *error, const char *cost, FILE *errors);
void gx_front_free(struct gx_front *front);
double gx_front_error(const struct gx_front *front, size_t row);
double gx_front_cost(const struct gx_front *front, size_t row);
/* dt over the largest stable step; NaN: unknown. */
double gx_front_share(const struct gx_front *front, size_t row);
/* The member that meets an error at the least cost, a row of the table; -1: none does. */
long gx_front_pick(const struct gx_front *front, double bound);
/* Says which cases do not count, and why. */
void gx_front_tell(const struct gx_front *front, FILE *errors);

#endif
