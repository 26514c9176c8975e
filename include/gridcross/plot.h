/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of studies, drawn by gnuplot. Its script and its data stay beside the figure, for people to restyle. */
#ifndef GRIDCROSS_PLOT_H
#define GRIDCROSS_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/table.h>

/* A value that a paper prints, drawn over the lines. */
struct gx_plot_point {
  double x, y;
};

struct gx_plot {
  size_t studies;
  const struct gx_table *const *table; /* [studies], borrowed */
  const char *const *name;             /* [studies] values of the axis `study` */
  const char *const *directory;        /* [studies] where histories are read */
  const char *title;                   /* "": none */
  const char *x;                       /* lines: column, NULL: as the rows of gx_comparison */
  const char *y;                       /* what is drawn, see the kind's `y`; NULL: its default */
  size_t bys;
  const char *const *by; /* [bys] paths that lead the labels of lines; the other axes follow */
  size_t points;
  const struct gx_plot_point *point; /* [points], lines: drawn as circles */
  double time;                       /* s, field: of the snapshot nearest to it; NaN: the last */
  const char *output;                /* ends in .svg, .png or .pdf */
};

enum gx_plot_status {
  GX_PLOT_DONE,
  GX_PLOT_FAILED, /* a file cannot be written, gnuplot is absent or fails */
  GX_PLOT_REFUSED /* what is asked for is not there, or there is nothing to draw */
};

/* A kind of figure. Cases that cannot be drawn are counted in a note, in the figure and to `errors`, where every message goes. */
struct gx_plot_kind {
  const char *name;
  const char *help;
  const char *y;      /* what --y may name, the default first; NULL: nothing to choose */
  const char *across; /* what it is drawn against, in words; NULL: --x names it */
  bool at_time;       /* --time names one */
  const char *example;
  enum gx_plot_status (*draw)(const struct gx_plot *plot, FILE *errors);
  enum gx_plot_status (*front)(const struct gx_plot *plot, FILE *errors); /* the same with --front; NULL: it has none */
};

/* All kinds, NULL-ended; the first is the default. */
extern const struct gx_plot_kind *const gx_plot_family[];
const struct gx_plot_kind *gx_plot_find(const char *name); /* NULL: no such kind */

#endif
