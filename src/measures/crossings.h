/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes of cell of particles that move through a grid. */
#ifndef GRIDCROSS_MEASURES_CROSSINGS_H
#define GRIDCROSS_MEASURES_CROSSINGS_H

#include <gridcross/space.h>

/* Changes since cell was set, to what it is now. cells: per direction, unless the space has edges of its own; cell: [dim][n]. */
double gx_crossings_count(const struct gx_space *space, const int *cells, double *const *cell);

#endif
