/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error budget: terms add up to the error of a step, fall with the orders that theory gives them, and the one that dominates is
 * the one whose removal helps. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "measures/integral.h"
#include "rig.h"

static double entry(const struct gx_case *one, enum gx_budget_entry which)
{
  struct gx_result result = gx_case_run(one);
  gx_case_free(&result);
  return result.budget.value[which];
}

/* berzins2022 §12.1: the bar with the papers' E = 64, h = 0.01, two particles a cell. */
static struct gx_case papers_bar(const char *clock, const char *particles, const char *mass)
{
  struct gx_case one =
      case_draft("problem.name=bar-linear", "problem.modulus=16", "problem.amplitude=0.05", "mesh.cells=100",
                 "method.basis=cpgimp", "time.dt=1e-4", "time.periods=0.5", "output.measures=final", "output.budget=50");
  case_set(&one, GX_METHOD_CLOCK, clock);
  case_set(&one, GX_MESH_PARTICLES_PER_CELL, particles);
  case_set(&one, GX_METHOD_MASS, mass);
  gx_parameter_resolve(one.value);
  return one;
}

static void the_sum_of_terms_is_the_error_of_a_step(void **state)
{
  (void)state;
  static const char *const clocks[] = {"euler-stress-last",
                                       "euler-stress-first",
                                       "central-difference",
                                       "stormer-verlet",
                                       "rk4",
                                       "optimised-verlet-position",
                                       "rkn4"};
  for (size_t k = 0; k < sizeof clocks / sizeof *clocks; k++) {
    struct gx_case one = papers_bar(clocks[k], "2", "lumped");
    struct gx_result result = case_result(&one);
    gx_case_free(&result);
    const double *value = result.budget.value;
    CLOSE(value[GX_BUDGET_VELOCITY_SUM], value[GX_BUDGET_VELOCITY_STEP], 0.1);
    CLOSE(value[GX_BUDGET_DISPLACEMENT_SUM], value[GX_BUDGET_DISPLACEMENT_STEP], 0.1);
    bool single = k == 0 || k == 2; /* one acceleration, from the exact state: nothing is left over */
    if (single)
      CHECK(value[GX_BUDGET_VELOCITY_REST] < 1e-10 * value[GX_BUDGET_VELOCITY_STEP], "%g", value[GX_BUDGET_VELOCITY_REST]);
  }
}

/* The error of the step, taken without the budget. */
static void the_step_is_that_of_the_method(void **state)
{
  (void)state;
  static const char *const spaces[] = {"standard", "moving-mesh"};
  static const char *const clocks[] = {"central-difference", "rk4"};
  for (int k = 0; k < 4; k++) {
    struct gx_case one = case_draft("mesh.cells=20", "mesh.particles_per_cell=3", "time.dt=1e-4", "time.start=0.0013",
                                    "time.steps=1", "output.budget=1");
    case_set(&one, GX_METHOD_SPACE, spaces[k & 1]);
    case_set(&one, GX_METHOD_CLOCK, clocks[k >> 1]);
    gx_parameter_resolve(one.value);
    struct rig rig;
    rig_build(&rig, &one, NULL, NULL, NULL);
    const struct gx_particles *particles = rig.simulation.particles;
    const struct gx_posed *posed = rig.simulation.posed;
    size_t n = particles->n;
    double before[60], after[60], v0[60], u0[60], square = 0, t = 0.0013 - (k < 2 ? 0.5e-4 : 0);
    if (rig.simulation.kind->settle) rig.simulation.kind->settle(rig.simulation.space);
    memcpy(v0, particles->v[0], sizeof v0);
    memcpy(u0, particles->u[0], sizeof u0);
    assert_int_equal(n, 60);
    rig_run(&rig, 1);
    posed->problem->exact(posed, t, NULL, (double *[]){before}, NULL, NULL);
    posed->problem->exact(posed, t + 1e-4, NULL, (double *[]){after}, NULL, NULL);
    for (size_t p = 0; p < n; p++) square += pow(particles->v[0][p] - v0[p] - (after[p] - before[p]), 2);
    CLOSE(entry(&one, GX_BUDGET_VELOCITY_STEP), sqrt(square / (double)n), 1e-9);
    posed->problem->exact(posed, 0.0013, (double *[]){before}, NULL, NULL, NULL);
    posed->problem->exact(posed, 0.0014, (double *[]){after}, NULL, NULL, NULL);
    square = 0;
    for (size_t p = 0; p < n; p++) square += pow(particles->u[0][p] - u0[p] - (after[p] - before[p]), 2);
    CLOSE(entry(&one, GX_BUDGET_DISPLACEMENT_STEP), sqrt(square / (double)n), 1e-7);
    rig_free(&rig);
  }
}

/* In velocity the quadrature of forces dominates, and more particles remove it; in displacement the lumped mass, beside a clock that
 * adds nothing, and the consistent one removes that. */
static void what_dominates_is_what_to_remove(void **state)
{
  (void)state;
  struct gx_case few = papers_bar("rk4", "2", "lumped"), many = papers_bar("rk4", "8", "lumped");
  struct gx_case consistent = papers_bar("rk4", "2", "consistent"), euler = papers_bar("euler-stress-last", "2", "lumped");
  struct gx_result result = case_result(&few), other = case_result(&many), full = case_result(&consistent);
  struct gx_result first = case_result(&euler);
  const double *value = result.budget.value;
  enum gx_budget_entry next;
  assert_int_equal(gx_budget_dominant(&result.budget, GX_BUDGET_VELOCITY_STEP, &next), GX_BUDGET_VELOCITY_QUADRATURE);
  assert_int_equal(next, GX_BUDGET_VELOCITY_LUMPING);
  assert_true(other.budget.value[GX_BUDGET_VELOCITY_QUADRATURE] < 0.1 * value[GX_BUDGET_VELOCITY_QUADRATURE]);
  assert_true(other.budget.value[GX_BUDGET_VELOCITY_STEP] < 0.1 * value[GX_BUDGET_VELOCITY_STEP]);
  CLOSE(other.budget.value[GX_BUDGET_VELOCITY_LUMPING], value[GX_BUDGET_VELOCITY_LUMPING], 0.01);
  assert_int_equal(gx_budget_dominant(&result.budget, GX_BUDGET_DISPLACEMENT_STEP, &next), GX_BUDGET_DISPLACEMENT_LUMPING);
  assert_int_equal(next, GX_BUDGET_DISPLACEMENT_INTERPOLATION);
  NEAR(full.budget.value[GX_BUDGET_DISPLACEMENT_LUMPING], 0, 0);
  assert_true(full.budget.value[GX_BUDGET_DISPLACEMENT_STEP] < 0.2 * value[GX_BUDGET_DISPLACEMENT_STEP]);
  /* over the half period it is the displacement's term that decides */
  double error = result.measured.last.error[GX_DISPLACEMENT][GX_RMS];
  assert_true(full.measured.last.error[GX_DISPLACEMENT][GX_RMS] < 0.2 * error);
  assert_true(other.measured.last.error[GX_DISPLACEMENT][GX_RMS] > 0.8 * error);
  assert_int_equal(gx_budget_dominant(&first.budget, GX_BUDGET_DISPLACEMENT_STEP, &next), GX_BUDGET_DISPLACEMENT_TIME);
  assert_int_equal(next, GX_BUDGET_DISPLACEMENT_LUMPING);
}

/* The jump of the budget's step is that of a run of that step; unasked, there is none. */
static void jumps_are_those_of_the_step(void **state)
{
  (void)state;
  struct gx_case one = case_of("mesh.cells=40", "method.basis=linear", "time.dt=2e-4", "time.start=0.002", "time.steps=1",
                               "output.budget=1", "output.jumps=yes");
  struct gx_result result = case_result(&one);
  assert_true(result.measured.last.jump[GX_RMS] > 1e-7);
  CLOSE(result.budget.value[GX_BUDGET_DISPLACEMENT_JUMP], result.measured.last.jump[GX_RMS], 1e-12);
  one.value[GX_OUTPUT_JUMPS].type = GX_NULL;
  assert_true(isnan(entry(&one, GX_BUDGET_DISPLACEMENT_JUMP)));
}

static struct gx_case one_step(const char *space, const char *degree, const char *cells, const char *particles, const char *clock,
                               const char *dt)
{
  struct gx_case one = case_draft("time.start=0.002122", "time.steps=1", "output.budget=1", "output.measures=final");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_METHOD_DEGREE, degree);
  case_set(&one, GX_MESH_CELLS, cells);
  case_set(&one, GX_MESH_PARTICLES_PER_CELL, particles);
  case_set(&one, GX_METHOD_CLOCK, clock);
  case_set(&one, GX_TIME_DT, dt);
  gx_parameter_resolve(one.value);
  return one;
}

static void check_order(struct gx_case coarse, struct gx_case fine, double ratio, enum gx_budget_entry which, double order)
{
  double a = entry(&coarse, which), b = entry(&fine, which), seen = log(a / b) / log(ratio);
  CHECK(fabs(seen - order) < 0.25, "%s: order %g, not %g (%g, %g)", gx_budget_columns[which].name, seen, order, a, b);
}

static void terms_fall_with_the_cells(void **state)
{
  (void)state;
  static const char *const degrees[] = {"1", "2", "3"};
  for (int p = 1; p <= 3; p++) {
    const char *degree = degrees[p - 1];
    struct gx_case coarse = one_step("moving-mesh", degree, "32", "4", "central-difference", "1e-5");
    struct gx_case fine = one_step("moving-mesh", degree, "128", "4", "central-difference", "1e-5");
    check_order(coarse, fine, 4, GX_BUDGET_VELOCITY_INTERPOLATION, p + 1);
    check_order(coarse, fine, 4, GX_BUDGET_DISPLACEMENT_INTERPOLATION, p + 1);
    check_order(coarse, fine, 4, GX_BUDGET_INF_VELOCITY, p + 1); /* berzins2022 eq. 63 */
    check_order(coarse, fine, 4, GX_BUDGET_INF_GRADIENT, p);     /* eq. 64 */
    check_order(coarse, fine, 4, GX_BUDGET_VELOCITY_LUMPING, 2);
    check_order(coarse, fine, 4, GX_BUDGET_DISPLACEMENT_LUMPING, 2);
    check_order(coarse, fine, 4, GX_BUDGET_VELOCITY_QUADRATURE,
                p % 2 ? p + 1 : p);                          /* the midpoint rule over kinks at cell edges */
    check_order(coarse, fine, 4, GX_BUDGET_L2_PROJECTED, 2); /* steffen2010 eq. 121 */
  }
}

/* steffen2010 eqs 94, 95 over a nodal mass: alpha/h with hats, alpha^2/h with quadratic splines, alpha the inverse of the particles a
 * cell. */
static void quadrature_falls_with_the_particles(void **state)
{
  (void)state;
  static const char *const degrees[] = {"1", "2"};
  for (int p = 1; p <= 2; p++) {
    const char *degree = degrees[p - 1];
    struct gx_case few = one_step("standard", degree, "64", "4", "central-difference", "1e-5");
    struct gx_case many = one_step("standard", degree, "64", "32", "central-difference", "1e-5");
    struct gx_case fine = one_step("standard", degree, "512", "4", "central-difference", "1e-5");
    check_order(few, many, 8, GX_BUDGET_VELOCITY_QUADRATURE, p);
    check_order(few, fine, 8, GX_BUDGET_VELOCITY_QUADRATURE, -1);
    check_order(few, fine, 8, GX_BUDGET_VELOCITY_LUMPING, 2);
    check_order(few, fine, 8, GX_BUDGET_VELOCITY_INTERPOLATION, p + 1);
  }
}

/* The clock's quadrature of exact accelerations: one order more than the clock's own; of the velocity at half steps likewise. */
static void time_falls_with_the_step(void **state)
{
  (void)state;
  static const struct {
    const char *clock;
    double velocity, displacement;
  } rows[] = {{"euler-stress-last", 2, 2}, {"central-difference", 3, 3}, {"stormer-verlet", 3, 3}, {"rkn3", 4, 4}, {"rk4", 5, 5}};
  for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
    struct gx_case coarse = one_step("standard", "2", "8", "4", rows[k].clock, "8e-4");
    struct gx_case fine = one_step("standard", "2", "8", "4", rows[k].clock, "4e-4");
    check_order(coarse, fine, 2, GX_BUDGET_VELOCITY_TIME, rows[k].velocity);
    check_order(coarse, fine, 2, GX_BUDGET_L2_TIME, rows[k].velocity);
    check_order(coarse, fine, 2, GX_BUDGET_DISPLACEMENT_TIME, rows[k].displacement);
  }
}

/* The budget of a wave along x alone is in a plane that of the bar. */
static void a_plane_wave_has_the_budget_of_the_bar(void **state)
{
  (void)state;
  static const char *const spaces[] = {"standard", "moving-mesh"};
  for (int s = 0; s < 2; s++) {
    struct gx_budget_values bar = {0};
    for (int dim = 1; dim <= 2; dim++) {
      struct gx_case one =
          case_draft("problem.name=axis-aligned", "problem.active=x", "mesh.cells=6", "mesh.particles_per_cell=3", "time.dt=1e-4",
                     "time.start=0.001", "time.steps=1", "output.budget=1", "method.clock=rk4");
      case_set(&one, GX_METHOD_SPACE, spaces[s]);
      case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
      gx_parameter_resolve(one.value);
      struct gx_result result = case_result(&one);
      gx_case_free(&result);
      for (int i = 0; i < GX_BUDGET_ENTRIES && dim > 1; i++)
        if (i != GX_BUDGET_DISPLACEMENT_JUMP) NEAR(result.budget.value[i], bar.value[i], 1e-7 * bar.value[i] + 1e-11);
      bar = result.budget;
      assert_true(bar.value[GX_BUDGET_VELOCITY_STEP] > 1e-3);
    }
  }
}

/* Whether the method can be run at all. */
static bool check_budget(const struct gx_case *one, const char *name)
{
  struct gx_case plain = *one;
  plain.value[GX_OUTPUT_BUDGET].type = GX_NULL;
  struct gx_result with = gx_case_run(one), without = gx_case_run(&plain);
  if (with.outcome.status == GX_REFUSED) {                /* cpgimp where the mesh moves; rk4 with PIC */
    assert_int_equal(without.outcome.status, GX_REFUSED); /* not for its budget */
    gx_case_free(&with);
    gx_case_free(&without);
    return false;
  }
  CHECK(with.outcome.status == GX_OK, "%s: %s", name, with.outcome.reason);
  assert_memory_equal(&with.measured, &without.measured, sizeof with.measured); /* it observes */
  const double *value = with.budget.value;
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++)
    if (i != GX_BUDGET_DISPLACEMENT_JUMP) CHECK(value[i] >= 0 && value[i] < 1e3, "%s: %s", name, gx_budget_columns[i].name);
  const int step[] = {GX_BUDGET_VELOCITY_STEP, GX_BUDGET_DISPLACEMENT_STEP};
  const int rest[] = {GX_BUDGET_VELOCITY_REST, GX_BUDGET_DISPLACEMENT_REST};
  for (int k = 0; k < 2; k++) {
    double most = value[step[k] + 1] + value[rest[k]], least = fabs(value[step[k] + 1] - value[rest[k]]);
    double slack = 1e-9 * most;
    CHECK(value[step[k]] <= most + slack && value[step[k]] >= least - slack, "%s: %g is not between %g and %g", name,
          value[step[k]], least, most);
  }
  gx_case_free(&with);
  gx_case_free(&without);
  return true;
}

/* With every clock, basis, mass, way of moving and dimension: it changes nothing, and its sums are those of signed terms. */
static void every_method_has_a_budget(void **state)
{
  (void)state;
  static const char *const spaces[] = {"standard", "moving-mesh"}, *const masses[] = {"lumped", "consistent"};
  for (int k = 0; gx_clock_family[k]; k++)
    for (int b = 0; gx_basis_family[b]; b++) {
      int taken = 0;
      for (int bits = 0; bits < 64; bits++) {
        struct gx_case one = case_draft("problem.name=axis-aligned", "problem.modulus=4", "problem.amplitude=0.02",
                                        "mesh.cells=5", "mesh.particles_per_cell=3", "time.dt=0.002", "time.start=0.1",
                                        "time.steps=2", "output.budget=1", "output.measures=all");
        case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
        case_set(&one, GX_METHOD_BASIS, gx_basis_family[b]->name);
        case_set(&one, GX_METHOD_SPACE, spaces[bits & 1]);
        case_set(&one, GX_METHOD_MASS, masses[bits >> 1 & 1]);
        case_set(&one, GX_METHOD_PROJECTION, bits >> 2 & 1 ? "once" : "each-step");
        case_set(&one, GX_METHOD_POSITION, bits >> 3 & 1 ? "particle" : "nodal");
        case_set(&one, GX_PROBLEM_BOUNDARY, bits >> 4 & 1 ? "fixed" : "periodic");
        if (bits >> 5 & 1) case_set(&one, GX_METHOD_TRANSFER, "pic");
        case_set_integer(&one, GX_PROBLEM_DIMENSION, bits == 0 ? 2 : 1);
        gx_parameter_resolve(one.value);
        taken += check_budget(&one, gx_clock_family[k]->name);
      }
      CHECK(taken >= 8, "%s, %s: %d budgets", gx_clock_family[k]->name, gx_basis_family[b]->name, taken);
    }
}

/* F falls to 0.0004, and Newton's method alone would leap: X + u = x at every point, in any dimension, and no mass is lost. */
static void the_material_is_found_near_tangling(void **state)
{
  (void)state;
  for (int dim = 1; dim <= GX_MAX_DIM; dim++) {
    struct gx_case one = case_draft("problem.name=axis-aligned", "problem.amplitude=0.1591", "mesh.particles_per_cell=1");
    case_set_integer(&one, GX_MESH_CELLS, dim == 1 ? 400 : 4);
    case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
    gx_parameter_resolve(one.value);
    struct rig rig;
    struct gx_integral *integral = NULL;
    rig_build(&rig, &one, NULL, NULL, NULL);
    assert_int_equal(gx_integral_create(&integral, rig.simulation.space, &rig.simulation.space_options, &rig.outcome), GX_OK);
    const struct gx_particles *points = integral->points;
    double *u[GX_MAX_DIM], *block = malloc(points->n * GX_MAX_DIM * sizeof *block), mass = 0;
    for (int d = 0; d < GX_MAX_DIM; d++) u[d] = block + (size_t)d * points->n;
    for (double t = 0; t < 0.011; t += 0.002) {
      assert_int_equal(gx_integral_place(integral, t), GX_OK);
      integral->posed->problem->exact(integral->posed, t, u, NULL, NULL, NULL);
      for (int d = 0; d < dim; d++)
        for (size_t p = 0; p < points->n; p++) NEAR(points->X[d][p] + u[d][p], integral->x[d][p], 1e-12);
      mass = 0;
      for (size_t p = 0; p < points->n; p++) mass += points->m[p];
      if (dim == 1 && t > 0 && t < 0.01) NEAR(mass, 1, 1e-9);
    }
    free(block);
    gx_integral_free(integral);
    rig_free(&rig);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_sum_of_terms_is_the_error_of_a_step),
      cmocka_unit_test(the_step_is_that_of_the_method),
      cmocka_unit_test(jumps_are_those_of_the_step),
      cmocka_unit_test(what_dominates_is_what_to_remove),
      cmocka_unit_test(terms_fall_with_the_cells),
      cmocka_unit_test(quadrature_falls_with_the_particles),
      cmocka_unit_test(time_falls_with_the_step),
      cmocka_unit_test(every_method_has_a_budget),
      cmocka_unit_test(a_plane_wave_has_the_budget_of_the_bar),
      cmocka_unit_test(the_material_is_found_near_tangling),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
