/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is watched besides norms: a probe is the particle asked for, jump errors are those of steffen2010 eq. 86, and watching changes
 * nothing. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "rig.h"

static struct gx_case probed(const char *space, const char *levels)
{
  struct gx_case one = case_draft("problem.modulus=1", "mesh.cells=16", "method.basis=linear", "output.histories=1",
                                  "mesh.particles_per_cell=1", "output.probe=0.31", "time.cfl=0.05");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_OUTPUT_MEASURES, levels);
  gx_parameter_resolve(one.value);
  return one;
}

/* The particles nearest to 0.31 are those of X = (4 + 1/2)/16 = 0.281 and 0.344. */
static void check_probe(const char *space)
{
  struct gx_case one = probed(space, "all"), unwatched = one;
  case_set(&unwatched, GX_OUTPUT_PROBE, "");
  struct gx_result result = gx_case_run(&one), plain = gx_case_run(&unwatched);
  const struct gx_history *history = &result.history;
  const double X = 4.5 / 16, dt = result.dt;
  double change = 0, largest = 0;
  bool fixed = !strcmp(space, "standard");
  assert_int_equal(result.outcome.status, GX_OK);
  assert_int_equal(result.probe, 4);
  for (size_t i = 0; i < history->samples; i++) {
    const struct gx_probe *probe = &history->probe[i];
    double t = history->sample[i].time, wave = 0.05 * sin(2 * M_PI * X);
    NEAR(probe->u[0] - probe->u_error[0], wave * cos(M_PI * t), 1e-15);
    NEAR(probe->v[0] - probe->v_error[0], -M_PI * wave * sin(M_PI * t), 1e-15);
    assert_true(fabs(probe->u_error[0]) <= history->sample[i].error[GX_DISPLACEMENT][GX_INF]);
    if (i == 0 || i + 1 == history->samples) continue;
    if (!fixed) NEAR((probe[1].v[0] - probe[-1].v[0]) / (2 * dt), probe->a[0], 0.01);
    largest = fmax(largest, fabs(probe->a[0] - probe[-1].a[0]));
    if (!fixed || floor(16 * (X + probe->u[0])) == floor(16 * (X + probe[-1].u[0])))
      change = fmax(change, fabs(probe->a[0] - probe[-1].a[0]));
  }
  assert_true(change > (fixed ? 0.1 : 1e-3));
  assert_int_equal(largest > change, fixed); /* its own crossings change more */
  NEAR(result.measured.probe_change, change, 1e-12);
  /* of the place, 0.0017 less than that of the particle; linear functions that are crossed keep no F that would say */
  double tangent = 0.05 * (sin(2 * M_PI * X) + 2 * M_PI * cos(2 * M_PI * X) * (0.31 - X));
  if (!fixed) NEAR(result.measured.probe_displacement, tangent, 5e-4);
  assert_null(plain.history.probe);
  assert_true(isnan(plain.measured.probe_change));
  plain.measured.probe_change = result.measured.probe_change;
  assert_true(isnan(plain.measured.probe_displacement));
  plain.measured.probe_displacement = result.measured.probe_displacement;
  assert_memory_equal(&plain.measured, &result.measured, sizeof plain.measured);
  gx_case_free(&result);
  gx_case_free(&plain);
}

static void a_probe_is_the_particle_asked_for(void **state)
{
  (void)state;
  check_probe("standard");
  check_probe("moving-mesh");
}

static void a_probe_is_the_same_at_every_level(void **state)
{
  (void)state;
  struct gx_case all = probed("standard", "all");
  struct gx_result full = gx_case_run(&all);
  const char *const levels[] = {"max", "final"};
  for (int i = 0; i < 2; i++) {
    struct gx_case less = probed("standard", levels[i]);
    struct gx_result result = gx_case_run(&less);
    assert_int_equal(result.history.samples, full.history.samples);
    for (size_t k = 0; k < full.history.samples; k++)
      for (int d = 0; d < 1; d++) {
        NEAR(result.history.probe[k].a[d], full.history.probe[k].a[d], 0);
        NEAR(result.history.probe[k].v_error[d], full.history.probe[k].v_error[d], 0);
      }
    if (i == 0) NEAR(result.measured.probe_change, full.measured.probe_change, 0);
    if (i == 1) assert_true(isnan(result.measured.probe_change)); /* cells are not kept */
    gx_case_free(&result);
  }
  gx_case_free(&full);
}

/* In 3-D the nearest by distance, and one column a component. */
static void a_probe_has_the_components_of_its_dimension(void **state)
{
  (void)state;
  struct gx_case one = case_of("problem.name=axis-aligned", "problem.dimension=3", "problem.modulus=1", "mesh.cells=3",
                               "mesh.particles_per_cell=1", "time.steps=2", "output.histories=1", "output.probe=0.1 0.45 0.9");
  struct gx_result result = gx_case_run(&one);
  assert_int_equal(result.probe, 0 + 3 * 1 + 9 * 2);
  const double X[] = {1.0 / 6, 0.5, 5.0 / 6};
  for (int d = 0; d < 3; d++) NEAR(result.history.probe[0].u[d], 0.05 * sin(2 * M_PI * X[d]), 1e-15);
  struct gx_table *table = gx_study_table_history(&result);
  const char *const names[] = {"probe.displacement.x", "probe.displacement.y", "probe.displacement.z"};
  for (int d = 0; d < 3; d++) {
    long column = gx_table_find(table, names[d]);
    assert_true(column >= 0);
    NEAR(gx_table_get(table, 0, (size_t)column).real, 0.05 * sin(2 * M_PI * X[d]), 1e-15);
  }
  gx_table_free(table);
  gx_case_free(&result);
}

/* steffen2010 eq. 70, stepped by eq. 75 and by the two steps of eq. 84 in plain arithmetic. */
static double model_velocity(double x)
{
  return x < 1.0 / 3 ? 3 * x + 1 : x < 2.0 / 3 ? 6 * x : x < 5.0 / 6 ? 12 * x - 4 : 18 * x - 9;
}

static void model_jumps_by_hand(void **state)
{
  (void)state;
  const double knots[] = {1.0 / 3, 2.0 / 3, 5.0 / 6}, slopes[] = {3, 6, 12}, dt = 1.25e-4;
  struct gx_case one = case_of("problem.name=jump-model", "method.clock=euler-stress-last", "time.dt=1.25e-4", "time.end=0.39",
                               "output.jumps=yes", "output.histories=1", "output.probe=0");
  struct gx_result result = gx_case_run(&one);
  double x = 0, sum = 0, last = 0, estimate = 0;
  int met = 0;
  for (size_t i = 1; i < result.history.samples; i++) {
    double v = model_velocity(x), next = x + dt * v, jump = 0;
    if (met < 3 && next >= knots[met]) {
      double first = (knots[met] - x) / v;
      last = jump = next - (knots[met] + (dt - first) * model_velocity(knots[met]));
      estimate = -0.25 * slopes[met++] * v * dt * dt;
    }
    sum += jump;
    NEAR(result.history.sample[i].jump_step, jump, 1e-15);
    NEAR(result.history.sample[i].jump[GX_INF], fabs(sum), 1e-15);
    NEAR(result.history.probe[i].jump[0], sum, 1e-15);
    x = next;
  }
  assert_int_equal(met, 3);
  NEAR(result.measured.last.crossings, 3, 0);
  NEAR(result.measured.last_jump, last, 1e-15);
  NEAR(result.measured.estimated_jump, estimate, 1e-15);
  NEAR(result.measured.max_jump[GX_RMS], fabs(sum), 1e-15);
  gx_case_free(&result);
}

/* Between nodes the velocity of hats is linear: from two particles of a cell to its edge by the straight line through them. */
static void grid_jumps_by_hand(void **state)
{
  (void)state;
  enum { MOST = 128 };
  struct gx_case one =
      case_of("problem.name=axis-aligned", "problem.phases=0.4", "problem.modulus=1", "mesh.cells=8", "method.basis=linear",
              "time.dt=0.2", "time.steps=1", "output.jumps=yes", "method.clock=euler-stress-last");
  struct rig rig;
  assert_true(rig_build(&rig, &one, NULL, NULL, NULL));
  const struct gx_particles *particles = rig.simulation.particles;
  double x[MOST], v[MOST], a[MOST], dt = rig.simulation.dt, square = 0, largest = 0, estimate = 0;
  size_t n = particles->n, crossed = 0;
  assert_true(n <= MOST);
  for (size_t p = 0; p < n; p++) {
    x[p] = particles->X[0][p] + particles->u[0][p];
    a[p] = -particles->v[0][p] / dt;
  }
  rig_run(&rig, -1);
  for (size_t p = 0; p < n; p++) {
    v[p] = (particles->X[0][p] + particles->u[0][p] - x[p]) / dt;
    a[p] += particles->v[0][p] / dt;
  }
  for (size_t p = 0; p < n; p++) {
    double cell = floor(8 * x[p]), other = floor(8 * (x[p] + dt * v[p])), edge = (cell + (other > cell)) / 8;
    size_t q = p ? p - 1 : p + 1;
    if (floor(8 * x[q]) != cell) q = p + 1;
    if (cell == other) continue;
    assert_true(floor(8 * x[q]) == cell);
    double slope = (v[q] - v[p]) / (x[q] - x[p]), first = (edge - x[p]) / v[p];
    double jump = x[p] + dt * v[p] - (edge + (dt - first) * (v[p] + slope * (edge - x[p])));
    square += jump * jump;
    if (fabs(jump) > fabs(largest)) {
      largest = jump;
      estimate = -0.25 * (slope * v[p] + a[p]) * dt * dt;
    }
    crossed++;
  }
  rig_free(&rig);
  struct gx_result result = case_result(&one);
  CHECK(crossed >= 4 && square > 1e-12, "%zu, %g", crossed, square);
  NEAR(result.measured.last.crossings, (double)crossed, 0);
  CLOSE(result.measured.last.jump[GX_RMS], sqrt(square / (double)n), 1e-9);
  CLOSE(result.measured.last_jump, largest, 1e-9);
  CLOSE(result.measured.estimated_jump, estimate, 1e-9);
}

/* A wave along one axis of 2-D: rows of particles that jump alike. */
static void jumps_along_one_axis_are_those_of_the_bar(void **state)
{
  (void)state;
  struct gx_case bar = case_draft("problem.modulus=1", "mesh.cells=8", "output.jumps=yes", "time.periods=0.5");
  struct gx_case plane = bar;
  gx_parameter_resolve(bar.value);
  case_set(&plane, GX_PROBLEM_NAME, "axis-aligned");
  case_set(&plane, GX_PROBLEM_DIMENSION, "2");
  case_set(&plane, GX_PROBLEM_ACTIVE, "y");
  gx_parameter_resolve(plane.value);
  struct gx_result thin = case_result(&bar), thick = case_result(&plane);
  assert_true(thin.measured.max_jump[GX_INF] > 1e-6);
  for (int k = 0; k < GX_L2N; k++) {
    CLOSE(thick.measured.max_jump[k], thin.measured.max_jump[k], 1e-10);
    CLOSE(thick.measured.last.jump[k], thin.measured.last.jump[k], 1e-10);
  }
  /* of two mirror images that jump alike round-off chooses one */
  double sign = thick.measured.last_jump * thin.measured.last_jump < 0 ? -1 : 1;
  CLOSE(thick.measured.last_jump, sign * thin.measured.last_jump, 1e-10);
  CLOSE(thick.measured.estimated_jump, sign * thin.measured.estimated_jump, 1e-10);
}

static void measuring_jumps_changes_nothing(void **state)
{
  (void)state;
  const char *const names[] = {"bar-neo-hookean", "jump-model"};
  for (int i = 0; i < 2; i++) {
    struct gx_case one = case_draft("problem.name=bar-neo-hookean");
    case_set(&one, GX_PROBLEM_NAME, names[i]);
    gx_parameter_resolve(one.value);
    struct gx_result plain = case_result(&one);
    case_set(&one, GX_OUTPUT_JUMPS, "yes");
    struct gx_result watched = case_result(&one);
    case_set(&one, GX_OUTPUT_MEASURES, "final");
    struct gx_result last = case_result(&one);
    assert_memory_equal(plain.measured.last.error, watched.measured.last.error, sizeof plain.measured.last.error);
    assert_memory_equal(plain.measured.max_error, watched.measured.max_error, sizeof plain.measured.max_error);
    assert_memory_equal(last.measured.last.jump, watched.measured.last.jump, sizeof last.measured.last.jump);
    assert_true(watched.measured.last.jump[GX_INF] > 0 && isnan(plain.measured.last.jump[GX_INF]));
    assert_true(isnan(last.measured.max_jump[GX_INF]) && isnan(plain.measured.last_jump));
  }
}

/* A clock of several drifts has no one field that its step followed; nor have particles that follow their own velocity. */
static void jumps_are_refused_where_there_is_no_one_step(void **state)
{
  (void)state;
  int measured = 0;
  for (int k = 0; gx_clock_family[k]; k++) {
    struct gx_case one = case_draft("mesh.cells=4", "time.steps=1", "output.jumps=yes");
    case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
    gx_parameter_resolve(one.value);
    struct gx_result result = gx_case_run(&one);
    measured += result.outcome.status == GX_OK;
    if (result.outcome.status != GX_OK) {
      assert_int_equal(result.outcome.status, GX_REFUSED);
      assert_non_null(strstr(result.outcome.reason, ": euler-stress-last, euler-stress-first, central-difference"));
    }
    gx_case_free(&result);
  }
  assert_int_equal(measured, 3);
  struct gx_case own = case_of("time.steps=1", "output.jumps=yes", "method.position=particle");
  assert_int_equal(gx_case_run(&own).outcome.status, GX_REFUSED);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_probe_is_the_particle_asked_for),
      cmocka_unit_test(a_probe_is_the_same_at_every_level),
      cmocka_unit_test(a_probe_has_the_components_of_its_dimension),
      cmocka_unit_test(model_jumps_by_hand),
      cmocka_unit_test(grid_jumps_by_hand),
      cmocka_unit_test(jumps_along_one_axis_are_those_of_the_bar),
      cmocka_unit_test(measuring_jumps_changes_nothing),
      cmocka_unit_test(jumps_are_refused_where_there_is_no_one_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
