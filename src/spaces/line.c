/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chosen once for a run; what it lacks, the general transfers do on the same weights and nodal fields. */
#include "line.h"

#include <stdlib.h>

#include "../core/aligned.h"
#include "../core/vector.h"
#include "mesh.h"

extern const struct gx_basis gx_linear, gx_ugimp, gx_cpgimp, gx_bspline;

/* Bases whose weights the passes make. */
static bool knows(const struct gx_basis *basis)
{
  return basis == &gx_linear || basis == &gx_ugimp || basis == &gx_cpgimp || basis == &gx_bspline;
}

static bool suits(const struct gx_mesh *mesh)
{
  const struct gx_space_options *options = &mesh->options;
  return mesh->grid.dim == 1 && mesh->space.particles->n >= GX_LINE_BLOCK && mesh->space.kind->fixed_grid &&
         knows(options->basis) && !options->consistent && !options->reconstructed && !options->apic &&
         !options->particle_motion && !options->stress_rate && options->each_step;
}

struct gx_line *gx_line_create(struct gx_mesh *mesh)
{
  if (!suits(mesh)) return NULL;
  struct gx_line *line = calloc(1, sizeof *line);
  if (!line) return NULL;
  const struct gx_particles *particles = mesh->space.particles;
  const struct gx_weights *weights = &mesh->blocks.whole;
  const size_t stored = mesh->grid.stored,
               records = (stored + 2 * GX_LINE_WINDOW) / GX_LINE_WINDOW * GX_LINE_WINDOW * GX_LINE_RECORD;
  const size_t scratch = (size_t)(GX_LINE_LANES * weights->support * GX_LINE_BLOCK * GX_LINE_RECORD);
  double *room = gx_aligned_zeros((records + scratch) * sizeof(double), &line->block);
  if (!room) {
    free(line);
    return NULL;
  }
  line->passes = gx_line_wide_supported() ? &gx_line_wide_passes : &gx_line_narrow_passes;
  line->fields = (struct gx_line_fields){
      .n = particles->n,
      .stored = stored,
      .support = weights->support,
      .axis = &mesh->grid.axis[0],
      .basis = mesh->options.basis,
      .first = weights->first[0],
      .S = weights->S[0],
      .D = weights->D[0],
      .X = particles->X[0],
      .half_length = particles->half_length[0],
      .half = mesh->options.basis->deforms ? mesh->half[0] : NULL,
      .m = particles->m,
      .V0 = particles->V0,
      .P = particles->P[0],
      .b = mesh->space.posed->problem->body ? particles->b[0] : NULL,
      .u = particles->u[0],
      .v = particles->v[0],
      .F = particles->F[0],
      .record = room,
      .scratch = room + records,
      .mass = mesh->mass,
      .velocity = mesh->v[0],
      .acceleration = mesh->a[0],
      .trace = mesh->trace,
  };
  return line;
}

void gx_line_free(struct gx_line *line)
{
  if (line) free(line->block);
  free(line);
}

bool gx_line_weigh(struct gx_line *line, double low, double high)
{
  return line->passes->weigh(&line->fields, low, high);
}

/* Contents of periodic images to the nodes they stand for. */
static void fold(const struct gx_axis *axis, size_t size, double *record)
{
  const size_t functions = (size_t)axis->functions, stored = (size_t)axis->stored;
  for (size_t i = stored * size; i-- > functions * size;) {
    record[i - functions * size] += record[i];
    record[i] = 0;
  }
}

static void finish(const struct gx_mesh *mesh, double *field)
{
  gx_grid_fix(&mesh->grid, 0, field);
  gx_grid_spread(&mesh->grid, field);
}

static void collect(struct gx_mesh *mesh, enum gx_line_part part)
{
  const struct gx_line *line = mesh->line;
  line->passes->scatter(&line->fields, part);
  fold(&mesh->grid.axis[0], part == GX_LINE_FORCE ? 1 : GX_LINE_RECORD, line->fields.record);
  line->passes->divide(&line->fields, part);
  if (part & GX_LINE_MOTION) finish(mesh, mesh->v[0]);
  if (part & GX_LINE_FORCE) finish(mesh, mesh->a[0]);
}

void gx_line_project(struct gx_mesh *mesh)
{
  collect(mesh, GX_LINE_MOTION);
}

void gx_line_accelerate(struct gx_mesh *mesh, bool project)
{
  collect(mesh, project ? GX_LINE_ALL : GX_LINE_FORCE);
}

bool gx_line_advance(struct gx_mesh *mesh, double kick, double strain, double drift)
{
  const bool lacks = kick == 0 ? strain == 0 || drift != 0 : drift == 0;
  if (lacks) return false;
  const struct gx_line_step step = {kick, strain, drift, mesh->options.pic ? 0 : mesh->options.flip};
  mesh->line->passes->advance(&mesh->line->fields, &step);
  return true;
}

void gx_line_acceleration(const struct gx_mesh *mesh, double *a)
{
  mesh->line->passes->gather(&mesh->line->fields, mesh->a[0], a);
}
