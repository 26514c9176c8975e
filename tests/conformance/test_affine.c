/* SPDX-License-Identifier: GPL-3.0-or-later */
/* APIC transfers alone, of a body in the middle of its box, with every basis in 1-D to 3-D, on nodes at rest and on nodes that have
 * moved: linear and angular momentum pass whole from particles to nodes and back, affine velocity is reproduced, and without an
 * affine part the transfers are PIC's. */
#include <gsl/gsl_errno.h>

#include "core/vector.h"
#include "rig.h"
#include "spaces/mesh.h"

struct setting {
  const struct gx_space_kind *kind;
  const struct gx_basis *basis;
  const char *transfer;
  int dim, degree;
  bool periodic;
  struct gx_simulation simulation;
  struct gx_mesh *mesh;
  double *y[GX_MAX_DIM]; /* [stored] where nodes are */
};

static int cells_of(int dim)
{
  return dim == 3 ? 10 : 16;
}

static struct gx_case box(const struct setting *setting)
{
  struct gx_case one = case_draft("problem.name=axis-aligned", "problem.amplitude=0", "mesh.particles_per_cell=1",
                                  "method.projection=each-step", "method.clock=euler-stress-last", "time.dt=0.01");
  case_set_integer(&one, GX_PROBLEM_DIMENSION, setting->dim);
  case_set_integer(&one, GX_MESH_CELLS, cells_of(setting->dim));
  case_set(&one, GX_METHOD_SPACE, setting->kind->name);
  case_set(&one, GX_METHOD_BASIS, setting->basis->name);
  case_set_integer(&one, GX_METHOD_DEGREE, setting->degree);
  case_set(&one, GX_METHOD_TRANSFER, setting->transfer);
  gx_parameter_resolve(one.value);
  return one;
}

/* All particles into the middle third, at irregular places, with velocities without pattern. */
static void squeeze(struct gx_particles *particles)
{
  uint64_t seed = 61;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) {
      particles->X[d][p] = 0.35 + 0.3 * particles->X[d][p] + check_random(&seed, -0.01, 0.01);
      particles->half_length[d][p] *= check_random(&seed, 0.3, 1);
      particles->v[d][p] = check_random(&seed, -1, 2);
    }
}

/* A moving mesh is deformed, and particles with it; on a fixed grid nodes are where they are. */
static void place_nodes(struct setting *setting)
{
  struct gx_mesh *mesh = setting->mesh;
  const struct gx_grid *grid = &mesh->grid;
  for (int d = 0; d < setting->dim; d++) {
    setting->y[d] = malloc(grid->stored * sizeof(double));
    for (size_t i = 0; i < grid->stored; i++) {
      double X[GX_MAX_DIM] = {0};
      for (int e = 0; e < setting->dim; e++) {
        int k = (int)(i / grid->stride[e] % (size_t)grid->axis[e].stored);
        X[e] = grid->axis[e].h * setting->basis->site(&grid->axis[e], k);
      }
      mesh->u[d][i] = setting->kind->fixed_grid ? 0 : 0.1 * sin(4 * X[0] + 7 * X[1] + d) + 0.05 * cos(9 * X[2] - 3 * X[d]);
      setting->y[d][i] = X[d] + mesh->u[d][i];
    }
  }
  if (setting->kind->fixed_grid) return;
  gx_transfer_gather(&mesh->blocks.whole, mesh->u, mesh->space.particles->u);
  gx_transfer_gather_gradient(&mesh->blocks.whole, mesh->u, mesh->space.particles->F);
  for (int d = 0; d < setting->dim; d++)
    for (size_t p = 0; p < mesh->space.particles->n; p++) mesh->space.particles->F[d * setting->dim + d][p] += 1;
}

static void build(struct setting *setting)
{
  struct gx_case one = box(setting);
  struct gx_outcome outcome = {.status = GX_OK, .particle = -1};
  struct gx_simulation *s = &setting->simulation;
  assert_int_equal(gx_simulation_plan(s, &one, &outcome), GX_OK);
  s->space_options.periodic = setting->periodic; /* else free: nothing is held */
  s->particles = gx_particles_create(setting->dim, s->space_options.cells, s->per_cell, s->layout, 1);
  s->posed = gx_problem_pose(s->problem, &s->problem_options, s->particles->n, s->particles->X);
  squeeze(s->particles);
  CHECK(s->kind->create(s->kind, &s->space, &s->space_options, s->particles, s->posed, &outcome) == GX_OK, "%s", outcome.reason);
  setting->mesh = (struct gx_mesh *)s->space;
  place_nodes(setting);
}

static void destroy(struct setting *setting)
{
  for (int d = 0; d < setting->dim; d++) free(setting->y[d]);
  gx_simulation_free(&setting->simulation);
}

static void each_setting(const char *transfer, void (*check)(struct setting *setting))
{
  struct setting setting = {.transfer = transfer};
  int ran = 0;
  for (int s = 0; (setting.kind = gx_space_family[s]); s++) {
    if (setting.kind->of_problem || setting.kind->collocation) continue;
    for (int b = 0; (setting.basis = gx_basis_family[b]); b++)
      for (setting.dim = 1; setting.dim <= GX_MAX_DIM; setting.dim++)
        for (int periodic = 0; periodic < 2; periodic++)
          for (setting.degree = 1; setting.degree <= (!setting.basis->has_degree ? 1
                                                      : setting.dim == 3         ? 3
                                                                                 : 5);
               setting.degree++) {
            if (setting.basis->deforms && !setting.kind->fixed_grid) continue;
            setting.periodic = periodic;
            build(&setting);
            check(&setting);
            destroy(&setting);
            ran++;
          }
  }
  assert_true(ran > 60);
}

static const char *describe(const struct setting *setting)
{
  static char text[160];
  snprintf(text, sizeof text, "%s %s degree %d %d-D %s", setting->kind->name, setting->basis->name, setting->degree, setting->dim,
           setting->periodic ? "periodic" : "free");
  return text;
}

struct momentum {
  double linear[GX_MAX_DIM], angular[GX_MAX_DIM];
};

static void add(struct momentum *momentum, int dim, double m, double *const *x, double *const *shift, double *const *v, size_t i)
{
  double at[GX_MAX_DIM] = {0}, velocity[GX_MAX_DIM] = {0};
  for (int d = 0; d < dim; d++) {
    at[d] = x[d][i] + (shift ? shift[d][i] : 0);
    velocity[d] = v[d][i];
    momentum->linear[d] += m * velocity[d];
  }
  for (int d = 0; d < GX_MAX_DIM; d++) {
    int e = (d + 1) % 3, f = (d + 2) % 3;
    momentum->angular[d] += m * (at[e] * velocity[f] - at[f] * velocity[e]);
  }
}

static struct momentum of_particles(const struct setting *setting)
{
  struct momentum momentum = {{0}, {0}};
  const struct gx_particles *particles = setting->simulation.particles;
  for (size_t p = 0; p < particles->n; p++)
    add(&momentum, setting->dim, particles->m[p], particles->X, particles->u, particles->v, p);
  setting->kind->spin(setting->simulation.space, 0, momentum.angular);
  return momentum;
}

static struct momentum of_nodes(const struct setting *setting)
{
  struct momentum momentum = {{0}, {0}};
  for (size_t i = 0; i < setting->mesh->grid.stored; i++)
    add(&momentum, setting->dim, setting->mesh->mass[i], setting->y, NULL, setting->mesh->v, i);
  return momentum;
}

static void compare(const struct setting *setting, const char *what, struct momentum before, struct momentum after)
{
  const double tolerance = 1e-13; /* of a body of mass 1, width 0.3 and speeds of order 1 */
  for (int d = 0; d < GX_MAX_DIM; d++) {
    CHECK(fabs(after.linear[d] - before.linear[d]) < tolerance, "%s, %s: linear %g", describe(setting), what,
          after.linear[d] - before.linear[d]);
    CHECK(fabs(after.angular[d] - before.angular[d]) < tolerance, "%s, %s: angular %g", describe(setting), what,
          after.angular[d] - before.angular[d]);
  }
}

static void rough_nodes(const struct setting *setting)
{
  struct gx_mesh *mesh = setting->mesh;
  uint64_t seed = 67;
  for (int d = 0; d < setting->dim; d++) {
    for (size_t i = 0; i < mesh->grid.stored; i++) mesh->v[d][i] = check_random(&seed, d - 1, d + 1);
    gx_grid_spread(&mesh->grid, mesh->v[d]);
  }
}

/* Particles take velocity by a kick of no force. */
static void to_particles(const struct setting *setting)
{
  for (int d = 0; d < setting->dim; d++) memset(setting->mesh->a[d], 0, setting->mesh->grid.stored * sizeof(double));
  setting->kind->advance(setting->simulation.space, 1, 0, 0);
}

static void to_nodes(const struct setting *setting)
{
  assert_int_equal(setting->kind->weights(setting->simulation.space), GX_OK);
  assert_int_equal(setting->kind->project(setting->simulation.space), GX_OK);
  gx_mesh_catch_up(setting->mesh);
}

/* Particles move, and the nodes of a moving mesh with them. */
static void drift(struct setting *setting, double span)
{
  setting->kind->advance(setting->simulation.space, 0, 0, span);
  for (int d = 0; d < setting->dim && !setting->kind->fixed_grid; d++)
    gx_vector_add(setting->mesh->grid.stored, span, setting->mesh->v[d], setting->y[d]);
  assert_int_equal(setting->kind->weights(setting->simulation.space), GX_OK);
}

static void check_momentum(struct setting *setting)
{
  const bool hats = setting->mesh->blocks.whole.support == 2 && setting->kind->fixed_grid; /* keep the gradient */
  rough_nodes(setting);
  struct momentum before = of_nodes(setting);
  if (setting->dim > 1) assert_true(fabs(before.angular[2]) > 1e-3);
  to_particles(setting);
  struct momentum between = of_particles(setting), alone = between;
  double none[GX_MAX_DIM] = {0};
  setting->kind->spin(setting->simulation.space, 0, none);
  compare(setting, "to particles", before, between);
  to_nodes(setting);
  compare(setting, "to nodes", between, of_nodes(setting));
  rough_nodes(setting);
  to_particles(setting);
  drift(setting, 0.005);
  struct momentum moved = of_particles(setting);
  if (!hats) compare(setting, "on the way", before, moved);
  to_nodes(setting);
  compare(setting, "to other nodes", moved, of_nodes(setting));
  for (int d = 0; d < GX_MAX_DIM; d++) alone.angular[d] -= none[d];
  if (setting->dim > 1) assert_true(fabs(alone.angular[2] - between.angular[2]) > 1e-5); /* the affine part counts */
}

static void momentum_passes_whole(void **state)
{
  (void)state;
  each_setting("apic", check_momentum);
}

/* v = c + A y, in 2-D and 3-D with a rotation. */
static double affine(int dim, int d, double *const *x, double *const *shift, size_t i)
{
  static const double A[GX_MAX_DIM][GX_MAX_DIM] = {{0.3, -1.1, 0.4}, {0.9, -0.2, 0.7}, {-0.5, 0.6, 0.1}};
  double v = 0.2 * (d + 1);
  for (int e = 0; e < dim; e++) v += A[d][e] * (x[e][i] + (shift ? shift[e][i] : 0));
  return v;
}

static void check_affine(struct setting *setting)
{
  struct gx_mesh *mesh = setting->mesh;
  const struct gx_particles *particles = setting->simulation.particles;
  for (int d = 0; d < setting->dim; d++)
    for (size_t i = 0; i < mesh->grid.stored; i++) mesh->v[d][i] = affine(setting->dim, d, setting->y, NULL, i);
  for (int round = 0; round < 3; round++) {
    to_particles(setting);
    for (int d = 0; d < setting->dim; d++)
      for (size_t p = 0; p < particles->n; p++)
        CHECK(fabs(particles->v[d][p] - affine(setting->dim, d, particles->X, particles->u, p)) < 1e-12, "%s: v of %zu off by %g",
              describe(setting), p, particles->v[d][p] - affine(setting->dim, d, particles->X, particles->u, p));
    to_nodes(setting);
    for (int d = 0; d < setting->dim; d++)
      for (size_t i = 0; i < mesh->grid.stored; i++) {
        double off = mesh->v[d][i] - affine(setting->dim, d, setting->y, NULL, i);
        CHECK(mesh->mass[i] < 1e-9 || fabs(off) < 1e-9, "%s: v of node %zu, mass %g, off by %g", describe(setting), i,
              mesh->mass[i], off);
      }
  }
}

static void affine_velocity_is_reproduced(void **state)
{
  (void)state;
  each_setting("apic", check_affine);
}

/* The nodes take the same from particles whose affine part is zero, and particles the same v from equal nodes. */
static void check_limit(struct setting *apic)
{
  struct setting pic = *apic;
  pic.transfer = "pic";
  build(&pic);
  const struct gx_particles *ours = apic->simulation.particles, *theirs = pic.simulation.particles;
  const struct gx_mesh *mesh = apic->mesh;
  for (int d = 0; d < apic->dim; d++)
    for (size_t i = 0; i < mesh->grid.stored; i++) NEAR(mesh->v[d][i], pic.mesh->v[d][i], 0);
  rough_nodes(apic);
  rough_nodes(&pic);
  to_particles(apic);
  to_particles(&pic);
  for (int d = 0; d < apic->dim; d++)
    for (size_t p = 0; p < ours->n; p++) NEAR(ours->v[d][p], theirs->v[d][p], 0);
  to_nodes(apic);
  to_nodes(&pic);
  double apart = 0;
  for (int d = 0; d < apic->dim; d++)
    for (size_t i = 0; i < mesh->grid.stored; i++) apart = fmax(apart, fabs(mesh->v[d][i] - pic.mesh->v[d][i]));
  assert_true(apart > 0.01);
  destroy(&pic);
}

static void without_an_affine_part_it_is_pic(void **state)
{
  (void)state;
  each_setting("apic", check_limit);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(momentum_passes_whole),
      cmocka_unit_test(affine_velocity_is_reproduced),
      cmocka_unit_test(without_an_affine_part_it_is_pic),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
