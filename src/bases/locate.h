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

#endif
