/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes: the parameters that tell the cases of a table apart. */
#ifndef GRIDCROSS_VIEW_AXES_H
#define GRIDCROSS_VIEW_AXES_H

#include <stdbool.h>

#include <gridcross/table.h>

/* Columns other than case and result.* */
bool gx_axes_parameter(const struct gx_table *table, size_t column);
/* Whether rows differ there. */
bool gx_axes_vary(const struct gx_table *table, size_t column);
/* rank: [rows], of each row's value among the distinct values: numbers ascending, texts as they first appear.
 * Returns how many are distinct, or -1 when memory runs out. */
long gx_axes_rank(const struct gx_table *table, size_t column, size_t *rank);
/* The same, and first: [rows], a row of each distinct value, by its rank. */
long gx_axes_values(const struct gx_table *table, size_t column, size_t *first);
/* Splits groups of rows by rank: group becomes the index of (group, rank) in their order. Returns how many groups there are,
 * or -1 when memory runs out. */
long gx_axes_refine(size_t rows, size_t *group, const size_t *rank);
/* Adds to the `chosen` columns in axis, in table order, every parameter that still tells rows apart; one that follows from those
 * before it does not, unless it sets studies apart: two studies are no refinement of one another for having different cells.
 * axis: [columns]. Returns the new count, or -1 when memory runs out. */
long gx_axes_find(const struct gx_table *table, size_t chosen, size_t *axis);

#endif
