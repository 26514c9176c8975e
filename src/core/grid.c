/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Periodic images and fixed ends of nodal fields, direction by direction: along one, a field is blocks of consecutive entries, in each
 * first those of the functions, then those of their images. */
#include <gridcross/grid.h>

/* Entries of all functions of direction d, and of a block: that many with the images. */
static size_t period_of(const struct gx_grid *grid, int d)
{
  return grid->stride[d] * (size_t)grid->axis[d].functions;
}

static size_t block_of(const struct gx_grid *grid, int d)
{
  return grid->stride[d] * (size_t)grid->axis[d].stored;
}

void gx_grid_fold(const struct gx_grid *grid, double *field)
{
  for (int d = 0; d < grid->dim; d++) {
    const size_t period = period_of(grid, d), length = block_of(grid, d);
    for (double *block = field; block < field + grid->stored; block += length)
      for (size_t i = length; i-- > period;) { /* an image of an image first */
        block[i - period] += block[i];
        block[i] = 0;
      }
  }
}

void gx_grid_spread(const struct gx_grid *grid, double *field)
{
  for (int d = 0; d < grid->dim; d++) {
    const size_t period = period_of(grid, d), length = block_of(grid, d);
    for (double *block = field; block < field + grid->stored; block += length)
      for (size_t i = period; i < length; i++) block[i] = block[i - period];
  }
}

void gx_grid_fix(const struct gx_grid *grid, int d, double *field)
{
  for (int e = 0; e < grid->dim; e++) {
    const struct gx_axis *axis = &grid->axis[e];
    const size_t length = block_of(grid, e), edge = grid->stride[e] * (size_t)axis->edge;
    for (int end = 0; end < 2 && !axis->periodic; end++) {
      double *first = field + (end ? period_of(grid, e) - edge : 0);
      for (double *block = first; axis->held[end] >> d & 1 && block < field + grid->stored; block += length)
        for (size_t i = 0; i < edge; i++) block[i] = 0;
    }
  }
}
