/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is watched besides norms: a probe is the particle asked for, and watching changes nothing. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

static struct gx_case probed(const char *space, const char *levels)
{
  struct gx_case one = case_draft("problem.modulus=1", "mesh.cells=16", "method.basis=linear", "output.histories=1",
                                  "output.probe=0.31", "time.cfl=0.05");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_OUTPUT_MEASURES, levels);
  gx_parameter_resolve(one.value);
  return one;
}

/* The particles nearest to 0.31 are those of X = (19 + 1/2)/64 = 0.3047 and 0.3203. */
static void check_probe(const char *space)
{
  struct gx_case one = probed(space, "all"), unwatched = one;
  case_set(&unwatched, GX_OUTPUT_PROBE, "");
  struct gx_result result = gx_case_run(&one), plain = gx_case_run(&unwatched);
  const struct gx_history *history = &result.history;
  const double X = 19.5 / 64, dt = result.dt;
  double change = 0;
  bool fixed = !strcmp(space, "standard");
  assert_int_equal(result.outcome.status, GX_OK);
  assert_int_equal(result.probe, 19);
  for (size_t i = 0; i < history->samples; i++) {
    const struct gx_probe *probe = &history->probe[i];
    double t = history->sample[i].time, wave = 0.05 * sin(2 * M_PI * X);
    NEAR(probe->u[0] - probe->u_error[0], wave * cos(M_PI * t), 1e-15);
    NEAR(probe->v[0] - probe->v_error[0], -M_PI * wave * sin(M_PI * t), 1e-15);
    assert_true(fabs(probe->u_error[0]) <= history->sample[i].error[GX_DISPLACEMENT][GX_INF]);
    if (i == 0 || i + 1 == history->samples) continue;
    if (!fixed) NEAR((probe[1].v[0] - probe[-1].v[0]) / (2 * dt), probe->a[0], 0.01);
    if (!fixed || floor(16 * (X + probe->u[0])) == floor(16 * (X + probe[-1].u[0])))
      change = fmax(change, fabs(probe->a[0] - probe[-1].a[0]));
  }
  assert_true(change > (fixed ? 0.1 : 1e-3));
  NEAR(result.measured.probe_change, change, 1e-12);
  assert_null(plain.history.probe);
  assert_true(isnan(plain.measured.probe_change));
  plain.measured.probe_change = result.measured.probe_change;
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

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_probe_is_the_particle_asked_for),
      cmocka_unit_test(a_probe_is_the_same_at_every_level),
      cmocka_unit_test(a_probe_has_the_components_of_its_dimension),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
