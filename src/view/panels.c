/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cases that failed have snapshots up to then, and are drawn: what went wrong is to be seen there. */
#include "panels.h"

#include <stdlib.h>
#include <string.h>

#include <gridcross/recorder.h>

static const char *text_of(const struct gx_table *table, size_t row, const char *column)
{
  long c = gx_table_find(table, column);
  struct gx_value value = c < 0 ? (struct gx_value){.type = GX_NULL} : gx_table_get(table, row, (size_t)c);
  return value.type == GX_TEXT ? value.text : "";
}

long gx_panels_choose(struct gx_sketch *sketch, size_t most, struct gx_panels_case **cases, FILE *errors)
{
  const struct gx_pivot *pivot = sketch->pivot;
  size_t count = 0;
  *cases = calloc(pivot->rows * pivot->columns + 1, sizeof **cases);
  if (!*cases) {
    gx_sketch_no_memory(errors);
    return -1;
  }
  for (size_t c = 0; c < pivot->columns; c++)
    for (size_t r = 0; r < pivot->rows; r++) {
      long at = pivot->cell[r * pivot->columns + c];
      if (at < 0) continue;
      size_t row = (size_t)at, study = gx_sketch_study(sketch->plot, &row);
      const char *directory = sketch->plot->directory[study], *id = text_of(pivot->table, (size_t)at, "case");
      if (gx_recorder_has(directory, id))
        (*cases)[count++] = (struct gx_panels_case){directory, id, (size_t)at, c, r};
      else if (gx_left_out_try(&sketch->left_out, pivot->table, (size_t)at))
        sketch->left_out.empty++;
    }
  if (count && count <= most) return (long)count;
  if (count)
    fprintf(errors, "gridcross: %zu cases have snapshots, and a figure shows at most %zu: choose by --where PATH=VALUE\n", count,
            most);
  else
    fputs("gridcross: no case has snapshots: set output.snapshots in the run file, and run that again\n", errors);
  return -1;
}

char *gx_panels_title(const struct gx_sketch *sketch, const struct gx_panels_case *one)
{
  char *label = gx_sketch_label(sketch, one->line_column, sketch->pivot->rows > 1, one->line_row), *title = NULL;
  const char *status = text_of(sketch->pivot->table, one->row, "result.status");
  size_t length;
  FILE *out = label ? open_memstream(&title, &length) : NULL;
  if (out) {
    fputs(label, out);
    if (*status && strcmp(status, gx_status_name(GX_OK)) != 0) fprintf(out, "%s%s", *label ? ": " : "", status);
    if (fclose(out)) {
      free(title);
      title = NULL;
    }
  }
  free(label);
  return title;
}
