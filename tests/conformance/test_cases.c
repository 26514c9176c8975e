/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whole cases: every space and the equations of every problem with every clock end well, measures do not change what
 * they measure, and a repeated run gives the same bits. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "rig.h"

static void check_finite(const struct gx_result *result, const char *what)
{
  for (int q = 0; q < GX_QUANTITIES; q++)
    for (int k = 0; k < GX_NORMS; k++) {
      double last = result->measured.last.error[q][k], most = result->measured.max_error[q][k];
      CHECK(isfinite(last) && isfinite(most) && last > 0 && most >= last, "%s: error %d %d is %g, largest %g", what, q, k, last,
            most);
    }
  assert_true(isfinite(result->measured.drift) && isfinite(result->measured.max_defect));
  assert_false(result->seconds <= 0 || result->ns_per_particle_step <= 0); /* too few steps to tell: not a number */
}

static void every_method_ends_well(void **state)
{
  (void)state;
  for (int s = 0; gx_space_family[s]; s++)
    for (int k = 0; gx_clock_family[k]; k++)
      for (int b = 0; gx_basis_family[b]; b++)
        for (int consistent = 0; consistent < 2; consistent++)
          for (int p = 0; gx_problem_family[p]; p++) {
            if (gx_space_family[s]->of_problem || !gx_problem_family[p]->waves) continue;
            bool collocation = gx_space_family[s]->collocation;
            if (collocation ? b || consistent : gx_basis_family[b]->deforms && !gx_space_family[s]->fixed_grid) continue;
            struct gx_case one = case_draft("mesh.cells=16", "problem.modulus=100");
            case_set(&one, GX_TIME_CFL, collocation ? "0.05" : "0.2"); /* particles are four times as dense as nodes */
            case_set(&one, GX_PROBLEM_NAME, gx_problem_family[p]->name);
            case_set(&one, GX_METHOD_SPACE, gx_space_family[s]->name);
            case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
            case_set(&one, GX_METHOD_BASIS, gx_basis_family[b]->name);
            case_set(&one, GX_METHOD_MASS, consistent ? "consistent" : "lumped");
            gx_parameter_resolve(one.value);
            struct gx_result result = gx_case_run(&one);
            char what[160];
            snprintf(what, sizeof what, "%s %s %s %s mass %d", gx_problem_family[p]->name, gx_space_family[s]->name,
                     gx_clock_family[k]->name, gx_basis_family[b]->name, consistent);
            CHECK(result.outcome.status == GX_OK, "%s: %s %s", what, gx_status_name(result.outcome.status),
                  result.outcome.reason);
            check_finite(&result, what);
            CHECK(result.measured.max_error[GX_DISPLACEMENT][GX_INF] < 0.05, "%s: as wrong as the wave is high", what);
            gx_case_free(&result);
          }
}

static void check_levels(struct gx_case one);
static void check_repetition(struct gx_case one);

/* The problems that bring equations of their own; a step is a hundredth of their motion. */
static void own_equations_end_well(void **state)
{
  (void)state;
  for (int p = 0; gx_problem_family[p]; p++)
    for (int k = 0; gx_clock_family[k]; k++) {
      const struct gx_problem *problem = gx_problem_family[p];
      if (!problem->space) continue;
      struct gx_case one = case_draft("problem.modulus=1");
      case_set(&one, GX_PROBLEM_NAME, problem->name);
      case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
      case_set(&one, GX_TIME_DT, problem->cycles > 0 ? "0.02" : "0.004");
      gx_parameter_resolve(one.value);
      struct gx_result result = case_result(&one);
      for (int q = 0; q < GX_STRESS; q++) {
        double last = result.measured.last.error[q][GX_INF], most = result.measured.max_error[q][GX_INF];
        CHECK(last > 0 && most >= last && most < 0.5 * M_PI, "%s %s: error %d is %g, largest %g", problem->name,
              gx_clock_family[k]->name, q, last, most);
      }
      assert_int_equal(isfinite(result.measured.max_error[GX_STRESS][GX_INF]), problem->material->piola != NULL);
      assert_int_equal(isfinite(result.measured.drift), problem->cycles > 0);
      assert_int_equal(isfinite(result.stable_dt), problem->cycles > 0);
      check_levels(one);
      check_repetition(one);
    }
}

/* Every space on every clock. */
static void each_method(void (*check)(struct gx_case one))
{
  for (int s = 0; gx_space_family[s]; s++)
    for (int k = 0; gx_clock_family[k]; k++) {
      if (gx_space_family[s]->of_problem) continue;
      struct gx_case one = case_draft("mesh.cells=16", "method.degree=3", "time.periods=0.5");
      case_set(&one, GX_METHOD_SPACE, gx_space_family[s]->name);
      case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
      if (gx_space_family[s]->collocation) case_set(&one, GX_TIME_CFL, "0.05");
      gx_parameter_resolve(one.value);
      check(one);
    }
}

static void check_levels(struct gx_case one)
{
  struct gx_result all = case_result(&one);
  case_set(&one, GX_OUTPUT_MEASURES, "max");
  struct gx_result most = case_result(&one);
  case_set(&one, GX_OUTPUT_MEASURES, "final");
  struct gx_result last = case_result(&one);
  assert_memory_equal(all.measured.last.error, most.measured.last.error, sizeof all.measured.last.error);
  assert_memory_equal(all.measured.last.error, last.measured.last.error, sizeof all.measured.last.error);
  assert_memory_equal(all.measured.max_error, most.measured.max_error, sizeof all.measured.max_error);
  NEAR(most.measured.last.crossings, all.measured.last.crossings, 0);
}

static void measuring_more_changes_nothing(void **state)
{
  (void)state;
  each_method(check_levels);
}

static void check_repetition(struct gx_case one)
{
  struct gx_result first = case_result(&one), second = case_result(&one);
  assert_memory_equal(&first.measured, &second.measured, sizeof first.measured);
  NEAR(second.time, first.time, 0);
  NEAR(second.steps, first.steps, 0);
}

static void repetition_gives_the_same_bits(void **state)
{
  (void)state;
  each_method(check_repetition);
}

static void shear(struct gx_particles *particles, void *context)
{
  (void)context;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++)
      particles->v[d][p] = (d + 1) * 0.3 * sin(2 * M_PI * (particles->X[(d + 1) % particles->dim][p] + 0.1 * d));
}

static void shear_run(struct rig *rig, const char *space, int dim)
{
  struct gx_case one =
      case_draft("problem.name=axis-aligned", "problem.amplitude=0", "problem.modulus=1", "problem.poisson=0.3", "time.dt=0.01",
                 "time.end=0.2", "method.clock=rk4", "mesh.particles_per_cell=2", "method.mass=consistent", "method.degree=3");
  case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
  case_set_integer(&one, GX_MESH_CELLS, dim == 2 ? 12 : 8);
  case_set(&one, GX_METHOD_SPACE, space);
  gx_parameter_resolve(one.value);
  rig_build(rig, &one, NULL, shear, NULL);
  rig_run(rig, -1);
}

/* All spaces follow the same continuum through large shear: F agrees with that of the moving mesh but for the error of the grid. */
static void spaces_agree_on_shear(void **state)
{
  (void)state;
  for (int dim = 2; dim <= GX_MAX_DIM; dim++) {
    struct rig mesh;
    shear_run(&mesh, "moving-mesh", dim);
    const struct gx_particles *b = mesh.simulation.particles;
    for (int s = 0; gx_space_family[s]; s++) {
      if (gx_space_family[s]->of_problem || gx_space_family[s] == mesh.simulation.kind) continue;
      struct rig other;
      shear_run(&other, gx_space_family[s]->name, dim);
      const struct gx_particles *a = other.simulation.particles;
      double worst = 0, strain = 0;
      for (size_t p = 0; p < a->n; p++)
        for (int k = 0; k < dim * dim; k++) {
          worst = fmax(worst, fabs(a->F[k][p] - b->F[k][p]));
          strain = fmax(strain, fabs(b->F[k][p] - (k % (dim + 1) == 0)));
        }
      CHECK(strain > 0.3, "%g", strain);
      CHECK(worst < 0.02 * strain, "%s, %d-D: F differs by %g of %g", gx_space_family[s]->name, dim, worst, strain);
      rig_free(&other);
    }
    rig_free(&mesh);
  }
}

static void shear_deformed(struct gx_particles *particles, void *context)
{
  const double *F = context;
  shear(particles, NULL);
  for (int k = 0; k < 9; k++)
    for (size_t p = 0; p < particles->n; p++) particles->F[k][p] = F[k];
}

/* dF/dt = L F, in this order: the rate at F = I is L. */
static void gradients_multiply_from_the_left(void **state)
{
  (void)state;
  double F[] = {1.1, 0.3, 0.2, -0.1, 0.9, 0.4, 0.5, 0, 1.2}, identity[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  struct gx_case one = case_of("problem.name=axis-aligned", "problem.amplitude=0", "problem.modulus=1", "problem.dimension=3",
                               "method.clock=rk4", "mesh.particles_per_cell=1", "mesh.cells=4", "method.space=standard");
  double *rate[2][GX_MAX_STATE];
  struct gx_state view;
  for (int k = 0; k < 2; k++) {
    struct rig rig;
    rig_build(&rig, &one, NULL, shear_deformed, k ? F : identity);
    assert_int_equal(gx_stepper_accelerate(rig.stepper, 0), GX_OK);
    rig.simulation.kind->state(rig.simulation.space, &view);
    for (int i = 0; i < view.count; i++) rate[k][i] = calloc(view.length[i], sizeof(double));
    rig.simulation.kind->rates(rig.simulation.space, rate[k]);
    rig_free(&rig);
  }
  for (size_t p = 0; p < view.length[6]; p++) /* the state is u, v, F */
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        double product = 0;
        for (int k = 0; k < 3; k++) product += rate[0][6 + 3 * i + k][p] * F[3 * k + j];
        NEAR(rate[1][6 + 3 * i + j][p], product, 1e-13);
      }
  for (int i = 0; i < 2 * view.count; i++) free(rate[i % 2][i / 2]);
}

/* Failures are recorded results that name the particle or the reason, and other cases go on. */
static void failures_are_results(void **state)
{
  (void)state;
  const struct {
    enum gx_status status;
    bool names_particle;
    const char *set[8];
  } failing[] = {
      {GX_TANGLED, true, {"method.basis=linear", "mesh.cells=64", "time.cfl=3"}},
      {GX_TANGLED, true, {"method.basis=cpgimp", "mesh.particles_per_cell=1"}},
      {GX_TANGLED, true, {"method.stress=rate", "method.basis=ugimp", "problem.amplitude=0.158", "time.periods=3"}},
      {GX_TANGLED,
       true,
       {"method.space=moving-mesh", "method.stress=rate", "method.basis=ugimp", "problem.amplitude=0.12", "time.periods=3"}},
      {GX_UNSTABLE, false, {"problem.amplitude=1e-4", "time.cfl=3"}},
      {GX_UNSTABLE, false, {"problem.amplitude=1e-4", "time.cfl=3", "method.space=moving-mesh", "method.stress=rate"}},
      {GX_LEFT_DOMAIN,
       true,
       {"problem.name=bar-linear", "method.basis=linear", "method.position=particle", "problem.amplitude=0.12",
        "time.periods=20"}},
      {GX_SINGULAR, false, {"method.mass=consistent", "method.basis=linear", "mesh.particles_per_cell=1", "problem.amplitude=0"}},
      {GX_SINGULAR, false, {"method.mass=consistent", "method.degree=3", "mesh.particles_per_cell=1", "problem.amplitude=0"}},
      {GX_LEFT_DOMAIN,
       true,
       {"problem.name=bar-linear", "method.space=spline-particle", "method.frame=current", "time.cfl=8", "mesh.cells=10",
        "time.periods=4"}},
      {GX_LEFT_DOMAIN,
       true,
       {"problem.name=bar-linear", "method.space=spline-grid", "method.frame=current", "method.closure=symmetric", "time.cfl=8",
        "mesh.cells=10", "time.periods=4"}},
      {GX_TANGLED,
       true,
       {"method.space=spline-particle", "method.frame=current", "method.degree=9", "mesh.layout=gauss", "problem.amplitude=0.12",
        "time.periods=4"}},
      {GX_TANGLED,
       true,
       {"method.space=spline-grid", "method.degree=3", "method.stress=rate", "mesh.cells=8", "mesh.particles_per_cell=1",
        "problem.amplitude=0.15", "time.cfl=0.5"}},
      {GX_REFUSED, false, {"method.space=spline-grid", "method.degree=9", "mesh.cells=8"}},
      {GX_REFUSED, false, {"method.space=spline-particle", "method.degree=9", "mesh.cells=2"}},
      {GX_REFUSED,
       false,
       {"method.space=spline-particle", "problem.name=axis-aligned", "problem.dimension=2", "method.frame=current"}},
      {GX_REFUSED,
       false,
       {"method.space=spline-grid", "problem.name=axis-aligned", "problem.dimension=3", "problem.boundary=fixed",
        "method.closure=papers"}},
      {GX_TANGLED,
       true,
       {"method.space=spline-particle", "problem.name=axis-aligned", "problem.dimension=2", "mesh.cells=8", "time.cfl=2"}},
      {GX_REFUSED, false, {"problem.amplitude=0.2"}},
      {GX_REFUSED, false, {"method.basis=cpgimp", "method.space=moving-mesh"}},
      {GX_REFUSED, false, {"method.clock=rk4", "method.transfer=pic"}},
      {GX_REFUSED, false, {"method.clock=rk4", "method.flip=0.9"}},
      {GX_REFUSED, false, {"method.clock=rk4", "method.transfer=apic"}},
      {GX_REFUSED, false, {"method.clock=stormer-verlet", "method.transfer=apic"}},
      {GX_REFUSED, false, {"method.mass=consistent", "method.transfer=apic"}},
      {GX_REFUSED, false, {"method.projection=once", "method.transfer=apic"}},
      {GX_REFUSED, false, {"time.dt=1e-300"}},
  };
  for (size_t i = 0; i < sizeof failing / sizeof *failing; i++) {
    struct gx_case one = case_from(failing[i].set);
    struct gx_result result = gx_case_run(&one);
    CHECK(result.outcome.status == failing[i].status, "case %zu: %s, %s, particle %ld, after %g steps", i,
          gx_status_name(result.outcome.status), result.outcome.reason, result.outcome.particle, result.steps);
    assert_true(*result.outcome.reason);
    CHECK(!strstr(result.outcome.reason, "site"), "case %zu speaks of splines, not particles: %s", i, result.outcome.reason);
    assert_int_equal(result.outcome.particle >= 0, failing[i].names_particle);
    gx_case_free(&result);
  }
}

/* The last particle of the bar, pushed past the end. */
static void push(struct gx_particles *particles, void *context)
{
  (void)context;
  particles->v[0][particles->n - 1] = 1e4;
}

static void the_last_particle_may_leave_too(void **state)
{
  (void)state;
  const char *const closure[] = {"method.closure=papers", "method.closure=symmetric"};
  for (int i = 0; i < 2; i++) {
    struct gx_case one = case_of("problem.name=bar-linear", "method.space=spline-particle", "method.frame=current", closure[i],
                                 "method.clock=rk4");
    struct rig rig;
    assert_true(rig_build(&rig, &one, NULL, push, NULL));
    assert_int_equal(gx_stepper_step(rig.stepper, 0, rig.simulation.dt), GX_LEFT_DOMAIN);
    assert_int_equal(rig.outcome.particle, rig.simulation.particles->n - 1);
    rig_free(&rig);
  }
}

static int accelerations; /* of the one thread of this test */

static enum gx_status count(struct gx_space *space, double t)
{
  accelerations++;
  const struct gx_space_kind *original = gx_space_find(space->kind->name);
  return original->accelerate(space, t);
}

/* Accelerations in a step, after the first; watched: asked for between steps too. */
static int accelerations_a_step(const struct gx_case *one, bool watched, bool *starts_accelerated)
{
  struct rig rig;
  assert_true(rig_build(&rig, one, NULL, NULL, NULL));
  struct gx_space_kind kind = *rig.simulation.space->kind;
  kind.accelerate = count;
  rig.simulation.space->kind = &kind;
  for (int k = 0; k < 3; k++) {
    accelerations = 0;
    if (watched) assert_int_equal(gx_stepper_accelerate(rig.stepper, k * rig.simulation.dt), GX_OK);
    assert_int_equal(gx_stepper_step(rig.stepper, k * rig.simulation.dt, rig.simulation.dt), GX_OK);
  }
  *starts_accelerated = gx_stepper_starts_accelerated(rig.stepper);
  rig_free(&rig);
  return accelerations;
}

/* Stages are what a step costs; with weights of two positions nothing is reused. */
static void check_stages(struct gx_case one)
{
  const struct gx_clock *clock = gx_clock_find(one.value[GX_METHOD_CLOCK].text);
  const struct gx_space_kind *kind = gx_space_find(one.value[GX_METHOD_SPACE].text);
  bool reused;
  int cost = accelerations_a_step(&one, false, &reused), watched = accelerations_a_step(&one, true, &reused);
  int expected = clock->stages + (clock->plain_rows && kind->fixed_grid);
  CHECK(cost == expected, "%s on %s: %d accelerations a step, not %d", clock->name, kind->name, cost, expected);
  CHECK(watched == cost + !reused, "%s on %s: %d, watched %d", clock->name, kind->name, cost, watched);
}

static void stages_are_accelerations_a_step(void **state)
{
  (void)state;
  each_method(check_stages);
}

/* However short the end is beside the step, and however large a phase: the time asked for is run. */
static void extremes_are_run(void **state)
{
  (void)state;
  const char *const landing[] = {"time.landing=exact", "time.landing=past"};
  for (int i = 0; i < 2; i++) {
    struct gx_case one = case_of("time.dt=1e3", "time.end=1e-8", landing[i], "problem.amplitude=0");
    struct gx_result result = case_result(&one);
    CHECK(result.steps == 1 && result.time == (i ? 1e3 : 1e-8), "%g steps to %.17g", result.steps, result.time);
  }
  struct gx_case turned = case_of("problem.name=axis-aligned", "problem.phases=1e308", "time.periods=0.1");
  struct gx_case straight = case_of("problem.name=axis-aligned", "problem.phases=0", "time.periods=0.1");
  double far = case_result(&turned).measured.last.error[GX_DISPLACEMENT][GX_RMS];
  NEAR(far, case_result(&straight).measured.last.error[GX_DISPLACEMENT][GX_RMS], 0);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_method_ends_well),
      cmocka_unit_test(own_equations_end_well),
      cmocka_unit_test(measuring_more_changes_nothing),
      cmocka_unit_test(repetition_gives_the_same_bits),
      cmocka_unit_test(spaces_agree_on_shear),
      cmocka_unit_test(gradients_multiply_from_the_left),
      cmocka_unit_test(failures_are_results),
      cmocka_unit_test(extremes_are_run),
      cmocka_unit_test(the_last_particle_may_leave_too),
      cmocka_unit_test(stages_are_accelerations_a_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
