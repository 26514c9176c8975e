/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies side by side: rows along one axis, columns along the others, orders between rows that refine. */
#ifndef GRIDCROSS_COMPARE_H
#define GRIDCROSS_COMPARE_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/page.h>
#include <gridcross/table.h>

struct gx_comparison {
  size_t studies;
  const struct gx_table *const *table; /* [studies], borrowed */
  const char *const *name;             /* [studies] values of the axis `study`, which joins where a case is in two studies */
  const char *rows; /* path; NULL: of mesh.cells, time.dt, time.cfl, method.degree, any: the first that varies */
  size_t columns;
  const char *const *column; /* [columns] paths; none: every axis that is left */
  bool open;                 /* every other axis follows the columns; else a column that is missing is an error */
  size_t values;
  const char *const *value; /* [values] column names; none: result.displacement.max.rms */
};

/* Aligned tables, one a value; blocks of columns where they are wider than the page, or in a file than 100 characters. What is best
 * when least, errors and cost, has the least of each row marked: bold, or by an asterisk where the page has no attributes. The observed order between a row and the one
 * before is log(e1/e2)/log(h1/h2) with h = 1/mesh.cells, time.dt or time.cfl, for errors and energies of cases that ended ok.
 * Returns 0, or -1 after a message to `errors`. */
int gx_compare_print(const struct gx_comparison *comparison, const struct gx_page *page, FILE *out, FILE *errors);

/* The same, one row a case: the row axis, the column axes, result.status, and each value with its order
 * ("result.displacement.max.rms.order"). NULL after a message. */
struct gx_table *gx_compare_table(const struct gx_comparison *comparison, FILE *errors);

#endif
