/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transfers factored by direction against the general ones: every basis and degree, 1-D to 3-D, periodic and bounded, both
 * layouts, grids smaller than a support and grids of several parts, with one thread and with several. */
#include <string.h>

#include "check.h"
#include "points.h"
#include "spaces/lattice.h"

struct setting {
  const struct gx_particles *particles;
  struct points points;
  struct gx_lattice *lattice, *team_lattice;
  const char *what;
};

static double **fields(int count, size_t length)
{
  double **field = calloc((size_t)count, sizeof *field);
  for (int i = 0; i < count; i++) field[i] = calloc(length, sizeof **field);
  return field;
}

static void fields_free(double **field, int count)
{
  for (int i = 0; i < count; i++) free(field[i]);
  free(field);
}

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

/* What is there already is added to. */
static void check_scatter(const struct setting *setting, bool loaded)
{
  const int dim = setting->particles->dim;
  const size_t n = setting->particles->n, nodes = setting->points.grid.stored;
  double **T = random_fields(dim * dim, n, 5), **body = random_fields(dim, n, 7), **m = random_fields(1, n, 11);
  double **force = random_fields(dim, nodes, 13), **team = random_fields(dim, nodes, 13),
         **expected = random_fields(dim, nodes, 13);
  struct forces forces = {dim, T, loaded ? body : NULL};
  struct gx_lattice_pass pass = {.sum = force, .T = true, .body = loaded, .visit = set_forces, .context = &forces};
  gx_transfer_scatter_force(&setting->points.weights, T, loaded ? body : NULL, expected);
  gx_transfer_scatter(&setting->points.weights, m[0], body, NULL, expected);
  gx_lattice_run(setting->lattice, &pass);
  gx_lattice_scatter(setting->lattice, m[0], body, force);
  pass.sum = team;
  gx_lattice_run(setting->team_lattice, &pass);
  gx_lattice_scatter(setting->team_lattice, m[0], body, team);
  double met = pow(3, dim) * (setting->points.weights.support + 1); /* particles that a node sums, weights below 1 */
  compare(setting, "force", dim, nodes, force, team, expected, met * 3 * setting->points.grid.axis[dim - 1].cells);
  double **nodal[] = {force, team, expected};
  for (int i = 0; i < 3; i++) fields_free(nodal[i], dim);
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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(factored_sums_are_the_general_ones),
      cmocka_unit_test(other_particles_do_not_factor),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
