/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes of a figure in gnuplot's language: scale, range, tics, labels. */
#ifndef GRIDCROSS_VIEW_SCRIPT_AXIS_H
#define GRIDCROSS_VIEW_SCRIPT_AXIS_H

#include "figure.h"

/* Scale, range and tics of both axes. */
void gx_script_axis_scales(const struct gx_figure *figure, FILE *out);
/* Palette, range and label of the colours of values. */
void gx_script_axis_colours(const struct gx_figure *figure, FILE *out);
/* axis: "x", "y" or "cb". */
void gx_script_axis_label(const char *axis, const struct gx_column *column, FILE *out);

#endif
