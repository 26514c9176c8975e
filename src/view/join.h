/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies as one table, and its columns by name. */
#ifndef GRIDCROSS_VIEW_JOIN_H
#define GRIDCROSS_VIEW_JOIN_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/table.h>

/* Two studies of one name could not be told apart, and most likely are one. Returns 0, or -1 after a message. */
int gx_join_check(size_t studies, const char *const *name, FILE *errors);
/* Columns of every study by name, in the order of the first that has them, then `study`: the last, so that it is an axis only
 * where parameters do not tell two cases apart. NULL when memory runs out. */
struct gx_table *gx_join_tables(size_t studies, const struct gx_table *const *table, const char *const *name);
/* Column of a parameter (or of any column), or -1 after a message with what was probably meant. */
long gx_join_find(const struct gx_table *joined, const char *name, bool parameter, FILE *errors);

#endif
