/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of the papers that one or a few quick runs give: steffen2010 Table II and Fig 13b, berzins2021 Table 2. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

/* Second simulation. The printed "RMS" is the max norm, 8.39e-5; started with v(-dt/2). */
static void steffen_table_2(void **state)
{
  (void)state;
  struct gx_case one = case_of("mesh.cells=64", "time.cfl=0.9", "time.landing=past");
  struct gx_result result = case_result(&one);
  NEAR(result.steps, 143, 0);
  CLOSE(result.dt, 0.9 / 64 / 100, 1e-15);
  CLOSE(result.measured.last.error[GX_DISPLACEMENT][GX_INF], 8.378e-5, 0.01);
  CLOSE(result.measured.last.error[GX_DISPLACEMENT][GX_RMS], 3.42e-5, 0.01);
}

static void steffen_figure_13b(void **state)
{
  (void)state;
  const double printed[] = {1.41e-3, 6.73e-4, 2.94e-4, 1.37e-4, 5.42e-5};
  for (int i = 0; i < 5; i++) {
    struct gx_case one = case_of("method.basis=linear", "time.cfl=0.1", "output.measures=final");
    case_set_integer(&one, GX_MESH_CELLS, 16 << i);
    case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, 4 << i);
    CLOSE(case_result(&one).measured.last.error[GX_DISPLACEMENT][GX_RMS], printed[i], 0.2);
  }
}

/* Papers' E = 16 and 256, that is moduli 4 and 64: crossings and max over time of the 2-norm over N. */
static void berzins_table_2(void **state)
{
  (void)state;
  static const struct {
    const char *modulus;
    double crossings, error;
  } rows[] = {{"4", 198, 1.42e-3}, {"64", 794, 5.1e-3}};
  for (int i = 0; i < 2; i++) {
    struct gx_case one = case_of("problem.name=bar-linear", "mesh.cells=20", "mesh.particles_per_cell=2", "method.basis=cpgimp",
                                 "method.clock=euler-stress-first", "time.dt=2e-5", "time.end=1", "output.measures=max");
    case_set(&one, GX_PROBLEM_MODULUS, rows[i].modulus);
    struct gx_result result = case_result(&one);
    NEAR(result.measured.last.crossings, rows[i].crossings, 0);
    CLOSE(result.measured.max_error[GX_DISPLACEMENT][GX_L2N], rows[i].error, 0.02);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(steffen_table_2),
      cmocka_unit_test(steffen_figure_13b),
      cmocka_unit_test(berzins_table_2),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
