/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running text on lines of a page. */
#ifndef GRIDCROSS_CLI_TEXT_H
#define GRIDCROSS_CLI_TEXT_H

#include <stdio.h>

/* Characters of a line of text on standard output: the terminal's, at most 100, and those in a file. */
int gx_text_width(void);
/* Prints words from column `at`, where the line stands, in lines of at most `width`, the later ones indented; ends the line. */
void gx_text_print(const char *text, int at, int indent, int width, FILE *out);

#endif
