/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moving-mesh (total Lagrangian) MPM, steffen2010 eqs 50-61: weights at the reference positions X, computed once,
 *   F_p = I + sum u_i D_ip,  a_i = M^-1 sum (-V0 P_p D_ip + m_p b_p S_ip),  v_i += dt a_i,  u_i += dt v_i.
 * projection once: the state is (u_i, v_i) and particles sample it, x_p = X_p + sum S_ip u_i, v_p = sum S_ip v_i.
 * On a complete lattice of particles all sums over weights are factored by direction (lattice.h), and F, P and the forces of a
 * row of particles exist only while it is in cache: particles see them when they are settled.
 * projection each-step: the paper to the letter, v_i = M^-1 sum m_p v_p S_ip each step, u_p and v_p incremented. */
#include "mesh.h"

#include <limits.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "../core/kernel.h"
#include "../core/large.h"
#include "../core/vector.h"
#include "slots.h"

struct moving_mesh {
  struct gx_mesh mesh;
  struct gx_slots *slots; /* 1-D lattices: forces slot by slot; NULL: by rows */
  double accelerated;     /* s, when the lattice last was */
  /* The nodes' share of the body force then, N, once the power has been asked for; all of [GX_MAX_DIM][stored], NULL: it was not */
  double *load;
  bool loaded;
};

/* A hat has a slope where it has no value: a node that only particles on a face of its cells touch would strain them, freely. */
static enum gx_status check_hats(struct gx_mesh *mesh)
{
  double largest = 0;
  for (size_t i = 0; i < mesh->grid.stored; i++) largest = mesh->mass[i] > largest ? mesh->mass[i] : largest;
  for (size_t i = 0; i < mesh->grid.stored && mesh->grid.axis[0].support == 2; i++)
    if (mesh->mass[i] > 0 && mesh->mass[i] < 1e-12 * largest)
      return gx_status_set(mesh->space.outcome, GX_SINGULAR, -1,
                           "a node has next to no mass, since particles at the edge of the body lie on faces of cells: move the "
                           "body, or use a basis without kinks there, such as bspline of degree 2");
  return GX_OK;
}

static enum gx_status create(const struct gx_space_kind *kind, struct gx_space **space, const struct gx_space_options *options,
                             struct gx_particles *particles, const struct gx_posed *posed, struct gx_outcome *outcome)
{
  struct gx_mesh *mesh = NULL;
  GX_TRY(gx_mesh_create(&mesh, sizeof(struct moving_mesh), kind, options, particles, posed, outcome));
  *space = &mesh->space;
  posed->problem->material->piola(&posed->options.moduli, particles->dim, particles->n, particles->F, particles->P);
  GX_TRY(gx_mesh_weigh(mesh, NULL, NULL));
  GX_TRY(gx_mesh_assemble(mesh, particles->u, mesh->u));
  gx_mesh_keep_mass(mesh);
  GX_TRY(check_hats(mesh));
  GX_TRY(gx_mesh_project(mesh, particles->v, mesh->v));
  if (mesh->affine) gx_affine_gather(mesh);
  if (!options->reconstructed) mesh->lattice = gx_lattice_create(&mesh->grid, options->basis, particles, options->team);
  if (mesh->lattice && particles->dim == 1 && !options->stress_rate)
    ((struct moving_mesh *)mesh)->slots = gx_slots_create(gx_lattice_line(mesh->lattice), particles, posed);
  if (((struct moving_mesh *)mesh)->slots && !options->each_step && posed->problem->exact && posed->problem->material->piola)
    mesh->space.surveyed = gx_slots_survey_keeps(((struct moving_mesh *)mesh)->slots);
  return GX_OK;
}

static void free_mesh(struct gx_space *space)
{
  if (space) {
    gx_slots_free(((struct moving_mesh *)space)->slots);
    free(((struct moving_mesh *)space)->load);
  }
  gx_mesh_free(space);
}

static enum gx_status weights(struct gx_space *space)
{
  (void)space;
  return GX_OK;
}

static enum gx_status project(struct gx_space *space)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  return mesh->options.each_step ? gx_mesh_project(mesh, space->particles->v, mesh->v) : GX_OK;
}

GX_CLONES static void add_one(size_t n, double *F)
{
  for (size_t p = 0; p < n; p++) F[p] += 1;
}

/* F = 1 + grad u of the lent u. */
static void deform_block(const struct gx_mesh *mesh, const struct gx_block *block)
{
  const int dim = mesh->grid.dim;
  double *F[GX_MAX_TENSOR];
  gx_block_part(block, dim * dim, mesh->space.particles->F, F);
  gx_exchange_gather(&mesh->exchange, block, NULL, NULL, F);
  for (int d = 0; d < dim; d++) add_one(block->n, F[d * dim + d]);
}

/* A nodal field at the particles and 1 + its gradient, either of which may be NULL. */
static void gather(struct gx_space *space, double *const *field, double *const *value, double *const *F)
{
  const struct gx_slots *slots = ((struct moving_mesh *)space)->slots;
  if (slots) {
    gx_slots_gather(slots, field[0], value ? value[0] : NULL, F ? F[0] : NULL);
    return;
  }
  gx_mesh_gather((struct gx_mesh *)space, field, value, F);
  for (int d = 0; F && d < space->particles->dim; d++) add_one(space->particles->n, F[d * space->particles->dim + d]);
}

static void deform(struct gx_mesh *mesh)
{
  gather(&mesh->space, mesh->u, NULL, mesh->space.particles->F);
}

static long load(struct gx_mesh *mesh, struct gx_block *block)
{
  deform_block(mesh, block);
  const long tangled = gx_mesh_stress(mesh, block);
  gx_mesh_load_nominal(mesh, block);
  return tangled;
}

/* A pass of forces over a lattice. */
struct loading {
  struct gx_mesh *mesh;
  double t;
  atomic_long tangled; /* first particle; LONG_MAX: none */
};

/* T <- -V0 T */
GX_CLONES static void times_volume(size_t n, const double *restrict V0, double *restrict T)
{
  for (size_t p = 0; p < n; p++) T[p] *= -V0[p];
}

GX_CLONES static void times_mass(size_t n, const double *restrict m, double *restrict b)
{
  for (size_t p = 0; p < n; p++) b[p] *= m[p];
}

/* grad u to F, P(F) and -V0 P, and the body force, in place. */
static void load_row(void *context, const struct gx_lattice_row *row)
{
  struct loading *loading = context;
  const struct gx_mesh *mesh = loading->mesh;
  const struct gx_particles *particles = mesh->space.particles;
  const struct gx_posed *posed = mesh->space.posed;
  const int dim = particles->dim;
  for (int d = 0; d < dim; d++) add_one(row->n, row->gradient[d * dim + d]);
  long bad = posed->problem->material->piola(&posed->options.moduli, dim, row->n, row->gradient, row->T);
  long first = atomic_load_explicit(&loading->tangled, memory_order_relaxed);
  if (bad >= 0) bad += (long)row->first;
  while (bad >= 0 && bad < first && !atomic_compare_exchange_weak(&loading->tangled, &first, bad)) continue;
  for (int k = 0; k < dim * dim; k++) {
    if (mesh->options.stress_rate) memcpy(row->T[k], particles->P[k] + row->first, row->n * sizeof(double));
    times_volume(row->n, particles->V0 + row->first, row->T[k]);
  }
  if (!posed->problem->body) return;
  const struct gx_posed part = gx_problem_part(posed, row->first, row->n);
  posed->problem->body(&part, loading->t, row->body);
  for (int d = 0; d < dim; d++) times_mass(row->n, particles->m + row->first, row->body[d]);
}

static long load_rows(struct gx_mesh *mesh, double t)
{
  struct loading loading = {.mesh = mesh, .t = t, .tangled = LONG_MAX};
  const struct gx_lattice_pass pass = {.field = mesh->u,
                                       .gradient = true,
                                       .sum = mesh->a,
                                       .T = true,
                                       .body = mesh->space.posed->problem->body,
                                       .visit = load_row,
                                       .context = &loading};
  gx_lattice_run(mesh->lattice, &pass);
  return loading.tangled < LONG_MAX ? loading.tangled : -1;
}

/* The first particle that is tangled, or -1. */
static long load_slots(struct moving_mesh *moving, double t)
{
  const struct gx_particles *particles = moving->mesh.space.particles;
  const struct gx_posed *posed = moving->mesh.space.posed;
  if (gx_slots_force(moving->slots, moving->mesh.u[0], t, moving->mesh.a[0])) return -1;
  deform(&moving->mesh);
  return posed->problem->material->piola(&posed->options.moduli, 1, particles->n, particles->F, particles->P);
}

static enum gx_status accelerate_lattice(struct moving_mesh *moving, double t)
{
  struct gx_mesh *mesh = &moving->mesh;
  const long tangled = moving->slots ? load_slots(moving, t) : load_rows(mesh, t);
  moving->accelerated = t;
  moving->loaded = false;
  if (tangled < 0) return gx_mesh_solve(mesh, mesh->a);
  deform(mesh);
  return gx_status_set(mesh->space.outcome, GX_TANGLED, tangled, "det F of a particle is %g",
                       gx_particles_jacobian(mesh->space.particles, (size_t)tangled));
}

static enum gx_status accelerate(struct gx_space *space, double t)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  if (mesh->lattice) return accelerate_lattice((struct moving_mesh *)space, t);
  gx_exchange_lend(&mesh->exchange, mesh->u, NULL);
  return gx_mesh_accelerate(mesh, t, load);
}

/* dP/dt of a block at its F for dF/dt = grad v of the lent v. */
struct straining {
  struct gx_mesh *mesh;
  double span;           /* s, added to P; or */
  double *const *rate_P; /* [dim * dim][n] kept; NULL: not */
};

static void strain_block(void *context, struct gx_block *block)
{
  const struct straining *straining = context;
  const struct gx_mesh *mesh = straining->mesh;
  const struct gx_posed *posed = mesh->space.posed;
  const int dim = mesh->grid.dim;
  double *F[GX_MAX_TENSOR], *P[GX_MAX_TENSOR], *rate[GX_MAX_TENSOR], *const *rate_P = block->rate_P;
  gx_block_part(block, dim * dim, mesh->space.particles->F, F);
  gx_block_part(block, dim * dim, mesh->space.particles->P, P);
  if (straining->rate_P) {
    gx_block_part(block, dim * dim, straining->rate_P, rate);
    rate_P = rate;
  }
  gx_exchange_gather(&mesh->exchange, block, NULL, NULL, block->gradient);
  posed->problem->material->piola_rate(&posed->options.moduli, dim, block->n, F, block->gradient, rate_P);
  for (int k = 0; !straining->rate_P && k < dim * dim; k++) gx_vector_add(block->n, straining->span, rate_P[k], P[k]);
}

/* Stress by rate: by span, or its rate into rate_P. */
static void rate_of_stress(struct gx_mesh *mesh, double span, double *const *rate_P)
{
  struct straining straining = {mesh, span, rate_P};
  deform(mesh);
  gx_exchange_lend(&mesh->exchange, mesh->v, NULL);
  gx_blocks_each(&mesh->blocks, strain_block, &straining);
}

static void strain(struct gx_mesh *mesh, double span)
{
  if (mesh->options.stress_rate) rate_of_stress(mesh, span, NULL); /* else F comes from u_i */
}

/* Particles that carry velocity and position follow the lent nodes. */
struct following {
  struct gx_mesh *mesh;
  double kick, drift; /* s */
};

static void follow_block(void *context, struct gx_block *block)
{
  const struct following *following = context;
  const struct gx_mesh *mesh = following->mesh;
  struct gx_particles *particles = mesh->space.particles;
  const size_t from = block->from;
  gx_exchange_gather(&mesh->exchange, block, following->kick != 0 ? block->a : NULL, block->v, NULL);
  if (following->kick != 0) gx_mesh_kick_block(mesh, block, following->kick);
  for (int d = 0; following->drift != 0 && d < particles->dim; d++)
    gx_vector_add(block->n, following->drift, mesh->options.particle_motion ? particles->v[d] + from : block->v[d],
                  particles->u[d] + from);
}

/* Stretches of the nodes, of so many, are kicked, then moved, while in cache. */
enum { STRETCH = 1024 };

struct stepping {
  struct gx_mesh *mesh;
  double kick, drift; /* s */
};

GX_CLONES static void kick_and_move(size_t n, double kick, double drift, const double *restrict a, double *restrict v,
                                    double *restrict u)
{
  for (size_t i = 0; i < n; i++) {
    v[i] += kick * a[i];
    u[i] += drift * v[i];
  }
}

static void step_stretch(void *context, size_t part, size_t worker)
{
  const struct stepping *stepping = context;
  const struct gx_mesh *mesh = stepping->mesh;
  const size_t stored = mesh->grid.stored, from = part * STRETCH, n = stored - from < STRETCH ? stored - from : STRETCH;
  (void)worker;
  for (int d = 0; d < mesh->grid.dim; d++) {
    if (stepping->kick != 0 && stepping->drift != 0)
      kick_and_move(n, stepping->kick, stepping->drift, mesh->a[d] + from, mesh->v[d] + from, mesh->u[d] + from);
    else if (stepping->kick != 0)
      gx_vector_add(n, stepping->kick, mesh->a[d] + from, mesh->v[d] + from);
    else if (stepping->drift != 0)
      gx_vector_add(n, stepping->drift, mesh->v[d] + from, mesh->u[d] + from);
  }
}

static void step_nodes(struct gx_mesh *mesh, double kick, double drift)
{
  struct stepping stepping = {mesh, kick, drift};
  gx_team_run(mesh->options.team, (mesh->grid.stored + STRETCH - 1) / STRETCH, step_stretch, &stepping);
}

static void advance(struct gx_space *space, double kick, double span, double drift)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  const bool between = (kick != 0 && mesh->affine) || (span != 0 && mesh->options.stress_rate);
  step_nodes(mesh, kick, between ? 0 : drift);
  if (between) {
    if (kick != 0 && mesh->affine) gx_affine_gather(mesh); /* before the nodes move */
    if (span != 0) strain(mesh, span);
    step_nodes(mesh, 0, drift);
  }
  if (!mesh->options.each_step) return;
  struct following following = {mesh, kick, drift};
  double momentum[GX_MAX_DIM];
  gx_mesh_momentum_expect(mesh, kick, momentum);
  gx_exchange_lend(&mesh->exchange, mesh->v, kick != 0 ? mesh->a : NULL);
  gx_blocks_each(&mesh->blocks, follow_block, &following);
  if (kick != 0) gx_mesh_momentum_keep(mesh, momentum, space->particles->v);
}

/* Weights and mass never change, so that most of these have nothing to do. */
static enum gx_status twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  const bool open = primitive == GX_OPEN;
  for (int d = 0; d < mesh->grid.dim && primitive == GX_KICK_NODES; d++)
    gx_vector_add(mesh->grid.stored, span, mesh->a[d], mesh->v[d]);
  if (!open && primitive != GX_CLOSE) return GX_OK;
  for (int d = 0; d < mesh->grid.dim; d++) {
    double *y = mesh->opened_nodes[d], *u = mesh->u[d];
    for (size_t i = 0; i < mesh->grid.stored; i++) *(open ? &y[i] : &u[i]) = (open ? u[i] : y[i]) + span * mesh->v[d][i];
  }
  if (mesh->options.each_step) gx_mesh_open(mesh, primitive, span);
  return GX_OK;
}

/* Gives particles what a pass over the lattice left out: P of F and the body force of the last acceleration. */
static void catch_up(struct moving_mesh *moving)
{
  struct gx_mesh *mesh = &moving->mesh;
  struct gx_particles *particles = mesh->space.particles;
  const struct gx_posed *posed = mesh->space.posed;
  const struct gx_problem *problem = posed->problem;
  if (!mesh->options.stress_rate)
    problem->material->piola(&posed->options.moduli, particles->dim, particles->n, particles->F, particles->P);
  if (problem->body) problem->body(posed, moving->accelerated, particles->b);
}

static void settle(struct gx_space *space)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  const bool each_step = mesh->options.each_step;
  gather(space, mesh->u, each_step ? NULL : space->particles->u, space->particles->F);
  if (mesh->lattice) catch_up((struct moving_mesh *)space);
  if (each_step) return;
  gather(space, mesh->v, space->particles->v, NULL);
  if (!mesh->reconstruction) return;
  double momentum[GX_MAX_DIM];
  gx_mesh_momentum_of(mesh, mesh->v, momentum);
  gx_mesh_momentum_keep(mesh, momentum, space->particles->v);
}

static void particle_acceleration(struct gx_space *space, double *const *a)
{
  gather(space, ((struct gx_mesh *)space)->a, a, NULL);
}

static void load_body(void *context, const struct gx_lattice_row *row)
{
  const struct moving_mesh *moving = context;
  const struct gx_space *space = &moving->mesh.space;
  const struct gx_posed part = gx_problem_part(space->posed, row->first, row->n);
  part.problem->body(&part, moving->accelerated, row->body);
  for (int d = 0; d < space->particles->dim; d++) times_mass(row->n, space->particles->m + row->first, row->body[d]);
}

/* load_i = sum m_p b_p S_ip. Particles without a velocity of their own take sum_i load_i v_i of power. */
static bool power(struct gx_space *space, double ahead, double *power)
{
  struct moving_mesh *moving = (struct moving_mesh *)space;
  const struct gx_mesh *mesh = &moving->mesh;
  const size_t stored = mesh->grid.stored;
  double *load[GX_MAX_DIM];
  if (!mesh->lattice || mesh->options.each_step) return false;
  if (!moving->load) moving->load = gx_large_zeros((GX_MAX_DIM * stored + GX_SLOTS_ROOM) * sizeof(double));
  if (!moving->load) return false;
  for (int d = 0; d < mesh->grid.dim; d++) load[d] = moving->load + (size_t)d * stored;
  if (!moving->loaded && moving->slots)
    gx_slots_force_body(moving->slots, moving->accelerated, load[0]);
  else if (!moving->loaded)
    gx_lattice_run(mesh->lattice, &(struct gx_lattice_pass){.sum = load, .body = true, .visit = load_body, .context = moving});
  moving->loaded = true;
  *power = 0;
  for (int d = 0; d < mesh->grid.dim; d++)
    *power += gx_vector_dot(stored, load[d], mesh->v[d]) + (ahead != 0 ? ahead * gx_vector_dot(stored, load[d], mesh->a[d]) : 0);
  return true;
}

static void survey(struct gx_space *space, struct gx_survey *survey)
{
  const struct moving_mesh *moving = (const struct moving_mesh *)space;
  const struct gx_mesh *mesh = &moving->mesh;
  gx_slots_survey(moving->slots, &(struct gx_slots_nodes){mesh->mass, mesh->u[0], mesh->v[0], mesh->a[0]}, survey);
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
    double impulse[GX_MAX_DIM];
    gather(space, mesh->a, rate, NULL);
    gx_mesh_momentum_of(mesh, mesh->a, impulse);
    gx_mesh_momentum_keep(mesh, impulse, rate);
    if (mesh->options.particle_motion)
      for (int d = 0; d < dim; d++) memcpy(rate[dim + d], particles->v[d], particles->n * sizeof(double));
    else
      gather(space, mesh->v, rate + dim, NULL);
    rate += 2 * dim;
  } else {
    for (int d = 0; d < dim; d++) memcpy(rate[d], mesh->a[d], mesh->grid.stored * sizeof(double));
    rate += dim;
  }
  if (mesh->options.stress_rate) rate_of_stress(mesh, 0, rate);
}

static void image(struct gx_space *space, struct gx_image *image)
{
  GX_IMAGE(image, ((struct moving_mesh *)space)->accelerated);
  gx_mesh_image(space, image);
}

const struct gx_space_kind gx_moving_mesh = {
    .name = "moving-mesh",
    .help = "total Lagrangian MPM: gradients in the reference configuration, first Piola-Kirchhoff stress",
    .source = "steffen2010 eqs 50-61",
    .create = create,
    .free = free_mesh,
    .weights = weights,
    .project = project,
    .accelerate = accelerate,
    .advance = advance,
    .twofold = twofold,
    .state = state,
    .rates = rates,
    .image = image,
    .kinetic = gx_mesh_kinetic,
    .settle = settle,
    .power = power,
    .spin = gx_affine_spin,
    .survey = survey,
    .particle_acceleration = particle_acceleration,
    .field = gx_mesh_field,
};
