/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energy of second-order clocks on standard MPM with cpGIMP (berzins2022 §10): the defect of a step by its smooth theory, and what
 * remains of the energy after many. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

static struct gx_result linear_bar(const char *clock, const char *modulus, const char *dt)
{
  struct gx_case one = case_of("problem.name=bar-linear", "problem.amplitude=0.015", "mesh.cells=100",
                               "mesh.particles_per_cell=2", "method.basis=cpgimp", "time.end=1");
  case_set(&one, GX_METHOD_CLOCK, clock);
  case_set(&one, GX_PROBLEM_MODULUS, modulus);
  case_set(&one, GX_TIME_DT, dt);
  gx_parameter_resolve(one.value);
  return case_result(&one);
}

/* A^2 omega^5 dt^3 rho0 / 16 for a standing wave that starts from its rest position */
static void the_defect_is_of_third_order(void **state)
{
  (void)state;
  static const char *const clocks[] = {"stormer-verlet", "trgimp"};
  double omega = 8 * M_PI, theory = 0.015 * 0.015 * pow(omega, 5) * 1e-12 / 16;
  for (int i = 0; i < 2; i++) {
    double coarse = linear_bar(clocks[i], "16", "1e-4").measured.max_defect;
    double fine = linear_bar(clocks[i], "16", "5e-5").measured.max_defect;
    CLOSE(coarse, theory, 0.02);
    NEAR(log2(coarse / fine), 3, 0.05);
  }
}

/* trgimp keeps the Euler step's F: half a cycle of strain and velocity is multiplied by 1 - (omega dt)^2/2 in area each step. */
static void trgimp_loses_energy_and_stormer_verlet_does_not(void **state)
{
  (void)state;
  double omega = 16 * M_PI, lost = 1 - exp(-0.5 * omega * omega * 1e-4);
  CLOSE(linear_bar("trgimp", "64", "1e-4").measured.drift, lost, 0.02);
  assert_true(linear_bar("stormer-verlet", "64", "1e-4").measured.drift < 2.5e-4);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_defect_is_of_third_order),
      cmocka_unit_test(trgimp_loses_energy_and_stormer_verlet_does_not),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
