/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies side by side, for people and for programs. */
#include <gridcross/compare.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "left_out.h"
#include "pivot.h"
#include "sheet.h"

enum { PAGE = 100, GAP = 3, ORDER = 8 };
static const char bold[] = "\033[1m", plain[] = "\033[0m";

/* What one value of a pivot looks like. */
struct layout {
  const struct gx_pivot *pivot;
  size_t v;
  bool ordered;
  bool marked;     /* the best of some row is */
  bool attributes; /* by them, else by an asterisk */
  int row_width, value_width, order_width, group_width;
};

static const char *axis_label(const struct gx_pivot *pivot, size_t axis, size_t column, char text[GX_SHEET_LABEL])
{
  return gx_sheet_label(pivot->table, pivot->axis[axis], pivot->column_sample[column], text);
}

static const char *row_label(const struct gx_pivot *pivot, size_t row, char buffer[GX_NUMBER_LENGTH])
{
  const char *name = pivot->table->column[pivot->row_axis].name;
  return gx_sheet_text(name, gx_table_get(pivot->table, pivot->row_sample[row], pivot->row_axis), buffer);
}

/* The value, or why there is none. */
static const char *cell_text(const struct layout *at, size_t row, size_t column, char buffer[GX_NUMBER_LENGTH])
{
  const struct gx_table *table = at->pivot->table;
  long here = at->pivot->cell[row * at->pivot->columns + column];
  size_t c = at->pivot->value[at->v];
  if (here < 0) return "";
  if (!gx_pivot_ok(at->pivot, here, c) && table->column[c].type != GX_TEXT) c = (size_t)gx_table_find(table, "result.status");
  return gx_sheet_text(table->column[c].name, gx_table_get(table, (size_t)here, c), buffer);
}

static const char *order_text(const struct layout *at, size_t row, size_t column, char text[ORDER])
{
  double order = gx_pivot_order(at->pivot, at->v, row, column);
  if (isnan(order))
    text[0] = '\0';
  else
    snprintf(text, ORDER, "%.2f", fabs(order) < 0.005 ? 0 : fmin(fmax(order, -99), 99));
  return text;
}

/* The least absolute value of a row, where that is best and there is a choice; NaN: none. */
static double best_of(const struct gx_pivot *pivot, size_t v, size_t row)
{
  double best = NAN;
  size_t choices = 0;
  if (!gx_sheet_least_is_best(pivot->table->column[pivot->value[v]].name)) return NAN;
  for (size_t c = 0; c < pivot->columns; c++) {
    long cell = pivot->cell[row * pivot->columns + c];
    double value = gx_pivot_ok(pivot, cell, pivot->value[v]) ? fabs(gx_pivot_number(pivot, cell, pivot->value[v])) : NAN;
    if (!isnan(value)) choices++;
    best = fmin(best, value);
  }
  return choices > 1 ? best : NAN;
}

static bool is_best(const struct layout *at, size_t row, size_t column)
{
  const struct gx_pivot *pivot = at->pivot;
  long cell = pivot->cell[row * pivot->columns + column];
  if (!at->marked || !gx_pivot_ok(pivot, cell, pivot->value[at->v])) return false;
  return fabs(gx_pivot_number(pivot, cell, pivot->value[at->v])) == best_of(pivot, at->v, row);
}

/* After the value, where the order or the next column stands apart from it. */
static int mark_width(const struct layout *at)
{
  return at->marked && !at->attributes;
}

static void widen(int *width, const char *text)
{
  int w = gx_sheet_width(text);
  if (w > *width) *width = w;
}

static struct layout measure(const struct gx_pivot *pivot, size_t v, const struct gx_page *page)
{
  struct layout at = {.pivot = pivot, .v = v, .ordered = gx_pivot_ordered(pivot, v), .attributes = page->attributes};
  for (size_t r = 0; r < pivot->rows && !at.marked; r++) at.marked = !isnan(best_of(pivot, v, r));
  char buffer[GX_NUMBER_LENGTH], label[GX_SHEET_LABEL];
  widen(&at.row_width, pivot->table->column[pivot->row_axis].name);
  if (at.ordered) at.order_width = (int)strlen("order");
  for (size_t r = 0; r < pivot->rows; r++) {
    widen(&at.row_width, row_label(pivot, r, buffer));
    for (size_t c = 0; c < pivot->columns; c++) {
      widen(&at.value_width, cell_text(&at, r, c, buffer));
      if (at.ordered) widen(&at.order_width, order_text(&at, r, c, label));
    }
  }
  at.value_width += mark_width(&at);
  at.group_width = at.value_width + (at.ordered ? 1 + at.order_width : 0);
  for (size_t a = 0; a < pivot->axes; a++)
    for (size_t c = 0; c < pivot->columns; c++) widen(&at.group_width, axis_label(pivot, a, c, label));
  at.value_width = at.group_width - (at.ordered ? 1 + at.order_width : 0);
  return at;
}

/* Labels of one axis after the lead; a label stands once over neighbours that share it and all labels above it. */
static void print_labels(const struct layout *at, const char *lead, size_t axis, size_t from, size_t to, FILE *out)
{
  bool innermost = axis + 1 == at->pivot->axes, right = innermost && !at->ordered;
  int skipped = at->row_width - gx_sheet_width(lead);
  fputs(lead, out);
  for (size_t c = from; c < to; c++) {
    char label[GX_SHEET_LABEL], before[GX_SHEET_LABEL];
    bool same = c > from && !innermost;
    for (size_t a = 0; a <= axis && same; a++)
      same = !strcmp(axis_label(at->pivot, a, c, label), axis_label(at->pivot, a, c - 1, before));
    axis_label(at->pivot, axis, c, label);
    skipped += GAP;
    if (same || !*label) {
      skipped += at->group_width;
      continue;
    }
    fprintf(out, "%*s", skipped, "");
    gx_sheet_pad(label, right ? at->group_width : 0, right, out);
    skipped = right ? 0 : at->group_width - gx_sheet_width(label);
  }
  putc('\n', out);
}

static bool any_label(const struct gx_pivot *pivot, size_t axis, size_t from, size_t to)
{
  char label[GX_SHEET_LABEL];
  for (size_t c = from; c < to; c++)
    if (*axis_label(pivot, axis, c, label)) return true;
  return false;
}

/* Text at the right of a field whose left is filled with the blanks still owed. Blanks at the end of a line are never printed. */
static void print_right(const char *text, int width, int *owed, FILE *out)
{
  *owed += width - gx_sheet_width(text);
  if (!*text) return;
  fprintf(out, "%*s%s", *owed, "", text);
  *owed = 0;
}

static void print_cell(const struct layout *at, size_t row, size_t column, int *owed, FILE *out)
{
  char buffer[GX_NUMBER_LENGTH];
  const char *text = cell_text(at, row, column, buffer);
  bool best = is_best(at, row, column);
  int mark = mark_width(at), width = GAP + at->value_width - mark;
  if (best && at->attributes) {
    *owed += width - gx_sheet_width(text);
    fprintf(out, "%*s%s%s%s", *owed, "", bold, text, plain);
    *owed = 0;
    return;
  }
  print_right(text, width, owed, out);
  if (best)
    putc('*', out);
  else
    *owed += mark;
}

static void print_block(const struct layout *at, size_t from, size_t to, FILE *out)
{
  const struct gx_pivot *pivot = at->pivot;
  char buffer[GX_NUMBER_LENGTH], order[ORDER];
  const char *name = pivot->table->column[pivot->row_axis].name;
  bool right = pivot->table->column[pivot->row_axis].type != GX_TEXT, named = false;
  int owed = 0;
  for (size_t a = 0; a < pivot->axes; a++) {
    bool last = !at->ordered && a + 1 == pivot->axes;
    if (!last && !any_label(pivot, a, from, to)) continue;
    print_labels(at, last ? name : "", a, from, to, out);
    named = last;
  }
  if (!named) fputs(name, out);
  if (at->ordered) owed = at->row_width - gx_sheet_width(name);
  for (size_t c = from; c < to && at->ordered; c++) print_right("order", GAP + at->group_width, &owed, out);
  if (!named) putc('\n', out);
  for (size_t r = 0; r < pivot->rows; r++) {
    gx_sheet_pad(row_label(pivot, r, buffer), at->row_width, right, out);
    owed = 0;
    for (size_t c = from; c < to; c++) {
      print_cell(at, r, c, &owed, out);
      if (at->ordered) print_right(order_text(at, r, c, order), 1 + at->order_width, &owed, out);
    }
    putc('\n', out);
  }
}

/* End of the block that begins at `from` and holds at most `fit` columns: where the outermost axis changes that changes there. */
static size_t block_end(const struct gx_pivot *pivot, size_t from, size_t fit)
{
  size_t end = from + fit, best = pivot->axes;
  if (end >= pivot->columns) return pivot->columns;
  size_t at = end;
  for (size_t c = from + 1; c <= end; c++) {
    char label[GX_SHEET_LABEL], before[GX_SHEET_LABEL];
    size_t axis = 0;
    while (axis < pivot->axes && !strcmp(axis_label(pivot, axis, c, label), axis_label(pivot, axis, c - 1, before))) axis++;
    if (axis > best) continue;
    best = axis;
    at = c;
  }
  return at;
}

/* Whether cases ended ok, and none of them has the value. */
static bool is_empty(const struct gx_pivot *pivot, size_t v)
{
  size_t ok = 0;
  for (size_t i = 0; i < pivot->rows * pivot->columns; i++) {
    if (pivot->cell[i] < 0 || !gx_pivot_ok(pivot, pivot->cell[i], pivot->value[v])) continue;
    if (gx_table_get(pivot->table, (size_t)pivot->cell[i], pivot->value[v]).type != GX_NULL) return false;
    ok++;
  }
  return ok;
}

static void print_value(const struct gx_pivot *pivot, size_t v, const struct gx_page *page, FILE *out)
{
  const struct gx_column *column = &pivot->table->column[pivot->value[v]];
  struct layout at = measure(pivot, v, page);
  int fit = ((page->width ? page->width : PAGE) - at.row_width) / (GAP + at.group_width);
  fprintf(out, v ? "\n%s" : "%s", column->name);
  if (*column->unit) fprintf(out, " [%s]", column->unit);
  if (at.marked && at.attributes) fprintf(out, ", the least of each row %sbold%s", bold, plain);
  fputs(at.marked && !at.attributes ? ", * the least of its row\n" : "\n", out);
  for (size_t from = 0, to; from < pivot->columns; from = to) {
    to = block_end(pivot, from, fit > 0 ? (size_t)fit : 1);
    putc('\n', out);
    print_block(&at, from, to, out);
  }
}

int gx_compare_print(const struct gx_comparison *comparison, const struct gx_page *page, FILE *out, FILE *errors)
{
  struct gx_pivot *pivot = gx_pivot_create(comparison, errors);
  if (!pivot) return -1;
  for (size_t v = 0; v < pivot->values; v++) {
    print_value(pivot, v, page, out);
    if (is_empty(pivot, v)) gx_left_out_suggest(pivot->table, pivot->table->column[pivot->value[v]].name, errors);
  }
  gx_pivot_free(pivot);
  return 0;
}

static int copy_column(struct gx_table *to, size_t column, const struct gx_pivot *pivot, size_t from)
{
  const struct gx_column *source = &pivot->table->column[from];
  int failed = gx_table_column(to, column, source->name, source->unit, source->type);
  size_t row = 0;
  for (size_t i = 0; i < pivot->rows * pivot->columns; i++)
    if (pivot->cell[i] >= 0 && !failed)
      failed = gx_table_set(to, row++, column, gx_table_get(pivot->table, (size_t)pivot->cell[i], from));
  return failed;
}

static int order_column(struct gx_table *to, size_t column, const struct gx_pivot *pivot, size_t v)
{
  char name[GX_SHEET_LABEL];
  snprintf(name, sizeof name, "%s.order", pivot->table->column[pivot->value[v]].name);
  int failed = gx_table_column(to, column, name, "", GX_REAL);
  size_t row = 0;
  for (size_t i = 0; i < pivot->rows * pivot->columns; i++) {
    if (pivot->cell[i] < 0) continue;
    struct gx_value order = {.type = GX_REAL, .real = gx_pivot_order(pivot, v, i / pivot->columns, i % pivot->columns)};
    if (isnan(order.real)) order.type = GX_NULL;
    if (!failed) failed = gx_table_set(to, row++, column, order);
  }
  return failed;
}

struct gx_table *gx_compare_table(const struct gx_comparison *comparison, FILE *errors)
{
  struct gx_pivot *pivot = gx_pivot_create(comparison, errors);
  if (!pivot) return NULL;
  long status = gx_table_find(pivot->table, "result.status");
  size_t columns = 1 + pivot->axes + (status >= 0) + pivot->values, at = 0;
  for (size_t v = 0; v < pivot->values; v++) columns += gx_pivot_ordered(pivot, v);
  struct gx_table *table = gx_table_create(columns, pivot->table->rows);
  int failed = !table || copy_column(table, at++, pivot, pivot->row_axis);
  for (size_t a = 0; a < pivot->axes && !failed; a++) failed = copy_column(table, at++, pivot, pivot->axis[a]);
  if (status >= 0 && !failed) failed = copy_column(table, at++, pivot, (size_t)status);
  for (size_t v = 0; v < pivot->values && !failed; v++) {
    failed = copy_column(table, at++, pivot, pivot->value[v]);
    if (!failed && gx_pivot_ordered(pivot, v)) failed = order_column(table, at++, pivot, v);
  }
  gx_pivot_free(pivot);
  if (!failed) return table;
  fputs("gridcross: out of memory\n", errors);
  gx_table_free(table);
  return NULL;
}
