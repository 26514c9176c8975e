/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orders on the model problems of steffen2010 §5. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "rig.h"

static double error_of(const struct gx_clock *clock, const char *end, double dt)
{
  struct gx_case one = case_draft("problem.name=jump-model", "output.measures=final");
  case_set(&one, GX_METHOD_CLOCK, clock->name);
  case_set(&one, GX_TIME_END, end);
  case_set_real(&one, GX_TIME_DT, dt);
  gx_parameter_resolve(one.value);
  return case_result(&one).measured.last.error[GX_DISPLACEMENT][GX_INF];
}

/* Displacement at 0.1 s, while the particle reaches over the end at 0 and its acceleration is smooth. */
static double smooth_end(const struct gx_clock *clock, double dt)
{
  struct gx_case one = case_draft("problem.name=quadrature-model", "problem.jump=20", "time.end=0.1");
  struct rig rig;
  case_set(&one, GX_METHOD_CLOCK, clock->name);
  case_set_real(&one, GX_TIME_DT, dt);
  gx_parameter_resolve(one.value);
  assert_true(rig_build(&rig, &one, NULL, NULL, NULL));
  rig_run(&rig, -1);
  double u = rig.simulation.particles->u[0][0];
  rig_free(&rig);
  return u;
}

static bool uses_both_ends(const struct gx_clock *clock)
{
  for (const struct gx_row *row = clock->rows; row && row->primitive != GX_END; row++)
    if (row->primitive == GX_CLOSE) return true;
  return false;
}

/* Before the first knot. A drift keeps the velocity of where it started, so a clock of drifts moves through a field at order 1,
 * whatever its own; the average over both ends of a step is Heun's method; stages of rates keep their order. */
static void drifts_through_a_field_are_of_order_one(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++) {
    const struct gx_clock *clock = gx_clock_family[i];
    int order = clock->tableau ? clock->order : uses_both_ends(clock) ? 2 : 1;
    double before = error_of(clock, "0.2", 0.0025), after = error_of(clock, "0.2", 0.00125);
    CHECK(fabs(log2(before / after) - order) < 0.05, "%s: order %.3f, not %d", clock->name, log2(before / after), order);
  }
}

static void accelerations_do_not_change_that(void **state)
{
  (void)state;
  double reference = smooth_end(gx_clock_find("rk4"), 1e-4);
  for (size_t i = 0; gx_clock_family[i]; i++) {
    const struct gx_clock *clock = gx_clock_family[i];
    int order = clock->tableau ? clock->order : uses_both_ends(clock) && !clock->staggered ? 2 : 1;
    double before = fabs(smooth_end(clock, 0.005) - reference), after = fabs(smooth_end(clock, 0.0025) - reference);
    CHECK(fabs(log2(before / after) - order) < 0.1, "%s: order %.3f, not %d", clock->name, log2(before / after), order);
  }
}

/* Length that [a, b] and [c, d] share. */
static double shared(double a, double b, double c, double d)
{
  return fmax(0, fmin(b, d) - fmax(a, c));
}

/* Eqs 89-92 in plain arithmetic, the integral piece by piece. */
static void quadrature_model_by_hand(void **state)
{
  (void)state;
  const double end[] = {0, 1.0 / 3, 2.0 / 3, 5.0 / 6, 1}, slope[] = {3, 6, 12, 18}, offset[] = {1, 0, -4, -9};
  const double dt = 1e-3, width = 0.25;
  for (int corrected = 0; corrected < 2; corrected++) {
    const double g[] = {-2, 0, corrected ? 1 : 2, 3};
    struct gx_case one = case_draft("problem.name=quadrature-model", "problem.jump=2", "time.dt=0.001", "time.end=0.4",
                                    "method.clock=euler-stress-last");
    case_set(&one, GX_PROBLEM_VARIANT, corrected ? "corrected" : "printed");
    gx_parameter_resolve(one.value);
    double x = 0, external = 0;
    for (int k = 0; k < 400; k++) {
      int piece = 0;
      while (x >= end[piece + 1]) piece++;
      double a = g[piece] * width;
      for (int i = 0; i < 4; i++) a += g[i] * (end[i + 1] - end[i] - shared(end[i], end[i + 1], x - width / 2, x + width / 2));
      external += a * dt;
      x += (slope[piece] * x + offset[piece] + external) * dt;
    }
    struct rig rig;
    assert_true(rig_build(&rig, &one, NULL, NULL, NULL));
    rig_run(&rig, -1);
    NEAR(rig.simulation.particles->u[0][0], x, 1e-12);
    NEAR(rig.simulation.particles->v[0][0], 18 * x - 9 + external, 1e-11);
    rig_free(&rig);
  }
}

/* Past all knots: the same, since a jump of the slope costs dt^2 once. */
static void euler_passes_knots_at_order_one(void **state)
{
  (void)state;
  const struct gx_clock *euler = gx_clock_find("euler-stress-last");
  NEAR(log2(error_of(euler, "0.4", 1e-4) / error_of(euler, "0.4", 5e-5)), 1, 0.02);
}

/* steffen2010 Fig 5: slope * v(knot) / 4 dt^2, half way over the knot: 3*2/4, 6*4/4, 12*6/4. */
static void jumps_are_of_order_two(void **state)
{
  (void)state;
  const double limit[] = {1.5, 6, 18};
  for (int k = 0; k < 3; k++) {
    double jump[2];
    for (int i = 0; i < 2; i++) {
      struct gx_case one =
          case_draft("problem.name=jump-model", "method.clock=euler-stress-last", "time.steps=1", "output.jumps=yes");
      case_set_integer(&one, GX_PROBLEM_KNOT, k + 1);
      case_set_real(&one, GX_TIME_DT, i ? 1e-4 : 2e-4);
      gx_parameter_resolve(one.value);
      jump[i] = -case_result(&one).measured.last_jump;
    }
    NEAR(log2(jump[0] / jump[1]), 2, 0.002);
    CLOSE(jump[1] / 1e-8, limit[k], 0.001);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(drifts_through_a_field_are_of_order_one),
      cmocka_unit_test(accelerations_do_not_change_that),
      cmocka_unit_test(quadrature_model_by_hand),
      cmocka_unit_test(euler_passes_knots_at_order_one),
      cmocka_unit_test(jumps_are_of_order_two),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
