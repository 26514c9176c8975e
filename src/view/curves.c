/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of one line a case. */
#include "curves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/measure.h>

#include "sketch.h"

/* Errors spread over orders of magnitude; energies swing. */
static bool is_error(const char *name)
{
  for (int q = 0; q < GX_QUANTITIES; q++)
    if (!strncmp(name, gx_measure_quantity[q].name, strlen(gx_measure_quantity[q].name))) return true;
  return false;
}

/* curve: [rows][columns] of the pivot. Returns 0, or -1 after a message. */
static int read_curves(struct gx_sketch *sketch, const struct gx_curves *kind, struct gx_curve *curve, FILE *errors)
{
  const struct gx_pivot *pivot = sketch->pivot;
  const char *name = sketch->plot->y ? sketch->plot->y : kind->name;
  long id = gx_table_find(pivot->table, "case");
  for (size_t i = 0; i < pivot->rows * pivot->columns; i++) {
    long at = pivot->cell[i];
    if (at < 0 || id < 0 || !gx_left_out_try(&sketch->left_out, pivot->table, (size_t)at)) continue;
    size_t row = (size_t)at, study = gx_sketch_study(sketch->plot, &row);
    curve[i] = kind->read(sketch->plot, study, row, name, errors);
    if (!curve[i].table || !gx_sketch_numeric(curve[i].table, 1, "--y", errors)) return -1;
  }
  return 0;
}

static int fill_curves(struct gx_sketch *sketch, const struct gx_curve *curve)
{
  const struct gx_pivot *pivot = sketch->pivot;
  size_t cells = pivot->rows * pivot->columns, samples = 0;
  const struct gx_table *any = NULL;
  for (size_t i = 0; i < cells; i++) {
    if (!curve[i].table) continue;
    samples += curve[i].table->rows;
    any = curve[i].table;
  }
  int failed = any ? gx_figure_start(&sketch->figure, cells, samples, &any->column[0], &any->column[1], NULL) : 0;
  for (size_t c = 0; c < pivot->columns && any && !failed; c++)
    for (size_t r = 0; r < pivot->rows && !failed; r++) {
      const struct gx_table *one = curve[r * pivot->columns + c].table;
      if (!one) continue;
      struct gx_figure_line *line = gx_sketch_begin(sketch, c, pivot->rows > 1, r);
      failed = !line;
      if (line) line->nyquist = curve[r * pivot->columns + c].nyquist;
      for (size_t k = 0; k < one->rows && !failed; k++)
        if (gx_table_get(one, k, 1).type != GX_NULL)
          failed = gx_figure_add(&sketch->figure, gx_table_get(one, k, 0), gx_table_get(one, k, 1));
      if (failed) continue;
      sketch->left_out.empty += !line->count;
      gx_figure_end(&sketch->figure);
    }
  return failed;
}

enum gx_plot_status gx_curves_plot(const struct gx_plot *plot, const struct gx_curves *kind, FILE *errors)
{
  struct gx_sketch sketch = gx_sketch_create_cases(plot, errors);
  size_t cells = sketch.pivot ? sketch.pivot->rows * sketch.pivot->columns : 0;
  struct gx_curve *curve = calloc(cells + 1, sizeof *curve);
  enum gx_plot_status status = GX_PLOT_REFUSED;
  if (!curve || (sketch.pivot && gx_sketch_style(&sketch))) {
    status = gx_sketch_no_memory(errors);
  } else if (sketch.pivot && !read_curves(&sketch, kind, curve, errors)) {
    if (fill_curves(&sketch, curve)) {
      status = gx_sketch_no_memory(errors);
    } else {
      sketch.figure.dense = true;
      sketch.figure.x = gx_figure_range(&sketch.figure, GX_FIGURE_X, kind->in_time ? INFINITY : 10, 0);
      sketch.figure.y =
          gx_figure_range(&sketch.figure, GX_FIGURE_Y, is_error(plot->y ? plot->y : kind->name) ? 10 : INFINITY, kind->in_time);
      status = gx_sketch_draw(&sketch, plot->y ? plot->y : kind->name, errors);
    }
  }
  for (size_t i = 0; curve && i < cells; i++) gx_table_free(curve[i].table);
  free(curve);
  gx_sketch_free(&sketch);
  return status;
}
