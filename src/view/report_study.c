/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a report compares: studies with run file and provenance, axes with their values, and what all cases share. */
#include <stdlib.h>
#include <string.h>

#include <gridcross/store.h>

#include "axes.h"
#include "report_page.h"
#include "sheet.h"

static const char *const provenance[] = {"version", "git_revision", "compiler", "flags", "gsl", "fftw", "hdf5", "yaml"};

static int write_study(const struct gx_report_page *page, size_t s, struct gx_report_json *json, FILE *errors)
{
  const struct gx_report *report = page->report;
  int failed = 0;
  gx_report_json_open(json, NULL, '{');
  gx_report_json_text(json, "name", report->name[s]);
  gx_report_json_text(json, "title", page->title[s]);
  gx_report_json_integer(json, "cases", (long)report->table[s]->rows);
  gx_report_json_integer(json, "repeats", gx_store_read_repeats(report->directory[s]));
  gx_report_json_text(json, "run_file", page->run_file[s]);
  gx_report_json_open(json, "provenance", '[');
  for (size_t i = 0; i < sizeof provenance / sizeof *provenance && !failed; i++) {
    char *text = gx_store_read_provenance(report->directory[s], provenance[i], errors);
    gx_report_json_open(json, NULL, '[');
    gx_report_json_text(json, NULL, provenance[i]);
    gx_report_json_text(json, NULL, text);
    gx_report_json_close(json, ']');
    failed = !text;
    free(text);
  }
  gx_report_json_close(json, ']');
  gx_report_json_close(json, '}');
  return failed ? -1 : 0;
}

/* Path, unit and distinct values of a column of parameters. first: [rows] of scratch. */
static int write_parameter(const struct gx_table *table, size_t column, size_t *first, struct gx_report_json *json)
{
  enum { MOST = 200 };
  char text[GX_NUMBER_LENGTH];
  long count = gx_axes_values(table, column, first);
  if (count < 0) return -1;
  gx_report_json_open(json, NULL, '{');
  gx_report_json_text(json, "path", table->column[column].name);
  gx_report_json_text(json, "unit", table->column[column].unit);
  gx_report_json_open(json, "values", '[');
  for (long i = 0; i < count && i < MOST; i++)
    gx_report_json_text(json, NULL, gx_sheet_text(table->column[column].name, gx_table_get(table, first[i], column), text));
  gx_report_json_close(json, ']');
  gx_report_json_close(json, '}');
  return 0;
}

static bool is_axis(const struct gx_report_page *page, size_t column)
{
  for (size_t a = 0; a < page->axes; a++)
    if (page->axis[a] == column) return true;
  return false;
}

/* Parameters that apply to some case and do not tell cases apart. */
static bool is_shared(const struct gx_report_page *page, size_t column)
{
  const struct gx_table *table = page->table;
  if (!gx_axes_parameter(table, column) || is_axis(page, column) || !strcmp(table->column[column].name, "study")) return false;
  for (size_t r = 0; r < table->rows; r++)
    if (gx_table_get(table, r, column).type != GX_NULL) return true;
  return false;
}

int gx_report_study_write(const struct gx_report_page *page, struct gx_report_json *json, FILE *errors)
{
  size_t *first = calloc(page->table->rows + 1, sizeof *first);
  int failed = !first;
  gx_report_json_open(json, "studies", '[');
  for (size_t s = 0; s < page->report->studies && !failed; s++) failed = write_study(page, s, json, errors);
  gx_report_json_close(json, ']');
  gx_report_json_open(json, "axes", '[');
  for (size_t a = 0; a < page->axes && !failed && !page->papers; a++)
    failed = write_parameter(page->table, page->axis[a], first, json);
  gx_report_json_close(json, ']');
  gx_report_json_open(json, "fixed", '[');
  for (size_t c = 0; c < page->table->columns && !failed && !page->papers; c++)
    if (is_shared(page, c)) failed = write_parameter(page->table, c, first, json);
  gx_report_json_close(json, ']');
  free(first);
  return failed ? -1 : 0;
}
