/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers at the ends of their ranges: a case ends well with numbers, or says what is wrong, in every column of its row. */
#include <float.h>

#include <gsl/gsl_errno.h>

#include "case_of.h"

/* A result that ended well has all errors that its problem knows; any other says why and has none in its row. */
static void check_result(const struct gx_case *one, const struct gx_result *result, const char *what)
{
  const bool ok = result->outcome.status == GX_OK;
  const struct gx_problem *problem = gx_problem_find(one->value[GX_PROBLEM_NAME].text);
  static const char *const columns[] = {"result.displacement.final.inf", "result.velocity.max.rms", "result.stress.max.inf",
                                        "result.energy.defect"};
  struct gx_table *table = gx_study_table_begin(1, false);
  assert_int_equal(gx_study_table_fill(table, 0, one, result, false), 0);
  for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
    const struct gx_value value = gx_table_get(table, 0, (size_t)gx_table_find(table, columns[i]));
    const bool known = ok && (problem->exact || i == 3) && (problem->material->piola || i < 2);
    CHECK((value.type == GX_REAL) == known, "%s: %s is %s, status %s", what, columns[i],
          value.type == GX_REAL ? "there" : "missing", gx_status_name(result->outcome.status));
  }
  CHECK(ok || *result->outcome.reason, "%s: %s, and does not say why", what, gx_status_name(result->outcome.status));
  gx_table_free(table);
}

static enum gx_status status_of(const struct gx_case *one, const char *what)
{
  struct gx_result result = gx_case_run(one);
  check_result(one, &result, what);
  gx_case_free(&result);
  return result.outcome.status;
}

/* Without amplitude nothing moves, on one cell and with one particle too, whatever the method; or it is refused. */
static void nothing_moves_at_rest(void **state)
{
  (void)state;
  static const char *const problems[] = {"bar-neo-hookean", "bar-linear"};
  int ended_well = 0;
  for (int i = 0; i < 2; i++)
    for (int s = 0; gx_space_family[s]; s++)
      for (int b = 0; gx_basis_family[b] && !gx_space_family[s]->of_problem; b++)
        for (long cells = 1; cells <= 8; cells *= 2)
          for (long per_cell = 1; per_cell <= 2; per_cell++) {
            char what[128];
            struct gx_case one = case_draft("problem.amplitude=0", "time.steps=3");
            case_set(&one, GX_PROBLEM_NAME, problems[i]);
            case_set(&one, GX_METHOD_SPACE, gx_space_family[s]->name);
            case_set(&one, GX_METHOD_BASIS, gx_basis_family[b]->name);
            case_set_integer(&one, GX_MESH_CELLS, cells);
            case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, per_cell);
            gx_parameter_resolve(one.value);
            snprintf(what, sizeof what, "%s %s %s, %ld cells of %ld", problems[i], gx_space_family[s]->name,
                     gx_basis_family[b]->name, cells, per_cell);
            struct gx_result result = gx_case_run(&one);
            check_result(&one, &result, what);
            CHECK(result.outcome.status == GX_OK || result.outcome.status == GX_REFUSED, "%s: %s, %s", what,
                  gx_status_name(result.outcome.status), result.outcome.reason);
            if (result.outcome.status == GX_OK) {
              ended_well++;
              NEAR(result.measured.max_error[GX_DISPLACEMENT][GX_INF], 0, 1e-14);
              NEAR(result.measured.max_error[GX_VELOCITY][GX_INF], 0, 1e-11);
            }
            gx_case_free(&result);
          }
  assert_true(ended_well > 100);
}

/* A box of one cell has a full mass matrix too: GIMP meets four functions a direction there, and three in any other cell. */
static void one_cell_has_a_full_mass_matrix(void **state)
{
  (void)state;
  for (int b = 0; gx_basis_family[b]; b++)
    for (int k = 0; k < 4; k++) {
      struct gx_case one = case_draft("problem.name=free-flight", "problem.dimension=2", "problem.velocity=0 0", "mesh.cells=1",
                                      "method.mass=consistent", "body.size=1 1", "time.dt=1e-3", "time.steps=2");
      case_set(&one, GX_PROBLEM_BOUNDARY, k & 1 ? "free" : "periodic");
      case_set(&one, GX_METHOD_SPACE, k & 2 && !gx_basis_family[b]->deforms ? "moving-mesh" : "standard");
      case_set(&one, GX_METHOD_BASIS, gx_basis_family[b]->name);
      gx_parameter_resolve(one.value);
      CHECK(status_of(&one, gx_basis_family[b]->name) == GX_OK, "%s", gx_basis_family[b]->name);
    }
}

/* F = 1 - 2 pi m A at least: it reaches 0 at A = 1/(2 pi m). */
static void exact_solutions_that_tangle_are_refused(void **state)
{
  (void)state;
  static const char *const names[] = {"bar-neo-hookean", "bar-linear", "axis-aligned"};
  for (int i = 0; i < 3; i++)
    for (long mode = 1; mode <= (i == 1 ? 3 : 1); mode++)
      for (int k = 0; k < 4; k++) {
        const double limit = 1 / (2 * M_PI * (double)mode),
                     amplitude[] = {limit * (1 - 1e-9), limit * (1 + 1e-15), 2 * limit, DBL_MAX};
        struct gx_case one = case_draft("mesh.cells=8", "time.dt=1e-9", "time.steps=1");
        case_set(&one, GX_PROBLEM_NAME, names[i]);
        case_set_integer(&one, GX_PROBLEM_MODE, mode);
        case_set_real(&one, GX_PROBLEM_AMPLITUDE, amplitude[k]);
        gx_parameter_resolve(one.value);
        struct gx_result result = gx_case_run(&one);
        check_result(&one, &result, names[i]);
        CHECK((result.outcome.status == GX_REFUSED) == (k > 0), "%s at %.17g: %s", names[i], amplitude[k],
              gx_status_name(result.outcome.status));
        if (k > 0) assert_non_null(strstr(result.outcome.reason, "the exact solution itself tangles"));
        char figures[64];
        snprintf(figures, sizeof figures, "least F is -1; amplitude must stay below %.6g", limit);
        if (k == 2) assert_non_null(strstr(result.outcome.reason, figures));
        gx_case_free(&result);
      }
}

/* What overflows is said to. */
static void overflow_is_no_result(void **state)
{
  (void)state;
  static const char *const cases[][6] = {
      {"problem.name=free-flight", "problem.velocity=1e200", "time.dt=1e-205", "time.steps=5"},
      {"problem.name=free-flight", "problem.velocity=1e308", "time.dt=1e3", "time.steps=5"},
      {"problem.name=spinning-block", "problem.dimension=2", "problem.spin=1e200", "time.dt=1e-210", "time.steps=3"},
      {"problem.name=cantilever", "problem.dimension=2", "problem.gravity=1e300", "time.dt=1e-3", "time.steps=3"},
      {"problem.name=bar-neo-hookean", "time.dt=1e300", "time.end=1e300"},
      {"problem.name=bar-linear", "time.start=1e300", "time.dt=1e299", "time.steps=2"},
      {"problem.name=oscillator", "problem.interpolation_error=1e300", "time.dt=1e-3", "time.steps=5"},
      {"problem.name=oscillator", "problem.interpolation_error=1e308", "time.dt=1e-3", "time.steps=5"},
      {"problem.name=quadrature-model", "problem.jump=-1e308", "time.dt=1e-3", "time.steps=5"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    struct gx_case one = case_from(cases[i]);
    const enum gx_status status = status_of(&one, cases[i][1]);
    CHECK(status == GX_UNSTABLE || status == GX_LEFT_DOMAIN, "%s %s: %s", cases[i][0], cases[i][1], gx_status_name(status));
  }
}

/* The smallest and the largest material there may be gives the numbers of any other, scaled. */
static void units_do_not_matter(void **state)
{
  (void)state;
  static const char *const extreme[] = {"1e-100", "1", "1e100"};
  double error[9];
  for (int i = 0; i < 9; i++) {
    struct gx_case one = case_draft("problem.name=bar-linear", "mesh.cells=8", "time.steps=4");
    case_set(&one, GX_PROBLEM_MODULUS, extreme[i / 3]);
    case_set(&one, GX_PROBLEM_DENSITY, extreme[i % 3]);
    gx_parameter_resolve(one.value);
    struct gx_result result = case_result(&one);
    check_result(&one, &result, extreme[i / 3]);
    error[i] = result.measured.max_error[GX_DISPLACEMENT][GX_RMS];
    CHECK(error[i] > 0 && fabs(error[i] - error[0]) < 1e-12 * error[0], "%.17g, not %.17g", error[i], error[0]);
  }
}

/* Particles on cell edges and on both ends of the domain, all at one place, all in one cell, far from most nodes, and of hardly any mass. */
static void particles_may_be_anywhere(void **state)
{
  (void)state;
  static const struct {
    size_t n;
    double X[4], V0[4];
  } lists[] = {
      {2, {0, 1}, {0.1, 0.1}},
      {3, {0.25, 0.5, 0.75}, {0.1, 0.1, 0.1}},
      {3, {0.3, 0.3, 0.3}, {0.1, 0.1, 0.1}},
      {4, {0.26, 0.27, 0.28, 0.29}, {0.1, 0.1, 0.1, 0.1}},
      {1, {1}, {1e-30}},
      {2, {0.125, 0.625}, {1e-30, 0.1}},
  };
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
    for (int b = 0; gx_basis_family[b]; b++)
      for (int consistent = 0; consistent < 2; consistent++) {
        double X[4], V0[4];
        memcpy(X, lists[i].X, sizeof X);
        memcpy(V0, lists[i].V0, sizeof V0);
        const struct gx_points points = {.dim = 1, .n = lists[i].n, .X = {X}, .V0 = V0};
        char what[64];
        struct gx_case one = case_draft("problem.name=free-flight", "body.shape=points", "mesh.cells=4", "problem.velocity=0.5",
                                        "time.dt=1e-3", "time.steps=4");
        case_set(&one, GX_METHOD_BASIS, gx_basis_family[b]->name);
        case_set(&one, GX_METHOD_MASS, consistent ? "consistent" : "lumped");
        gx_parameter_resolve(one.value);
        one.points = &points;
        snprintf(what, sizeof what, "list %zu, %s, %s", i, gx_basis_family[b]->name, consistent ? "consistent" : "lumped");
        struct gx_result result = gx_case_run(&one);
        check_result(&one, &result, what);
        if (consistent)
          CHECK(result.outcome.status == GX_OK || result.outcome.status == GX_SINGULAR, "%s: %s", what, result.outcome.reason);
        else
          CHECK(result.outcome.status == GX_OK && result.measured.max_error[GX_VELOCITY][GX_INF] < 1e-15 &&
                    result.measured.max_error[GX_DISPLACEMENT][GX_INF] < 1e-15,
                "%s: %s, errors %g, %g", what, result.outcome.reason, result.measured.max_error[GX_DISPLACEMENT][GX_INF],
                result.measured.max_error[GX_VELOCITY][GX_INF]);
        gx_case_free(&result);
      }
}

/* GIMP's functions would not add up to 1. */
static void domains_wider_than_a_cell_are_refused(void **state)
{
  (void)state;
  double X[] = {0.2, 0.6}, V0[] = {0.25, 0.2501};
  struct gx_points points = {.dim = 1, .n = 1, .X = {X}, .V0 = V0};
  for (points.n = 1; points.n <= 2; points.n++) {
    struct gx_case one = case_of("problem.name=free-flight", "body.shape=points", "mesh.cells=4", "method.basis=ugimp",
                                 "time.dt=1e-3", "time.steps=2");
    one.points = &points;
    struct gx_result result = gx_case_run(&one);
    assert_int_equal(result.outcome.status, points.n == 1 ? GX_OK : GX_REFUSED);
    assert_int_equal(result.outcome.particle, points.n == 1 ? -1 : 1);
    gx_case_free(&result);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_moves_at_rest),
      cmocka_unit_test(exact_solutions_that_tangle_are_refused),
      cmocka_unit_test(overflow_is_no_result),
      cmocka_unit_test(units_do_not_matter),
      cmocka_unit_test(one_cell_has_a_full_mass_matrix),
      cmocka_unit_test(particles_may_be_anywhere),
      cmocka_unit_test(domains_wider_than_a_cell_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
