/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The comparison of a report: cases along the axis that refines and the others, with orders. */
#include <math.h>
#include <stdlib.h>

#include "report_page.h"
#include "sheet.h"

/* Columns of the pivot that are shown. */
static size_t columns_shown(const struct gx_report_page *page, const struct gx_pivot *pivot)
{
  size_t most = 400 / page->divisor;
  return pivot->columns < most ? pivot->columns : most;
}

/* One object a value that has orders: its place among the results, and [columns][rows] orders. */
static void write_orders(const struct gx_report_page *page, const struct gx_pivot *pivot, struct gx_report_json *json)
{
  gx_report_json_open(json, "orders", '[');
  for (size_t v = 0; v < pivot->values; v++) {
    if (!gx_pivot_ordered(pivot, v)) continue;
    gx_report_json_open(json, NULL, '{');
    gx_report_json_integer(json, "result", (long)v);
    gx_report_json_open(json, "order", '[');
    for (size_t c = 0; c < columns_shown(page, pivot); c++) {
      gx_report_json_open(json, NULL, '[');
      for (size_t r = 0; r < pivot->rows; r++) {
        double order = gx_pivot_order(pivot, v, r, c);
        gx_report_json_number(json, NULL, isnan(order) ? NAN : 0.01 * round(100 * fmin(fmax(order, -99), 99)));
      }
      gx_report_json_close(json, ']');
    }
    gx_report_json_close(json, ']');
    gx_report_json_close(json, '}');
  }
  gx_report_json_close(json, ']');
}

static void write_rows(const struct gx_pivot *pivot, struct gx_report_json *json)
{
  const struct gx_table *table = pivot->table;
  const struct gx_column *axis = &table->column[pivot->row_axis];
  char text[GX_NUMBER_LENGTH];
  gx_report_json_text(json, "path", axis->name);
  gx_report_json_text(json, "unit", axis->unit);
  gx_report_json_open(json, "rows", '[');
  for (size_t r = 0; r < pivot->rows; r++) {
    struct gx_value value = gx_table_get(table, pivot->row_sample[r], pivot->row_axis);
    gx_report_json_open(json, NULL, '[');
    gx_report_json_text(json, NULL, gx_sheet_text(axis->name, value, text));
    gx_report_json_number(json, NULL, gx_value_number(value));
    gx_report_json_close(json, ']');
  }
  gx_report_json_close(json, ']');
}

static void write_pivot(const struct gx_report_page *page, const struct gx_pivot *pivot, struct gx_report_json *json)
{
  char label[GX_SHEET_LABEL];
  write_rows(pivot, json);
  gx_report_json_open(json, "axes", '[');
  for (size_t a = 0; a < pivot->axes; a++) gx_report_json_text(json, NULL, pivot->table->column[pivot->axis[a]].name);
  gx_report_json_close(json, ']');
  gx_report_json_integer(json, "total", (long)pivot->columns);
  gx_report_json_open(json, "columns", '[');
  for (size_t c = 0; c < columns_shown(page, pivot); c++) {
    gx_report_json_open(json, NULL, '{');
    gx_report_json_open(json, "labels", '[');
    for (size_t a = 0; a < pivot->axes; a++)
      gx_report_json_text(json, NULL, gx_sheet_label(pivot->table, pivot->axis[a], pivot->column_sample[c], label));
    gx_report_json_close(json, ']');
    gx_report_json_open(json, "cases", '[');
    for (size_t r = 0; r < pivot->rows; r++) {
      long row = pivot->cell[r * pivot->columns + c];
      gx_report_json_integer(json, NULL, row < 0 ? -1 : page->index[row]);
    }
    gx_report_json_close(json, ']');
    gx_report_json_close(json, '}');
  }
  gx_report_json_close(json, ']');
  write_orders(page, pivot, json);
}

int gx_report_compare_write(const struct gx_report_page *page, struct gx_report_json *json, FILE *errors)
{
  const struct gx_report *report = page->report;
  const char **value = calloc(page->results + 1, sizeof *value);
  if (!value) return -1;
  for (size_t v = 0; v < page->results; v++) value[v] = page->table->column[page->result[v]].name;
  const struct gx_comparison comparison = {
      .studies = report->studies, .table = report->table, .name = report->name, .values = page->results, .value = value};
  struct gx_pivot *pivot = page->results ? gx_pivot_create(&comparison, errors) : NULL;
  int failed = page->results && !pivot;
  if (pivot && pivot->columns) {
    gx_report_json_open(json, "compare", '{');
    write_pivot(page, pivot, json);
    gx_report_json_close(json, '}');
  }
  gx_pivot_free(pivot);
  free(value);
  return failed ? -1 : 0;
}
