/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choosing cases by the value of a column. */
#include "where.h"

#include <stdlib.h>
#include <string.h>

#include "../study/number.h"
#include "../view/axes.h"
#include "../view/join.h"
#include "../view/sheet.h"

/* Whether the value is what the text says; no text: null. */
static bool matches(struct gx_value value, const char *text)
{
  double number;
  if (value.type == GX_NULL) return !*text;
  if (value.type == GX_TEXT) return !strcmp(value.text, text);
  return !gx_number_real(text, &number) && gx_value_number(value) == number;
}

static void name_values(const struct gx_table *table, size_t column)
{
  size_t *first = calloc(table->rows + 1, sizeof *first);
  long distinct = first ? gx_axes_values(table, column, first) : 0;
  char buffer[GX_NUMBER_LENGTH];
  for (long i = 0; i < distinct && i < 20; i++) {
    struct gx_value value = gx_table_get(table, first[i], column);
    if (value.type != GX_NULL) fprintf(stderr, " %s", gx_sheet_text(table->column[column].name, value, buffer));
  }
  fputs(distinct > 20 ? " ...\n" : "\n", stderr);
  free(first);
}

/* Keeps the rows of one study that match: none where it lacks the column. Returns how many do, -1: memory ran out. */
static long keep(struct gx_table *table, const char *name, const char *path, const char *text)
{
  long column = gx_table_find(table, path);
  bool whole = !strcmp(path, "study") && !strcmp(name, text), *kept = calloc(table->rows + 1, sizeof *kept);
  if (!kept) return -1;
  for (size_t r = 0; r < table->rows; r++)
    kept[r] = whole || (column >= 0 && matches(gx_table_get(table, r, (size_t)column), text));
  gx_table_keep(table, kept);
  free(kept);
  return (long)table->rows;
}

static int apply(struct gx_command_studies *studies, const char *command, const char *where)
{
  const char *equals = strchr(where, '=');
  struct gx_table *joined =
      gx_join_tables(studies->count, (const struct gx_table *const *)studies->table, (const char *const *)studies->name);
  char *path = strndup(where, equals ? (size_t)(equals - where) : 0);
  long left = 0, column = -1;
  int code = GX_EXIT_USAGE;
  if (!equals) {
    fprintf(stderr, "gridcross %s: --where takes PATH=VALUE, not '%s'\n", command, where);
  } else if (!joined || !path) {
    code = gx_command_no_memory();
  } else if ((column = gx_join_find(joined, path, false, stderr)) >= 0) {
    for (size_t s = 0; s < studies->count && left >= 0; s++) {
      long kept = keep(studies->table[s], studies->name[s], path, equals + 1);
      left = kept < 0 ? -1 : left + kept;
    }
    if (left > 0) {
      code = GX_EXIT_DONE;
    } else if (left < 0) {
      code = gx_command_no_memory();
    } else {
      fprintf(stderr, "gridcross %s: no case has %s; there are:", command, where);
      name_values(joined, (size_t)column);
    }
  }
  free(path);
  gx_table_free(joined);
  return code;
}

int gx_where_keep(struct gx_command_studies *studies, const struct gx_options *options)
{
  const char **where = calloc(options->count + 1, sizeof *where);
  if (!where) return gx_command_no_memory();
  size_t count = gx_options_values(options, "where", where);
  int code = GX_EXIT_DONE;
  for (size_t i = 0; i < count && !code; i++) code = apply(studies, options->command->name, where[i]);
  free(where);
  return code;
}
