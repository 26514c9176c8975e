/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Histories and last spectra of some cases of a report. */
#include <stdlib.h>
#include <string.h>

#include <gridcross/spectra.h>
#include <gridcross/store.h>

#include "report_page.h"

enum { MOST_CASES = 24, MOST_SAMPLES = 300 };

static struct gx_value value_of(const struct gx_report_page *page, size_t row, const char *name)
{
  long c = gx_table_find(page->table, name);
  return c < 0 ? (struct gx_value){0} : gx_table_get(page->table, row, (size_t)c);
}

static bool keeps_histories(const struct gx_report_page *page, size_t row)
{
  return gx_value_number(value_of(page, row, "output.histories")) > 0;
}

static bool keeps_spectra(const struct gx_report_page *page, size_t row)
{
  return gx_value_number(value_of(page, row, "output.spectra")) > 0;
}

/* A column of numbers, thinned, into an open object. */
static void write_numbers(const struct gx_table *table, size_t column, const char *key, size_t most, struct gx_report_json *json)
{
  size_t count = table->rows < most ? table->rows : most;
  gx_report_json_open(json, key, '[');
  for (size_t i = 0; i < count; i++)
    gx_report_json_number(json, NULL,
                          gx_value_number(gx_table_get(table, gx_report_page_spread(i, count, table->rows - 1), column)));
  gx_report_json_close(json, ']');
}

/* Members time and one a quantity. A case that stopped at its start may have kept nothing. */
static void write_history(const struct gx_report_page *page, size_t row, struct gx_report_json *json, FILE *errors)
{
  static const char *const names[] = {"displacement.rms", "velocity.rms", "stress.rms", "energy.kinetic",
                                      "energy.elastic",   "energy.work",  "crossings"};
  size_t own = row, study = gx_report_page_study(page, &own), most = MOST_SAMPLES / page->divisor + 2;
  const char *id = value_of(page, row, "case").text;
  gx_report_json_open(json, NULL, '{');
  gx_report_json_integer(json, "case", page->index[row]);
  for (size_t q = 0; q < sizeof names / sizeof *names; q++) {
    struct gx_table *history = gx_store_read_history(page->report->directory[study], id, names[q], errors);
    if (!history) break;
    if (!q) write_numbers(history, 0, "time", most, json);
    write_numbers(history, 1, names[q], most, json);
    gx_table_free(history);
  }
  gx_report_json_close(json, '}');
}

/* Members nyquist, wavenumber and one a quantity. */
static void write_spectra(const struct gx_report_page *page, size_t row, struct gx_report_json *json, FILE *errors)
{
  size_t own = row, study = gx_report_page_study(page, &own);
  struct gx_spectra *spectra = gx_store_read_spectra(page->report->directory[study], page->report->table[study], own, errors);
  gx_report_json_open(json, NULL, '{');
  gx_report_json_integer(json, "case", page->index[row]);
  if (spectra) gx_report_json_number(json, "nyquist", spectra->nyquist);
  for (size_t q = 0; q < GX_QUANTITIES && spectra; q++) {
    struct gx_table *last = gx_spectra_last(spectra, (enum gx_quantity)q);
    if (!last) break;
    if (!q) write_numbers(last, 0, "wavenumber", last->rows, json);
    write_numbers(last, 1, gx_measure_quantity[q].name, last->rows, json);
    gx_table_free(last);
  }
  gx_report_json_close(json, '}');
  gx_store_free_spectra(spectra);
}

/* A member: cases that keep such curves, and how many there are. */
static int write_kind(const struct gx_report_page *page, const char *key, struct gx_report_json *json,
                      bool (*keeps)(const struct gx_report_page *page, size_t row),
                      void (*write)(const struct gx_report_page *page, size_t row, struct gx_report_json *json, FILE *errors))
{
  size_t row[MOST_CASES], count = gx_report_page_choose(page, MOST_CASES / page->divisor, row, keeps), total = 0, length;
  char *ignored = NULL;
  FILE *errors = open_memstream(&ignored, &length);
  if (!errors) return -1;
  for (size_t r = 0; r < page->table->rows; r++) total += keeps(page, r);
  gx_report_json_open(json, key, '{');
  gx_report_json_integer(json, "total", (long)total);
  gx_report_json_open(json, "curves", '[');
  for (size_t i = 0; i < count; i++) write(page, row[i], json, errors);
  gx_report_json_close(json, ']');
  gx_report_json_close(json, '}');
  fclose(errors);
  free(ignored);
  return 0;
}

int gx_report_curves_write(const struct gx_report_page *page, struct gx_report_json *json)
{
  if (write_kind(page, "histories", json, keeps_histories, write_history)) return -1;
  return write_kind(page, "spectra", json, keeps_spectra, write_spectra);
}
