/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the fields reconstructed from particles take over from them: values, symmetry at fixed ends, and how many particles and of
 * which kind they need. Momentum, mirrors, translations and order of particles are seen to in test_symmetries. */
#include <gsl/gsl_errno.h>

#include "check.h"
#include "rig.h"
#include "spaces/least_squares.h"
#include "spaces/mesh.h"
#include "spaces/spline_fit.h"

enum { N = 24 };

/* Uneven, in no order: particle p is in place 7 p of N. */
static void scatter_particles(double *X)
{
  uint64_t seed = 5;
  for (int p = 0; p < N; p++) X[7 * p % N] = (p + check_random(&seed, 0.1, 0.9)) / N;
}

static struct gx_fit *fit_through(double *X, int degree, bool periodic, size_t points, const double *point)
{
  struct gx_outcome outcome;
  struct gx_fit *fit = NULL;
  assert_int_equal(gx_spline_fit_create(&fit, degree, periodic, N, X, points, point, &outcome), GX_OK);
  assert_int_equal(fit->kind->place(fit, (const double *[]){X}), GX_OK);
  return fit;
}

/* At the particles the field has their values; an uniform one is uniform everywhere. */
static void fields_pass_through_the_particles(void **state)
{
  (void)state;
  double X[N], sorted[N], value[N], one[N], out[N], *in = value, *to = out;
  scatter_particles(X);
  for (int p = 0; p < N; p++) {
    sorted[p] = X[7 * p % N];
    value[7 * p % N] = sin(9 * sorted[p]) + p % 3;
    one[p] = 1.5;
  }
  for (int periodic = 0; periodic < 2; periodic++)
    for (int degree = 1; degree <= GX_MAX_DEGREE; degree++)
      for (int odd = 0; odd < 2; odd++) {
        struct gx_fit *fit = fit_through(X, degree, periodic, N, sorted);
        in = value;
        fit->kind->take(fit, 1, odd, &in, &to);
        for (int p = 0; p < N; p++) NEAR(out[p], value[7 * p % N], 1e-10);
        in = one;
        fit->kind->take(fit, 1, false, &in, &to);
        for (int p = 0; p < N; p++) NEAR(out[p], 1.5, 1e-13);
        fit->kind->free(fit);
      }
}

/* Fields that are odd and even at the ends, of 24 particles a wave: degree 5 errs by (2 pi / 24)^6 / 100 or so. */
static void ends_are_respected(void **state)
{
  (void)state;
  const double at[4] = {0, 0.01, 0.5, 1};
  double X[N], odd[N], even[N], out[4], *in = odd, *to = out;
  for (int p = 0; p < N; p++) {
    X[p] = (p + 0.5) / N;
    odd[p] = sin(2 * M_PI * X[p]);
    even[p] = cos(2 * M_PI * X[p]);
  }
  struct gx_fit *fit = fit_through(X, 3, false, 4, at);
  fit->kind->take(fit, 1, true, &in, &to);
  NEAR(out[0], 0, 1e-15);
  NEAR(out[3], 0, 1e-15);
  for (int i = 0; i < 4; i++) NEAR(out[i], sin(2 * M_PI * at[i]), 2e-6);
  in = even;
  fit->kind->take(fit, 1, false, &in, &to);
  for (int i = 0; i < 4; i++) NEAR(out[i], cos(2 * M_PI * at[i]), 2e-6);
  fit->kind->free(fit);
}

/* Mass of the nodes through a deformed bar: right to the order of the quadrature, 2 (degree + 1). */
static void mass_of_the_nodes_converges(void **state)
{
  (void)state;
  static const char *const cells[] = {"8", "16"};
  for (int fixed = 0; fixed < 2; fixed++) {
    double error[2];
    for (int k = 0; k < 2; k++) {
      struct gx_case one = case_draft("method.quadrature=reconstructed", "method.degree=2");
      case_set(&one, GX_PROBLEM_BOUNDARY, fixed ? "fixed" : "periodic");
      case_set(&one, GX_MESH_CELLS, cells[k]);
      gx_parameter_resolve(one.value);
      struct rig rig;
      rig_build(&rig, &one, NULL, NULL, NULL);
      const struct gx_mesh *mesh = (const struct gx_mesh *)rig.simulation.space;
      double mass = 0;
      for (size_t i = 0; i < mesh->grid.stored; i++) mass += mesh->mass[i];
      error[k] = fabs(mass - 1);
      rig_free(&rig);
    }
    CHECK(error[0] < 1e-4 && error[1] < error[0] / 16, "%s: total mass off by %g, %g", fixed ? "fixed" : "periodic", error[0],
          error[1]);
  }
}

/* Polynomials up to the degree of the fit, at particles in no order, up to the walls. */
static void polynomials_are_reproduced(void **state)
{
  (void)state;
  for (int dim = 1; dim <= GX_MAX_DIM; dim++)
    for (int degree = 1; degree <= 4; degree++) {
      struct gx_grid grid = {.dim = dim};
      int cells[GX_MAX_DIM] = {3, 4, 3};
      for (int d = 0; d < dim; d++) grid.axis[d] = (struct gx_axis){.cells = cells[d], .h = 1.0 / cells[d]};
      struct gx_particles *points = gx_particles_points(dim, cells, 2);
      struct gx_particles *particles = gx_particles_create(dim, cells, 4, GX_LAYOUT_UNIFORM, 1);
      double *value = malloc(particles->n * sizeof *value), *out = malloc(points->n * sizeof *out);
      const double *x[GX_MAX_DIM] = {particles->X[0], particles->X[1], particles->X[2]};
      uint64_t seed = 9;
      for (size_t p = 0; p < particles->n; p++) {
        double sum = 0;
        for (int d = 0; d < dim; d++) {
          particles->X[d][p] += check_random(&seed, -0.1, 0.1) / cells[d];
          sum += (d + 1) * particles->X[d][p];
        }
        value[p] = pow(sum - 1, degree);
      }
      struct gx_outcome outcome;
      struct gx_fit *fit = NULL;
      assert_int_equal(gx_least_squares_create(&fit, &grid, degree, 2, points, particles->n, &outcome), GX_OK);
      assert_int_equal(fit->kind->place(fit, x), GX_OK);
      assert_int_equal(fit->left_cells, 0);
      fit->kind->take(fit, 1, false, &value, &out);
      for (size_t q = 0; q < points->n; q++) {
        double sum = 0;
        for (int d = 0; d < dim; d++) sum += (d + 1) * points->X[d][q];
        NEAR(out[q], pow(sum - 1, degree), 1e-8);
      }
      fit->kind->free(fit);
      free(value);
      free(out);
      gx_particles_free(points);
      gx_particles_free(particles);
    }
}

/* A disk in flight: cells at its edge are left to sums over their particles and counted; mass and momentum stay, and no stress arises
 * where it cannot. */
static void bodies_leave_their_edge_to_the_particles(void **state)
{
  (void)state;
  struct gx_case one = case_draft("problem.name=free-flight", "problem.dimension=2", "mesh.cells=12", "mesh.particles_per_cell=3",
                                  "method.quadrature=reconstructed", "method.clock=euler-stress-first", "time.steps=5");
  gx_parameter_resolve(one.value);
  struct rig rig;
  rig_build(&rig, &one, NULL, NULL, NULL);
  const struct gx_particles *particles = rig.simulation.particles;
  double before[2] = {0}, size = 0, worst = 0;
  for (size_t p = 0; p < particles->n; p++)
    for (int d = 0; d < 2; d++) {
      before[d] += particles->m[p] * particles->v[d][p];
      size += particles->m[p] * fabs(particles->v[d][p]);
    }
  rig_run(&rig, 60);
  for (int d = 0; d < 2; d++) {
    double after = 0;
    for (size_t p = 0; p < particles->n; p++) after += particles->m[p] * particles->v[d][p];
    NEAR(after, before[d], 1e-13 * size);
  }
  for (int k = 0; k < 4; k++)
    for (size_t p = 0; p < particles->n; p++) worst = fmax(worst, fabs(particles->F[k][p] - (k % 3 == 0)));
  NEAR(worst, 0, 1e-12);
  rig_free(&rig);
  struct gx_result result = case_result(&one);
  assert_true(result.left_cells > 0 && result.left_cells < 144);
  case_set(&one, GX_METHOD_MASS, "consistent");
  result = gx_case_run(&one);
  gx_case_free(&result);
  assert_int_equal(result.outcome.status, GX_SINGULAR);
  assert_non_null(strstr(result.outcome.reason, "too few particles around"));
}

static enum gx_status status_of(const char *const *set, const char *reason)
{
  struct gx_case one = case_begin(set);
  gx_parameter_resolve(one.value);
  struct gx_result result = gx_case_run(&one);
  gx_case_free(&result);
  CHECK(strstr(result.outcome.reason, reason), "%s", result.outcome.reason);
  return result.outcome.status;
}

#define STATUS(reason, ...) status_of((const char *const[]){"method.quadrature=reconstructed", __VA_ARGS__, NULL}, reason)

static void what_it_cannot_do_is_refused_with_the_reason(void **state)
{
  (void)state;
  assert_int_equal(STATUS("need 6 particles or more", "mesh.cells=4", "mesh.particles_per_cell=1", "method.degree=3"),
                   GX_REFUSED);
  assert_int_equal(
      STATUS("degree 5 at most", "problem.name=axis-aligned", "problem.dimension=2", "mesh.cells=6", "method.degree=5"),
      GX_REFUSED);
  assert_int_equal(STATUS("met or passed", "problem.name=bar-linear", "problem.amplitude=0.15", "problem.modulus=16",
                          "method.position=particle", "mesh.cells=8", "time.periods=20"),
                   GX_TANGLED);
}

/* A density that falls off within a cell is fitted by values below zero, which is no mass of a node. */
static void negative_mass_is_not_taken_for_none(void **state)
{
  (void)state;
  static const char *const dimensions[] = {"problem.dimension=1", "problem.dimension=2"}, *const masses[] = {"lumped",
                                                                                                             "consistent"};
  for (int k = 0; k < 8; k++) {
    const int heavy = k & 1, full = k >> 1 & 1;
    struct gx_case one = case_draft("problem.name=axis-aligned", dimensions[k >> 2], "mesh.cells=4", "mesh.particles_per_cell=2",
                                    "method.quadrature=reconstructed", "time.steps=1");
    case_set(&one, GX_METHOD_MASS, masses[full]);
    gx_parameter_resolve(one.value);
    struct gx_simulation simulation = {0};
    struct gx_outcome outcome = {.particle = -1};
    assert_int_equal(gx_simulation_plan(&simulation, &one, &outcome), GX_OK);
    assert_int_equal(gx_simulation_lay_out(&simulation, &outcome), GX_OK);
    assert_int_equal(gx_simulation_pose(&simulation, &outcome), GX_OK);
    if (heavy) simulation.particles->m[0] *= 1e3;
    assert_int_equal(gx_simulation_open(&simulation, &outcome), heavy ? GX_SINGULAR : GX_OK);
    if (heavy) CHECK(strstr(outcome.reason, full ? "not positive definite" : "gives a node the mass -"), "%s", outcome.reason);
    gx_simulation_free(&simulation);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fields_pass_through_the_particles),
      cmocka_unit_test(ends_are_respected),
      cmocka_unit_test(mass_of_the_nodes_converges),
      cmocka_unit_test(polynomials_are_reproduced),
      cmocka_unit_test(bodies_leave_their_edge_to_the_particles),
      cmocka_unit_test(what_it_cannot_do_is_refused_with_the_reason),
      cmocka_unit_test(negative_mass_is_not_taken_for_none),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
