/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A figure of lines and points: its data, its gnuplot script, its image. */
#ifndef GRIDCROSS_VIEW_FIGURE_H
#define GRIDCROSS_VIEW_FIGURE_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/plot.h>

/* Columns of the data; VALUE where the figure is coloured by one. */
enum { GX_FIGURE_LINE, GX_FIGURE_X, GX_FIGURE_Y, GX_FIGURE_LABEL, GX_FIGURE_VALUE };

/* Markers: so many shapes filled, then the same open. */
enum { GX_FIGURE_COLOURS = 7, GX_FIGURE_SHAPES = 6, GX_FIGURE_MARKERS = 2 * GX_FIGURE_SHAPES, GX_FIGURE_DASHES = 5 };
enum { GX_FIGURE_TRIANGLES = 4 };

enum gx_figure_style {
  GX_FIGURE_LINES_POINTS,
  GX_FIGURE_POINTS,
  GX_FIGURE_STEPS,
  GX_FIGURE_PRINTED, /* points of a paper: circles */
  GX_FIGURE_CURVES,  /* thin lines, without points */
  GX_FIGURE_GUIDES,  /* dark lines, behind the others */
  GX_FIGURE_EXACT,   /* a black line */
  GX_FIGURE_COLOURED /* points in the colour of their value */
};

struct gx_figure_line {
  char *label; /* owned */
  enum gx_figure_style style;
  size_t panel;
  size_t first, count;      /* rows of data */
  int colour, marker, dash; /* from 0; taken modulo what there is */
  double order;             /* for the legend; NaN: none */
  double nyquist;           /* x of a vertical line; NaN: none */
};

struct gx_figure_axis {
  bool log;
  bool exact;         /* the axis ends there */
  double least, most; /* of the data shown */
};

/* A right-angled triangle under a line: 1 along x, the slope along y. */
struct gx_figure_triangle {
  const struct gx_figure_line *line;
  double at[3][2]; /* right angle last */
  double slope;
};

struct gx_figure {
  const char *title;     /* borrowed; "": none */
  char *note;            /* small, under the axes; NULL or "": none; owned */
  struct gx_table *data; /* line (from 1), x, y, label, value; owned. Names and units of x, y and value label the axes. */
  size_t lines;
  struct gx_figure_line *line; /* owned */
  size_t panels;               /* side by side, with the same axes; 0: one without title */
  char **panel;                /* [panels] their titles, owned */
  struct gx_figure_axis x, y, value;
  bool equal;     /* lengths along x and y are drawn alike */
  double spacing; /* between coloured points along x, which are drawn as wide */
  bool few_x;     /* x takes few values, as parameters do: a tic at each */
  bool dense;     /* so many points that few of them are marked */
  size_t triangles;
  struct gx_figure_triangle triangle[GX_FIGURE_TRIANGLES];
};

/* Room for lines and points; units and names of x and y, and of the value that colours points (NULL: none). Returns 0, or -1 when
 * memory runs out. */
int gx_figure_start(struct gx_figure *figure, size_t lines, size_t points, const struct gx_column *x, const struct gx_column *y,
                    const struct gx_column *value);
/* Begins a line, to be styled by the caller. Takes the label; NULL when there is none. */
struct gx_figure_line *gx_figure_begin(struct gx_figure *figure, char *label);
/* Adds a point to the line begun last; null y: the line is interrupted. Returns 0, or -1 when memory runs out. */
int gx_figure_add(struct gx_figure *figure, struct gx_value x, struct gx_value y);
/* What the data calls the point added last, instead of the line's label, and its value. Return 0, or -1 when memory runs out. */
int gx_figure_name(struct gx_figure *figure, const char *label);
int gx_figure_colour(struct gx_figure *figure, double value);
/* Drops the line begun last if it has no point. */
void gx_figure_end(struct gx_figure *figure);
/* Logarithmic where every value is positive and the greatest exceeds the least by this factor. from: points of each line that do
 * not count. */
struct gx_figure_axis gx_figure_range(const struct gx_figure *figure, size_t column, double factor, size_t from);
/* x, y or value of a row of data. */
double gx_figure_number(const struct gx_figure *figure, size_t row, size_t column);
/* Writes FIGURE.csv and FIGURE.gp beside the output and has gnuplot draw it. */
enum gx_plot_status gx_figure_draw(const struct gx_figure *figure, const char *output, FILE *errors);
void gx_figure_free(struct gx_figure *figure);

#endif
