/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Momentum between nodes and particles where the integrals are not sums over these. */
#include "mesh.h"

#include "../core/vector.h"

void gx_mesh_momentum_of(const struct gx_mesh *mesh, double *const *field, double *moment)
{
  for (int d = 0; d < mesh->grid.dim; d++) moment[d] = gx_vector_dot(mesh->grid.stored, mesh->mass, field[d]);
}

void gx_mesh_momentum_expect(const struct gx_mesh *mesh, double kick, double *momentum)
{
  const struct gx_particles *particles = mesh->space.particles;
  const double flip = mesh->options.pic ? 0 : mesh->options.flip;
  double impulse[GX_MAX_DIM], of_nodes[GX_MAX_DIM];
  if (!mesh->reconstruction) return;
  gx_mesh_momentum_of(mesh, mesh->a, impulse);
  gx_mesh_momentum_of(mesh, mesh->v, of_nodes);
  for (int d = 0; d < particles->dim; d++)
    momentum[d] =
        flip * (gx_vector_dot(particles->n, particles->m, particles->v[d]) + kick * impulse[d]) + (1 - flip) * of_nodes[d];
}

void gx_mesh_momentum_keep(const struct gx_mesh *mesh, const double *momentum, double *const *v)
{
  if (mesh->reconstruction) gx_reconstruction_keep(mesh->reconstruction, momentum, v);
}
