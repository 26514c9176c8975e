/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses axes and places each case in its cell. */
#include "pivot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "axes.h"
#include "join.h"
#include "sheet.h"

/* Axes along which an error has an order, and whether they refine upwards. */
static const struct {
  const char *path;
  bool upwards;
} refining[] = {{"mesh.cells", true}, {"time.dt", false}, {"time.cfl", false}};

/* Where every case has a value of them. */
static const char *const preferred_rows[] = {"mesh.cells", "time.dt", "time.cfl", "method.degree"};

static int no_memory(FILE *errors)
{
  fputs("gridcross: out of memory\n", errors);
  return -1;
}

static bool among(size_t column, size_t count, const size_t *list)
{
  for (size_t i = 0; i < count; i++)
    if (list[i] == column) return true;
  return false;
}

static bool has_null(const struct gx_table *table, size_t column)
{
  for (size_t r = 0; r < table->rows; r++)
    if (gx_table_get(table, r, column).type == GX_NULL) return true;
  return false;
}

static size_t default_rows(const struct gx_pivot *pivot)
{
  const struct gx_table *table = pivot->table;
  for (size_t i = 0; i < sizeof preferred_rows / sizeof *preferred_rows; i++) {
    long c = gx_table_find(table, preferred_rows[i]);
    if (c < 0 || !gx_axes_vary(table, (size_t)c) || among((size_t)c, pivot->axes, pivot->axis)) continue;
    if (!has_null(table, (size_t)c)) return (size_t)c;
  }
  for (size_t c = 0; c < table->columns; c++)
    if (gx_axes_parameter(table, c) && gx_axes_vary(table, c) && !among(c, pivot->axes, pivot->axis)) return c;
  long c = gx_table_find(table, preferred_rows[0]);
  return c >= 0 && !among((size_t)c, pivot->axes, pivot->axis) ? (size_t)c : table->columns - 1;
}

/* Every axis that is left, or an error where the user's columns leave one. axis has room for every column. */
static int fill_axes(struct gx_pivot *pivot, const struct gx_comparison *comparison, FILE *errors)
{
  size_t *all = calloc(pivot->table->columns + 1, sizeof *all);
  if (!all) return no_memory(errors);
  all[0] = pivot->row_axis;
  memcpy(all + 1, pivot->axis, pivot->axes * sizeof *all);
  long count = gx_axes_find(pivot->table, pivot->axes + 1, all);
  int failed = count < 0 ? no_memory(errors) : 0;
  size_t known = pivot->axes + 1;
  if (!failed && comparison->columns && !comparison->open && (size_t)count > known) {
    const char *left = pivot->table->column[all[known]].name;
    fprintf(errors, "gridcross: %s varies too: add --columns %s, or leave out --columns\n", left, left);
    failed = -1;
  }
  for (size_t i = known; !failed && i < (size_t)count; i++) pivot->axis[pivot->axes++] = all[i];
  free(all);
  return failed;
}

static int choose_axes(struct gx_pivot *pivot, const struct gx_comparison *comparison, FILE *errors)
{
  for (size_t i = 0; i < comparison->columns; i++) {
    long c = gx_join_find(pivot->table, comparison->column[i], true, errors);
    if (c < 0) return -1;
    if (!among((size_t)c, pivot->axes, pivot->axis)) pivot->axis[pivot->axes++] = (size_t)c;
  }
  long rows = comparison->rows ? gx_join_find(pivot->table, comparison->rows, true, errors) : (long)default_rows(pivot);
  if (rows < 0) return -1;
  pivot->row_axis = (size_t)rows;
  if (among(pivot->row_axis, pivot->axes, pivot->axis)) {
    fprintf(errors, "gridcross: %s cannot be both rows and columns\n", pivot->table->column[rows].name);
    return -1;
  }
  return fill_axes(pivot, comparison, errors);
}

static int choose_values(struct gx_pivot *pivot, const struct gx_comparison *comparison, FILE *errors)
{
  static const char *const standard[] = {"result.displacement.max.rms"};
  pivot->values = comparison->values ? comparison->values : 1;
  const char *const *name = comparison->values ? comparison->value : standard;
  pivot->value = calloc(pivot->values, sizeof *pivot->value);
  if (!pivot->value) return no_memory(errors);
  for (size_t v = 0; v < pivot->values; v++) {
    long c = gx_join_find(pivot->table, name[v], false, errors);
    if (c < 0) return -1;
    pivot->value[v] = (size_t)c;
  }
  return 0;
}

/* Rows are ordered so that refinement goes down the page. */
static bool descends(const struct gx_pivot *pivot)
{
  for (size_t i = 0; i < sizeof refining / sizeof *refining; i++)
    if (!strcmp(refining[i].path, pivot->table->column[pivot->row_axis].name)) return !refining[i].upwards;
  return false;
}

/* scratch: [3][table->rows] */
static int place(struct gx_pivot *pivot, size_t *scratch, FILE *errors)
{
  const struct gx_table *table = pivot->table;
  size_t n = table->rows, *row = scratch, *column = scratch + n, *rank = scratch + 2 * n;
  long rows = gx_axes_rank(table, pivot->row_axis, row), columns = n ? 1 : 0;
  for (size_t i = 0; i < pivot->axes && columns >= 0; i++)
    columns = gx_axes_rank(table, pivot->axis[i], rank) < 0 ? -1 : gx_axes_refine(n, column, rank);
  if (rows < 0 || columns < 0) return no_memory(errors);
  pivot->rows = (size_t)rows;
  pivot->columns = (size_t)columns;
  pivot->row_sample = calloc(pivot->rows + 1, sizeof *pivot->row_sample);
  pivot->column_sample = calloc(pivot->columns + 1, sizeof *pivot->column_sample);
  pivot->cell = calloc(pivot->rows * pivot->columns + 1, sizeof *pivot->cell);
  if (!pivot->row_sample || !pivot->column_sample || !pivot->cell) return no_memory(errors);
  for (size_t i = 0; i < pivot->rows * pivot->columns; i++) pivot->cell[i] = -1;
  bool down = descends(pivot);
  for (size_t r = 0; r < n; r++) {
    if (down) row[r] = pivot->rows - 1 - row[r];
    pivot->row_sample[row[r]] = r;
    pivot->column_sample[column[r]] = r;
    long *cell = &pivot->cell[row[r] * pivot->columns + column[r]];
    if (*cell >= 0) {
      fputs("gridcross: a case is there twice: was a study named twice?\n", errors);
      return -1;
    }
    *cell = (long)r;
  }
  return 0;
}

struct gx_pivot *gx_pivot_create(const struct gx_comparison *comparison, FILE *errors)
{
  struct gx_pivot *pivot = calloc(1, sizeof *pivot);
  if (!pivot || !(pivot->table = gx_join_tables(comparison->studies, comparison->table, comparison->name)) ||
      !(pivot->axis = calloc(pivot->table->columns + 1, sizeof *pivot->axis))) {
    no_memory(errors);
    gx_pivot_free(pivot);
    return NULL;
  }
  int failed = choose_axes(pivot, comparison, errors);
  if (!failed) failed = choose_values(pivot, comparison, errors);
  if (!failed) {
    size_t *scratch = calloc(3 * pivot->table->rows + 1, sizeof *scratch);
    failed = scratch ? place(pivot, scratch, errors) : no_memory(errors);
    free(scratch);
  }
  if (!failed) return pivot;
  gx_pivot_free(pivot);
  return NULL;
}

void gx_pivot_free(struct gx_pivot *pivot)
{
  if (!pivot) return;
  gx_table_free(pivot->table);
  free(pivot->axis);
  free(pivot->value);
  free(pivot->row_sample);
  free(pivot->column_sample);
  free(pivot->cell);
  free(pivot);
}

bool gx_pivot_ok(const struct gx_pivot *pivot, long table_row, size_t column)
{
  static const char budget[] = "result.budget.";
  long c = gx_table_find(pivot->table, "result.status");
  bool measured = !strncmp(pivot->table->column[column].name, budget, sizeof budget - 1);
  if (c < 0 || table_row < 0 || measured) return table_row >= 0;
  struct gx_value status = gx_table_get(pivot->table, (size_t)table_row, (size_t)c);
  return status.type != GX_TEXT || !strcmp(status.text, "ok");
}

bool gx_pivot_ordered(const struct gx_pivot *pivot, size_t v)
{
  if (pivot->rows < 2 || !gx_sheet_error_like(pivot->table->column[pivot->value[v]].name)) return false;
  for (size_t i = 0; i < sizeof refining / sizeof *refining; i++)
    if (!strcmp(refining[i].path, pivot->table->column[pivot->row_axis].name)) return true;
  return false;
}

double gx_pivot_number(const struct gx_pivot *pivot, long table_row, size_t column)
{
  return gx_value_number(gx_table_get(pivot->table, (size_t)table_row, column));
}

double gx_pivot_order(const struct gx_pivot *pivot, size_t v, size_t row, size_t column)
{
  long here = pivot->cell[row * pivot->columns + column], above = -1;
  while (above < 0 && row > 0) above = pivot->cell[--row * pivot->columns + column];
  if (!gx_pivot_ordered(pivot, v) || !gx_pivot_ok(pivot, here, pivot->value[v]) || !gx_pivot_ok(pivot, above, pivot->value[v]))
    return NAN;
  double e1 = gx_pivot_number(pivot, above, pivot->value[v]), e2 = gx_pivot_number(pivot, here, pivot->value[v]);
  double h1 = gx_pivot_number(pivot, above, pivot->row_axis), h2 = gx_pivot_number(pivot, here, pivot->row_axis);
  if (!(e1 > 0 && e2 > 0 && h1 > 0 && h2 > 0)) return NAN;
  double order = log(e1 / e2) / log(h1 / h2);
  return descends(pivot) ? order : -order;
}
