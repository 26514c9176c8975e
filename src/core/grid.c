/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Periodic images and fixed ends of nodal fields, direction by direction. */
#include <gridcross/grid.h>

/* Layer k of direction d is every entry whose index along d is k: `outer` runs of `inner` consecutive entries. */
static size_t outer_of(const struct gx_grid *grid, int d)
{
  return grid->stored / (grid->stride[d] * (size_t)grid->axis[d].stored);
}

static double *layer(const struct gx_grid *grid, int d, double *field, size_t outer, int k)
{
  return field + (outer * (size_t)grid->axis[d].stored + (size_t)k) * grid->stride[d];
}

void gx_grid_fold(const struct gx_grid *grid, double *field)
{
  for (int d = 0; d < grid->dim; d++) {
    const struct gx_axis *axis = &grid->axis[d];
    size_t inner = grid->stride[d], outer = outer_of(grid, d);
    for (size_t o = 0; o < outer; o++)
      for (int k = axis->stored - 1; k >= axis->functions; k--) {
        double *image = layer(grid, d, field, o, k), *original = layer(grid, d, field, o, k - axis->functions);
        for (size_t i = 0; i < inner; i++) {
          original[i] += image[i];
          image[i] = 0;
        }
      }
  }
}

void gx_grid_spread(const struct gx_grid *grid, double *field)
{
  for (int d = 0; d < grid->dim; d++) {
    const struct gx_axis *axis = &grid->axis[d];
    size_t inner = grid->stride[d], outer = outer_of(grid, d);
    for (size_t o = 0; o < outer; o++)
      for (int k = axis->functions; k < axis->stored; k++) {
        double *image = layer(grid, d, field, o, k);
        const double *original = layer(grid, d, field, o, k - axis->functions);
        for (size_t i = 0; i < inner; i++) image[i] = original[i];
      }
  }
}

void gx_grid_fix(const struct gx_grid *grid, int d, double *field)
{
  for (int e = 0; e < grid->dim; e++) {
    const struct gx_axis *axis = &grid->axis[e];
    size_t inner = grid->stride[e], outer = outer_of(grid, e);
    for (int end = 0; end < 2 && !axis->periodic; end++)
      for (size_t o = 0; axis->held[end] >> d & 1 && o < outer; o++)
        for (int k = 0; k < axis->edge; k++) {
          double *run = layer(grid, e, field, o, end ? axis->functions - 1 - k : k);
          for (size_t i = 0; i < inner; i++) run[i] = 0;
        }
  }
}
