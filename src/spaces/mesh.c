/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Set-up, weights, projection and acceleration that standard and moving-mesh MPM share. */
#include "mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/aligned.h"
#include "../core/kernel.h"
#include "../core/vector.h"

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

/* Hands out `count` arrays of `length` doubles from `at`; with at NULL only counts them. A cache line between two arrays keeps
 * arrays whose length is a power of two out of the same cache set. */
static size_t hand_out(double **array, int count, size_t length, double *at)
{
  const size_t line = 8, stride = (length + line - 1) / line * line + line;
  for (int i = 0; at && i < count; i++) array[i] = at + (size_t)i * stride;
  return (size_t)count * stride;
}

/* Sets every array of the mesh; returns the number of doubles they take. */
static size_t place_arrays(struct gx_mesh *mesh, double *block)
{
  int dim = mesh->grid.dim, support = mesh->grid.axis[0].support;
  size_t nodes = mesh->grid.stored, n = mesh->space.particles->n, used = 0;
#define PLACE(array, count, length) used += hand_out(array, count, length, block ? block + used : NULL)
  PLACE(&mesh->mass, 1, nodes);
  PLACE(mesh->v, dim, nodes);
  PLACE(mesh->a, dim, nodes);
  PLACE(mesh->u, dim, nodes);
  PLACE(mesh->x, dim, n);
  PLACE(mesh->half, dim, n);
  PLACE(mesh->T, dim * dim, n);
  PLACE(mesh->body, dim, n);
  PLACE(mesh->opened, dim, n);
  PLACE(mesh->opened_nodes, dim, nodes);
  PLACE(mesh->gathered_a, dim, n);
  PLACE(mesh->gathered_v, dim, n);
  PLACE(mesh->gradient, dim * dim, n);
  PLACE(mesh->rate_P, dim * dim, n);
  PLACE(mesh->weights.S, dim, n * (size_t)support);
  PLACE(mesh->weights.D, dim, n * (size_t)support);
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
  lay_out_grid(mesh);
  const double most = 4e9; /* bytes; a larger band is a slip, or takes longer to factor than any run should */
  if (options->consistent && gx_mass_bytes(&mesh->grid) > most) {
    gx_status_set(outcome, GX_REFUSED, -1,
                  "the consistent mass matrix would take %.3g GB as a band: use fewer cells, a lower degree, or lumped mass",
                  1e-9 * gx_mass_bytes(&mesh->grid));
    free(mesh);
    return GX_REFUSED;
  }
  int dim = mesh->grid.dim;
  size_t bytes = place_arrays(mesh, NULL) * sizeof(double);
  double *arrays = gx_aligned_zeros(bytes, &mesh->block);
  mesh->first_block = calloc(particles->n * (size_t)dim + 1, sizeof(int));
  if (options->consistent) mesh->consistent = gx_mass_create(&mesh->grid);
  if (!mesh->block || !mesh->first_block || (options->consistent && !mesh->consistent)) {
    gx_mesh_free(&mesh->space);
    return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  }
  place_arrays(mesh, arrays);
  mesh->weights.dim = dim;
  mesh->weights.support = mesh->grid.axis[0].support;
  mesh->weights.n = particles->n;
  for (int d = 0; d < dim; d++) {
    mesh->weights.stride[d] = mesh->grid.stride[d];
    mesh->weights.first[d] = mesh->first_block + (size_t)d * particles->n;
  }
  *out = mesh;
  return GX_OK;
}

void gx_mesh_free(struct gx_space *space)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  if (!mesh) return;
  gx_mass_free(mesh->consistent);
  free(mesh->block);
  free(mesh->first_block);
  free(mesh);
}

/* x = X + u; returns whether every x lies within [low, high]. */
GX_CLONES static bool move(size_t n, const double *restrict X, const double *restrict u, double low, double high,
                           double *restrict x)
{
  int outside = 0;
  for (size_t p = 0; p < n; p++) {
    double at = X[p] + u[p];
    x[p] = at;
    outside |= !(at >= low && at <= high);
  }
  return !outside;
}

/* Farther than this, positions on a periodic grid mean nothing; past a fixed end, more than this is not round-off. */
static const double far = 1e6, edge = 1e-12;

static enum gx_status report_outside(struct gx_mesh *mesh, int d)
{
  const double *x = mesh->x[d];
  size_t p = 0;
  while (mesh->grid.axis[d].periodic ? fabs(x[p]) <= far : x[p] >= -edge && x[p] <= 1 + edge) p++;
  if (mesh->grid.axis[d].periodic || !isfinite(x[p]))
    return gx_status_set(mesh->space.outcome, GX_UNSTABLE, (long)p, "the position of a particle is %g", x[p]);
  return gx_status_set(mesh->space.outcome, GX_LEFT_DOMAIN, (long)p, "a particle is at %.6g, outside the domain [0, 1]", x[p]);
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
  const struct gx_particles *particles = mesh->space.particles;
  const struct gx_basis *basis = mesh->options.basis;
  size_t n = particles->n;
  for (int d = 0; d < mesh->grid.dim; d++) {
    const struct gx_axis *axis = &mesh->grid.axis[d];
    const double *x = particles->X[d], *half = domains(mesh, d, F, frozen);
    if (u) {
      if (!move(n, x, u[d], axis->periodic ? -far : -edge, axis->periodic ? far : 1 + edge, mesh->x[d]))
        return report_outside(mesh, d);
      x = mesh->x[d];
    }
    long wide = basis->evaluate(axis, n, x, half, mesh->weights.first[d], mesh->weights.S[d], mesh->weights.D[d]);
    if (wide >= 0)
      return gx_status_set(mesh->space.outcome, GX_TANGLED, wide, "the domain of a particle is %.4g cells wide; %s needs 0 to 1",
                           2 * half[wide] * axis->cells, basis->name);
  }
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

static void zero(const struct gx_mesh *mesh, double *field)
{
  memset(field, 0, mesh->grid.stored * sizeof *field);
}

GX_CLONES static void divide_by_mass(size_t nodes, const double *restrict mass, double *restrict field)
{
  for (size_t i = 0; i < nodes; i++) field[i] = mass[i] > 0 ? field[i] / mass[i] : 0;
}

/* field[d] <- M^-1 field[d] with ends held, for every component. */
static void solve_mass(struct gx_mesh *mesh, double *const *field)
{
  for (int d = 0; d < mesh->grid.dim; d++) {
    gx_grid_fold(&mesh->grid, field[d]);
    if (mesh->consistent) {
      gx_mass_solve(mesh->consistent, d, field[d]);
      continue;
    }
    divide_by_mass(mesh->grid.stored, mesh->mass, field[d]);
    gx_grid_fix(&mesh->grid, d, field[d]);
    gx_grid_spread(&mesh->grid, field[d]);
  }
}

enum gx_status gx_mesh_assemble(struct gx_mesh *mesh, double *const *value, double *const *field)
{
  const double *m = mesh->space.particles->m;
  zero(mesh, mesh->mass);
  for (int d = 0; value && d < mesh->grid.dim; d++) zero(mesh, field[d]);
  gx_transfer_scatter(&mesh->weights, m, value, mesh->mass, field);
  gx_grid_fold(&mesh->grid, mesh->mass);
  if (mesh->consistent && gx_mass_factor(mesh->consistent, &mesh->weights, m))
    return gx_status_set(mesh->space.outcome, GX_SINGULAR, -1,
                         "the consistent mass matrix is not positive definite: too few particles under a basis function");
  if (value) solve_mass(mesh, field);
  return GX_OK;
}

void gx_mesh_project(struct gx_mesh *mesh, double *const *value, double *const *field)
{
  for (int d = 0; d < mesh->grid.dim; d++) zero(mesh, field[d]);
  gx_transfer_scatter(&mesh->weights, mesh->space.particles->m, value, NULL, field);
  solve_mass(mesh, field);
}

enum gx_status gx_mesh_stress(struct gx_mesh *mesh)
{
  struct gx_particles *particles = mesh->space.particles;
  const struct gx_posed *posed = mesh->space.posed;
  /* stress by rate: only to see whether F still is a deformation */
  double *const *P = mesh->options.stress_rate ? mesh->rate_P : particles->P;
  long tangled = posed->problem->material->piola(&posed->options.moduli, particles->dim, particles->n, particles->F, P);
  if (tangled < 0) return GX_OK;
  return gx_status_set(mesh->space.outcome, GX_TANGLED, tangled, "det F of a particle is %g",
                       gx_particles_jacobian(particles, (size_t)tangled));
}

void gx_mesh_kick_particles(struct gx_mesh *mesh, double kick)
{
  struct gx_particles *particles = mesh->space.particles;
  double flip = mesh->options.pic ? 0 : mesh->options.flip;
  for (int d = 0; d < particles->dim; d++) {
    double *v = particles->v[d];
    gx_vector_add(particles->n, kick, mesh->gathered_a[d], v);
    if (flip < 1)
      for (size_t p = 0; p < particles->n; p++) v[p] = flip * v[p] + (1 - flip) * mesh->gathered_v[d][p];
  }
}

GX_CLONES static void multiply(size_t n, const double *restrict a, const double *restrict b, double *restrict product)
{
  for (size_t p = 0; p < n; p++) product[p] = a[p] * b[p];
}

void gx_mesh_accelerate(struct gx_mesh *mesh, double t)
{
  struct gx_particles *particles = mesh->space.particles;
  const struct gx_posed *posed = mesh->space.posed;
  bool loaded = posed->problem->body;
  if (loaded) posed->problem->body(posed, t, particles->b);
  for (int d = 0; d < mesh->grid.dim; d++) {
    zero(mesh, mesh->a[d]);
    if (loaded) multiply(particles->n, particles->m, particles->b[d], mesh->body[d]);
  }
  gx_transfer_scatter_force(&mesh->weights, mesh->T, loaded ? mesh->body : NULL, mesh->a);
  solve_mass(mesh, mesh->a);
}

double gx_mesh_kinetic(const struct gx_space *space)
{
  const struct gx_mesh *mesh = (const struct gx_mesh *)space;
  double twice = 0;
  for (int d = 0; d < mesh->grid.dim; d++) twice += gx_vector_square(mesh->grid.stored, mesh->mass, mesh->v[d]);
  return 0.5 * twice;
}

void gx_mesh_particle_acceleration(struct gx_space *space, double *const *a)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  gx_transfer_gather(&mesh->weights, mesh->a, a);
}

/* In blocks, so that nothing is allocated. */
void gx_mesh_field(const struct gx_space *space, enum gx_field which, size_t n, double *const *point, double *const *value)
{
  enum { BLOCK = 64 };
  const struct gx_mesh *mesh = (const struct gx_mesh *)space;
  const int dim = mesh->grid.dim;
  int first[GX_MAX_DIM][BLOCK];
  double S[GX_MAX_DIM][GX_MAX_SUPPORT * BLOCK], D[GX_MAX_DIM][GX_MAX_SUPPORT * BLOCK], half[BLOCK];
  struct gx_weights weights = {.dim = dim, .support = mesh->weights.support};
  for (int i = 0; i < BLOCK; i++) half[i] = 1e-12 * mesh->grid.axis[0].h; /* a hat, but for round-off at its kinks */
  for (size_t from = 0; from < n; from += weights.n) {
    double *out[GX_MAX_DIM];
    weights.n = n - from < BLOCK ? n - from : BLOCK;
    for (int d = 0; d < dim; d++) {
      weights.stride[d] = mesh->weights.stride[d];
      weights.first[d] = first[d];
      weights.S[d] = S[d];
      weights.D[d] = D[d];
      out[d] = value[d] + from;
      mesh->options.basis->evaluate(&mesh->grid.axis[d], weights.n, point[d] + from, half, first[d], S[d], D[d]);
    }
    gx_transfer_gather(&weights, which == GX_FIELD_VELOCITY ? mesh->v : mesh->a, out);
  }
}

void gx_mesh_append(struct gx_state *state, int count, double *const *array, size_t length)
{
  for (int i = 0; i < count; i++, state->count++) {
    state->array[state->count] = array[i];
    state->length[state->count] = length;
  }
}
