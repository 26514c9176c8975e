/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts cases by how they ended. */
#include "left_out.h"

#include <stdlib.h>
#include <string.h>

bool gx_left_out_try(struct gx_left_out *left_out, const struct gx_table *table, size_t row)
{
  long c = gx_table_find(table, "result.status");
  if (c < 0) return true;
  struct gx_value status = gx_table_get(table, row, (size_t)c);
  if (status.type != GX_TEXT || !strcmp(status.text, gx_status_name(GX_OK))) return true;
  for (int s = 0; s < GX_STATUSES; s++) left_out->ended[s] += !strcmp(status.text, gx_status_name(s));
  return false;
}

/* A result that tells cases apart by more than how long they ran. */
static bool is_measured(const struct gx_table *table, size_t column)
{
  static const char *const others[] = {
      "result.particle", "result.probe.particle",       "result.dt",       "result.steps", "result.time",
      "result.seconds",  "result.ns_per_particle_step", "result.stable_dt"};
  const char *name = table->column[column].name;
  if (strncmp(name, "result.", strlen("result.")) != 0 || table->column[column].type == GX_TEXT) return false;
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    if (!strcmp(name, others[i])) return false;
  for (size_t row = 0; row < table->rows; row++)
    if (gx_table_get(table, row, column).type != GX_NULL) return true;
  return false;
}

void gx_left_out_suggest(const struct gx_table *table, const char *column, FILE *errors)
{
  enum { SHOWN = 8 };
  int shown = 0;
  fprintf(errors, "gridcross: no case has %s", column);
  for (size_t c = 0; c < table->columns && shown < SHOWN; c++)
    if (is_measured(table, c)) fprintf(errors, shown++ ? ", %s" : "; some have %s", table->column[c].name);
  fputs(shown ? "\n" : "; run again with output.measures: all\n", errors);
}

/* "3 tangled, 1 unstable" */
static void list_ended(const struct gx_left_out *left_out, FILE *out)
{
  const char *gap = "";
  for (int s = 0; s < GX_STATUSES; s++) {
    if (!left_out->ended[s]) continue;
    fprintf(out, "%s%zu %s", gap, left_out->ended[s], gx_status_name(s));
    gap = ", ";
  }
}

static size_t count_ended(const struct gx_left_out *left_out)
{
  size_t count = 0;
  for (int s = 0; s < GX_STATUSES; s++) count += left_out->ended[s];
  return count;
}

void gx_left_out_tell(const struct gx_left_out *left_out, FILE *errors)
{
  size_t count = count_ended(left_out);
  if (count) {
    fprintf(errors, "note: %zu case%s left out: ", count, count == 1 ? " is" : "s are");
    list_ended(left_out, errors);
    putc('\n', errors);
  }
  if (left_out->empty)
    fprintf(errors, "note: %zu case%s no value there\n", left_out->empty, left_out->empty == 1 ? " has" : "s have");
}

char *gx_left_out_text(const struct gx_left_out *left_out)
{
  char *text = NULL;
  size_t length, count = count_ended(left_out);
  FILE *out = open_memstream(&text, &length);
  if (!out) return NULL;
  if (count || left_out->empty) fputs("left out: ", out);
  list_ended(left_out, out);
  if (left_out->empty) fprintf(out, "%s%zu without value", count ? ", " : "", left_out->empty);
  if (!fclose(out)) return text;
  free(text);
  return NULL;
}
