/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Set-up, projection and acceleration that standard and moving-mesh MPM share. */
#include "mesh.h"

#include <limits.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "../core/aligned.h"
#include "../core/kernel.h"
#include "../core/vector.h"
#include "mass_band.h"

/* Of the least particle's mass. A particle whose domain ends on a node, or on the edge of a quadratic spline, has a share in the function
 * beyond of 0 or of the square of round-off, and a slope of 0 or of round-off: their ratio would strain it by forces of any size. Hats'
 * shares on faces of cells, 2^-60, are more than this. */
static const double faint = 0x1p-90;

static double least_mass(const struct gx_particles *particles)
{
  double least = particles->m[0];
  for (size_t p = 1; p < particles->n; p++) least = particles->m[p] < least ? particles->m[p] : least;
  return least;
}

static void lay_out_grid(struct gx_mesh *mesh)
{
  struct gx_grid *grid = &mesh->grid;
  grid->dim = mesh->space.particles->dim;
  grid->stored = 1;
  for (int d = 0; d < grid->dim; d++) {
    struct gx_axis *axis = &grid->axis[d];
    *axis = (struct gx_axis){
        .cells = mesh->options.cells[d],
        .periodic = mesh->options.periodic,
        .h = 1.0 / mesh->options.cells[d],
        .degree = mesh->options.degree,
        .held = {mesh->options.held[d][0], mesh->options.held[d][1]},
    };
    mesh->options.basis->layout(axis);
    grid->stride[d] = grid->stored;
    grid->stored *= (size_t)axis->stored;
  }
}

/* Sets every array of the mesh; returns the number of doubles they take. */
static size_t place_arrays(struct gx_mesh *mesh, double *block)
{
  const int dim = mesh->grid.dim;
  size_t nodes = mesh->grid.stored, n = mesh->space.particles->n, used = 0;
#define PLACE(array, count, length) used += gx_aligned_place(array, count, length, block ? block + used : NULL)
  PLACE(&mesh->mass, 1, nodes);
  PLACE(mesh->v, dim, nodes);
  PLACE(mesh->a, dim, nodes);
  PLACE(mesh->u, dim, nodes);
  PLACE(&mesh->inverse, 1, nodes);
  PLACE(mesh->half, dim, n);
  PLACE(mesh->opened, dim, n);
  PLACE(mesh->opened_nodes, dim, nodes);
#undef PLACE
  return used;
}

enum gx_status gx_mesh_create(struct gx_mesh **out, size_t size, const struct gx_space_kind *kind,
                              const struct gx_space_options *options, struct gx_particles *particles,
                              const struct gx_posed *posed, struct gx_outcome *outcome)
{
  struct gx_mesh *mesh = calloc(1, size);
  if (!mesh) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  mesh->space = (struct gx_space){.kind = kind, .particles = particles, .posed = posed, .outcome = outcome};
  mesh->options = *options;
  mesh->trace = faint * least_mass(particles);
  lay_out_grid(mesh);
  enum gx_status status = GX_OK;
  double *arrays = gx_aligned_zeros(place_arrays(mesh, NULL) * sizeof(double), &mesh->block);
  if (options->reconstructed)
    status = gx_reconstruction_create(&mesh->reconstruction, &mesh->grid, options, particles, kind->fixed_grid, outcome);
  if (status != GX_OK) {
    gx_mesh_free(&mesh->space);
    return status;
  }
  if (options->consistent)
    mesh->consistent =
        gx_mass_create(&mesh->grid, options->basis, mesh->reconstruction ? mesh->reconstruction->points : particles);
  const bool whole = options->consistent || options->apic;
  if (gx_blocks_init(&mesh->blocks, &mesh->grid, options->basis, particles->n, particles->X, whole, options->team) ||
      gx_exchange_init(&mesh->exchange, &mesh->grid, options->team) || !arrays || (options->consistent && !mesh->consistent) ||
      (options->apic && !(mesh->affine = gx_affine_create(mesh)))) {
    gx_mesh_free(&mesh->space);
    return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  }
  place_arrays(mesh, arrays);
  *out = mesh;
  return GX_OK;
}

void gx_mesh_free(struct gx_space *space)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  if (!mesh) return;
  gx_mass_free(mesh->consistent);
  gx_affine_free(mesh->affine);
  gx_lattice_free(mesh->lattice);
  gx_line_free(mesh->line);
  gx_reconstruction_free(mesh->reconstruction);
  gx_blocks_free(&mesh->blocks);
  gx_exchange_free(&mesh->exchange);
  free(mesh->block);
  free(mesh);
}

GX_CLONES static void divide_by_mass(size_t nodes, double trace, const double *restrict mass, double *restrict field)
{
  for (size_t i = 0; i < nodes; i++) field[i] = mass[i] > trace ? field[i] / mass[i] : 0;
}

GX_CLONES static void times_inverse(size_t nodes, const double *restrict inverse, double *restrict field)
{
  for (size_t i = 0; i < nodes; i++) field[i] *= inverse[i];
}

void gx_mesh_keep_mass(struct gx_mesh *mesh)
{
  for (size_t i = 0; i < mesh->grid.stored; i++) mesh->inverse[i] = mesh->mass[i] > mesh->trace ? 1 / mesh->mass[i] : 0;
  gx_grid_spread(&mesh->grid, mesh->inverse);
  mesh->kept = true;
}

/* Lumped, of one component. */
struct solving {
  struct gx_mesh *mesh;
  double *const *field;
};

static void solve_component(void *context, size_t d, size_t worker)
{
  const struct solving *solving = context;
  const struct gx_mesh *mesh = solving->mesh;
  double *field = solving->field[d];
  (void)worker;
  if (mesh->kept) times_inverse(mesh->grid.stored, mesh->inverse, field); /* before entries are changed one by one */
  gx_grid_fold(&mesh->grid, field);
  if (!mesh->kept) divide_by_mass(mesh->grid.stored, mesh->trace, mesh->mass, field);
  gx_grid_fix(&mesh->grid, (int)d, field);
  gx_grid_spread(&mesh->grid, field);
}

enum gx_status gx_mesh_solve(struct gx_mesh *mesh, double *const *field)
{
  if (!mesh->consistent) {
    struct solving solving = {mesh, field};
    gx_team_run(mesh->options.team, (size_t)mesh->grid.dim, solve_component, &solving);
    return GX_OK;
  }
  for (int d = 0; d < mesh->grid.dim; d++) gx_grid_fold(&mesh->grid, field[d]);
  return gx_mass_solve(mesh->consistent, field, mesh->space.outcome);
}

/* Velocities of the particles come with their affine part. */
static void add_affine(struct gx_mesh *mesh, double *const *value, double *const *field)
{
  if (mesh->affine && value == mesh->space.particles->v) gx_affine_scatter(mesh, field);
}

/* A pass that scatters what the particles carry: value, and with `load` forces. */
struct scattering {
  struct gx_mesh *mesh;
  double *const *value; /* [dim][n], NULL: mass alone */
  double t;
  long (*load)(struct gx_mesh *mesh, struct gx_block *block);
  atomic_long tangled; /* first particle; LONG_MAX: none */
};

GX_CLONES static void multiply(size_t n, const double *restrict a, const double *restrict b, double *restrict product)
{
  for (size_t p = 0; p < n; p++) product[p] = a[p] * b[p];
}

static void load_block(struct scattering *scattering, struct gx_block *block, double *const *b)
{
  struct gx_mesh *mesh = scattering->mesh;
  const struct gx_posed *posed = mesh->space.posed;
  long bad = scattering->load(mesh, block), first = atomic_load(&scattering->tangled);
  if (bad >= 0) bad += (long)block->from;
  while (bad >= 0 && bad < first && !atomic_compare_exchange_weak(&scattering->tangled, &first, bad)) continue;
  if (!posed->problem->body) return;
  if (block->n < posed->n) {
    const struct gx_posed part = gx_problem_part(posed, block->from, block->n);
    posed->problem->body(&part, scattering->t, b);
  } else {
    posed->problem->body(posed, scattering->t, b);
  }
  for (int d = 0; d < mesh->grid.dim; d++) multiply(block->n, mesh->space.particles->m + block->from, b[d], block->body[d]);
}

static void scatter_block(void *context, struct gx_block *block)
{
  struct scattering *scattering = context;
  struct gx_mesh *mesh = scattering->mesh;
  const struct gx_particles *particles = mesh->space.particles;
  const int dim = mesh->grid.dim;
  double *value[GX_MAX_DIM], *b[GX_MAX_DIM];
  if (scattering->value) gx_block_part(block, dim, scattering->value, value);
  gx_block_part(block, dim, particles->b, b);
  if (scattering->load) load_block(scattering, block, b);
  gx_exchange_scatter(&mesh->exchange, block, particles->m + block->from, scattering->value ? value : NULL, block->T,
                      mesh->space.posed->problem->body ? block->body : NULL);
}

/* T of the particles, which the reconstruction takes from there. */
static void keep_block(void *context, struct gx_block *block)
{
  struct scattering *scattering = context;
  struct gx_mesh *mesh = scattering->mesh;
  double *b[GX_MAX_DIM];
  gx_block_part(block, mesh->grid.dim, mesh->space.particles->b, b);
  load_block(scattering, block, b);
  for (int k = 0; k < mesh->grid.dim * mesh->grid.dim; k++)
    memcpy(mesh->reconstruction->field[k] + block->from, block->T[k], block->n * sizeof(double));
}

static void scatter_points(void *context, struct gx_block *block)
{
  const struct scattering *scattering = context;
  struct gx_mesh *mesh = scattering->mesh;
  const struct gx_reconstruction *r = mesh->reconstruction;
  const int dim = mesh->grid.dim;
  double *value[GX_MAX_DIM], *T[GX_MAX_TENSOR], *body[GX_MAX_DIM];
  gx_block_part(block, dim, r->points->v, value);
  gx_block_part(block, dim * dim, r->points->P, T);
  gx_block_part(block, dim, r->points->b, body);
  gx_exchange_scatter(&mesh->exchange, block, r->points->m + block->from, scattering->value ? value : NULL, T,
                      mesh->space.posed->problem->body ? body : NULL);
}

/* What is left to the particles of cells that no field is fitted in. */
static void scatter_left(void *context, struct gx_block *block)
{
  const struct scattering *scattering = context;
  struct gx_mesh *mesh = scattering->mesh;
  const struct gx_reconstruction *r = mesh->reconstruction;
  const struct gx_particles *particles = mesh->space.particles;
  const bool *left = r->fit->left + block->from;
  const int dim = mesh->grid.dim;
  double *value[GX_MAX_DIM], *m = block->a[0];
  if (scattering->value) gx_block_part(block, dim, scattering->value, value);
  for (size_t p = 0; p < block->n; p++) {
    const size_t at = block->from + p;
    m[p] = left[p] ? particles->m[at] : 0;
    for (int k = 0; k < dim * dim; k++) block->T[k][p] = left[p] ? r->field[k][at] / r->inverse_volume[at] : 0;
    for (int d = 0; d < dim; d++) block->body[d][p] = m[p] * particles->b[d][at];
  }
  gx_exchange_scatter(&mesh->exchange, block, m, scattering->value ? value : NULL, block->T,
                      mesh->space.posed->problem->body ? block->body : NULL);
}

/* Scatters from the points that integrals are sums over. */
static void scatter(struct scattering *scattering)
{
  struct gx_mesh *mesh = scattering->mesh;
  struct gx_reconstruction *r = mesh->reconstruction;
  if (!r) {
    gx_blocks_each_apart(&mesh->blocks, scatter_block, scattering);
    return;
  }
  if (scattering->load) {
    gx_blocks_each(&mesh->blocks, keep_block, scattering);
    gx_reconstruction_force(r, mesh->space.posed->problem->body ? mesh->space.particles->b : NULL);
  }
  if (scattering->value) gx_reconstruction_value(r, scattering->value);
  gx_blocks_each_apart(&r->blocks, scatter_points, scattering);
  if (r->fit->left) gx_blocks_each_apart(&mesh->blocks, scatter_left, scattering);
}

static enum gx_status factor_mass(struct gx_mesh *mesh)
{
  const struct gx_reconstruction *r = mesh->reconstruction;
  if (r && r->fit->left)
    return gx_status_set(mesh->space.outcome, GX_SINGULAR, -1,
                         "too few particles around %zu of the cells to reconstruct fields there with consistent mass: use lumped "
                         "mass, or quadrature particles",
                         r->fit->left_cells);
  return gx_mass_factor(mesh->consistent, r ? &r->blocks.whole : &mesh->blocks.whole, (r ? r->points : mesh->space.particles)->m,
                        mesh->space.outcome);
}

/* A density that is fitted to few or uneven particles can fall below zero, and a node's mass with it, by more than round-off. */
static enum gx_status check_fitted_mass(const struct gx_mesh *mesh)
{
  const double least = GX_MASS_NEGATIVE * gx_vector_max(mesh->grid.stored, mesh->mass);
  for (size_t i = 0; i < mesh->grid.stored; i++)
    if (mesh->mass[i] < least)
      return gx_status_set(
          mesh->space.outcome, GX_SINGULAR, -1,
          "the density that is fitted to the particles gives a node the mass %.3g kg: use more particles in a cell, "
          "or quadrature particles",
          mesh->mass[i]);
  return GX_OK;
}

enum gx_status gx_mesh_assemble(struct gx_mesh *mesh, double *const *value, double *const *field)
{
  struct scattering scattering = {.mesh = mesh, .value = value};
  mesh->unprojected = false;
  if (mesh->reconstruction) gx_reconstruction_mass(mesh->reconstruction);
  gx_exchange_collect(&mesh->exchange, mesh->mass, value ? field : NULL, NULL);
  scatter(&scattering);
  gx_exchange_deliver(&mesh->exchange);
  gx_grid_fold(&mesh->grid, mesh->mass);
  if (mesh->consistent)
    GX_TRY(factor_mass(mesh));
  else if (mesh->reconstruction)
    GX_TRY(check_fitted_mass(mesh));
  if (!value) return GX_OK;
  add_affine(mesh, value, field);
  return gx_mesh_solve(mesh, field);
}

enum gx_status gx_mesh_postpone(struct gx_mesh *mesh)
{
  mesh->unprojected = true;
  if (mesh->consistent || mesh->reconstruction)
    return gx_mesh_assemble(mesh, mesh->options.each_step ? mesh->space.particles->v : NULL, mesh->v);
  return GX_OK;
}

void gx_mesh_catch_up(struct gx_mesh *mesh)
{
  const bool unprojected = mesh->unprojected;
  mesh->unprojected = false;
  if (unprojected && mesh->line)
    gx_line_project(mesh);
  else if (unprojected)
    gx_mesh_assemble(mesh, mesh->options.each_step ? mesh->space.particles->v : NULL, mesh->v);
}

enum gx_status gx_mesh_project(struct gx_mesh *mesh, double *const *value, double *const *field)
{
  struct scattering scattering = {.mesh = mesh, .value = value};
  if (mesh->lattice) {
    gx_lattice_scatter(mesh->lattice, mesh->space.particles->m, value, field);
    add_affine(mesh, value, field);
    return gx_mesh_solve(mesh, field);
  }
  gx_mesh_catch_up(mesh);
  gx_exchange_collect(&mesh->exchange, NULL, field, NULL);
  scatter(&scattering);
  gx_exchange_deliver(&mesh->exchange);
  add_affine(mesh, value, field);
  return gx_mesh_solve(mesh, field);
}

long gx_mesh_stress(struct gx_mesh *mesh, struct gx_block *block)
{
  struct gx_particles *particles = mesh->space.particles;
  const struct gx_posed *posed = mesh->space.posed;
  const int dim = particles->dim;
  double *F[GX_MAX_TENSOR], *P[GX_MAX_TENSOR];
  gx_block_part(block, dim * dim, particles->F, F);
  gx_block_part(block, dim * dim, particles->P, P);
  /* stress by rate: only to see whether F still is a deformation */
  return posed->problem->material->piola(&posed->options.moduli, dim, block->n, F, mesh->options.stress_rate ? block->rate_P : P);
}

GX_CLONES static void nominal(size_t n, const double *restrict V0, const double *restrict P, double *restrict T)
{
  for (size_t p = 0; p < n; p++) T[p] = -V0[p] * P[p];
}

long gx_mesh_load_nominal(struct gx_mesh *mesh, struct gx_block *block)
{
  const struct gx_particles *particles = mesh->space.particles;
  for (int k = 0; k < particles->dim * particles->dim; k++)
    nominal(block->n, particles->V0 + block->from, particles->P[k] + block->from, block->T[k]);
  return -1;
}

void gx_mesh_kick_block(const struct gx_mesh *mesh, const struct gx_block *block, double kick)
{
  struct gx_particles *particles = mesh->space.particles;
  double flip = mesh->options.pic ? 0 : mesh->options.flip;
  for (int d = 0; d < particles->dim; d++) {
    double *v = particles->v[d] + block->from;
    gx_vector_add(block->n, kick, block->a[d], v);
    if (flip < 1)
      for (size_t p = 0; p < block->n; p++) v[p] = flip * v[p] + (1 - flip) * block->v[d][p];
  }
}

enum gx_status gx_mesh_accelerate(struct gx_mesh *mesh, double t, long (*load)(struct gx_mesh *mesh, struct gx_block *block))
{
  struct gx_particles *particles = mesh->space.particles;
  const bool assemble = mesh->unprojected, project = assemble && mesh->options.each_step;
  struct scattering scattering = {
      .mesh = mesh, .value = project ? particles->v : NULL, .t = t, .load = load, .tangled = LONG_MAX};
  mesh->unprojected = false;
  gx_exchange_collect(&mesh->exchange, assemble ? mesh->mass : NULL, project ? mesh->v : NULL, mesh->a);
  scatter(&scattering);
  if (scattering.tangled < LONG_MAX)
    return gx_status_set(mesh->space.outcome, GX_TANGLED, scattering.tangled, "det F of a particle is %g",
                         gx_particles_jacobian(particles, (size_t)scattering.tangled));
  gx_exchange_deliver(&mesh->exchange);
  if (assemble) gx_grid_fold(&mesh->grid, mesh->mass); /* lumped */
  add_affine(mesh, scattering.value, mesh->v);
  if (project) GX_TRY(gx_mesh_solve(mesh, mesh->v));
  return gx_mesh_solve(mesh, mesh->a);
}

struct opening {
  struct gx_mesh *mesh;
  double *const *from, *const *to; /* [dim][n] m */
  double span;                     /* s */
};

static void open_block(void *context, struct gx_block *block)
{
  const struct opening *opening = context;
  gx_exchange_gather(&opening->mesh->exchange, block, NULL, block->v, NULL);
  for (int d = 0; d < opening->mesh->grid.dim; d++) {
    const double *from = opening->from[d] + block->from, *v = block->v[d];
    double *to = opening->to[d] + block->from;
    for (size_t p = 0; p < block->n; p++) to[p] = from[p] + opening->span * v[p];
  }
}

void gx_mesh_open(struct gx_mesh *mesh, enum gx_primitive primitive, double span)
{
  double *const *u = mesh->space.particles->u, *const *y = mesh->opened;
  struct opening opening = {mesh, primitive == GX_OPEN ? u : y, primitive == GX_OPEN ? y : u, span};
  gx_exchange_lend(&mesh->exchange, mesh->v, NULL);
  gx_blocks_each(&mesh->blocks, open_block, &opening);
}

double gx_mesh_kinetic(const struct gx_space *space)
{
  const struct gx_mesh *mesh = (const struct gx_mesh *)space;
  double twice = 0;
  for (int d = 0; d < mesh->grid.dim; d++) twice += gx_vector_weighted(mesh->grid.stored, mesh->mass, mesh->v[d], mesh->v[d]);
  return 0.5 * twice;
}

void gx_mesh_particle_acceleration(struct gx_space *space, double *const *a)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  if (mesh->line)
    gx_line_acceleration(mesh, a[0]);
  else
    gx_mesh_gather(mesh, mesh->a, a, NULL);
}

void gx_mesh_image(struct gx_space *space, struct gx_image *image)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  if (!space->kind->fixed_grid) gx_image_reals(image, mesh->grid.dim, mesh->u, mesh->grid.stored);
  if (!mesh->options.each_step) gx_image_reals(image, mesh->grid.dim, mesh->v, mesh->grid.stored);
  if (mesh->affine) gx_affine_image(mesh, image);
}

void gx_mesh_append(struct gx_state *state, int count, double *const *array, size_t length)
{
  for (int i = 0; i < count; i++, state->count++) {
    state->array[state->count] = array[i];
    state->length[state->count] = length;
  }
}
