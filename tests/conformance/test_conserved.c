/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Momentum over a run: kept where the problem keeps it, and said to be unknown where it does not. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "rig.h"

/* Standing wave of the linear bar on a periodic grid: no force from outside. */
static struct gx_case periodic_bar(const char *space, const char *transfer, const char *measures)
{
  struct gx_case one = case_draft("problem.name=bar-linear", "problem.boundary=periodic", "method.projection=each-step",
                                  "output.histories=1", "mesh.cells=16", "time.periods=0.5");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_METHOD_TRANSFER, transfer);
  case_set(&one, GX_OUTPUT_MEASURES, measures);
  gx_parameter_resolve(one.value);
  return one;
}

static void linear_momentum_is_kept_to_round_off(void **state)
{
  (void)state;
  const char *const spaces[] = {"standard", "moving-mesh"}, *const transfers[] = {"flip", "pic"};
  for (int s = 0; s < 2; s++)
    for (int t = 0; t < 2; t++) {
      struct gx_case one = periodic_bar(spaces[s], transfers[t], "all");
      struct gx_result result = gx_case_run(&one);
      assert_int_equal(result.outcome.status, GX_OK);
      NEAR(result.measured.momentum_change, 0, 1e-13);
      assert_true(isnan(result.measured.angular_change)); /* in 1-D there is none */
      for (size_t i = 0; i < result.history.samples; i++) {
        const struct gx_sample *sample = &result.history.sample[i], *first = result.history.sample;
        double bound = sqrt(2 * fmax(sample->kinetic, first->kinetic)); /* of mass 1 */
        assert_true(fabs(sample->momentum[0] - first->momentum[0]) <= 1e-13 * fmax(bound, 1));
      }
      gx_case_free(&result);
    }
}

static double change_of(const char *const *set)
{
  struct gx_case one = case_from(set);
  return case_result(&one).measured.momentum_change;
}
#define change(...) change_of((const char *const[]){__VA_ARGS__, NULL})

static void what_the_problem_does_not_keep_is_null(void **state)
{
  (void)state;
  assert_false(isnan(change("problem.name=bar-linear", "problem.boundary=periodic")));
  assert_true(isnan(change("problem.name=bar-linear")));      /* held ends */
  assert_true(isnan(change("problem.name=bar-neo-hookean"))); /* body force */
  assert_true(isnan(change("problem.name=oscillator")));
  assert_true(isnan(change("problem.name=bar-linear", "problem.boundary=periodic", "output.measures=max")));
  assert_true(isnan(change("problem.name=bar-linear", "problem.boundary=periodic", "problem.amplitude=0"))); /* nothing moves */
}

/* Held ends push at a body that runs into one of them. */
static void skew(struct gx_particles *particles, void *context)
{
  (void)context;
  for (size_t p = 0; p < particles->n; p++) particles->v[0][p] = particles->X[0][p];
}

static void a_push_changes_it(void **state)
{
  (void)state;
  struct gx_case one = case_of("problem.name=bar-linear", "mesh.cells=16", "time.cfl=0.1");
  struct rig rig;
  rig_build(&rig, &one, NULL, skew, NULL);
  struct gx_measure *measure = gx_measure_create(rig.simulation.space, rig.simulation.clock, NULL, GX_MEASURE_ALL);
  gx_measure_momentum(measure, true, true);
  for (int k = 0; k < 20; k++) {
    assert_int_equal(gx_measure_take(measure, rig.stepper, rig.steps * rig.simulation.dt, rig.simulation.dt), GX_OK);
    rig_run(&rig, 1);
  }
  assert_true(gx_measure_result(measure)->momentum_change > 0.1);
  gx_measure_free(measure);
  rig_free(&rig);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(linear_momentum_is_kept_to_round_off),
      cmocka_unit_test(what_the_problem_does_not_keep_is_null),
      cmocka_unit_test(a_push_changes_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
