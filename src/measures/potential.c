/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strain energies are made piece by piece and take no memory. */
#include "potential.h"

#include "../core/vector.h"

double gx_potential_of(const struct gx_space *space, double volume)
{
  const struct gx_particles *particles = space->particles;
  const struct gx_moduli *moduli = &space->posed->options.moduli;
  const struct gx_material *material = space->posed->problem->material;
  if (space->kind->potential) return space->kind->potential(space);
  if (volume > 0 && material->total) return volume * material->total(moduli, particles->dim, particles->n, particles->F);
  double W[GX_VECTOR_PIECE], parts[GX_VECTOR_LANES] = {0}, *F[GX_MAX_TENSOR];
  for (size_t from = 0; from < particles->n; from += GX_VECTOR_PIECE) {
    const size_t n = gx_vector_piece(particles->n, from);
    for (int k = 0; k < particles->dim * particles->dim; k++) F[k] = particles->F[k] + from;
    material->energy(moduli, particles->dim, n, F, W);
    gx_vector_dot_piece(n, W, particles->V0 + from, parts);
  }
  return gx_vector_total(parts);
}
