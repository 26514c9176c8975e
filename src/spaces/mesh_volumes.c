/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a function of the grid integrates to: products of integrals along each direction, taken by Gauss points of the cells. */
#include "mesh.h"

#include <stdlib.h>

#include <gsl/gsl_integration.h>

enum { POINTS = GX_MAX_DEGREE / 2 + 1 }; /* exact up to that degree */

/* length: [stored] zeros, m; images of periodic functions count to these. */
static void integrate(const struct gx_basis *basis, const struct gx_axis *axis, const gsl_integration_glfixed_table *gauss,
                      double *length)
{
  int first[POINTS];
  double x[POINTS], w[POINTS], half[POINTS], S[GX_MAX_SUPPORT * POINTS], D[GX_MAX_SUPPORT * POINTS];
  for (int cell = 0; cell < axis->cells; cell++) {
    for (size_t q = 0; q < POINTS; q++) {
      gsl_integration_glfixed_point(cell * axis->h, (cell + 1) * axis->h, q, &x[q], &w[q], gauss);
      half[q] = 1e-12 * axis->h;
    }
    basis->evaluate(axis, POINTS, x, half, first, S, D);
    for (int k = 0; k < axis->support; k++)
      for (int q = 0; q < POINTS; q++) {
        int i = first[q] + k;
        length[axis->periodic ? i % axis->functions : i] += w[q] * S[k * POINTS + q];
      }
  }
}

int gx_mesh_volumes(const struct gx_mesh *mesh, double *volume)
{
  const struct gx_grid *grid = &mesh->grid;
  gsl_integration_glfixed_table *gauss = gsl_integration_glfixed_table_alloc(POINTS);
  int failed = gauss ? 0 : -1;
  for (size_t i = 0; i < grid->stored; i++) volume[i] = 1;
  for (int d = 0; d < grid->dim && !failed; d++) {
    const size_t stored = (size_t)grid->axis[d].stored;
    double *length = calloc(stored, sizeof *length);
    failed = length ? 0 : -1;
    if (length) integrate(mesh->options.basis, &grid->axis[d], gauss, length);
    for (size_t i = 0; i < grid->stored && length; i++) volume[i] *= length[i / grid->stride[d] % stored];
    free(length);
  }
  if (gauss) gsl_integration_glfixed_table_free(gauss);
  return failed;
}
