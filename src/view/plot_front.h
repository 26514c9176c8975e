/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error-cost front as a figure. */
#ifndef GRIDCROSS_VIEW_PLOT_FRONT_H
#define GRIDCROSS_VIEW_PLOT_FRONT_H

#include <gridcross/plot.h>

/* The error y against the cost x (NULL: result.seconds) of every case that counts for an advice, a colour for each value of `by`
 * (none: method.space where it varies, else the first parameter that does), and the error-cost front as steps. */
enum gx_plot_status gx_plot_front_draw(const struct gx_plot *plot, FILE *errors);

#endif
