/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What lines hold. */
#ifndef GRIDCROSS_SPLINE_LINES_H
#define GRIDCROSS_SPLINE_LINES_H

#include <gridcross_splines.h>

struct gx_spline_lines {
  const struct gx_spline_interpolant *interpolant; /* borrowed */
  const struct gx_spline_points *points;           /* borrowed */
  double *value;                                   /* scratch, [larger of sites and points][lanes], owned */
  double *coefficient;                             /* scratch, [functions][lanes], behind value */
};

#endif
