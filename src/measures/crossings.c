/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crossings count particles whose cell is another than at the last count, direction by direction. */
#include "crossings.h"

#include <math.h>

#include "../core/kernel.h"

/* The count is as wide as a double, of which as many fit in a vector. */
GX_CLONES static double moved_cell(size_t n, const double *restrict X, const double *restrict u, double cells,
                                   double *restrict cell)
{
  long moved = 0;
  for (size_t p = 0; p < n; p++) {
    double now = floor((X[p] + u[p]) * cells);
    moved += now != cell[p];
    cell[p] = now;
  }
  return (double)moved;
}

/* The same for cells that end at given edges. */
static double moved_edges(size_t n, const double *X, const double *u, const struct gx_space *space, double *cell)
{
  double moved = 0;
  for (size_t p = 0; p < n; p++) {
    size_t now = 0;
    while (now < space->edges && X[p] + u[p] >= space->edge[now]) now++;
    moved += (double)now != cell[p];
    cell[p] = (double)now;
  }
  return moved;
}

double gx_crossings_count(const struct gx_space *space, const int *cells, double *const *cell)
{
  const struct gx_particles *particles = space->particles;
  double moved = 0;
  for (int d = 0; d < particles->dim; d++) {
    const double *X = particles->X[d], *u = particles->u[d];
    moved += space->edge ? moved_edges(particles->n, X, u, space, cell[d]) : moved_cell(particles->n, X, u, cells[d], cell[d]);
  }
  return moved;
}
