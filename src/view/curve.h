/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What figures of one line a case draw. */
#ifndef GRIDCROSS_VIEW_CURVE_H
#define GRIDCROSS_VIEW_CURVE_H

#include <stdbool.h>

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

extern const struct gx_curves gx_curve_history, gx_curve_spectrum;

/* Errors spread over orders of magnitude; energies swing. */
bool gx_curve_is_error(const char *name);

#endif
