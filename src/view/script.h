/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A figure in gnuplot's language. */
#ifndef GRIDCROSS_VIEW_SCRIPT_H
#define GRIDCROSS_VIEW_SCRIPT_H

#include "figure.h"

/* The first line of every script of ours: other files are not overwritten. */
extern const char gx_script_mark[];

/* The script that draws the figure. stem: name of the figure without folder and ending (svg, png or pdf). */
void gx_script_write(const struct gx_figure *figure, const char *stem, const char *ending, FILE *out);

#endif
