/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A row of a study's table as the run file of that one case. */
#ifndef GRIDCROSS_VIEW_RECIPE_H
#define GRIDCROSS_VIEW_RECIPE_H

#include <stdio.h>

#include <gridcross/table.h>

/* One line a section, `problem: {name: bar-linear}`, after `first` or `other`: parameters whose values do not follow from the
 * rest, so that the case of the run file is this case, with its id. */
void gx_recipe_write(const struct gx_table *table, size_t row, const char *first, const char *other, FILE *out);
/* Text as YAML, in double quotes. */
void gx_recipe_quote(const char *text, FILE *out);

#endif
