/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots are views of the run's own arrays, and of scratch for what follows from them. */
#include <gridcross/snapshot.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/arena.h"
#include "../spaces/mesh.h"

struct gx_snapshot_maker {
  struct gx_space *space; /* borrowed, as the next two */
  struct gx_measure *measure;
  const struct gx_mesh *mesh; /* NULL: no grid */
  double behind;              /* velocities are so many time steps behind */
  struct gx_arena arena;      /* all arrays below */
  double *x[GX_MAX_DIM];      /* [n], the same for the others of particles */
  double *sigma[GX_MAX_TENSOR];
  double *volume;
  double *b[GX_MAX_DIM]; /* NULL: no body force; the same for errors */
  double *error[GX_QUANTITIES][GX_MAX_TENSOR];
  double *point[GX_MAX_DIM];    /* [vertices.n], the same for the fields */
  double *field[4][GX_MAX_DIM]; /* VELOCITY, ... */
  double *density;
  double *volumes; /* [grid.stored] of functions; the same for the coefficients */
  double *coefficient[GX_MAX_DIM];
  struct gx_snapshot snapshot;
};

enum { VELOCITY, ACCELERATION, MOMENTUM, DISPLACEMENT };

int gx_snapshot_components(int dim, int rank)
{
  return rank == 0 ? 1 : rank == 1 ? dim : dim * dim;
}

const struct gx_record *gx_snapshot_record(const struct gx_record_set *set, const char *name)
{
  for (int i = 0; i < set->count; i++)
    if (!strcmp(set->record[i].name, name)) return &set->record[i];
  return NULL;
}

static int take_room(struct gx_snapshot_maker *maker, size_t n, int count, double **array)
{
  double *block = gx_arena_take(&maker->arena, n * (size_t)count * sizeof *block);
  for (int i = 0; block && i < count; i++) array[i] = block + (size_t)i * n;
  return block ? 0 : -1;
}

static bool has_errors(const struct gx_space *space)
{
  return space->posed->problem->exact;
}

/* Of X, u, ...: arrays of the run or of scratch. */
static void add(struct gx_record_set *set, int dim, struct gx_record record, double *const *value)
{
  memcpy(record.value, value, (size_t)gx_snapshot_components(dim, record.rank) * sizeof *value);
  set->record[set->count++] = record;
}

static void name_particles(struct gx_snapshot_maker *maker)
{
  const struct gx_particles *particles = maker->space->particles;
  const int dim = particles->dim;
  struct gx_record_set *set = &maker->snapshot.particles;
  *set = (struct gx_record_set){.n = particles->n, .shape = {particles->n, 1, 1}};
#define ADD(array, ...) add(set, dim, (struct gx_record){__VA_ARGS__}, array)
  ADD(maker->x, .name = "position", .rank = 1, .length = 1);
  ADD(particles->X, .name = "reference_position", .rank = 1, .length = 1, .constant = true);
  ADD(particles->u, .name = "displacement", .rank = 1, .length = 1);
  ADD(particles->v, .name = "velocity", .rank = 1, .length = 1, .time = -1);
  ADD(particles->F, .name = "deformation_gradient", .rank = 2);
  ADD(particles->P, .name = "first_piola_stress", .rank = 2, .length = -1, .mass = 1, .time = -2);
  ADD(maker->sigma, .name = "cauchy_stress", .rank = 2, .length = -1, .mass = 1, .time = -2);
  ADD(&particles->m, .name = "mass", .length = dim - 3, .mass = 1, .constant = true);
  ADD(&maker->volume, .name = "volume", .length = dim);
  if (maker->b[0]) ADD(maker->b, .name = "body_force", .rank = 1, .length = 1, .time = -2);
  if (!has_errors(maker->space)) return;
  ADD(maker->error[GX_DISPLACEMENT], .name = "displacement_error", .rank = 1, .length = 1);
  ADD(maker->error[GX_VELOCITY], .name = "velocity_error", .rank = 1, .length = 1, .time = -1);
  ADD(maker->error[GX_STRESS], .name = "stress_error", .rank = 2, .length = -1, .mass = 1, .time = -2);
}

static void name_vertices(struct gx_snapshot_maker *maker)
{
  const int dim = maker->snapshot.dim;
  struct gx_record_set *set = &maker->snapshot.vertices;
  ADD(maker->field[VELOCITY], .name = "velocity", .rank = 1, .length = 1, .time = -1);
  ADD(maker->field[ACCELERATION], .name = "acceleration", .rank = 1, .length = 1, .time = -2);
  ADD(&maker->density, .name = "density", .length = -3, .mass = 1);
  ADD(maker->field[MOMENTUM], .name = "momentum", .rank = 1, .length = -2, .mass = 1, .time = -1);
  if (maker->snapshot.moving) ADD(maker->field[DISPLACEMENT], .name = "displacement", .rank = 1, .length = 1);
#undef ADD
}

static int take_particle_rooms(struct gx_snapshot_maker *maker)
{
  const struct gx_space *space = maker->space;
  const int dim = space->particles->dim;
  const size_t n = space->particles->n;
  if (take_room(maker, n, dim, maker->x) || take_room(maker, n, dim * dim, maker->sigma) ||
      take_room(maker, n, 1, &maker->volume))
    return -1;
  if (space->posed->problem->body && take_room(maker, n, dim, maker->b)) return -1;
  for (int q = 0; q < GX_QUANTITIES && has_errors(space); q++)
    if (take_room(maker, n, q == GX_STRESS ? dim * dim : dim, maker->error[q])) return -1;
  return 0;
}

/* Vertices of the cells, first direction fastest. */
static int lay_out_vertices(struct gx_snapshot_maker *maker, const int *cells)
{
  struct gx_record_set *set = &maker->snapshot.vertices;
  const struct gx_grid *grid = &maker->mesh->grid;
  const int dim = grid->dim;
  set->n = 1;
  for (int d = 0; d < GX_MAX_DIM; d++) set->n *= set->shape[d] = d < dim ? (size_t)cells[d] + 1 : 1;
  if (take_room(maker, set->n, dim, maker->point) || take_room(maker, set->n, 1, &maker->density) ||
      take_room(maker, grid->stored, 1, &maker->volumes) || take_room(maker, grid->stored, dim, maker->coefficient))
    return -1;
  for (int f = VELOCITY; f <= (maker->snapshot.moving ? DISPLACEMENT : MOMENTUM); f++)
    if (take_room(maker, set->n, dim, maker->field[f])) return -1;
  size_t stride = 1;
  for (int d = 0; d < dim; stride *= set->shape[d++]) {
    maker->snapshot.spacing[d] = grid->axis[d].h;
    for (size_t i = 0; i < set->n; i++) maker->point[d][i] = (double)(i / stride % set->shape[d]) / (double)cells[d];
  }
  return gx_mesh_volumes(maker->mesh, maker->volumes);
}

struct gx_snapshot_maker *gx_snapshot_create(struct gx_space *space, const struct gx_clock *clock, struct gx_measure *measure,
                                             const int *cells)
{
  struct gx_snapshot_maker *maker = calloc(1, sizeof *maker);
  if (!maker) return NULL;
  maker->space = space;
  maker->measure = measure;
  maker->mesh = space->kind->field ? (const struct gx_mesh *)space : NULL;
  maker->behind = clock->staggered ? 0.5 : 0;
  maker->snapshot.dim = space->particles->dim;
  maker->snapshot.moving = maker->mesh && !space->kind->fixed_grid;
  if (take_particle_rooms(maker) || (maker->mesh && lay_out_vertices(maker, cells))) {
    gx_snapshot_free(maker);
    return NULL;
  }
  name_particles(maker);
  if (maker->mesh) name_vertices(maker);
  return maker;
}

void gx_snapshot_free(struct gx_snapshot_maker *maker)
{
  if (!maker) return;
  gx_arena_free(&maker->arena);
  free(maker);
}

double gx_snapshot_numbers(const struct gx_space *space, const int *cells)
{
  const double dim = space->particles->dim;
  const struct gx_problem *problem = space->posed->problem;
  double each = 3 * dim + 3 * dim * dim + 1, vertices = space->kind->field ? 1 : 0;
  if (problem->body) each += dim;
  if (problem->exact) each += 2 * dim + dim * dim;
  for (int d = 0; d < space->particles->dim; d++) vertices *= cells[d] + 1.0;
  return each * (double)space->particles->n + vertices * (space->kind->fixed_grid ? 3 * dim + 1 : 4 * dim + 1);
}

static void take_particles(struct gx_snapshot_maker *maker, double time)
{
  const struct gx_particles *particles = maker->space->particles;
  const struct gx_posed *posed = maker->space->posed;
  const int dim = particles->dim;
  for (int d = 0; d < dim; d++)
    for (size_t p = 0; p < particles->n; p++) maker->x[d][p] = particles->X[d][p] + particles->u[d][p];
  gx_material_cauchy(dim, particles->n, particles->F, particles->P, maker->sigma);
  for (size_t p = 0; p < particles->n; p++) maker->volume[p] = gx_particles_jacobian(particles, p) * particles->V0[p];
  if (maker->b[0]) posed->problem->body(posed, time, maker->b);
  for (int q = 0; q < GX_QUANTITIES && has_errors(maker->space); q++)
    for (int k = 0; k < (q == GX_STRESS ? dim * dim : dim); k++)
      gx_measure_error(maker->measure, (enum gx_quantity)q, k, maker->error[q][k]);
}

/* Fields of mass, and of it times velocity, by the volumes of their functions. */
static void take_densities(struct gx_snapshot_maker *maker)
{
  const struct gx_mesh *mesh = maker->mesh;
  const size_t n = maker->snapshot.vertices.n, stored = mesh->grid.stored;
  const double *V = maker->volumes;
  double *const *c = maker->coefficient;
  double *rho[GX_MAX_DIM], *density[GX_MAX_DIM];
  for (int d = 0; d < mesh->grid.dim; d++) {
    for (size_t i = 0; i < stored; i++) c[d][i] = V[i] > 0 ? mesh->mass[i] * mesh->v[d][i] / V[i] : 0;
    gx_grid_spread(&mesh->grid, c[d]);
    rho[d] = c[0];
    density[d] = maker->density;
  }
  gx_mesh_field_at(mesh, c, n, maker->point, maker->field[MOMENTUM]);
  for (size_t i = 0; i < stored; i++) c[0][i] = V[i] > 0 ? mesh->mass[i] / V[i] : 0;
  gx_grid_spread(&mesh->grid, c[0]);
  gx_mesh_field_at(mesh, rho, n, maker->point, density);
}

const struct gx_snapshot *gx_snapshot_take(struct gx_snapshot_maker *maker, double step, double time, double dt)
{
  const struct gx_mesh *mesh = maker->mesh;
  struct gx_snapshot *snapshot = &maker->snapshot;
  const char *const lagging[] = {"velocity", "momentum"};
  struct gx_record_set *const sets[] = {&snapshot->particles, &snapshot->vertices};
  snapshot->step = step;
  snapshot->time = time;
  snapshot->dt = dt;
  for (size_t i = 0; i < 2; i++)
    for (int k = 0; k < sets[i]->count; k++)
      for (size_t l = 0; l < 2; l++)
        if (!strcmp(sets[i]->record[k].name, lagging[l])) sets[i]->record[k].offset = -maker->behind * dt;
  gx_measure_settle(maker->measure);
  take_particles(maker, time);
  if (!mesh) return snapshot;
  gx_mesh_field_at(mesh, mesh->v, snapshot->vertices.n, maker->point, maker->field[VELOCITY]);
  gx_mesh_field_at(mesh, mesh->a, snapshot->vertices.n, maker->point, maker->field[ACCELERATION]);
  if (snapshot->moving) gx_mesh_field_at(mesh, mesh->u, snapshot->vertices.n, maker->point, maker->field[DISPLACEMENT]);
  take_densities(maker);
  return snapshot;
}
