/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums factored by direction against the general ones: every basis and degree, 1-D to 3-D, periodic and bounded, both
 * layouts, grids smaller than a support and grids of several parts, with one thread and with several. */
#include <string.h>

#include <gsl/gsl_errno.h>

#include "check.h"
#include "points.h"
#include "rig.h"
#include "spaces/lattice.h"

struct setting {
  const struct gx_particles *particles;
  struct points points;
  struct gx_lattice *lattice, *team_lattice;
  const char *what;
};

static double **random_fields(int count, size_t length, uint64_t seed)
{
  double **field = fields(count, length);
  for (int i = 0; i < count; i++)
    for (size_t p = 0; p < length; p++) field[i][p] = check_random(&seed, -1, 1);
  return field;
}

/* Sums of up to `terms` products of size `scale`. */
static void compare(const struct setting *setting, const char *sum, int count, size_t n, double **here, double **team,
                    double **there, double scale)
{
  for (int k = 0; k < count; k++) {
    CHECK(!memcmp(here[k], team[k], n * sizeof(double)), "%s: %s of a team has other bits", setting->what, sum);
    for (size_t p = 0; p < n; p++)
      CHECK(fabs(here[k][p] - there[k][p]) <= 1e-14 * scale, "%s: %s %d of %zu is %.17g, not %.17g", setting->what, sum, k, p,
            here[k][p], there[k][p]);
  }
}

static void check_gather(const struct setting *setting)
{
  const int dim = setting->particles->dim;
  const size_t n = setting->particles->n;
  double **field = random_fields(dim, setting->points.grid.stored, 3);
  double **value = fields(dim, n), **gradient = fields(dim * dim, n), **team_value = fields(dim, n);
  double **team_gradient = fields(dim * dim, n), **true_value = fields(dim, n), **true_gradient = fields(dim * dim, n);
  gx_transfer_gather(&setting->points.weights, field, true_value);
  gx_transfer_gather_gradient(&setting->points.weights, field, true_gradient);
  gx_lattice_gather(setting->lattice, field, value, gradient);
  gx_lattice_gather(setting->team_lattice, field, team_value, NULL);
  gx_lattice_gather(setting->team_lattice, field, NULL, team_gradient);
  compare(setting, "value", dim, n, value, team_value, true_value, 1);
  compare(setting, "gradient", dim * dim, n, gradient, team_gradient, true_gradient,
          3 * setting->points.grid.axis[dim - 1].cells);
  fields_free(field, dim);
  double **vectors[] = {value, team_value, true_value}, **tensors[] = {gradient, team_gradient, true_gradient};
  for (int i = 0; i < 3; i++) {
    fields_free(vectors[i], dim);
    fields_free(tensors[i], dim * dim);
  }
}

struct forces {
  int dim;
  double **T, **body;
};

static void set_forces(void *context, const struct gx_lattice_row *row)
{
  const struct forces *forces = context;
  const size_t bytes = row->n * sizeof(double);
  for (int k = 0; k < forces->dim * forces->dim; k++) memcpy(row->T[k], forces->T[k] + row->first, bytes);
  for (int d = 0; forces->body && d < forces->dim; d++) memcpy(row->body[d], forces->body[d] + row->first, bytes);
}

/* Whatever was there is replaced. */
static void check_scatter(const struct setting *setting, bool loaded)
{
  const int dim = setting->particles->dim;
  const size_t n = setting->particles->n, nodes = setting->points.grid.stored;
  double **T = random_fields(dim * dim, n, 5), **body = random_fields(dim, n, 7), **m = random_fields(1, n, 11);
  double **force = random_fields(dim, nodes, 13), **team = random_fields(dim, nodes, 17), **expected = fields(dim, nodes);
  double **momentum = random_fields(dim, nodes, 19), **team_momentum = random_fields(dim, nodes, 23);
  double **expected_momentum = fields(dim, nodes);
  struct forces forces = {dim, T, loaded ? body : NULL};
  struct gx_lattice_pass pass = {.sum = force, .T = true, .body = loaded, .visit = set_forces, .context = &forces};
  gx_transfer_scatter_force(&setting->points.weights, T, loaded ? body : NULL, expected);
  gx_transfer_scatter(&setting->points.weights, m[0], body, NULL, expected_momentum);
  gx_lattice_run(setting->lattice, &pass);
  gx_lattice_scatter(setting->lattice, m[0], body, momentum);
  pass.sum = team;
  gx_lattice_run(setting->team_lattice, &pass);
  gx_lattice_scatter(setting->team_lattice, m[0], body, team_momentum);
  double met = pow(3, dim) * (setting->points.weights.support + 1); /* particles that a node sums, weights below 1 */
  compare(setting, "force", dim, nodes, force, team, expected, met * 3 * setting->points.grid.axis[dim - 1].cells);
  compare(setting, "momentum", dim, nodes, momentum, team_momentum, expected_momentum, met);
  double **nodal[] = {force, team, expected, momentum, team_momentum, expected_momentum};
  for (int i = 0; i < 6; i++) fields_free(nodal[i], dim);
  fields_free(T, dim * dim);
  fields_free(body, dim);
  fields_free(m, 1);
}

static void check_setting(const struct gx_basis *basis, int dim, int degree, bool periodic, enum gx_layout layout, int cells,
                          int per_cell, struct gx_team *team)
{
  char what[120];
  snprintf(what, sizeof what, "%s degree %d, %d-D, %s, layout %d, %d cells of %d", basis->name, degree, dim,
           periodic ? "periodic" : "bounded", (int)layout, cells, per_cell);
  struct gx_particles *particles = gx_particles_create(dim, (int[]){cells, cells + 1, cells + 2}, per_cell, layout, 1);
  struct setting setting = {.particles = particles, .what = what};
  setting.points = points_at(basis, dim, cells, periodic, degree, particles->n, particles->X, particles->half_length);
  setting.lattice = gx_lattice_create(&setting.points.grid, basis, particles, NULL);
  setting.team_lattice = gx_lattice_create(&setting.points.grid, basis, particles, team);
  CHECK(setting.lattice, "%s does not factor", what);
  check_gather(&setting);
  check_scatter(&setting, false);
  check_scatter(&setting, true);
  gx_lattice_free(setting.lattice);
  gx_lattice_free(setting.team_lattice);
  points_free(&setting.points);
  gx_particles_free(particles);
}

static void factored_sums_are_the_general_ones(void **state)
{
  (void)state;
  struct gx_team *team = gx_team_create(3);
  for (size_t i = 0; gx_basis_family[i]; i++)
    for (int dim = 1; dim <= GX_MAX_DIM; dim++)
      for (int degree = 1; degree <= (gx_basis_family[i]->has_degree ? 5 : 1); degree++)
        for (int periodic = 0; periodic < 2; periodic++)
          for (int layout = GX_LAYOUT_UNIFORM; layout <= GX_LAYOUT_GAUSS; layout++) {
            check_setting(gx_basis_family[i], dim, degree, periodic, (enum gx_layout)layout, 2, 3, team);
            check_setting(gx_basis_family[i], dim, degree, periodic, (enum gx_layout)layout, 13, dim > 2 ? 1 : 2, team);
          }
  gx_team_free(team);
}

/* An incomplete lattice, and one whose particles sit otherwise from cell to cell. */
static void other_particles_do_not_factor(void **state)
{
  (void)state;
  struct gx_particles *particles = gx_particles_create(2, (int[]){6, 7}, 1, GX_LAYOUT_UNIFORM, 1);
  const struct gx_basis *basis = gx_basis_find("bspline");
  struct points points = points_at(basis, 2, 6, true, 2, particles->n, particles->X, particles->half_length);
  struct points others = points_at(basis, 2, 4, true, 2, particles->n, particles->X, particles->half_length);
  struct gx_lattice *lattice = gx_lattice_create(&points.grid, basis, particles, NULL);
  assert_non_null(lattice);
  gx_lattice_free(lattice);
  assert_null(gx_lattice_create(&others.grid, basis, particles, NULL));
  memset(particles->lattice, 0, sizeof particles->lattice);
  assert_null(gx_lattice_create(&points.grid, basis, particles, NULL));
  points_free(&points);
  points_free(&others);
  gx_particles_free(particles);
}

/* The case on a lattice, and on the same particles of which nobody says that they are one. */
static void build_both(struct rig *rig, const struct gx_case *one)
{
  assert_true(rig_build(&rig[0], one, NULL, NULL, NULL));
  const size_t n = rig[0].simulation.particles->n;
  size_t *order = malloc(n * sizeof *order);
  for (size_t p = 0; p < n; p++) order[p] = p;
  assert_true(rig_build(&rig[1], one, order, NULL, NULL));
  free(order);
}

/* By the nodes, whatever the particles have, where they do not carry velocity: sum m b (v + ahead a) of settled particles. */
static void check_power(const struct rig *rig, bool by_nodes)
{
  struct gx_space *space = rig->simulation.space;
  const struct gx_particles *particles = rig->simulation.particles;
  const size_t n = particles->n;
  double *a = calloc(GX_MAX_DIM * n, sizeof *a), *component[GX_MAX_DIM];
  for (int d = 0; d < particles->dim; d++) component[d] = a + (size_t)d * n;
  space->kind->particle_acceleration(space, component);
  for (int i = 0; i < 2; i++) {
    const double ahead = i * 0.01;
    double power = NAN, sum = 0, size = 0;
    assert_int_equal(space->kind->power(space, ahead, &power), by_nodes);
    for (int d = 0; d < particles->dim; d++)
      for (size_t p = 0; p < n; p++) {
        const double term = particles->m[p] * particles->b[d][p] * (particles->v[d][p] + ahead * component[d][p]);
        sum += term;
        size += fabs(term);
      }
    assert_true(size > 1e-6);
    if (by_nodes) NEAR(power, sum, 1e-13 * size);
  }
  free(a);
}

/* Particles that are settled after an acceleration have all that they have on the general path. */
static void settled_particles_are_complete(void **state)
{
  (void)state;
  static const char *const dimensions[] = {"1", "2", "3"}, *const stresses[] = {"F", "rate"},
                           *const projections[] = {"once", "each-step"};
  for (int i = 0; i < 12; i++) {
    struct gx_case one = case_draft("problem.name=axis-aligned", "problem.modulus=1", "problem.poisson=0.3", "mesh.cells=6",
                                    "mesh.particles_per_cell=2", "method.space=moving-mesh", "time.dt=0.02", "time.end=1");
    case_set(&one, GX_PROBLEM_DIMENSION, dimensions[i % 3]);
    case_set(&one, GX_METHOD_STRESS, stresses[i / 3 % 2]);
    case_set(&one, GX_METHOD_PROJECTION, projections[i / 6]);
    gx_parameter_resolve(one.value);
    struct rig rig[2];
    build_both(rig, &one);
    for (int r = 0; r < 2; r++)
      for (int half = 0; half < 2; half++) {
        rig_run(&rig[r], 5 * half);
        assert_int_equal(gx_stepper_accelerate(rig[r].stepper, 5 * half * rig[r].simulation.dt), GX_OK);
        rig[r].simulation.kind->settle(rig[r].simulation.space);
        check_power(&rig[r], r == 0 && i < 6);
      }
    const struct gx_particles *here = rig[0].simulation.particles, *there = rig[1].simulation.particles;
    double moved = 0;
    for (int d = 0; d < here->dim; d++)
      for (size_t p = 0; p < here->n; p++) {
        NEAR(here->u[d][p], there->u[d][p], 1e-15);
        NEAR(here->v[d][p], there->v[d][p], 1e-14);
        NEAR(here->b[d][p], there->b[d][p], 1e-14);
        moved = fmax(moved, fabs(here->b[d][p]));
      }
    for (int k = 0; k < here->dim * here->dim; k++)
      for (size_t p = 0; p < here->n; p++) {
        NEAR(here->F[k][p], there->F[k][p], 1e-13);
        NEAR(here->P[k][p], there->P[k][p], 1e-13);
      }
    assert_true(moved > 0.1);
    rig_free(&rig[0]);
    rig_free(&rig[1]);
  }
}

/* The same particle is the first to tangle. */
static void the_first_to_tangle_is_named(void **state)
{
  (void)state;
  struct gx_case one =
      case_of("problem.name=axis-aligned", "problem.dimension=2", "problem.modulus=1", "problem.amplitude=0.15", "mesh.cells=16",
              "mesh.particles_per_cell=2", "method.space=moving-mesh", "time.dt=0.4", "time.end=9");
  struct rig rig[2];
  build_both(rig, &one);
  for (int r = 0; r < 2; r++)
    for (int k = 0; k < 20 && rig[r].outcome.status == GX_OK; k++) gx_stepper_step(rig[r].stepper, k * 0.4, 0.4);
  assert_int_equal(rig[0].outcome.status, GX_TANGLED);
  assert_true(rig[0].outcome.particle > 0);
  assert_int_equal(rig[0].outcome.particle, rig[1].outcome.particle);
  CLOSE(gx_particles_jacobian(rig[0].simulation.particles, (size_t)rig[0].outcome.particle),
        gx_particles_jacobian(rig[1].simulation.particles, (size_t)rig[1].outcome.particle), 1e-9);
  rig_free(&rig[0]);
  rig_free(&rig[1]);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(factored_sums_are_the_general_ones),
      cmocka_unit_test(other_particles_do_not_factor),
      cmocka_unit_test(settled_particles_are_complete),
      cmocka_unit_test(the_first_to_tangle_is_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
