/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gnuplot itself, and its texts. */
#ifndef GRIDCROSS_VIEW_GNUPLOT_H
#define GRIDCROSS_VIEW_GNUPLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Part of a text in double quotes, byte for byte. */
void gx_gnuplot_quote(const char *text, size_t length, FILE *out);
/* The same for text to be seen: a line break would break the line, and what is no character would spoil the image. */
void gx_gnuplot_text(const char *text, FILE *out);
/* Its first bytes, which end between characters. */
void gx_gnuplot_part(const char *text, size_t bytes, FILE *out);
/* Has gnuplot run a script in its folder. Returns 0, or -1 after a message without its line end. */
int gx_gnuplot_run(const char *folder, const char *script, FILE *errors);
/* Whether an SVG, PNG or PDF has its end: gnuplot does not say when the disk is full. */
bool gx_gnuplot_is_whole(const char *image);
/* Blanks the date in a PDF, so that equal figures have equal bytes. Returns 0, or -1 when the file cannot be changed. */
int gx_gnuplot_undate(const char *pdf);

#endif
