/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of studies, drawn by gnuplot. Its script and its data stay beside the figure, for people to restyle. */
#ifndef GRIDCROSS_PLOT_H
#define GRIDCROSS_PLOT_H

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
  const char *y;                       /* lines: column, NULL: result.displacement.max.rms; history: NULL: displacement.rms;
                                        * spectrum: displacement, velocity or stress, NULL: displacement */
  size_t bys;
  const char *const *by; /* [bys] paths that lead the labels of lines; the other axes follow */
  size_t points;
  const struct gx_plot_point *point; /* [points], lines: drawn as circles */
  const char *output;                /* ends in .svg, .png or .pdf */
};

enum gx_plot_status {
  GX_PLOT_DONE,
  GX_PLOT_FAILED, /* a file cannot be written, gnuplot is absent or fails */
  GX_PLOT_REFUSED /* what is asked for is not there, or there is nothing to draw */
};

/* y against x, one line for each value of the other axes; cases that did not end ok are left out and counted in a note to
 * `errors`, where every message goes. */
enum gx_plot_status gx_plot_lines(const struct gx_plot *plot, FILE *errors);
/* The error y against the cost x (NULL: result.seconds) of every case that counts for an advice, a colour for each value of `by`
 * (none: method.space where it varies, else the first parameter that does), and the error-cost front as steps. */
enum gx_plot_status gx_plot_front(const struct gx_plot *plot, FILE *errors);
/* A history against time, one line for each case that ended ok. */
enum gx_plot_status gx_plot_history(const struct gx_plot *plot, FILE *errors);
/* The error's last spectrum by wavenumber, both axes logarithmic, the grid's Nyquist wavenumber marked: one line for each case
 * that ended ok. */
enum gx_plot_status gx_plot_spectrum(const struct gx_plot *plot, FILE *errors);

#endif
