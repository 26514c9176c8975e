/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moving-mesh (total Lagrangian) MPM, steffen2010 eqs 50-61: weights at the reference positions X, computed once,
 *   F_p = I + sum u_i D_ip,  a_i = M^-1 sum (-V0 P_p D_ip + m_p b_p S_ip),  v_i += dt a_i,  u_i += dt v_i.
 * projection once: the state is (u_i, v_i) and particles sample it, x_p = X_p + sum S_ip u_i, v_p = sum S_ip v_i.
 * projection each-step: the paper to the letter, v_i = M^-1 sum m_p v_p S_ip each step, u_p and v_p incremented. */
#include "mesh.h"

#include <string.h>

#include "../core/kernel.h"
#include "../core/vector.h"

static enum gx_status create(const struct gx_space_kind *kind, struct gx_space **space, const struct gx_space_options *options,
                             struct gx_particles *particles, const struct gx_posed *posed, struct gx_outcome *outcome)
{
  struct gx_mesh *mesh = NULL;
  GX_TRY(gx_mesh_create(&mesh, sizeof *mesh, kind, options, particles, posed, outcome));
  *space = &mesh->space;
  posed->problem->material->piola(&posed->options.moduli, particles->dim, particles->n, particles->F, particles->P);
  GX_TRY(gx_mesh_weigh(mesh, NULL, NULL));
  GX_TRY(gx_mesh_assemble(mesh, particles->u, mesh->u));
  gx_mesh_project(mesh, particles->v, mesh->v);
  return GX_OK;
}

static enum gx_status weights(struct gx_space *space)
{
  (void)space;
  return GX_OK;
}

static enum gx_status project(struct gx_space *space)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  if (mesh->options.each_step) gx_mesh_project(mesh, space->particles->v, mesh->v);
  return GX_OK;
}

GX_CLONES static void add_one(size_t n, double *F)
{
  for (size_t p = 0; p < n; p++) F[p] += 1;
}

static void deformation_gradient(struct gx_mesh *mesh)
{
  struct gx_particles *particles = mesh->space.particles;
  int dim = particles->dim;
  gx_transfer_gather_gradient(&mesh->weights, mesh->u, particles->F);
  for (int d = 0; d < dim; d++) add_one(particles->n, particles->F[d * dim + d]);
}

GX_CLONES static void nominal(size_t n, const double *restrict V0, const double *restrict P, double *restrict T)
{
  for (size_t p = 0; p < n; p++) T[p] = -V0[p] * P[p];
}

static enum gx_status accelerate(struct gx_space *space, double t)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  int dim = particles->dim;
  deformation_gradient(mesh);
  GX_TRY(gx_mesh_stress(mesh));
  for (int k = 0; k < dim * dim; k++) nominal(particles->n, particles->V0, particles->P[k], mesh->T[k]);
  gx_mesh_accelerate(mesh, t);
  return GX_OK;
}

/* dP/dt at the current F for dF/dt = grad v. */
static void rate_of_stress(struct gx_mesh *mesh, double *const *rate_P)
{
  struct gx_particles *particles = mesh->space.particles;
  const struct gx_posed *posed = mesh->space.posed;
  deformation_gradient(mesh);
  gx_transfer_gather_gradient(&mesh->weights, mesh->v, mesh->gradient);
  posed->problem->material->piola_rate(&posed->options.moduli, particles->dim, particles->n, particles->F, mesh->gradient,
                                       rate_P);
}

static void strain(struct gx_mesh *mesh, double span)
{
  const struct gx_particles *particles = mesh->space.particles;
  if (!mesh->options.stress_rate) return; /* F comes from u_i */
  rate_of_stress(mesh, mesh->rate_P);
  for (int k = 0; k < particles->dim * particles->dim; k++) gx_vector_add(particles->n, span, mesh->rate_P[k], particles->P[k]);
}

static void advance(struct gx_space *space, double kick, double span, double drift)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  int dim = particles->dim;
  bool carried = mesh->options.each_step; /* particles carry the state of velocity and position */
  if (kick != 0)
    for (int d = 0; d < dim; d++) gx_vector_add(mesh->grid.stored, kick, mesh->a[d], mesh->v[d]);
  if (span != 0) strain(mesh, span);
  if (drift != 0)
    for (int d = 0; d < dim; d++) gx_vector_add(mesh->grid.stored, drift, mesh->v[d], mesh->u[d]);
  if (!carried) return;
  gx_transfer_gather(&mesh->weights, mesh->v, mesh->gathered_v);
  if (kick != 0) {
    gx_transfer_gather(&mesh->weights, mesh->a, mesh->gathered_a);
    gx_mesh_kick_particles(mesh, kick);
  }
  if (drift != 0)
    for (int d = 0; d < dim; d++)
      gx_vector_add(particles->n, drift, mesh->options.particle_motion ? particles->v[d] : mesh->gathered_v[d], particles->u[d]);
}

/* Weights and mass never change, so that most of these have nothing to do. */
static enum gx_status twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  bool open = primitive == GX_OPEN;
  if (primitive == GX_STRAIN_BACK) strain(mesh, span);
  for (int d = 0; d < particles->dim && primitive == GX_KICK_NODES; d++)
    gx_vector_add(mesh->grid.stored, span, mesh->a[d], mesh->v[d]);
  if (!open && primitive != GX_CLOSE) return GX_OK;
  gx_transfer_gather(&mesh->weights, mesh->v, mesh->gathered_v);
  for (int d = 0; d < particles->dim; d++) {
    double *y = mesh->opened_nodes[d], *u = mesh->u[d];
    for (size_t i = 0; i < mesh->grid.stored; i++) *(open ? &y[i] : &u[i]) = (open ? u[i] : y[i]) + span * mesh->v[d][i];
    if (!mesh->options.each_step) continue;
    double *y_p = mesh->opened[d], *u_p = particles->u[d];
    for (size_t p = 0; p < particles->n; p++)
      *(open ? &y_p[p] : &u_p[p]) = (open ? u_p[p] : y_p[p]) + span * mesh->gathered_v[d][p];
  }
  return GX_OK;
}

static void settle(struct gx_space *space)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  deformation_gradient(mesh);
  if (mesh->options.each_step) return;
  gx_transfer_gather(&mesh->weights, mesh->u, space->particles->u);
  gx_transfer_gather(&mesh->weights, mesh->v, space->particles->v);
}

static void state(struct gx_space *space, struct gx_state *list)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  int dim = particles->dim;
  list->count = 0;
  gx_mesh_append(list, dim, mesh->u, mesh->grid.stored);
  if (mesh->options.each_step) {
    gx_mesh_append(list, dim, particles->v, particles->n);
    gx_mesh_append(list, dim, particles->u, particles->n);
  } else {
    gx_mesh_append(list, dim, mesh->v, mesh->grid.stored);
  }
  if (mesh->options.stress_rate) gx_mesh_append(list, dim * dim, particles->P, particles->n);
}

static void rates(struct gx_space *space, double *const *rate)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  int dim = particles->dim;
  for (int d = 0; d < dim; d++) memcpy(rate[d], mesh->v[d], mesh->grid.stored * sizeof(double));
  rate += dim;
  if (mesh->options.each_step) {
    gx_transfer_gather(&mesh->weights, mesh->a, rate);
    if (mesh->options.particle_motion)
      for (int d = 0; d < dim; d++) memcpy(rate[dim + d], particles->v[d], particles->n * sizeof(double));
    else
      gx_transfer_gather(&mesh->weights, mesh->v, rate + dim);
    rate += 2 * dim;
  } else {
    for (int d = 0; d < dim; d++) memcpy(rate[d], mesh->a[d], mesh->grid.stored * sizeof(double));
    rate += dim;
  }
  if (mesh->options.stress_rate) rate_of_stress(mesh, rate);
}

const struct gx_space_kind gx_moving_mesh = {
    .name = "moving-mesh",
    .help = "total Lagrangian MPM: gradients in the reference configuration, first Piola-Kirchhoff stress",
    .source = "steffen2010 eqs 50-61",
    .create = create,
    .free = gx_mesh_free,
    .weights = weights,
    .project = project,
    .accelerate = accelerate,
    .advance = advance,
    .twofold = twofold,
    .state = state,
    .rates = rates,
    .kinetic = gx_mesh_kinetic,
    .settle = settle,
    .particle_acceleration = gx_mesh_particle_acceleration,
    .field = gx_mesh_field,
};
