/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard MPM on a fixed grid, steffen2010 eqs 15-22: weights at the current positions x = X + u,
 *   m_i = sum m_p S_ip,  v_i = M^-1 sum m_p v_p S_ip,  a_i = M^-1 sum (-V_p sigma_p D_ip + m_p b_p S_ip),
 *   v_p += dt sum S_ip a_i,  F_p <- (I + dt sum v_i D_ip) F_p,  x_p += dt sum S_ip v_i.
 * V sigma = V0 P F^T, so P is the only stress that is kept. */
#include "mesh.h"

#include "../core/tensor.h"
#include "../core/vector.h"

static enum gx_status weights(struct gx_space *space)
{
  return gx_mesh_weigh((struct gx_mesh *)space, space->particles->u, space->particles->F);
}

static enum gx_status project(struct gx_space *space)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  return gx_mesh_assemble(mesh, mesh->options.each_step ? space->particles->v : NULL, mesh->v);
}

static enum gx_status create(const struct gx_space_kind *kind, struct gx_space **space, const struct gx_space_options *options,
                             struct gx_particles *particles, const struct gx_posed *posed, struct gx_outcome *outcome)
{
  struct gx_mesh *mesh = NULL;
  GX_TRY(gx_mesh_create(&mesh, sizeof *mesh, kind, options, particles, posed, outcome));
  *space = &mesh->space;
  (*space)->through_cells = true;
  posed->problem->material->piola(&posed->options.moduli, particles->dim, particles->n, particles->F, particles->P);
  GX_TRY(weights(*space));
  return gx_mesh_assemble(mesh, particles->v, mesh->v);
}

/* T = -V0 P F^T = -V sigma */
GX_CORE void kirchhoff_points(const int dim, const struct gx_particles *particles, double *const *T)
{
  const double *F[GX_MAX_TENSOR], *P[GX_MAX_TENSOR], *V0 = particles->V0;
  double *restrict out[GX_MAX_TENSOR];
  for (int k = 0; k < dim * dim; k++) {
    F[k] = particles->F[k];
    P[k] = particles->P[k];
    out[k] = T[k];
  }
  for (size_t p = 0; p < particles->n; p++)
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++) {
        double sum = 0;
        for (int k = 0; k < dim; k++) sum += P[i * dim + k][p] * F[j * dim + k][p];
        out[i * dim + j][p] = -V0[p] * sum;
      }
}

GX_CLONES static void kirchhoff(const struct gx_particles *particles, double *const *T)
{
  GX_FOR_DIM(particles->dim, kirchhoff_points(dim, particles, T))
}

static enum gx_status accelerate(struct gx_space *space, double t)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  GX_TRY(gx_mesh_stress(mesh));
  kirchhoff(space->particles, mesh->T);
  gx_mesh_accelerate(mesh, t);
  return GX_OK;
}

/* L <- L F: from the velocity gradient to the rate of F. */
GX_CORE void stretch_points(const int dim, size_t n, double *const *F, double *const *L)
{
  const double *f[GX_MAX_TENSOR];
  double *restrict l[GX_MAX_TENSOR];
  for (int k = 0; k < dim * dim; k++) {
    f[k] = F[k];
    l[k] = L[k];
  }
  for (size_t p = 0; p < n; p++)
    for (int i = 0; i < dim; i++) {
      double row[GX_MAX_DIM];
      for (int k = 0; k < dim; k++) row[k] = l[i * dim + k][p];
      for (int j = 0; j < dim; j++) {
        double sum = 0;
        for (int k = 0; k < dim; k++) sum += row[k] * f[k * dim + j][p];
        l[i * dim + j][p] = sum;
      }
    }
}

GX_CLONES static void stretch(int dimension, size_t n, double *const *F, double *const *L)
{
  GX_FOR_DIM(dimension, stretch_points(dim, n, F, L))
}

static void rate_of_stress(struct gx_space *space, double *const *rate_F, double *const *rate_P)
{
  const struct gx_particles *particles = space->particles;
  space->posed->problem->material->piola_rate(&space->posed->options.moduli, particles->dim, particles->n, particles->F, rate_F,
                                              rate_P);
}

/* What an advance needs of the nodes, in one pass when it is all. */
static void gather(struct gx_mesh *mesh, bool acceleration, bool velocity, bool gradient)
{
  if (acceleration && velocity && gradient) {
    gx_transfer_gather_all(&mesh->weights, mesh->a, mesh->v, mesh->gathered_a, mesh->gathered_v, mesh->gradient);
    return;
  }
  if (acceleration) gx_transfer_gather(&mesh->weights, mesh->a, mesh->gathered_a);
  if (velocity) gx_transfer_gather(&mesh->weights, mesh->v, mesh->gathered_v);
  if (gradient) gx_transfer_gather_gradient(&mesh->weights, mesh->v, mesh->gradient);
}

static void advance(struct gx_space *space, double kick, double strain, double drift)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  int dim = particles->dim;
  size_t n = particles->n;
  if (kick != 0)
    for (int d = 0; d < dim; d++) gx_vector_add(mesh->grid.stored, kick, mesh->a[d], mesh->v[d]);
  bool blend = mesh->options.pic || mesh->options.flip < 1;
  gather(mesh, kick != 0, drift != 0 || (kick != 0 && blend), strain != 0);
  if (kick != 0) gx_mesh_kick_particles(mesh, kick);
  if (strain != 0) {
    stretch(dim, n, particles->F, mesh->gradient);
    if (mesh->options.stress_rate) {
      rate_of_stress(space, mesh->gradient, mesh->rate_P);
      for (int k = 0; k < dim * dim; k++) gx_vector_add(n, strain, mesh->rate_P[k], particles->P[k]);
    }
    for (int k = 0; k < dim * dim; k++) gx_vector_add(n, strain, mesh->gradient[k], particles->F[k]);
  }
  if (drift != 0)
    for (int d = 0; d < dim; d++)
      gx_vector_add(n, drift, mesh->options.particle_motion ? particles->v[d] : mesh->gathered_v[d], particles->u[d]);
}

/* F <- (I - span L)^-1 F with L the velocity gradient. */
GX_CORE void stretch_back_points(const int dim, size_t n, double span, double *const *L, double *const *F)
{
  for (size_t p = 0; p < n; p++) {
    double a[GX_MAX_TENSOR], c[GX_MAX_TENSOR], f[GX_MAX_TENSOR], out[GX_MAX_TENSOR];
    gx_tensor_load(dim, F, p, f);
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++) a[i * dim + j] = (i == j) - span * L[i * dim + j][p];
    double J = gx_tensor_cofactor(dim, a, c);
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++) {
        double sum = 0;
        for (int k = 0; k < dim; k++) sum += c[k * dim + i] * f[k * dim + j];
        out[i * dim + j] = sum / J;
      }
    gx_tensor_store(dim, F, p, out);
  }
}

static void strain_back(struct gx_mesh *mesh, double span)
{
  struct gx_particles *particles = mesh->space.particles;
  int dimension = particles->dim;
  size_t n = particles->n;
  gx_transfer_gather_gradient(&mesh->weights, mesh->v, mesh->gradient);
  GX_FOR_DIM(dimension, stretch_back_points(dim, n, span, mesh->gradient, particles->F))
  if (!mesh->options.stress_rate) return;
  stretch(dimension, n, particles->F, mesh->gradient);
  rate_of_stress(&mesh->space, mesh->gradient, mesh->rate_P);
  for (int k = 0; k < dimension * dimension; k++) gx_vector_add(n, span, mesh->rate_P[k], particles->P[k]);
}

static enum gx_status twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  switch (primitive) {
  case GX_WEIGHTS_FROZEN:
    return gx_mesh_weigh_frozen(mesh, particles->u);
  case GX_STRETCH:
    return mesh->options.basis->deforms ? weights(space) : GX_OK;
  case GX_MASS:
    return gx_mesh_assemble(mesh, NULL, NULL);
  case GX_KICK_NODES:
    for (int d = 0; d < particles->dim; d++) gx_vector_add(mesh->grid.stored, span, mesh->a[d], mesh->v[d]);
    return GX_OK;
  case GX_STRAIN_BACK:
    strain_back(mesh, span);
    return GX_OK;
  default: /* GX_OPEN, GX_CLOSE */
    gx_transfer_gather(&mesh->weights, mesh->v, mesh->gathered_v);
    for (int d = 0; d < particles->dim; d++) {
      double *from = primitive == GX_OPEN ? particles->u[d] : mesh->opened[d];
      double *to = primitive == GX_OPEN ? mesh->opened[d] : particles->u[d];
      for (size_t p = 0; p < particles->n; p++) to[p] = from[p] + span * mesh->gathered_v[d][p];
    }
    return GX_OK;
  }
}

static void state(struct gx_space *space, struct gx_state *list)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  int dim = particles->dim;
  size_t n = particles->n;
  list->count = 0;
  gx_mesh_append(list, dim, particles->u, n);
  gx_mesh_append(list, dim, particles->v, n);
  gx_mesh_append(list, dim * dim, particles->F, n);
  if (mesh->options.stress_rate) gx_mesh_append(list, dim * dim, particles->P, n);
  if (!mesh->options.each_step) gx_mesh_append(list, dim, mesh->v, mesh->grid.stored);
}

static void rates(struct gx_space *space, double *const *rate)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  int dim = particles->dim;
  size_t n = particles->n;
  double *const *rate_u = rate, *const *rate_v = rate + dim, *const *rate_F = rate + 2 * dim;
  gx_transfer_gather_all(&mesh->weights, mesh->a, mesh->v, rate_v, rate_u, rate_F);
  if (mesh->options.particle_motion)
    for (int d = 0; d < dim; d++)
      for (size_t p = 0; p < n; p++) rate_u[d][p] = particles->v[d][p];
  stretch(dim, n, particles->F, rate_F);
  rate += 2 * dim + dim * dim;
  if (mesh->options.stress_rate) {
    rate_of_stress(space, rate_F, rate);
    rate += dim * dim;
  }
  if (!mesh->options.each_step)
    for (int d = 0; d < dim; d++)
      for (size_t i = 0; i < mesh->grid.stored; i++) rate[d][i] = mesh->a[d][i];
}

const struct gx_space_kind gx_standard = {
    .name = "standard",
    .help = "MPM on a fixed grid: particles move through the cells, Cauchy stress, gradients at current positions",
    .source = "steffen2010 eqs 15-22",
    .fixed_grid = true,
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
    .particle_acceleration = gx_mesh_particle_acceleration,
    .field = gx_mesh_field,
};
