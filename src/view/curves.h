/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What figures of one line a case draw. */
#ifndef GRIDCROSS_VIEW_CURVES_H
#define GRIDCROSS_VIEW_CURVES_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/plot.h>

struct gx_curve {
  struct gx_table *table; /* x and y, owned by the caller; NULL: none, after a message */
  double nyquist;         /* x to be marked; NaN: none */
};

struct gx_curves {
  const char *name; /* default of --y */
  bool in_time;     /* from an exact start; else by wavenumber */
  /* row: of the study's own table */
  struct gx_curve (*read)(const struct gx_plot *plot, size_t study, size_t row, const char *name, FILE *errors);
};

enum gx_plot_status gx_curves_plot(const struct gx_plot *plot, const struct gx_curves *kind, FILE *errors);

#endif
