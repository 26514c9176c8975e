/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard MPM on a fixed grid, steffen2010 eqs 15-22: weights at the current positions x = X + u,
 *   m_i = sum m_p S_ip,  v_i = M^-1 sum m_p v_p S_ip,  a_i = M^-1 sum (-V_p sigma_p D_ip + m_p b_p S_ip),
 *   v_p += dt sum S_ip a_i,  F_p <- (I + dt sum v_i D_ip) F_p,  x_p += dt sum S_ip v_i.
 * V sigma = V0 P F^T, so P is the only stress that is kept. */
#include "mesh.h"

#include <string.h>

#include "../core/tensor.h"
#include "../core/vector.h"

static enum gx_status weights(struct gx_space *space)
{
  return gx_mesh_weigh((struct gx_mesh *)space, space->particles->u, space->particles->F);
}

static enum gx_status project(struct gx_space *space)
{
  return gx_mesh_postpone((struct gx_mesh *)space);
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
  GX_TRY(gx_mesh_assemble(mesh, particles->v, mesh->v));
  if (mesh->affine) gx_affine_gather(mesh);
  mesh->line = gx_line_create(mesh);
  return GX_OK;
}

/* T = -V0 P F^T = -V sigma */
GX_CORE void kirchhoff_points(const int dim, const struct gx_particles *particles, const struct gx_block *block)
{
  const double *F[GX_MAX_TENSOR], *P[GX_MAX_TENSOR], *V0 = particles->V0 + block->from;
  double *restrict out[GX_MAX_TENSOR];
  for (int k = 0; k < dim * dim; k++) {
    F[k] = particles->F[k] + block->from;
    P[k] = particles->P[k] + block->from;
    out[k] = block->T[k];
  }
  GX_APART
  for (size_t p = 0; p < block->n; p++)
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++) {
        double sum = 0;
        for (int k = 0; k < dim; k++) sum += P[i * dim + k][p] * F[j * dim + k][p];
        out[i * dim + j][p] = -V0[p] * sum;
      }
}

GX_CLONES static void kirchhoff(const struct gx_particles *particles, const struct gx_block *block)
{
  GX_FOR_DIM(particles->dim, kirchhoff_points(dim, particles, block))
}

static long load(struct gx_mesh *mesh, struct gx_block *block)
{
  long tangled = gx_mesh_stress(mesh, block);
  kirchhoff(mesh->space.particles, block);
  return tangled;
}

static enum gx_status accelerate_line(struct gx_mesh *mesh, double t)
{
  const struct gx_particles *particles = mesh->space.particles;
  const struct gx_posed *posed = mesh->space.posed;
  long tangled = posed->problem->material->piola(&posed->options.moduli, 1, particles->n, particles->F, particles->P);
  if (tangled >= 0)
    return gx_status_set(mesh->space.outcome, GX_TANGLED, tangled, "det F of a particle is %g",
                         gx_particles_jacobian(particles, (size_t)tangled));
  if (posed->problem->body) posed->problem->body(posed, t, particles->b);
  gx_line_accelerate(mesh, mesh->unprojected);
  mesh->unprojected = false;
  return GX_OK;
}

static enum gx_status accelerate(struct gx_space *space, double t)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  if (mesh->line) return accelerate_line(mesh, t);
  return gx_mesh_accelerate((struct gx_mesh *)space, t, load);
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
  GX_APART
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

static void rate_of_stress(const struct gx_mesh *mesh, const struct gx_block *block, double *const *rate_F, double *const *rate_P)
{
  const struct gx_posed *posed = mesh->space.posed;
  const int dim = mesh->grid.dim;
  double *F[GX_MAX_TENSOR];
  gx_block_part(block, dim * dim, mesh->space.particles->F, F);
  posed->problem->material->piola_rate(&posed->options.moduli, dim, block->n, F, rate_F, rate_P);
}

static void add_rate_of_stress(const struct gx_mesh *mesh, const struct gx_block *block, double span)
{
  if (!mesh->options.stress_rate) return;
  rate_of_stress(mesh, block, block->gradient, block->rate_P);
  for (int k = 0; k < mesh->grid.dim * mesh->grid.dim; k++)
    gx_vector_add(block->n, span, block->rate_P[k], mesh->space.particles->P[k] + block->from);
}

struct advance {
  struct gx_mesh *mesh;
  double kick, strain, drift; /* s */
};

static void advance_block(void *context, struct gx_block *block)
{
  const struct advance *advance = context;
  const double kick = advance->kick, strain = advance->strain, drift = advance->drift;
  const struct gx_mesh *mesh = advance->mesh;
  struct gx_particles *particles = mesh->space.particles;
  const int dim = particles->dim;
  const bool blend = mesh->options.pic || mesh->options.flip < 1;
  gx_exchange_gather(&mesh->exchange, block, kick != 0 ? block->a : NULL, drift != 0 || (kick != 0 && blend) ? block->v : NULL,
                     strain != 0 ? block->gradient : NULL);
  if (kick != 0) gx_mesh_kick_block(mesh, block, kick);
  if (strain != 0) {
    double *F[GX_MAX_TENSOR];
    gx_block_part(block, dim * dim, particles->F, F);
    stretch(dim, block->n, F, block->gradient);
    add_rate_of_stress(mesh, block, strain);
    for (int k = 0; k < dim * dim; k++) gx_vector_add(block->n, strain, block->gradient[k], F[k]);
  }
  for (int d = 0; drift != 0 && d < dim; d++)
    gx_vector_add(block->n, drift, mesh->options.particle_motion ? particles->v[d] + block->from : block->v[d],
                  particles->u[d] + block->from);
}

static void advance(struct gx_space *space, double kick, double strain, double drift)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct advance advance = {mesh, kick, strain, drift};
  gx_mesh_catch_up(mesh);
  if (kick != 0)
    for (int d = 0; d < mesh->grid.dim; d++) gx_vector_add(mesh->grid.stored, kick, mesh->a[d], mesh->v[d]);
  if (mesh->line && gx_line_advance(mesh, kick, strain, drift)) return;
  double momentum[GX_MAX_DIM];
  gx_mesh_momentum_expect(mesh, kick, momentum);
  if (kick != 0 && mesh->affine) gx_affine_gather(mesh);
  gx_exchange_lend(&mesh->exchange, mesh->v, kick != 0 ? mesh->a : NULL);
  gx_blocks_each(&mesh->blocks, advance_block, &advance);
  if (kick != 0) gx_mesh_momentum_keep(mesh, momentum, space->particles->v);
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

static void strain_back_block(void *context, struct gx_block *block)
{
  const struct advance *advance = context;
  const struct gx_mesh *mesh = advance->mesh;
  const int dimension = mesh->grid.dim;
  const double span = advance->strain;
  double *F[GX_MAX_TENSOR];
  gx_block_part(block, dimension * dimension, mesh->space.particles->F, F);
  gx_exchange_gather(&mesh->exchange, block, NULL, NULL, block->gradient);
  GX_FOR_DIM(dimension, stretch_back_points(dim, block->n, span, block->gradient, F))
  if (mesh->options.stress_rate) stretch(dimension, block->n, F, block->gradient);
  add_rate_of_stress(mesh, block, span);
}

static enum gx_status twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_particles *particles = space->particles;
  struct advance advance = {mesh, 0, span, 0};
  gx_mesh_catch_up(mesh);
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
    gx_exchange_lend(&mesh->exchange, mesh->v, NULL);
    gx_blocks_each(&mesh->blocks, strain_back_block, &advance);
    return GX_OK;
  default:
    gx_mesh_open(mesh, primitive, span);
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

struct rates {
  struct gx_mesh *mesh;
  double *const *rate;
};

static void rates_of_block(void *context, struct gx_block *block)
{
  const struct rates *rates = context;
  const struct gx_mesh *mesh = rates->mesh;
  const struct gx_particles *particles = mesh->space.particles;
  const int dim = particles->dim;
  double *rate[2 * GX_MAX_DIM + 2 * GX_MAX_TENSOR], *F[GX_MAX_TENSOR];
  gx_block_part(block, dim * dim, particles->F, F);
  gx_block_part(block, 2 * dim + dim * dim * (1 + mesh->options.stress_rate), rates->rate, rate);
  double *const *rate_u = rate, *const *rate_v = rate + dim, *const *rate_F = rate + 2 * dim;
  gx_exchange_gather(&mesh->exchange, block, rate_v, rate_u, rate_F);
  for (int d = 0; mesh->options.particle_motion && d < dim; d++)
    memcpy(rate_u[d], particles->v[d] + block->from, block->n * sizeof(double));
  stretch(dim, block->n, F, rate_F);
  if (mesh->options.stress_rate) rate_of_stress(mesh, block, rate_F, rate_F + dim * dim);
}

static void rates(struct gx_space *space, double *const *rate)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  const int dim = mesh->grid.dim;
  struct rates rates = {mesh, rate};
  gx_exchange_lend(&mesh->exchange, mesh->v, mesh->a);
  gx_blocks_each(&mesh->blocks, rates_of_block, &rates);
  double impulse[GX_MAX_DIM];
  gx_mesh_momentum_of(mesh, mesh->a, impulse);
  gx_mesh_momentum_keep(mesh, impulse, rate + dim);
  rate += 2 * dim + dim * dim * (1 + mesh->options.stress_rate);
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
    .image = gx_mesh_image,
    .kinetic = gx_mesh_kinetic,
    .spin = gx_affine_spin,
    .particle_acceleration = gx_mesh_particle_acceleration,
    .field = gx_mesh_field,
};
