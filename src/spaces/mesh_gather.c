/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodal fields at all particles: direction by direction over a lattice, else block by block. */
#include "mesh.h"

struct gathering {
  struct gx_mesh *mesh;
  double *const *value, *const *gradient; /* NULL: not this one */
};

static void gather_block(void *context, struct gx_block *block)
{
  const struct gathering *gathering = context;
  const int dim = gathering->mesh->grid.dim;
  double *value[GX_MAX_DIM], *gradient[GX_MAX_TENSOR];
  if (gathering->value) gx_block_part(block, dim, gathering->value, value);
  if (gathering->gradient) gx_block_part(block, dim * dim, gathering->gradient, gradient);
  gx_exchange_gather(&gathering->mesh->exchange, block, NULL, gathering->value ? value : NULL,
                     gathering->gradient ? gradient : NULL);
}

void gx_mesh_gather(struct gx_mesh *mesh, double *const *field, double *const *value, double *const *gradient)
{
  struct gathering gathering = {mesh, value, gradient};
  if (mesh->lattice) {
    gx_lattice_gather(mesh->lattice, field, value, gradient);
    return;
  }
  gx_exchange_lend(&mesh->exchange, field, NULL);
  gx_blocks_each(&mesh->blocks, gather_block, &gathering);
}
