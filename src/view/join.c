/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joins studies column by column, by name. */
#include "join.h"

#include <string.h>

#include "../core/nearest.h"
#include "axes.h"

int gx_join_check(size_t studies, const char *const *name, FILE *errors)
{
  for (size_t s = 0; s < studies; s++)
    for (size_t before = 0; before < s; before++) {
      if (strcmp(name[s], name[before])) continue;
      fprintf(errors, "gridcross: two studies are called %s: was one named twice?\n", name[s]);
      return -1;
    }
  return 0;
}

static size_t count_columns(size_t studies, const struct gx_table *const *table)
{
  size_t count = 0;
  for (size_t s = 0; s < studies; s++)
    for (size_t c = 0; c < table[s]->columns; c++) {
      bool known = false;
      for (size_t before = 0; before < s && !known; before++) known = gx_table_find(table[before], table[s]->column[c].name) >= 0;
      count += !known;
    }
  return count;
}

struct gx_table *gx_join_tables(size_t studies, const struct gx_table *const *table, const char *const *name)
{
  size_t rows = 0, columns = 0, at = 0, study = count_columns(studies, table);
  for (size_t s = 0; s < studies; s++) rows += table[s]->rows;
  struct gx_table *joined = gx_table_create(study + 1, rows);
  int failed = !joined || gx_table_column(joined, study, "study", "", GX_TEXT);
  for (size_t s = 0; s < studies && !failed; s++) {
    const struct gx_table *one = table[s];
    for (size_t c = 0; c < one->columns && !failed; c++) {
      const struct gx_column *column = &one->column[c];
      long to = gx_table_find(joined, column->name);
      if (to < 0) {
        to = (long)columns++;
        failed = gx_table_column_like(joined, (size_t)to, column);
      }
      for (size_t r = 0; r < one->rows && !failed; r++)
        failed = gx_table_set(joined, at + r, (size_t)to, gx_table_get(one, r, c));
    }
    struct gx_value value = {.type = GX_TEXT, .text = name[s]};
    for (size_t r = 0; r < one->rows && !failed; r++) failed = gx_table_set(joined, at + r, study, value);
    at += one->rows;
  }
  if (!failed) return joined;
  gx_table_free(joined);
  return NULL;
}

static void name_candidates(const struct gx_table *table, const char *name, bool parameter, FILE *errors)
{
  struct gx_nearest near = {.word = name};
  const char *meant = NULL;
  for (size_t c = 0; c < table->columns; c++) {
    const char *column = table->column[c].name;
    size_t n = strlen(name), m = strlen(column);
    if (parameter && !gx_axes_parameter(table, c)) continue;
    gx_nearest_try(&near, column);
    bool tail = n && m > n && column[m - n - 1] == '.' && !strcmp(column + m - n, name);
    if (tail) meant = column;
  }
  if (!meant && *near.best) meant = near.best;
  if (meant)
    fprintf(errors, ": did you mean %s?", meant);
  else if (!parameter)
    fputs("; the first line of the study's table.csv names all", errors);
  const char *gap = "; what varies here: ";
  for (size_t c = 0; c < table->columns && parameter; c++)
    if (gx_axes_parameter(table, c) && gx_axes_vary(table, c)) {
      fprintf(errors, "%s%s", gap, table->column[c].name);
      gap = ", ";
    }
}

long gx_join_find(const struct gx_table *joined, const char *name, bool parameter, FILE *errors)
{
  long c = gx_table_find(joined, name);
  if (c >= 0 && (!parameter || gx_axes_parameter(joined, (size_t)c))) return c;
  fprintf(errors, "gridcross: no %s '%s'", parameter ? "parameter" : "column", name);
  name_candidates(joined, name, parameter, errors);
  putc('\n', errors);
  return -1;
}
