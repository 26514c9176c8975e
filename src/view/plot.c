/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which points and lines a figure of studies has. */
#include <gridcross/plot.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/compare.h>
#include <gridcross/store.h>

#include "axes.h"
#include "curve.h"
#include "figure.h"
#include "left_out.h"
#include "pivot.h"
#include "sheet.h"

struct sketch {
  const struct gx_plot *plot;
  struct gx_pivot *pivot;
  struct gx_figure figure;
  struct gx_left_out left_out;
  size_t *colour, *style; /* [pivot->columns], owned */
  size_t styles;
};

static enum gx_plot_status no_memory(FILE *errors)
{
  fputs("gridcross: out of memory\n", errors);
  return GX_PLOT_FAILED;
}

static void sketch_free(struct sketch *sketch)
{
  gx_figure_free(&sketch->figure);
  gx_pivot_free(sketch->pivot);
  free(sketch->colour);
  free(sketch->style);
}

/* Labels of the pivot's column, and of the row where that tells cases apart. */
static char *line_label(const struct sketch *sketch, size_t column, bool row_too, size_t row)
{
  const struct gx_pivot *pivot = sketch->pivot;
  char text[GX_SHEET_LABEL];
  char *label = calloc(pivot->axes + 1, GX_SHEET_LABEL + 2);
  for (size_t a = 0; label && a < pivot->axes + row_too; a++) {
    bool across = a < pivot->axes;
    gx_sheet_label(pivot->table, across ? pivot->axis[a] : pivot->row_axis,
                   across ? pivot->column_sample[column] : pivot->row_sample[row], text);
    if (*text && *label) strcat(label, ", ");
    strcat(label, text);
  }
  return label;
}

/* Numbers columns by the distinct values that the axes of `wanted` have there. Returns how many there are. */
static size_t number_columns(const struct gx_pivot *pivot, const bool *wanted, size_t *index)
{
  size_t count = 0;
  for (size_t c = 0; c < pivot->columns; c++) {
    size_t like = 0;
    for (bool same = false; like < c; like++) {
      same = true;
      for (size_t a = 0; a < pivot->axes && same; a++)
        same = !wanted[a] || !gx_value_compare(gx_table_get(pivot->table, pivot->column_sample[c], pivot->axis[a]),
                                               gx_table_get(pivot->table, pivot->column_sample[like], pivot->axis[a]));
      if (same) break;
    }
    index[c] = like < c ? index[like] : count++;
  }
  return count;
}

/* The axes that the colour shows: those of --by, else the one with most values that there are colours for. */
static void choose_coloured(const struct sketch *sketch, bool *coloured)
{
  const struct gx_pivot *pivot = sketch->pivot;
  size_t most = 0, best = 0;
  for (size_t a = 0; a < pivot->axes; a++)
    for (size_t b = 0; b < sketch->plot->bys; b++)
      coloured[a] = coloured[a] || !strcmp(sketch->plot->by[b], pivot->table->column[pivot->axis[a]].name);
  for (size_t a = 0; a < pivot->axes && !sketch->plot->bys; a++) {
    coloured[a] = true;
    size_t count = number_columns(pivot, coloured, sketch->colour);
    coloured[a] = false;
    if (count <= most || count > GX_FIGURE_COLOURS) continue;
    most = count;
    best = a;
  }
  if (!sketch->plot->bys && pivot->axes) coloured[best] = true;
}

/* Colours tell some axes apart, markers and dashes the others. */
static int choose_styles(struct sketch *sketch)
{
  const struct gx_pivot *pivot = sketch->pivot;
  bool *coloured = calloc(pivot->axes + 1, sizeof *coloured);
  sketch->colour = calloc(pivot->columns + 1, sizeof *sketch->colour);
  sketch->style = calloc(pivot->columns + 1, sizeof *sketch->style);
  if (coloured && sketch->colour && sketch->style) {
    choose_coloured(sketch, coloured);
    number_columns(pivot, coloured, sketch->colour);
    for (size_t a = 0; a < pivot->axes; a++) coloured[a] = !coloured[a];
    sketch->styles = number_columns(pivot, coloured, sketch->style);
  }
  int failed = !coloured || !sketch->colour || !sketch->style;
  free(coloured);
  return failed ? -1 : 0;
}

/* What a paper prints, as a line of its own. */
static int add_printed(struct sketch *sketch)
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

static int begin_line(struct sketch *sketch, size_t column, bool row_too, size_t row)
{
  size_t colour = sketch->colour[column], style = sketch->style[column] * (row_too ? sketch->pivot->rows : 1) + row_too * row;
  bool one_style = sketch->styles * (row_too ? sketch->pivot->rows : 1) == 1;
  struct gx_figure_line *line = gx_figure_begin(&sketch->figure, line_label(sketch, column, row_too, row));
  if (!line) return -1;
  line->colour = (int)(colour % GX_FIGURE_COLOURS);
  line->marker = (int)(one_style ? colour : style + colour / GX_FIGURE_COLOURS);
  line->dash = (int)(one_style ? colour / GX_FIGURE_COLOURS : style);
  return 0;
}

static double last_y(const struct gx_figure *figure, const struct gx_figure_line *line)
{
  return gx_figure_number(figure, line->first + line->count - 1, GX_FIGURE_Y);
}

/* Under the last pair of points of the steepest line; of lines about as steep, the lowest, where there is room. */
static void choose_triangle(struct gx_figure *figure)
{
  const struct gx_figure_line *steepest = NULL;
  double most = 0.5;
  for (size_t i = 0; i < figure->lines; i++) most = fmax(most, figure->line[i].order);
  for (size_t i = 0; i < figure->lines; i++) {
    const struct gx_figure_line *line = &figure->line[i];
    if (line->order >= 0.5 && line->order > most - 0.3 && (!steepest || last_y(figure, line) < last_y(figure, steepest)))
      steepest = line;
  }
  if (!steepest) return;
  double below = pow(figure->y.most / figure->y.least, -0.06), log_x[2], log_y[2];
  for (size_t i = 0; i < 2; i++) {
    size_t row = steepest->first + steepest->count - 2 + i;
    log_x[i] = log(gx_figure_number(figure, row, GX_FIGURE_X));
    log_y[i] = log(gx_figure_number(figure, row, GX_FIGURE_Y));
  }
  for (size_t i = 0; i < 2; i++) { /* the middle half of the pair */
    double t = i ? 0.75 : 0.25;
    figure->triangle[i][0] = exp(log_x[0] + t * (log_x[1] - log_x[0]));
    figure->triangle[i][1] = exp(log_y[0] + t * (log_y[1] - log_y[0])) * below;
  }
  figure->triangle[2][0] = figure->triangle[0][0];
  figure->triangle[2][1] = figure->triangle[1][1];
  figure->triangle_slope = steepest->order;
  figure->y.least = fmin(figure->y.least, figure->triangle[2][1] * below);
}

/* Whether a column holds numbers; if not, says so. */
static bool numeric(const struct gx_table *table, size_t column, const char *option, FILE *errors)
{
  if (table->column[column].type != GX_TEXT) return true;
  fprintf(errors, "gridcross: %s is not a number: name another %s\n", table->column[column].name, option);
  return false;
}

static int fill_lines(struct sketch *sketch, size_t x, size_t y)
{
  const struct gx_pivot *pivot = sketch->pivot;
  size_t points = pivot->table->rows + sketch->plot->points;
  int failed = gx_figure_start(&sketch->figure, pivot->columns + 1, points, &pivot->table->column[x], &pivot->table->column[y]);
  for (size_t c = 0; c < pivot->columns && !failed; c++) {
    size_t last = 0;
    failed = begin_line(sketch, c, false, 0);
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

/* name: of what is drawn, a column of the table or of histories. */
static enum gx_plot_status draw(struct sketch *sketch, const char *name, FILE *errors)
{
  gx_left_out_tell(&sketch->left_out, errors);
  if (sketch->figure.lines) return gx_figure_draw(&sketch->figure, sketch->plot->output, errors);
  if (!sketch->left_out.empty)
    fputs("gridcross: there is nothing to draw\n", errors);
  else if (gx_table_find(sketch->pivot->table, name) >= 0)
    gx_left_out_suggest(sketch->pivot->table, name, errors);
  else
    fprintf(errors, "gridcross: there is nothing to draw: no case has %s at any time; --y names another\n", name);
  return GX_PLOT_REFUSED;
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

static struct sketch sketch_create(const struct gx_plot *plot, const char *rows, size_t values, const char *const *value,
                                   FILE *errors)
{
  for (size_t b = 0; rows && b < plot->bys; b++) {
    if (strcmp(rows, plot->by[b])) continue;
    fprintf(errors, "gridcross: %s cannot be both --x and --by\n", rows);
    return (struct sketch){0};
  }
  const struct gx_comparison comparison = {
      .studies = plot->studies,
      .table = plot->table,
      .name = plot->name,
      .rows = rows,
      .columns = plot->bys,
      .column = plot->by,
      .open = true,
      .values = values,
      .value = value,
  };
  return (struct sketch){.plot = plot, .pivot = gx_pivot_create(&comparison, errors), .figure.title = plot->title};
}

enum gx_plot_status gx_plot_lines(const struct gx_plot *plot, FILE *errors)
{
  bool along = !plot->x || is_parameter(plot, plot->x);
  const char *const value[] = {plot->y ? plot->y : "result.displacement.max.rms", plot->x};
  struct sketch sketch = sketch_create(plot, along ? plot->x : NULL, along ? 1 : 2, value, errors);
  enum gx_plot_status status = GX_PLOT_REFUSED;
  if (sketch.pivot) {
    size_t x = along ? sketch.pivot->row_axis : sketch.pivot->value[1], y = sketch.pivot->value[0];
    if (!numeric(sketch.pivot->table, x, "--x", errors) || !numeric(sketch.pivot->table, y, "--y", errors)) {
      status = GX_PLOT_REFUSED;
    } else if (choose_styles(&sketch) || fill_lines(&sketch, x, y)) {
      status = no_memory(errors);
    } else {
      struct gx_figure *figure = &sketch.figure;
      bool ordered = along && gx_pivot_ordered(sketch.pivot, 0);
      figure->few_x = along;
      figure->x = gx_figure_range(figure, GX_FIGURE_X, ordered ? 2 : 10, 0);
      figure->y = gx_figure_range(figure, GX_FIGURE_Y, ordered ? 2 : 10, 0);
      for (size_t i = 0; i < figure->lines; i++)
        if (!figure->x.log || !figure->y.log) figure->line[i].order = NAN;
      choose_triangle(figure);
      status = draw(&sketch, value[0], errors);
    }
  }
  sketch_free(&sketch);
  return status;
}

/* The study that a row of the joined table came from; row becomes that of its own table. */
static size_t study_of(const struct gx_plot *plot, size_t *row)
{
  size_t s = 0;
  for (; *row >= plot->table[s]->rows; s++) *row -= plot->table[s]->rows;
  return s;
}

/* curve: [rows][columns] of the pivot. Returns 0, or -1 after a message. */
static int read_curves(struct sketch *sketch, const struct gx_curves *kind, struct gx_curve *curve, FILE *errors)
{
  const struct gx_pivot *pivot = sketch->pivot;
  const char *name = sketch->plot->y ? sketch->plot->y : kind->name;
  long id = gx_table_find(pivot->table, "case");
  for (size_t i = 0; i < pivot->rows * pivot->columns; i++) {
    long at = pivot->cell[i];
    if (at < 0 || id < 0 || !gx_left_out_try(&sketch->left_out, pivot->table, (size_t)at)) continue;
    size_t row = (size_t)at, study = study_of(sketch->plot, &row);
    curve[i] = kind->read(sketch->plot, study, row, name, errors);
    if (!curve[i].table || !numeric(curve[i].table, 1, "--y", errors)) return -1;
  }
  return 0;
}

static int fill_curves(struct sketch *sketch, const struct gx_curve *curve)
{
  const struct gx_pivot *pivot = sketch->pivot;
  size_t cells = pivot->rows * pivot->columns, samples = 0;
  const struct gx_table *any = NULL;
  for (size_t i = 0; i < cells; i++) {
    if (!curve[i].table) continue;
    samples += curve[i].table->rows;
    any = curve[i].table;
  }
  int failed = any ? gx_figure_start(&sketch->figure, cells, samples, &any->column[0], &any->column[1]) : 0;
  for (size_t c = 0; c < pivot->columns && any && !failed; c++)
    for (size_t r = 0; r < pivot->rows && !failed; r++) {
      const struct gx_table *one = curve[r * pivot->columns + c].table;
      if (!one) continue;
      failed = begin_line(sketch, c, pivot->rows > 1, r);
      sketch->figure.line[sketch->figure.lines - 1].nyquist = curve[r * pivot->columns + c].nyquist;
      for (size_t k = 0; k < one->rows && !failed; k++)
        if (gx_table_get(one, k, 1).type != GX_NULL)
          failed = gx_figure_add(&sketch->figure, gx_table_get(one, k, 0), gx_table_get(one, k, 1));
      if (failed) continue;
      sketch->left_out.empty += !sketch->figure.line[sketch->figure.lines - 1].count;
      gx_figure_end(&sketch->figure);
    }
  return failed;
}

static enum gx_plot_status plot_curves(const struct gx_plot *plot, const struct gx_curves *kind, FILE *errors)
{
  const char *const value[] = {"case"};
  bool by_study = false;
  for (size_t b = 0; b < plot->bys; b++) by_study = by_study || !strcmp(plot->by[b], "study");
  struct sketch sketch = sketch_create(plot, by_study ? NULL : "study", 1, value, errors);
  size_t cells = sketch.pivot ? sketch.pivot->rows * sketch.pivot->columns : 0;
  struct gx_curve *curve = calloc(cells + 1, sizeof *curve);
  enum gx_plot_status status = GX_PLOT_REFUSED;
  if (!curve || (sketch.pivot && choose_styles(&sketch))) {
    status = no_memory(errors);
  } else if (sketch.pivot && !read_curves(&sketch, kind, curve, errors)) {
    if (fill_curves(&sketch, curve)) {
      status = no_memory(errors);
    } else {
      sketch.figure.dense = true;
      sketch.figure.x = gx_figure_range(&sketch.figure, GX_FIGURE_X, kind->in_time ? INFINITY : 10, 0);
      sketch.figure.y = gx_figure_range(&sketch.figure, GX_FIGURE_Y,
                                        gx_curve_is_error(plot->y ? plot->y : kind->name) ? 10 : INFINITY, kind->in_time);
      status = draw(&sketch, plot->y ? plot->y : kind->name, errors);
    }
  }
  for (size_t i = 0; curve && i < cells; i++) gx_table_free(curve[i].table);
  free(curve);
  sketch_free(&sketch);
  return status;
}

enum gx_plot_status gx_plot_history(const struct gx_plot *plot, FILE *errors)
{
  return plot_curves(plot, &gx_curve_history, errors);
}

enum gx_plot_status gx_plot_spectrum(const struct gx_plot *plot, FILE *errors)
{
  return plot_curves(plot, &gx_curve_spectrum, errors);
}
