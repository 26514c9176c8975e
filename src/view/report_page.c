/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the parts of a report share: the studies joined, what tells their cases apart, and which of them are shown. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/store.h>

#include "axes.h"
#include "join.h"
#include "report_page.h"
#include "sheet.h"

enum { MOST_CASES = 2000 };

static int no_memory(FILE *errors)
{
  fputs("gridcross: out of memory\n", errors);
  return -1;
}

/* Run file and title of each study, and the item of a paper that it is. */
static int read_studies(struct gx_report_page *page, FILE *errors)
{
  const struct gx_report *report = page->report;
  page->run_file = calloc(report->studies + 1, sizeof *page->run_file);
  page->title = calloc(report->studies + 1, sizeof *page->title);
  page->item = calloc(report->studies + 1, sizeof *page->item);
  if (!page->run_file || !page->title || !page->item) return no_memory(errors);
  page->papers = report->studies > 1;
  for (size_t s = 0; s < report->studies; s++) {
    page->run_file[s] = gx_store_read_provenance(report->directory[s], "run_file", errors);
    page->title[s] = gx_store_read_provenance(report->directory[s], "title", errors);
    if (!page->run_file[s] || !page->title[s]) return -1;
    for (size_t i = 0; i < gx_paper_item_count; i++)
      if (!strcmp(gx_paper_items[i].run_file, page->run_file[s])) page->item[s] = &gx_paper_items[i];
    page->papers = page->papers && page->item[s];
  }
  return 0;
}

static bool has_number(const struct gx_table *table, size_t column)
{
  for (size_t r = 0; r < table->rows; r++)
    if (!isnan(gx_value_number(gx_table_get(table, r, column)))) return true;
  return false;
}

/* Columns of results that hold numbers: the preferred ones, errors, others. */
static int find_results(struct gx_report_page *page)
{
  static const char *const preferred[] = {"result.displacement.max.rms", "result.displacement.final.rms",
                                          "result.velocity.max.rms", "result.stress.max.rms"};
  enum { PREFERRED = sizeof preferred / sizeof *preferred };
  const struct gx_table *table = page->table;
  bool *taken = calloc(table->columns + 1, sizeof *taken);
  page->result = calloc(table->columns + 1, sizeof *page->result);
  if (!taken || !page->result) {
    free(taken);
    return -1;
  }
  for (size_t pass = 0; pass <= PREFERRED + 1; pass++)
    for (size_t c = 0; c < table->columns; c++) {
      const char *name = table->column[c].name;
      bool fits = pass < PREFERRED ? !strcmp(name, preferred[pass]) : pass > PREFERRED || gx_sheet_error_like(name);
      if (!fits || taken[c] || strncmp(name, "result.", 7) != 0 || !has_number(table, c)) continue;
      taken[c] = true;
      page->result[page->results++] = c;
    }
  free(taken);
  return 0;
}

/* The front of the first error that there is; its messages become the note. */
static int find_front(struct gx_report_page *page)
{
  size_t length, error = 0;
  FILE *notes = open_memstream(&page->front_note, &length);
  if (!notes) return -1;
  while (error < page->results && !gx_sheet_error_like(page->table->column[page->result[error]].name)) error++;
  const char *name = error < page->results ? page->table->column[page->result[error]].name : "result.displacement.max.rms";
  if (!gx_front_find(&page->front, page->table, name, "result.seconds", notes)) gx_front_tell(&page->front, notes);
  return ferror(notes) | fclose(notes) ? -1 : 0;
}

int gx_report_page_create(struct gx_report_page *page, const struct gx_report *report, FILE *errors)
{
  *page = (struct gx_report_page){.report = report};
  if (gx_join_check(report->studies, report->name, errors) || read_studies(page, errors)) return -1;
  page->table = gx_join_tables(report->studies, report->table, report->name);
  page->axis = page->table ? calloc(page->table->columns + 1, sizeof *page->axis) : NULL;
  page->index = page->table ? calloc(page->table->rows + 1, sizeof *page->index) : NULL;
  long axes = page->axis && page->index ? gx_axes_find(page->table, 0, page->axis) : -1;
  if (axes < 0) return no_memory(errors);
  page->axes = (size_t)axes;
  if (find_results(page) || find_front(page)) return no_memory(errors);
  return 0;
}

void gx_report_page_free(struct gx_report_page *page)
{
  for (size_t s = 0; s < page->report->studies; s++) {
    if (page->run_file) free(page->run_file[s]);
    if (page->title) free(page->title[s]);
  }
  free(page->run_file);
  free(page->title);
  free(page->item);
  gx_table_free(page->table);
  free(page->axis);
  free(page->result);
  gx_front_free(&page->front);
  free(page->front_note);
  free(page->index);
}

void gx_report_page_limit(struct gx_report_page *page, size_t divisor)
{
  const struct gx_table *table = page->table;
  page->divisor = divisor;
  page->shown = 0;
  for (size_t r = 0; r < table->rows; r++) page->index[r] = r < MOST_CASES / divisor ? 0 : -1;
  for (size_t m = 0; m < page->front.members; m++) page->index[page->front.member[m]] = 0;
  for (size_t r = 0; r < table->rows; r++)
    if (!page->index[r]) page->index[r] = (long)page->shown++;
}

size_t gx_report_page_study(const struct gx_report_page *page, size_t *row)
{
  size_t s = 0;
  for (; *row >= page->report->table[s]->rows; s++) *row -= page->report->table[s]->rows;
  return s;
}

char *gx_report_page_label(const struct gx_table *table, size_t axes, const size_t *axis, size_t row)
{
  char text[GX_SHEET_LABEL], *label = calloc(axes + 1, GX_SHEET_LABEL + 2);
  for (size_t a = 0; a < axes && label; a++) {
    gx_sheet_label(table, axis[a], row, text);
    if (*text && *label) strcat(label, ", ");
    strcat(label, text);
  }
  return label;
}

static bool is_space(const struct gx_table *table, size_t row, long column, const char *name)
{
  struct gx_value value = column < 0 ? (struct gx_value){0} : gx_table_get(table, row, (size_t)column);
  return value.type == GX_TEXT && !strcmp(value.text, name);
}

/* The case on a moving mesh that equals this one of the standard grid in every other axis; -1: none. */
static long partner(const struct gx_report_page *page, size_t row, long space,
                    bool (*wanted)(const struct gx_report_page *page, size_t row))
{
  const struct gx_table *table = page->table;
  if (!is_space(table, row, space, "standard")) return -1;
  for (size_t r = 0; r < table->rows; r++) {
    bool same = is_space(table, r, space, "moving-mesh");
    for (size_t a = 0; a < page->axes && same; a++)
      same = (long)page->axis[a] == space ||
             !gx_value_compare(gx_table_get(table, r, page->axis[a]), gx_table_get(table, row, page->axis[a]));
    if (same && wanted(page, r)) return (long)r;
  }
  return -1;
}

size_t gx_report_page_choose(const struct gx_report_page *page, size_t most, size_t *row,
                             bool (*wanted)(const struct gx_report_page *page, size_t row))
{
  long space = gx_table_find(page->table, "method.space");
  size_t count = 0;
  for (size_t r = 0; r < page->table->rows && count + 2 <= most; r++) {
    long other = page->index[r] >= 0 && wanted(page, r) ? partner(page, r, space, wanted) : -1;
    if (other < 0 || page->index[other] < 0) continue;
    row[count++] = r;
    row[count++] = (size_t)other;
  }
  for (size_t r = 0; r < page->table->rows && count < most; r++) {
    bool taken = page->index[r] < 0 || !wanted(page, r);
    for (size_t i = 0; i < count && !taken; i++) taken = row[i] == r;
    if (!taken) row[count++] = r;
  }
  return count;
}
