/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cases by their axes, and how lines of a figure are told apart. */
#include "sketch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "axes.h"
#include "sheet.h"

enum gx_plot_status gx_sketch_no_memory(FILE *errors)
{
  fputs("gridcross: out of memory\n", errors);
  return GX_PLOT_FAILED;
}

void gx_sketch_free(struct gx_sketch *sketch)
{
  gx_figure_free(&sketch->figure);
  gx_pivot_free(sketch->pivot);
  free(sketch->colour);
  free(sketch->style);
}

struct gx_sketch gx_sketch_create(const struct gx_plot *plot, const char *rows, size_t values, const char *const *value,
                                  FILE *errors)
{
  for (size_t b = 0; rows && b < plot->bys; b++) {
    if (strcmp(rows, plot->by[b])) continue;
    fprintf(errors, "gridcross: %s cannot be both --x and --by\n", rows);
    return (struct gx_sketch){0};
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
  return (struct gx_sketch){.plot = plot, .pivot = gx_pivot_create(&comparison, errors), .figure.title = plot->title};
}

struct gx_sketch gx_sketch_create_cases(const struct gx_plot *plot, FILE *errors)
{
  const char *const value[] = {"case"};
  bool by_study = false;
  for (size_t b = 0; b < plot->bys; b++) by_study = by_study || !strcmp(plot->by[b], "study");
  return gx_sketch_create(plot, by_study ? NULL : "study", 1, value, errors);
}

char *gx_sketch_label(const struct gx_sketch *sketch, size_t column, bool row_too, size_t row)
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
static void choose_coloured(const struct gx_sketch *sketch, bool *coloured)
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

int gx_sketch_style(struct gx_sketch *sketch)
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

/* Colour and marker tell the same values apart, for print in grey; dashes and filled or open markers the others. */
static void style_line(struct gx_figure_line *line, size_t colour, size_t style, bool one_style)
{
  line->colour = (int)(colour % GX_FIGURE_COLOURS);
  if (one_style) {
    line->marker = (int)(colour % GX_FIGURE_MARKERS);
    line->dash = (int)(colour / GX_FIGURE_MARKERS);
  } else {
    size_t shape = (colour + style / (2 * GX_FIGURE_DASHES)) % GX_FIGURE_SHAPES;
    line->marker = (int)(shape + GX_FIGURE_SHAPES * (style % 2));
    line->dash = (int)(style % GX_FIGURE_DASHES);
  }
}

struct gx_figure_line *gx_sketch_begin(struct gx_sketch *sketch, size_t column, bool row_too, size_t row)
{
  size_t rows = row_too ? sketch->pivot->rows : 1;
  struct gx_figure_line *line = gx_figure_begin(&sketch->figure, gx_sketch_label(sketch, column, row_too, row));
  if (line) style_line(line, sketch->colour[column], sketch->style[column] * rows + row_too * row, sketch->styles * rows == 1);
  return line;
}

size_t gx_sketch_study(const struct gx_plot *plot, size_t *row)
{
  size_t s = 0;
  for (; *row >= plot->table[s]->rows; s++) *row -= plot->table[s]->rows;
  return s;
}

bool gx_sketch_numeric(const struct gx_table *table, size_t column, const char *option, FILE *errors)
{
  if (table->column[column].type != GX_TEXT) return true;
  fprintf(errors, "gridcross: %s is not a number: name another %s\n", table->column[column].name, option);
  return false;
}

/* Takes the text, which follows what the figure's note says already. Returns 0, or -1 when memory runs out. */
static int add_note(struct gx_figure *figure, char *text)
{
  char *before = figure->note;
  size_t room = text ? strlen(text) + (before ? strlen(before) : 0) + 3 : 0;
  figure->note = text ? malloc(room) : NULL;
  if (figure->note) snprintf(figure->note, room, "%s%s%s", before ? before : "", before && *before && *text ? "; " : "", text);
  free(before);
  free(text);
  return figure->note ? 0 : -1;
}

enum gx_plot_status gx_sketch_draw(struct gx_sketch *sketch, const char *name, FILE *errors)
{
  gx_left_out_tell(&sketch->left_out, errors);
  if (sketch->figure.lines) {
    if (add_note(&sketch->figure, gx_left_out_text(&sketch->left_out))) return gx_sketch_no_memory(errors);
    return gx_figure_draw(&sketch->figure, sketch->plot->output, errors);
  }
  if (!sketch->left_out.empty)
    fputs("gridcross: there is nothing to draw\n", errors);
  else if (gx_table_find(sketch->pivot->table, name) >= 0)
    gx_left_out_suggest(sketch->pivot->table, name, errors);
  else
    fprintf(
        errors,
        "gridcross: there is nothing to draw: no case has %s at any time; --y names another: gridcross plot --help lists some\n",
        name);
  return GX_PLOT_REFUSED;
}
