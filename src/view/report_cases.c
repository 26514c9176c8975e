/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cases of a report, which its other parts name by their place. */
#include <stdlib.h>
#include <string.h>

#include "axes.h"
#include "report_page.h"
#include "sheet.h"

static const char *text_of(const struct gx_table *table, size_t row, const char *name)
{
  long c = gx_table_find(table, name);
  struct gx_value value = c < 0 ? (struct gx_value){0} : gx_table_get(table, row, (size_t)c);
  return value.type == GX_TEXT ? value.text : NULL;
}

/* case, status, reason, [rank of each axis' value], [results]. rank: [axes][rows] */
static void write_case(const struct gx_report_page *page, size_t row, const size_t *rank, struct gx_report_json *json)
{
  const struct gx_table *table = page->table;
  gx_report_json_open(json, NULL, '[');
  gx_report_json_text(json, NULL, text_of(table, row, "case"));
  gx_report_json_text(json, NULL, text_of(table, row, "result.status"));
  gx_report_json_text(json, NULL, text_of(table, row, "result.reason"));
  gx_report_json_open(json, NULL, '[');
  for (size_t a = 0; a < page->axes; a++) gx_report_json_integer(json, NULL, (long)rank[a * table->rows + row]);
  gx_report_json_close(json, ']');
  gx_report_json_open(json, NULL, '[');
  for (size_t c = 0; c < page->results; c++)
    gx_report_json_number(json, NULL, gx_value_number(gx_table_get(table, row, page->result[c])));
  gx_report_json_close(json, ']');
  gx_report_json_close(json, ']');
}

static void write_column(const struct gx_column *column, struct gx_report_json *json)
{
  gx_report_json_open(json, NULL, '{');
  gx_report_json_text(json, "name", column->name);
  gx_report_json_text(json, "unit", column->unit);
  if (gx_sheet_error_like(column->name)) gx_report_json_integer(json, "error", 1);
  gx_report_json_close(json, '}');
}

int gx_report_cases_write(const struct gx_report_page *page, struct gx_report_json *json)
{
  const struct gx_table *table = page->table;
  size_t *rank = calloc(page->axes * table->rows + 1, sizeof *rank);
  int failed = !rank;
  for (size_t a = 0; a < page->axes && !failed; a++) failed = gx_axes_rank(table, page->axis[a], rank + a * table->rows) < 0;
  if (failed) {
    free(rank);
    return -1;
  }
  gx_report_json_open(json, "cases", '{');
  gx_report_json_integer(json, "total", (long)table->rows);
  gx_report_json_open(json, "columns", '[');
  for (size_t c = 0; c < page->results; c++) write_column(&table->column[page->result[c]], json);
  gx_report_json_close(json, ']');
  gx_report_json_open(json, "rows", '[');
  for (size_t r = 0; r < table->rows; r++)
    if (page->index[r] >= 0) write_case(page, r, rank, json);
  gx_report_json_close(json, ']');
  gx_report_json_close(json, '}');
  free(rank);
  return 0;
}
