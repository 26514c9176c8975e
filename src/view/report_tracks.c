/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Paths of particles over the cells of some cases of a report, from snapshots. */
#include <math.h>
#include <stdlib.h>

#include "report_page.h"
#include "tracks.h"

enum { MOST_CASES = 12, MOST_TIMES = 100, MOST_CROSSINGS = 1500, PER_METRE = 100000 };

static bool keeps_snapshots(const struct gx_report_page *page, size_t row)
{
  long c = gx_table_find(page->table, "output.snapshots");
  return c >= 0 && gx_value_number(gx_table_get(page->table, row, (size_t)c)) > 0;
}

/* One path as whole numbers of 1/PER_METRE m: the first, then what each adds to the last that was a number. Null: it is none, or far
 * from the domain [0, 1]. x: [times] */
static void write_path(const double *x, size_t times, size_t samples, struct gx_report_json *json)
{
  const double far = 10;
  long before = 0;
  gx_report_json_open(json, NULL, '[');
  for (size_t i = 0; i < samples; i++) {
    double at = x[gx_report_page_spread(i, samples, times - 1)];
    if (!(fabs(at) < far)) {
      gx_report_json_text(json, NULL, NULL);
      continue;
    }
    long now = lround(at * PER_METRE);
    gx_report_json_integer(json, NULL, now - before);
    before = now;
  }
  gx_report_json_close(json, ']');
}

/* samples: 1 for what stays where it is. x: [count][times] */
static void write_paths(const char *key, size_t count, const double *x, size_t times, size_t samples, struct gx_report_json *json)
{
  gx_report_json_open(json, key, '[');
  for (size_t k = 0; k < count; k++) write_path(x + k * times, times, samples, json);
  gx_report_json_close(json, ']');
}

static void write_crossings(const struct gx_tracks *tracks, size_t most, struct gx_report_json *json)
{
  size_t count = tracks->crossings < most ? tracks->crossings : most;
  gx_report_json_integer(json, "crossed", (long)tracks->crossings);
  gx_report_json_open(json, "crossings", '[');
  for (size_t i = 0; i < count; i++) {
    const struct gx_tracks_crossing *crossing = &tracks->crossing[gx_report_page_spread(i, count, tracks->crossings - 1)];
    gx_report_json_open(json, NULL, '[');
    gx_report_json_number(json, NULL, crossing->time);
    gx_report_json_number(json, NULL, crossing->x);
    gx_report_json_close(json, ']');
  }
  gx_report_json_close(json, ']');
}

static void write_tracks(const struct gx_report_page *page, size_t row, const struct gx_tracks *tracks,
                         struct gx_report_json *json)
{
  size_t most = MOST_TIMES / page->divisor + 2, samples = tracks->times < most ? tracks->times : most;
  gx_report_json_open(json, NULL, '{');
  gx_report_json_integer(json, "case", page->index[row]);
  gx_report_json_integer(json, "particles", (long)tracks->of);
  if (tracks->row) gx_report_json_integer(json, "row", 1);
  gx_report_json_integer(json, "cells", (long)tracks->cells);
  gx_report_json_integer(json, "edges_of", (long)tracks->edges_of);
  gx_report_json_open(json, "time", '[');
  for (size_t i = 0; i < samples; i++)
    gx_report_json_number(json, NULL, tracks->time[gx_report_page_spread(i, samples, tracks->times - 1)]);
  gx_report_json_close(json, ']');
  write_paths("path", tracks->paths, tracks->path, tracks->times, samples, json);
  write_paths("edge", tracks->edges, tracks->edge, tracks->times, tracks->cells ? 1 : samples, json);
  write_crossings(tracks, MOST_CROSSINGS / page->divisor, json);
  gx_report_json_close(json, '}');
}

int gx_report_tracks_write(const struct gx_report_page *page, struct gx_report_json *json)
{
  size_t row[MOST_CASES], count = gx_report_page_choose(page, MOST_CASES / page->divisor, row, keeps_snapshots), total = 0,
                          length;
  char *ignored = NULL; /* a case without its files is left out */
  FILE *errors = open_memstream(&ignored, &length);
  if (!errors) return -1;
  for (size_t r = 0; r < page->table->rows; r++) total += keeps_snapshots(page, r);
  gx_report_json_open(json, "tracks", '{');
  gx_report_json_integer(json, "total", (long)total);
  gx_report_json_integer(json, "per_metre", PER_METRE);
  gx_report_json_open(json, "cases", '[');
  for (size_t i = 0; i < count; i++) {
    struct gx_tracks tracks;
    size_t own = row[i], study = gx_report_page_study(page, &own);
    long id = gx_table_find(page->table, "case");
    const char *name = gx_table_get(page->table, row[i], (size_t)id).text;
    if (!gx_tracks_read(&tracks, page->report->directory[study], name, errors) && tracks.times)
      write_tracks(page, row[i], &tracks, json);
    gx_tracks_free(&tracks);
  }
  gx_report_json_close(json, ']');
  gx_report_json_close(json, '}');
  fclose(errors);
  free(ignored);
  return 0;
}
