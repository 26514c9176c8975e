/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gnuplot's language, and gnuplot itself. */
#ifndef GRIDCROSS_VIEW_GNUPLOT_H
#define GRIDCROSS_VIEW_GNUPLOT_H

#include "figure.h"

/* The first line of every script of ours: other files are not overwritten. */
extern const char gx_gnuplot_mark[];

/* The script that draws the figure. stem: name of the figure without folder and ending (svg, png or pdf). */
void gx_gnuplot_write(const struct gx_figure *figure, const char *stem, const char *ending, FILE *out);
/* Has gnuplot run a script in its folder. Returns 0, or -1 after a message without its line end. */
int gx_gnuplot_run(const char *folder, const char *script, FILE *errors);

#endif
