/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A table turned so that one axis runs down and the others run across. */
#ifndef GRIDCROSS_VIEW_PIVOT_H
#define GRIDCROSS_VIEW_PIVOT_H

#include <stdbool.h>

#include <gridcross/compare.h>

struct gx_pivot {
  struct gx_table *table; /* the studies joined, with a last column `study`; owned */
  size_t row_axis;        /* column of table */
  size_t axes, *axis;     /* columns of table that run across, owned */
  size_t values, *value;  /* columns of table to show, owned */
  size_t rows, columns;
  size_t *row_sample;    /* [rows] a table row that has the row's value, owned */
  size_t *column_sample; /* [columns] a table row that has the column's values, owned */
  long *cell;            /* [rows][columns] table row, -1: no such case; owned */
};

/* NULL after a message to `errors`. */
struct gx_pivot *gx_pivot_create(const struct gx_comparison *comparison, FILE *errors);
void gx_pivot_free(struct gx_pivot *pivot);
/* An entry of the table as a number; NaN: null or text. */
double gx_pivot_number(const struct gx_pivot *pivot, long table_row, size_t column);
/* Whether orders of values[v] have a meaning. */
bool gx_pivot_ordered(const struct gx_pivot *pivot, size_t v);
/* Observed order of values[v] between this row and the last one above that has such a case; NaN: none. */
double gx_pivot_order(const struct gx_pivot *pivot, size_t v, size_t row, size_t column);
/* Whether the case in this table row ended ok, or else the column is of the budget: that is taken before the step that may fail. */
bool gx_pivot_ok(const struct gx_pivot *pivot, long table_row, size_t column);

#endif
