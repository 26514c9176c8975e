/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cases that a figure or an advice leaves out, and why. */
#ifndef GRIDCROSS_VIEW_LEFT_OUT_H
#define GRIDCROSS_VIEW_LEFT_OUT_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/status.h>
#include <gridcross/table.h>

/* Starts as {0}. */
struct gx_left_out {
  size_t ended[GX_STATUSES]; /* by how they ended */
  size_t empty;              /* no number, counted by the caller */
};

/* Whether the case of a row ended ok; if not, counts it. A table without result.status holds nothing but such cases. */
bool gx_left_out_try(struct gx_left_out *left_out, const struct gx_table *table, size_t row);
/* One line each for cases that did not end ok and for empty ones. */
void gx_left_out_tell(const struct gx_left_out *left_out, FILE *errors);
/* The same in one short line, "" when there are none; owned by the caller, NULL when memory runs out. */
char *gx_left_out_text(const struct gx_left_out *left_out);
/* Says that no case has a value in the column, and which results have some. */
void gx_left_out_suggest(const struct gx_table *table, const char *column, FILE *errors);

#endif
