/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of a stored study piece by piece, with its timing. */
#include <gridcross/store.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "assembly.h"
#include "store_rows.h"

struct gx_store_rows {
  char *study, *timing_path; /* owned */
  size_t columns;
  const char *const *column; /* borrowed */
  bool timed;                /* the timing is wanted */
  FILE *errors;
  struct gx_hdf5_rows *rows; /* NULL: paused */
  size_t total, next;        /* rows */
  FILE *timing;              /* NULL: paused, or there is none */
  long timing_at;            /* where it goes on after a pause */
  /* Of the line that no row has had yet. */
  char id[GX_ID_LENGTH]; /* "": none */
  double seconds, cost;
};

/* Whether a table has columns that only those who read it add. */
static bool has_ours(const struct gx_table *table)
{
  static const char *const ours[] = {"study", "result.seconds", "result.ns_per_particle_step"};
  for (size_t i = 0; i < sizeof ours / sizeof *ours; i++)
    if (gx_table_find(table, ours[i]) >= 0) return true;
  return false;
}

static bool wants_timing(size_t columns, const char *const *column)
{
  for (size_t c = 0; column && c < columns; c++)
    if (!strcmp(column[c], "result.seconds") || !strcmp(column[c], "result.ns_per_particle_step")) return true;
  return !column;
}

static int open_again(struct gx_store_rows *rows)
{
  if (rows->rows) return 0;
  rows->rows = gx_hdf5_rows_begin(rows->study, rows->columns, rows->column, rows->errors);
  if (!rows->rows) return -1;
  rows->total = gx_hdf5_rows_total(rows->rows);
  gx_hdf5_rows_seek(rows->rows, rows->next);
  rows->timing = rows->timed ? fopen(rows->timing_path, "rb") : NULL;
  if (rows->timing && rows->timing_at && fseek(rows->timing, rows->timing_at, SEEK_SET)) rows->timing_at = 0;
  return 0;
}

void gx_store_rows_pause(struct gx_store_rows *rows)
{
  gx_hdf5_rows_end(rows->rows);
  rows->rows = NULL;
  if (!rows->timing) return;
  rows->timing_at = ftell(rows->timing);
  fclose(rows->timing);
  rows->timing = NULL;
}

struct gx_store_rows *gx_store_rows_begin(const char *directory, size_t columns, const char *const *column, FILE *errors)
{
  struct gx_store_rows *rows = calloc(1, sizeof *rows);
  char *timing = gx_assembly_path(directory, "", gx_assembly_name[GX_ASSEMBLY_TIMING], "");
  char *study = gx_assembly_path(directory, "", gx_assembly_name[GX_ASSEMBLY_STUDY], "");
  if (rows && timing && study) {
    *rows = (struct gx_store_rows){.study = study,
                                   .timing_path = timing,
                                   .columns = columns,
                                   .column = column,
                                   .timed = wants_timing(columns, column),
                                   .errors = errors};
    if (!open_again(rows)) return rows;
    gx_store_rows_end(rows);
    return NULL;
  }
  gx_assembly_say(errors, NULL);
  free(rows);
  free(timing);
  free(study);
  return NULL;
}

size_t gx_store_rows_total(const struct gx_store_rows *rows)
{
  return rows->total;
}

struct gx_hdf5_rows *gx_store_rows_hdf5(struct gx_store_rows *rows)
{
  return open_again(rows) ? NULL : rows->rows;
}

/* Whether there is a line that no row has had. */
static bool look_at_timing(struct gx_store_rows *rows)
{
  char line[256];
  while (!*rows->id && rows->timing && fgets(line, sizeof line, rows->timing))
    if (sscanf(line, "%16[^,],%lf,%lf", rows->id, &rows->seconds, &rows->cost) != 3) *rows->id = '\0';
  return *rows->id;
}

/* Timings are a comment on the table: a missing or foreign timing.csv leaves them null. Its lines stand in the order of the rows. */
static int add_timing(struct gx_store_rows *rows, struct gx_table *table)
{
  const long id = gx_table_find(table, "case");
  const size_t first = table->columns - 2;
  if (gx_table_column(table, first, "result.seconds", "s", GX_REAL) ||
      gx_table_column(table, first + 1, "result.ns_per_particle_step", "ns", GX_REAL))
    return -1;
  for (size_t r = 0; id >= 0 && r < table->rows && look_at_timing(rows); r++) {
    struct gx_value value = gx_table_get(table, r, (size_t)id);
    if (value.type != GX_TEXT || strcmp(value.text, rows->id)) continue;
    gx_table_set(table, r, first, gx_value_from(isfinite(rows->cost) ? rows->seconds : NAN));
    gx_table_set(table, r, first + 1, gx_value_from(isfinite(rows->seconds) ? rows->cost : NAN));
    *rows->id = '\0';
  }
  return 0;
}

struct gx_table *gx_store_rows_next(struct gx_store_rows *rows, size_t most)
{
  struct gx_table *table = open_again(rows) ? NULL : gx_hdf5_rows_next(rows->rows, most, rows->timed ? 2 : 0);
  if (!table) return NULL;
  rows->next += table->rows;
  const bool damaged = has_ours(table); /* the last two have no names yet */
  if (!damaged && (!rows->timed || !add_timing(rows, table))) return table;
  if (damaged)
    fprintf(rows->errors, "%s: its table is damaged\n", rows->study);
  else
    gx_assembly_say(rows->errors, NULL);
  gx_table_free(table);
  return NULL;
}

void gx_store_rows_end(struct gx_store_rows *rows)
{
  if (!rows) return;
  gx_store_rows_pause(rows);
  free(rows->study);
  free(rows->timing_path);
  free(rows);
}
