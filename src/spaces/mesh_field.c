/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodal fields at points of the grid. */
#include "mesh.h"

/* In blocks, so that nothing is allocated. */
void gx_mesh_field_at(const struct gx_mesh *mesh, double *const *field, size_t n, double *const *point, double *const *value)
{
  enum { BLOCK = 64 };
  const int dim = mesh->grid.dim;
  int first[GX_MAX_DIM][BLOCK];
  double S[GX_MAX_DIM][GX_MAX_SUPPORT * BLOCK], D[GX_MAX_DIM][GX_MAX_SUPPORT * BLOCK], half[BLOCK];
  struct gx_weights weights = {.dim = dim, .support = mesh->grid.axis[0].support};
  for (int i = 0; i < BLOCK; i++) half[i] = 1e-12 * mesh->grid.axis[0].h; /* a hat, but for round-off at its kinks */
  for (size_t from = 0; from < n; from += weights.n) {
    double *out[GX_MAX_DIM];
    weights.n = n - from < BLOCK ? n - from : BLOCK;
    for (int d = 0; d < dim; d++) {
      weights.stride[d] = mesh->grid.stride[d];
      weights.first[d] = first[d];
      weights.S[d] = S[d];
      weights.D[d] = D[d];
      out[d] = value[d] + from;
      mesh->options.basis->evaluate(&mesh->grid.axis[d], weights.n, point[d] + from, half, first[d], S[d], D[d]);
    }
    gx_transfer_gather(&weights, field, out);
  }
}

void gx_mesh_field(const struct gx_space *space, enum gx_field which, size_t n, double *const *point, double *const *value)
{
  const struct gx_mesh *mesh = (const struct gx_mesh *)space;
  gx_mesh_field_at(mesh, which == GX_FIELD_VELOCITY ? mesh->v : mesh->a, n, point, value);
}
