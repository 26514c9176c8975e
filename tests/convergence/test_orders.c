/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orders of the moving mesh in 2-D and 3-D, periodic and between walls (runs/box-orders.yaml has more of them), and its errors there
 * against those of the 1-D problem. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

/* A wave along each direction; between walls, particles at degree + 1 Gauss points. */
static struct gx_case box(int dim, bool walls, const char *poisson, const char *mass, int degree, int cells)
{
  struct gx_case one = case_draft("problem.name=axis-aligned", "method.space=moving-mesh", "method.clock=rk4", "time.cfl=0.2",
                                  "output.measures=final");
  case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
  case_set(&one, GX_PROBLEM_AMPLITUDE, dim == 3 ? "0.02" : "0.05");
  case_set(&one, GX_TIME_PERIODS, dim == 3 ? "0.05" : "0.2");
  case_set(&one, GX_PROBLEM_POISSON, poisson);
  case_set(&one, GX_METHOD_MASS, mass);
  case_set_integer(&one, GX_METHOD_DEGREE, degree);
  case_set_integer(&one, GX_MESH_CELLS, cells);
  case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, walls ? degree + 1 : 2);
  if (walls) {
    case_set(&one, GX_PROBLEM_BOUNDARY, "fixed");
    case_set(&one, GX_MESH_LAYOUT, "gauss");
  }
  gx_parameter_resolve(one.value);
  return one;
}

static double error_of(const struct gx_case *one)
{
  return case_result(one).measured.last.error[GX_DISPLACEMENT][GX_RMS];
}

static void consistent_mass_gives_the_order_of_the_degree(void **state)
{
  (void)state;
  const double least[2][4] = {{0, 1.9, 1.9, 3.7}, {0, 1.9, 2.8, 3.7}}; /* uniform particles are the midpoint rule */
  for (int dim = 2; dim <= 3; dim++)
    for (int walls = 0; walls < 2; walls++)
      for (int degree = 1; degree <= 3; degree++) {
        struct gx_case coarse = box(dim, walls, "0.3", "consistent", degree, dim == 2 ? 16 : 8);
        struct gx_case fine = box(dim, walls, "0.3", "consistent", degree, dim == 2 ? 32 : 16);
        double order = log2(error_of(&coarse) / error_of(&fine));
        CHECK(order >= least[walls][degree], "%d-D, walls %d, degree %d: order %.3f", dim, walls, degree, order);
      }
}

static void lumped_mass_gives_order_two(void **state)
{
  (void)state;
  for (int degree = 1; degree <= 3; degree++) {
    struct gx_case coarse = box(2, false, "0.3", "lumped", degree, 16), fine = box(2, false, "0.3", "lumped", degree, 32);
    double order = log2(error_of(&coarse) / error_of(&fine));
    CHECK(order >= 1.9 && order < 2.2, "degree %d: order %.3f", degree, order);
  }
}

/* Without a bulk modulus the directions do not see each other, so that squared errors add up. */
static void each_direction_errs_as_in_1d(void **state)
{
  (void)state;
  const char *const masses[] = {"lumped", "consistent"};
  for (int dim = 2; dim <= 3; dim++)
    for (int walls = 0; walls < 2; walls++)
      for (int mass = 0; mass < 2; mass++)
        for (int degree = 1; degree <= 3; degree++) {
          struct gx_case many = box(dim, walls, "0", masses[mass], degree, 6), one = many;
          case_set_integer(&one, GX_PROBLEM_DIMENSION, 1);
          case_set(&one, GX_PROBLEM_ACTIVE, "x");
          case_set(&one, GX_PROBLEM_PHASES, "0");
          double expected = sqrt(dim) * error_of(&one), error = error_of(&many);
          CHECK(fabs(error - expected) <= 1e-9 * expected, "%d-D, walls %d, %s, degree %d: %.17g, not %.17g", dim, walls,
                masses[mass], degree, error, expected);
        }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(consistent_mass_gives_the_order_of_the_degree),
      cmocka_unit_test(lumped_mass_gives_order_two),
      cmocka_unit_test(each_direction_errs_as_in_1d),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
