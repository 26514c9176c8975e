/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A figure of lines and points: its data, its gnuplot script, its image. */
#ifndef GRIDCROSS_VIEW_FIGURE_H
#define GRIDCROSS_VIEW_FIGURE_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/plot.h>

enum { GX_FIGURE_LINE, GX_FIGURE_X, GX_FIGURE_Y, GX_FIGURE_LABEL, GX_FIGURE_COLUMNS };

enum { GX_FIGURE_COLOURS = 7 };

/* PRINTED: points of a paper, circles, no line */
enum gx_figure_style { GX_FIGURE_LINES_POINTS, GX_FIGURE_POINTS, GX_FIGURE_STEPS, GX_FIGURE_PRINTED };

struct gx_figure_line {
  char *label; /* owned */
  enum gx_figure_style style;
  size_t first, count;      /* rows of data */
  int colour, marker, dash; /* from 0; taken modulo what there is */
  double order;             /* for the legend; NaN: none */
  double nyquist;           /* x of a vertical line; NaN: none */
};

struct gx_figure_axis {
  bool log;
  double least, most; /* of the data shown */
};

struct gx_figure {
  const char *title;     /* borrowed; "": none */
  struct gx_table *data; /* line (from 1), x, y, label; owned. Names and units of x and y label the axes. */
  size_t lines;
  struct gx_figure_line *line; /* owned */
  struct gx_figure_axis x, y;
  bool few_x;            /* x takes few values, as parameters do: a tic at each */
  bool dense;            /* so many points that few of them are marked */
  double triangle[3][2]; /* right angle last */
  double triangle_slope; /* 0: no triangle */
};

/* Room for lines and points; units and names of x and y. Returns 0, or -1 when memory runs out. */
int gx_figure_start(struct gx_figure *figure, size_t lines, size_t points, const struct gx_column *x, const struct gx_column *y);
/* Begins a line, to be styled by the caller. Takes the label; NULL when there is none. */
struct gx_figure_line *gx_figure_begin(struct gx_figure *figure, char *label);
/* Adds a point to the line begun last. Returns 0, or -1 when memory runs out. */
int gx_figure_add(struct gx_figure *figure, struct gx_value x, struct gx_value y);
/* Drops the line begun last if it has no point. */
void gx_figure_end(struct gx_figure *figure);
/* Logarithmic where every value is positive and the greatest exceeds the least by this factor. from: points of each line that do
 * not count. */
struct gx_figure_axis gx_figure_range(const struct gx_figure *figure, size_t column, double factor, size_t from);
/* x or y of a row of data. */
double gx_figure_number(const struct gx_figure *figure, size_t row, size_t column);
/* Writes FIGURE.csv and FIGURE.gp beside the output and has gnuplot draw it. */
enum gx_plot_status gx_figure_draw(const struct gx_figure *figure, const char *output, FILE *errors);
void gx_figure_free(struct gx_figure *figure);

#endif
