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

/* A block that spins and vibrates, for a sixth of a turn. */
static struct gx_measured spun_from(const char *const *set)
{
  struct gx_case one = case_begin(set);
  case_set(&one, GX_PROBLEM_NAME, "spinning-block");
  case_set(&one, GX_METHOD_PROJECTION, "each-step");
  case_set_integer(&one, GX_MESH_CELLS, 8);
  case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, 3);
  if (one.value[GX_TIME_CFL].type == GX_NULL) case_set_real(&one, GX_TIME_CFL, 0.1);
  if (one.value[GX_TIME_END].type == GX_NULL) case_set_real(&one, GX_TIME_END, 0.02);
  gx_parameter_resolve(one.value);
  return case_result(&one).measured;
}
#define spun(...) spun_from((const char *const[]){__VA_ARGS__, NULL})

static void check_apic(const char *const *set)
{
  struct gx_measured apic = spun_from(set);
  NEAR(apic.momentum_change, 0, 1e-13);
  NEAR(apic.angular_change, 0, 1e-12);
}
#define kept(...) check_apic((const char *const[]){"method.transfer=apic", __VA_ARGS__, NULL})

static void apic_keeps_angular_momentum(void **state)
{
  (void)state;
  kept("method.degree=2");
  kept("method.degree=3");
  kept("problem.boundary=periodic", "body.size=0.25 0.25", "problem.amplitude=0.005");
  kept("method.degree=2", "body.shape=ring", "problem.poisson=0.3", "method.clock=euler-stress-last");
  kept("method.basis=ugimp", "method.clock=optimised-verlet-velocity");
  kept("method.basis=cpgimp", "method.clock=yoshida4", "method.position=particle");
  /* a drift by a nodal velocity that is not yet the particles' turns x against m v */
  assert_true(spun("method.transfer=apic", "method.clock=yoshida4").angular_change > 1e-5);
  kept("problem.dimension=3", "time.end=0.005");
  kept("method.space=moving-mesh", "method.basis=linear");
  kept("method.space=moving-mesh", "method.degree=3", "method.clock=stormer-verlet");
  kept("method.space=moving-mesh", "method.basis=ugimp", "problem.dimension=3", "time.end=0.005");
}

/* Increments of velocity belong to M, not to its row sums: sum x_p cross m S a = sum g_i cross M_ij a_j, which is the torque of the
 * forces, zero, where M a = f. */
static void flip_keeps_it_with_consistent_mass(void **state)
{
  (void)state;
  struct gx_measured consistent = spun("method.space=moving-mesh", "method.mass=consistent");
  struct gx_measured lumped = spun("method.space=moving-mesh");
  NEAR(consistent.momentum_change, 0, 1e-13);
  NEAR(consistent.angular_change, 0, 1e-13);
  NEAR(lumped.momentum_change, 0, 1e-13);
  assert_true(lumped.angular_change > 1e-3);
}

static void pic_keeps_least(void **state)
{
  (void)state;
  struct gx_measured flip = spun("method.degree=2"), apic = spun("method.transfer=apic"), pic = spun("method.transfer=pic");
  assert_true(pic.drift > 0.9 && flip.drift < 0.2 && apic.drift < 0.2);
  assert_true(pic.angular_change > 0.5 && pic.momentum_change < 1e-13);
}

/* A block from end to end of a periodic box pulls at its own images. */
static void images_must_be_apart(void **state)
{
  (void)state;
  assert_false(isnan(spun("problem.boundary=periodic", "body.size=0.25 0.25", "problem.amplitude=0.005").angular_change));
  assert_true(isnan(spun("problem.boundary=periodic").angular_change)); /* they meet when it has turned */
  assert_false(isnan(spun("problem.boundary=periodic").momentum_change));
}

static void a_tangled_block_is_refused(void **state)
{
  (void)state;
  struct gx_case one = case_of("problem.name=spinning-block", "problem.amplitude=0.17");
  struct gx_result result = gx_case_run(&one);
  assert_int_equal(result.outcome.status, GX_REFUSED);
  assert_non_null(strstr(result.outcome.reason, "amplitude must stay below 0.159155"));
  gx_case_free(&result);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(linear_momentum_is_kept_to_round_off),
      cmocka_unit_test(what_the_problem_does_not_keep_is_null),
      cmocka_unit_test(a_push_changes_it),
      cmocka_unit_test(apic_keeps_angular_momentum),
      cmocka_unit_test(flip_keeps_it_with_consistent_mass),
      cmocka_unit_test(pic_keeps_least),
      cmocka_unit_test(images_must_be_apart),
      cmocka_unit_test(a_tangled_block_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
