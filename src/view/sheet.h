/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables for people: short numbers, aligned columns. */
#ifndef GRIDCROSS_VIEW_SHEET_H
#define GRIDCROSS_VIEW_SHEET_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/page.h>
#include <gridcross/table.h>

/* Errors and energies: quantities that have an order, printed as 1.23e-4. */
bool gx_sheet_error_like(const char *column);
/* Those and times: the smaller, the better. */
bool gx_sheet_least_is_best(const char *column);
/* Text of a value as its column is shown: parameters in full, results by 3 or 4 digits, null as "-".
 * The answer is the buffer or the value's own text. */
const char *gx_sheet_text(const char *column, struct gx_value value, char buffer[GX_NUMBER_LENGTH]);
/* 1.23e-05 to 1.23e-5 */
void gx_sheet_shorten(char *text);
/* Characters that a terminal shows of UTF-8 text. */
int gx_sheet_width(const char *text);
/* Text filled with blanks to the width, at its left side when `right`. */
void gx_sheet_pad(const char *text, int width, bool right, FILE *out);
/* Columns of numbers are right-aligned; columns that hold nothing but null are left out. Where the page is too narrow, in this order
 * until it fits: headings are broken at dots and underscores, columns with one value in all rows are said beneath, a text in the last
 * column is broken between words, columns stand closer, and they go into blocks one below the other, each led by the parameters. No entry is ever
 * cut. Returns 0, or -1 when memory runs out. */
int gx_sheet_print(const struct gx_table *table, const struct gx_page *page, FILE *out);
enum { GX_SHEET_LABEL = 160 };

/* An entry of a table in a label: "standard" for a text, "degree 2" for a number; nothing where the parameter does not apply.
 * Returns text. */
const char *gx_sheet_label(const struct gx_table *table, size_t column, size_t row, char text[GX_SHEET_LABEL]);
/* The last part of a dotted path. */
const char *gx_sheet_leaf(const char *path);

#endif
