/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a figure's axes, legend and titles stand. Lengths are pixels of an SVG. */
#ifndef GRIDCROSS_VIEW_SCRIPT_LAYOUT_H
#define GRIDCROSS_VIEW_SCRIPT_LAYOUT_H

#include "figure.h"

struct gx_script_layout {
  double width, height; /* of the figure */
  double across, down;  /* extent of the axes of one panel */
  double top;           /* above the first of them */
  double right;         /* where the last of them end */
  size_t columns;       /* of panels */
  double point;         /* size of coloured points, for gnuplot */
  bool key;
};

struct gx_script_layout gx_script_layout_choose(const struct gx_figure *figure);
/* ending: svg, png or pdf */
void gx_script_layout_terminal(const struct gx_script_layout *layout, const char *ending, FILE *out);
/* Title, note, legend, colour bar; the margins of a figure without panels. */
void gx_script_layout_write(const struct gx_figure *figure, const struct gx_script_layout *layout, FILE *out);
/* Margins, title and labels of one panel. */
void gx_script_layout_panel(const struct gx_figure *figure, const struct gx_script_layout *layout, size_t panel, FILE *out);

#endif
