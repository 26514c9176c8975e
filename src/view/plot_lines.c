/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A result against a parameter or another result, one line for each value of the other axes. */
#include <math.h>
#include <string.h>

#include "axes.h"
#include "sketch.h"
#include "plot_front.h"
#include "triangle.h"

/* What a paper prints, as a line of its own. */
static int add_printed(struct gx_sketch *sketch)
{
  const struct gx_plot *plot = sketch->plot;
  if (!plot->points) return 0;
  struct gx_figure_line *line = gx_figure_begin(&sketch->figure, strdup("printed"));
  int failed = !line;
  if (line) line->style = GX_FIGURE_PRINTED;
  for (size_t i = 0; i < plot->points && !failed; i++)
    failed = gx_figure_add(&sketch->figure, (struct gx_value){.type = GX_REAL, .real = plot->point[i].x},
                           (struct gx_value){.type = GX_REAL, .real = plot->point[i].y});
  return failed;
}

static int fill_lines(struct gx_sketch *sketch, size_t x, size_t y)
{
  const struct gx_pivot *pivot = sketch->pivot;
  size_t points = pivot->table->rows + sketch->plot->points;
  int failed =
      gx_figure_start(&sketch->figure, pivot->columns + 1, points, &pivot->table->column[x], &pivot->table->column[y], NULL);
  for (size_t c = 0; c < pivot->columns && !failed; c++) {
    size_t last = 0;
    failed = !gx_sketch_begin(sketch, c, false, 0);
    for (size_t r = 0; r < pivot->rows && !failed; r++) {
      long at = pivot->cell[r * pivot->columns + c];
      if (at < 0 || (!gx_pivot_ok(pivot, at, y) && !gx_left_out_try(&sketch->left_out, pivot->table, (size_t)at))) continue;
      if (isnan(gx_pivot_number(pivot, at, x)) || isnan(gx_pivot_number(pivot, at, y))) {
        sketch->left_out.empty++;
        continue;
      }
      failed =
          gx_figure_add(&sketch->figure, gx_table_get(pivot->table, (size_t)at, x), gx_table_get(pivot->table, (size_t)at, y));
      last = r;
    }
    if (failed) break;
    if (x == pivot->row_axis) sketch->figure.line[sketch->figure.lines - 1].order = gx_pivot_order(pivot, 0, last, c);
    gx_figure_end(&sketch->figure);
  }
  if (!failed && sketch->figure.lines) failed = add_printed(sketch);
  return failed;
}

/* Whether some study has this parameter. */
static bool is_parameter(const struct gx_plot *plot, const char *path)
{
  for (size_t s = 0; s < plot->studies; s++) {
    long c = gx_table_find(plot->table[s], path);
    if (c >= 0 && gx_axes_parameter(plot->table[s], (size_t)c)) return true;
  }
  return !strcmp(path, "study");
}

static enum gx_plot_status draw(const struct gx_plot *plot, FILE *errors)
{
  bool along = !plot->x || is_parameter(plot, plot->x);
  const char *const value[] = {plot->y ? plot->y : "result.displacement.max.rms", plot->x};
  struct gx_sketch sketch = gx_sketch_create(plot, along ? plot->x : NULL, along ? 1 : 2, value, errors);
  enum gx_plot_status status = GX_PLOT_REFUSED;
  if (sketch.pivot) {
    size_t x = along ? sketch.pivot->row_axis : sketch.pivot->value[1], y = sketch.pivot->value[0];
    if (!gx_sketch_numeric(sketch.pivot->table, x, "--x", errors) || !gx_sketch_numeric(sketch.pivot->table, y, "--y", errors)) {
      status = GX_PLOT_REFUSED;
    } else if (gx_sketch_style(&sketch) || fill_lines(&sketch, x, y)) {
      status = gx_sketch_no_memory(errors);
    } else {
      struct gx_figure *figure = &sketch.figure;
      bool ordered = along && gx_pivot_ordered(sketch.pivot, 0);
      figure->few_x = along;
      figure->x = gx_figure_range(figure, GX_FIGURE_X, ordered ? 2 : 10, 0);
      figure->y = gx_figure_range(figure, GX_FIGURE_Y, ordered ? 2 : 10, 0);
      for (size_t i = 0; i < figure->lines; i++)
        if (!figure->x.log || !figure->y.log) figure->line[i].order = NAN;
      gx_triangle_find(figure);
      status = gx_sketch_draw(&sketch, value[0], errors);
    }
  }
  gx_sketch_free(&sketch);
  return status;
}

const struct gx_plot_kind gx_plot_lines = {
    .name = "lines",
    .help = "a result against what refines or costs, one line for each value of the other parameters, with observed orders",
    .y = "result.displacement.max.rms, or any other column of the table",
    .example = "gridcross plot FILE.study --x mesh.cells --by method.space -o order.svg",
    .draw = draw,
    .front = gx_plot_front_draw,
};
