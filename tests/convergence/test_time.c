/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orders in time on the moving mesh, each against the claim of its clock's own struct: of the motion, as the difference to the
 * same grid at a small step, and of the balance of energy and work. */
#include <gsl/gsl_errno.h>

#include "rig.h"

static struct gx_case smooth_bar(const struct gx_clock *clock, double steps)
{
  struct gx_case one = case_draft("method.space=moving-mesh", "method.degree=5", "method.mass=consistent", "mesh.cells=8",
                                  "problem.modulus=1", "time.end=0.6");
  case_set(&one, GX_METHOD_CLOCK, clock->name);
  case_set_real(&one, GX_TIME_DT, 0.6 / steps);
  gx_parameter_resolve(one.value);
  return one;
}

/* Enough for the order to show, and not so many that round-off does. */
static double steps_for(const struct gx_clock *clock)
{
  return clock->order > 4 ? 20 : clock->order > 1 ? 100 : 400;
}

enum { NODES = 64 };

static size_t run_bar(const struct gx_clock *clock, double steps, double *u)
{
  struct gx_case one = smooth_bar(clock, steps);
  struct rig rig;
  assert_true(rig_build(&rig, &one, NULL, NULL, NULL));
  rig_run(&rig, -1);
  NEAR(rig.steps, steps, 0);
  size_t n = rig.simulation.particles->n;
  assert_true(n <= NODES);
  memcpy(u, rig.simulation.particles->u[0], n * sizeof(double));
  rig_free(&rig);
  return n;
}

static double distance(size_t n, const double *u, const double *reference)
{
  double sum = 0;
  for (size_t p = 0; p < n; p++) sum += (u[p] - reference[p]) * (u[p] - reference[p]);
  return sqrt(sum / (double)n);
}

static void clocks_keep_their_order_on_the_moving_mesh(void **state)
{
  (void)state;
  double reference[NODES], coarse[NODES], fine[NODES];
  size_t n = run_bar(gx_clock_find("rk4"), 6000, reference);
  for (size_t i = 0; gx_clock_family[i]; i++) {
    const struct gx_clock *clock = gx_clock_family[i];
    double steps = steps_for(clock);
    run_bar(clock, steps, coarse);
    run_bar(clock, 2 * steps, fine);
    double before = distance(n, coarse, reference), after = distance(n, fine, reference), order = log2(before / after);
    CHECK(order > clock->order - 0.25, "%s: order %.3f, claims %d (%g, %g)", clock->name, order, clock->order, before, after);
  }
}

static double drift_of(const struct gx_clock *clock, double steps)
{
  struct gx_case one = smooth_bar(clock, steps);
  return case_result(&one).measured.drift;
}

/* Kinetic and elastic energy less the work of the body force: what is left vanishes with the order of the clock. A splitting of
 * Nystrom's kind keeps order 3 at most: work grows with v, and so breaks the property of kicks that its order 4 rests on. */
static void energy_and_work_balance(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++) {
    const struct gx_clock *clock = gx_clock_family[i];
    double steps = steps_for(clock);
    double before = drift_of(clock, steps), after = drift_of(clock, 2 * steps), order = log2(before / after);
    int claim = clock->splitting && clock->order > 3 ? 3 : clock->order;
    CHECK(order > claim - 0.25 || after < 1e-12, "%s: order %.3f, not %d (%g, %g)", clock->name, order, claim, before, after);
    CHECK(after < 1e-2, "%s: drift %g", clock->name, after);
  }
}

/* Smooth theory of the step's energy defect, Euler clocks from rest position: A^2 omega^4 dt^2 rho0 / 4; an independent program
 * has 2.245e-7 for this run. */
static double defect_at(const char *dt)
{
  struct gx_case one =
      case_of("problem.name=bar-linear", "problem.modulus=16", "problem.amplitude=0.015", "mesh.cells=100",
              "mesh.particles_per_cell=2", "method.basis=cpgimp", "method.clock=euler-stress-last", "time.end=1");
  case_set(&one, GX_TIME_DT, dt);
  gx_parameter_resolve(one.value);
  return case_result(&one).measured.max_defect;
}

static void energy_defect_follows_the_smooth_theory(void **state)
{
  (void)state;
  double omega = 8 * M_PI, theory = 0.015 * 0.015 * pow(omega, 4) * 1e-8 / 4;
  NEAR(theory, 2.245e-7, 1e-10);
  double coarse = defect_at("1e-4"), fine = defect_at("5e-5");
  CLOSE(coarse, theory, 0.02);
  NEAR(log2(coarse / fine), 2, 0.05);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(clocks_keep_their_order_on_the_moving_mesh),
      cmocka_unit_test(energy_and_work_balance),
      cmocka_unit_test(energy_defect_follows_the_smooth_theory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
