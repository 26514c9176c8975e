/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weights at the particles, and what is wrong with a particle that has none. */
#include "mesh.h"

#include <math.h>

/* Farther than this, positions on a periodic grid mean nothing; past a fixed end, more than this is not round-off. */
static const double far = 1e6, edge = 1e-12;

static enum gx_status report_stray(struct gx_mesh *mesh, const struct gx_blocks_stray *stray)
{
  const int d = stray->d;
  const size_t p = stray->particle;
  const double x = mesh->blocks.x[d][p];
  struct gx_outcome *outcome = mesh->space.outcome;
  if (stray->wide)
    return gx_status_set(outcome, GX_TANGLED, (long)p, "the domain of a particle is %.4g cells wide; %s needs 0 to 1",
                         2 * mesh->blocks.half[d][p] * mesh->grid.axis[d].cells, mesh->options.basis->name);
  if (mesh->grid.axis[d].periodic || !isfinite(x))
    return gx_status_set(outcome, GX_UNSTABLE, (long)p, "the position of a particle is %g", x);
  return gx_status_set(outcome, GX_LEFT_DOMAIN, (long)p, "a particle is at %.6g, outside the domain [0, 1]", x);
}

/* Half lengths of particle domains along d for a basis that needs them: stretched by F, as they were, or at reference. */
static const double *domains(struct gx_mesh *mesh, int d, double *const *F, bool frozen)
{
  const struct gx_particles *particles = mesh->space.particles;
  if (!mesh->options.basis->deforms || !(F || frozen)) return particles->half_length[d];
  if (!frozen)
    for (size_t p = 0; p < particles->n; p++) mesh->half[d][p] = F[d * mesh->grid.dim + d][p] * particles->half_length[d][p];
  return mesh->half[d];
}

static enum gx_status weigh(struct gx_mesh *mesh, double *const *u, double *const *F, bool frozen)
{
  double low[GX_MAX_DIM], high[GX_MAX_DIM];
  for (int d = 0; d < mesh->grid.dim; d++) {
    const bool periodic = mesh->grid.axis[d].periodic;
    low[d] = periodic ? -far : -edge;
    high[d] = periodic ? far : 1 + edge;
  }
  if (mesh->line && !frozen && gx_line_weigh(mesh->line, low[0], high[0])) return GX_OK;
  for (int d = 0; d < mesh->grid.dim; d++) mesh->blocks.half[d] = domains(mesh, d, F, frozen);
  struct gx_blocks_stray stray = gx_blocks_place(&mesh->blocks, u, low, high);
  if (stray.d >= 0) return report_stray(mesh, &stray);
  if (mesh->affine) gx_affine_weigh(mesh, mesh->blocks.x);
  if (!mesh->reconstruction) return GX_OK;
  GX_TRY(gx_reconstruction_place(mesh->reconstruction, mesh->blocks.x));
  const size_t left = mesh->reconstruction->fit->left_cells;
  if (left > mesh->space.left_cells) mesh->space.left_cells = left;
  return GX_OK;
}

enum gx_status gx_mesh_weigh(struct gx_mesh *mesh, double *const *u, double *const *F)
{
  return weigh(mesh, u, F, false);
}

enum gx_status gx_mesh_weigh_frozen(struct gx_mesh *mesh, double *const *u)
{
  return weigh(mesh, u, NULL, true);
}
