/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cell of a point and its place in it, without a branch that would stop vectorisation. */
#ifndef GRIDCROSS_BASES_LOCATE_H
#define GRIDCROSS_BASES_LOCATE_H

#include <gridcross/grid.h>

/* Position in units of cells, in [0, cells]; x in [0,1] when bounded, |x| below 2^31 when periodic. */
static inline double gx_locate(bool periodic, int cells, double x)
{
  int whole = (int)x - ((double)(int)x > x);
  return (periodic ? x - whole : x) * cells;
}

/* Cell of a position in units of cells; the far end belongs to the last cell. */
static inline int gx_locate_cell(int cells, double s)
{
  int c = (int)s;
  return c < cells ? c : cells - 1;
}

/* Place in a cell where functions are hats, within (0, 1). On a face of a cell a hat has a slope and no value, so that a node at the
 * edge of a body would have a slope to give and no mass to have a velocity: a share of 2^-60 gives it that of the particle. */
static inline double gx_locate_share(double r)
{
  r = r > 0x1p-60 ? r : 0x1p-60;
  return r < 1 - 0x1p-53 ? r : 1 - 0x1p-53;
}

#endif
