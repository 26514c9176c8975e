/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slope triangles. */
#ifndef GRIDCROSS_VIEW_TRIANGLE_H
#define GRIDCROSS_VIEW_TRIANGLE_H

#include "figure.h"

/* Puts triangles with the measured order under lines that have one, in a figure with logarithmic axes: one for each order, the steepest
 * first, where no line runs; makes room below the lowest line. */
void gx_triangle_find(struct gx_figure *figure);

#endif
