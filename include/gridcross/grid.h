/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The background grid: a box [0,1]^dim of equal cells, its basis functions per direction, and fields over them.
 * A periodic direction stores images of its first functions behind the last one, so that no kernel wraps an index. */
#ifndef GRIDCROSS_GRID_H
#define GRIDCROSS_GRID_H

#include <stdbool.h>
#include <stddef.h>

#include <gridcross/particles.h>

struct gx_axis {
  int cells;
  bool periodic;
  double h;         /* cell width 1/cells, m */
  int degree;       /* of the basis along this direction */
  int support;      /* functions that are non-zero in a cell */
  int functions;    /* distinct basis functions */
  int stored;       /* functions plus periodic images */
  int edge;         /* bounded: functions at each end that are zero where a component is held there */
  unsigned held[2]; /* bounded: bit d: vector component d is held at zero at the low, the high end */
};

struct gx_grid {
  int dim;
  struct gx_axis axis[GX_MAX_DIM];
  size_t stride[GX_MAX_DIM]; /* first direction fastest */
  size_t stored;             /* entries of a field: product of axis[d].stored */
};

/* Moves the contents of periodic images to the functions they stand for, leaving zeros. field: [stored]. */
void gx_grid_fold(const struct gx_grid *grid, double *field);
/* Copies functions to their periodic images. field: [stored]. */
void gx_grid_spread(const struct gx_grid *grid, double *field);
/* Zeroes vector component d where an end holds it. field: [stored]. */
void gx_grid_fix(const struct gx_grid *grid, int d, double *field);

#endif
