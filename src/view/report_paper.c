/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Published tables and figures in a report: rows beside the print, and the figures that an item draws with printed values over
 * ours. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/store.h>

#include "report_page.h"
#include "sheet.h"

enum { MOST_WORDS = 24, MOST_SAMPLES = 240 };

/* One line of an item's plot. */
struct drawing {
  bool history;
  const char *x, *y, *by[MOST_WORDS];
  size_t bys;
};

/* One study of an item and its pivot. */
struct view {
  const struct gx_report_page *page;
  size_t study;
  const struct gx_paper_item *item;
  const struct gx_pivot *pivot;
  struct gx_report_json *json;
};

/* line: written to */
static struct drawing parse(char *line)
{
  struct drawing drawing = {0};
  const char *option = "";
  char *rest = NULL;
  for (char *word = strtok_r(line, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
    if (!strcmp(word, "history")) drawing.history = true;
    if (!strcmp(option, "--x")) drawing.x = word;
    if (!strcmp(option, "--y")) drawing.y = word;
    if (!strcmp(option, "--by") && drawing.bys < MOST_WORDS) drawing.by[drawing.bys++] = word;
    option = word;
  }
  return drawing;
}

static void write_axis(const struct gx_column *column, const char *key, struct gx_report_json *json)
{
  gx_report_json_open(json, key, '{');
  gx_report_json_text(json, "name", column->name);
  gx_report_json_text(json, "unit", column->unit);
  gx_report_json_close(json, '}');
}

/* Labels of a column of the pivot, and of its row where row >= 0. */
static void write_labels(const struct view *view, size_t column, long row)
{
  const struct gx_pivot *pivot = view->pivot;
  char label[GX_SHEET_LABEL];
  gx_report_json_open(view->json, "labels", '[');
  for (size_t a = 0; a < pivot->axes; a++)
    gx_report_json_text(view->json, NULL, gx_sheet_label(pivot->table, pivot->axis[a], pivot->column_sample[column], label));
  if (row >= 0)
    gx_report_json_text(view->json, NULL, gx_sheet_label(pivot->table, pivot->row_axis, pivot->row_sample[row], label));
  gx_report_json_close(view->json, ']');
}

static void write_points(const struct view *view, size_t column, size_t x, size_t y, bool xs)
{
  const struct gx_pivot *pivot = view->pivot;
  gx_report_json_open(view->json, xs ? "x" : "y", '[');
  for (size_t r = 0; r < pivot->rows; r++) {
    long at = pivot->cell[r * pivot->columns + column];
    double across = gx_pivot_number(pivot, at, x), up = gx_pivot_number(pivot, at, y);
    if (at >= 0 && gx_pivot_ok(pivot, at, y) && !isnan(across) && !isnan(up))
      gx_report_json_number(view->json, NULL, xs ? across : up);
  }
  gx_report_json_close(view->json, ']');
}

static int write_printed(const struct view *view, const struct drawing *drawing)
{
  struct gx_plot_point *point = calloc(view->item->rows + 1, sizeof *point);
  if (!point) return -1;
  size_t count = gx_paper_points(view->item, view->page->report->table[view->study], drawing->x, drawing->y, point);
  gx_report_json_open(view->json, "printed", '[');
  for (size_t i = 0; i < count; i++) {
    gx_report_json_open(view->json, NULL, '[');
    gx_report_json_number(view->json, NULL, point[i].x);
    gx_report_json_number(view->json, NULL, point[i].y);
    gx_report_json_close(view->json, ']');
  }
  gx_report_json_close(view->json, ']');
  free(point);
  return 0;
}

static int write_lines(const struct view *view, const struct drawing *drawing)
{
  const struct gx_pivot *pivot = view->pivot;
  size_t x = (size_t)gx_table_find(pivot->table, drawing->x), y = pivot->value[0];
  write_axis(&pivot->table->column[x], "x", view->json);
  write_axis(&pivot->table->column[y], "y", view->json);
  int failed = write_printed(view, drawing);
  gx_report_json_open(view->json, "lines", '[');
  for (size_t c = 0; c < pivot->columns && !failed; c++) {
    gx_report_json_open(view->json, NULL, '{');
    write_labels(view, c, -1);
    write_points(view, c, x, y, true);
    write_points(view, c, x, y, false);
    gx_report_json_close(view->json, '}');
  }
  gx_report_json_close(view->json, ']');
  return failed;
}

static void write_samples(const struct gx_table *history, size_t column, const char *key, size_t most,
                          struct gx_report_json *json)
{
  size_t count = history->rows < most ? history->rows : most;
  gx_report_json_open(json, key, '[');
  for (size_t i = 0; i < count; i++)
    gx_report_json_number(json, NULL,
                          gx_value_number(gx_table_get(history, gx_report_page_spread(i, count, history->rows - 1), column)));
  gx_report_json_close(json, ']');
}

/* Axes come with the first line that is there. */
static void write_histories(const struct view *view, const struct drawing *drawing, FILE *errors)
{
  const struct gx_pivot *pivot = view->pivot;
  const char *directory = view->page->report->directory[view->study];
  size_t id = (size_t)gx_table_find(pivot->table, "case"), most = MOST_SAMPLES / view->page->divisor + 2, lines = 0;
  for (size_t i = 0; i < pivot->rows * pivot->columns; i++) {
    long at = pivot->cell[i];
    if (at < 0 || !gx_pivot_ok(pivot, at, id)) continue;
    struct gx_table *history =
        gx_store_read_history(directory, gx_table_get(pivot->table, (size_t)at, id).text, drawing->y, errors);
    if (!history) continue;
    if (!lines++) {
      write_axis(&history->column[0], "x", view->json);
      write_axis(&history->column[1], "y", view->json);
      gx_report_json_open(view->json, "lines", '[');
    }
    gx_report_json_open(view->json, NULL, '{');
    write_labels(view, i % pivot->columns, pivot->rows > 1 ? (long)(i / pivot->columns) : -1);
    write_samples(history, 0, "x", most, view->json);
    write_samples(history, 1, "y", most, view->json);
    gx_report_json_close(view->json, '}');
    gx_table_free(history);
  }
  if (lines) gx_report_json_close(view->json, ']');
}

static int write_drawing(struct view *view, char *line, FILE *errors)
{
  const struct drawing drawing = parse(line);
  const struct gx_report *report = view->page->report;
  const char *const value[] = {drawing.history ? "case" : drawing.y};
  const struct gx_comparison comparison = {.studies = 1,
                                           .table = &report->table[view->study],
                                           .name = &report->name[view->study],
                                           .rows = drawing.history ? "study" : drawing.x,
                                           .columns = drawing.bys,
                                           .column = drawing.by,
                                           .open = true,
                                           .values = 1,
                                           .value = value};
  struct gx_pivot *pivot = gx_pivot_create(&comparison, errors);
  if (!pivot) return -1;
  int failed = 0;
  view->pivot = pivot;
  gx_report_json_open(view->json, NULL, '{');
  if (drawing.history)
    write_histories(view, &drawing, errors);
  else
    failed = write_lines(view, &drawing);
  gx_report_json_close(view->json, '}');
  gx_pivot_free(pivot);
  return failed;
}

static int write_figures(struct view *view, FILE *errors)
{
  char *lines = strdup(view->item->plot), *rest = NULL;
  int failed = !lines;
  gx_report_json_open(view->json, "figures", '[');
  for (char *line = lines ? strtok_r(lines, "\n", &rest) : NULL; line && !failed; line = strtok_r(NULL, "\n", &rest))
    failed = write_drawing(view, line, errors);
  gx_report_json_close(view->json, ']');
  free(lines);
  return failed ? -1 : 0;
}

/* ours as a number, the print as it stands there. */
static void write_row(const struct view *view, const struct gx_table *table, size_t row)
{
  static const char *const texts[] = {"row", "quantity", "gate", "verdict", "reason"};
  struct gx_report_json *json = view->json;
  gx_report_json_open(json, NULL, '{');
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    struct gx_value value = gx_table_get(table, row, (size_t)gx_table_find(table, texts[i]));
    if (value.type == GX_TEXT) gx_report_json_text(json, texts[i], value.text);
  }
  gx_report_json_text(json, "printed", view->item->row[row].printed);
  gx_report_json_text(json, "corrected", view->item->row[row].corrected);
  struct gx_value ours = gx_table_get(table, row, (size_t)gx_table_find(table, "ours")); /* a status is a text */
  if (ours.type == GX_TEXT)
    gx_report_json_text(json, "ours", ours.text);
  else
    gx_report_json_number(json, "ours", gx_value_number(ours));
  gx_report_json_number(json, "ratio", gx_value_number(gx_table_get(table, row, (size_t)gx_table_find(table, "ratio"))));
  gx_report_json_close(json, '}');
}

static int write_item(struct view *view, FILE *errors)
{
  size_t missed = 0;
  struct gx_table *table = gx_paper_compare(view->item, view->page->report->table[view->study], &missed);
  if (!table) return -1;
  gx_report_json_open(view->json, NULL, '{');
  gx_report_json_integer(view->json, "study", (long)view->study);
  gx_report_json_text(view->json, "paper", view->item->paper);
  gx_report_json_text(view->json, "item", view->item->item);
  gx_report_json_integer(view->json, "missed", (long)missed);
  gx_report_json_open(view->json, "rows", '[');
  for (size_t r = 0; r < table->rows; r++) write_row(view, table, r);
  gx_report_json_close(view->json, ']');
  int failed = write_figures(view, errors);
  gx_report_json_close(view->json, '}');
  gx_table_free(table);
  return failed;
}

int gx_report_paper_write(const struct gx_report_page *page, struct gx_report_json *json, FILE *errors)
{
  int failed = 0;
  gx_report_json_open(json, "paper", '[');
  for (size_t i = 0; i < gx_paper_item_count && !failed; i++)
    for (size_t s = 0; s < page->report->studies && !failed; s++) {
      struct view view = {.page = page, .study = s, .item = &gx_paper_items[i], .json = json};
      if (page->item[s] == view.item) failed = write_item(&view, errors);
    }
  gx_report_json_close(json, ']');
  return failed ? -1 : 0;
}
