/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quadrature reconstructed against the errors of an independent program: the order of standard MPM through crossings of cells, long
 * runs, and the order that uniform particles lose between fixed ends. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

static double largest_error(struct gx_case one, const char *cells, enum gx_norm norm)
{
  case_set(&one, GX_MESH_CELLS, cells);
  gx_parameter_resolve(one.value);
  return case_result(&one).measured.max_error[GX_DISPLACEMENT][norm];
}

static struct gx_case bar(void)
{
  return case_draft("method.quadrature=reconstructed", "method.mass=consistent", "method.clock=rk4", "time.cfl=0.1",
                    "output.measures=max");
}

/* Max over time of RMS u on 8, 16 and 32 cells, within a tenth. */
static void standard_mpm_keeps_its_order_through_crossings(void **state)
{
  (void)state;
  static const struct {
    const char *degree, *amplitude, *per_cell, *periods;
    double error[3];
  } rows[] = {
      {"2", "0.05", "4", "1", {3.57e-4, 3.39e-5, 3.59e-6}}, {"3", "0.05", "4", "1", {1.46e-4, 4.30e-6, 1.35e-7}},
      {"5", "0.05", "4", "1", {1.04e-4, 9.2e-7, 3.8e-9}},   {"3", "0.05", "4", "10", {9.1e-4, 6.1e-6, 1.6e-7}},
      {"3", "0.05", "2", "1", {1.5e-4, 4.5e-6, 1.4e-7}},    {"3", "0.1", "4", "1", {2.3e-3, 1.9e-4, 1.4e-5}},
  };
  static const char *const cells[] = {"8", "16", "32"};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    for (int k = 0; k < 3; k++) {
      struct gx_case one = bar();
      case_set(&one, GX_METHOD_DEGREE, rows[i].degree);
      case_set(&one, GX_PROBLEM_AMPLITUDE, rows[i].amplitude);
      case_set(&one, GX_MESH_PARTICLES_PER_CELL, rows[i].per_cell);
      case_set(&one, GX_TIME_PERIODS, rows[i].periods);
      double error = largest_error(one, cells[k], GX_RMS), expected = rows[i].error[k];
      CHECK(fabs(error - expected) <= 0.1 * expected, "degree %s, amplitude %s, %s a cell, %s periods, %s cells: %.4e, not %.4e",
            rows[i].degree, rows[i].amplitude, rows[i].per_cell, rows[i].periods, cells[k], error, expected);
    }
}

/* The linear bar at the papers' E = 10000, 50 periods: max over time and particles of u. Between fixed ends no more than twice that. */
static void the_hardest_case_of_the_papers_is_solved(void **state)
{
  (void)state;
  static const struct {
    const char *degree, *cells;
    double error;
  } rows[] = {{"3", "8", 8.95e-3}, {"3", "16", 2.83e-4}, {"5", "8", 4.08e-3}, {"5", "16", 5.2e-5}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    struct gx_case one =
        case_draft("problem.name=bar-linear", "problem.modulus=2500", "method.quadrature=reconstructed", "method.mass=consistent",
                   "method.clock=rk4", "time.cfl=0.3", "time.end=1", "output.measures=max");
    case_set(&one, GX_METHOD_DEGREE, rows[i].degree);
    case_set(&one, GX_PROBLEM_BOUNDARY, "periodic");
    double ring = largest_error(one, rows[i].cells, GX_INF);
    CHECK(fabs(ring - rows[i].error) <= 0.1 * rows[i].error, "degree %s, %s cells: %.4e, not %.4e", rows[i].degree, rows[i].cells,
          ring, rows[i].error);
    case_set(&one, GX_PROBLEM_BOUNDARY, "fixed");
    double fixed = largest_error(one, rows[i].cells, GX_INF);
    CHECK(fixed <= 2 * rows[i].error, "degree %s, %s cells, fixed ends: %.4e", rows[i].degree, rows[i].cells, fixed);
  }
}

/* Order of the moving mesh between fixed ends, uniform particles: one or so by sums over particles. */
static void uniform_particles_between_fixed_ends_are_mended(void **state)
{
  (void)state;
  for (int reconstructed = 0; reconstructed < 2; reconstructed++) {
    struct gx_case one =
        case_draft("problem.name=bar-linear", "problem.modulus=16", "method.space=moving-mesh", "method.degree=3",
                   "method.mass=consistent", "method.clock=rk4", "time.cfl=0.05", "time.end=0.25", "output.measures=max");
    case_set(&one, GX_METHOD_QUADRATURE, reconstructed ? "reconstructed" : "particles");
    double order = log2(largest_error(one, "16", GX_RMS) / largest_error(one, "32", GX_RMS));
    CHECK(reconstructed ? order > 3.75 : order < 2, "quadrature %s: order %.2f", reconstructed ? "reconstructed" : "particles",
          order);
  }
}

/* Orders of axis-aligned waves in 2-D through crossings, by polynomials a cell. */
static void two_dimensions_keep_their_order_too(void **state)
{
  (void)state;
  static const double least[] = {2.7, 3.5}; /* degrees 2 and 3 */
  for (int degree = 2; degree <= 3; degree++) {
    struct gx_case one =
        case_draft("problem.name=axis-aligned", "problem.dimension=2", "method.quadrature=reconstructed",
                   "method.mass=consistent", "method.clock=rk4", "time.cfl=0.4", "time.periods=0.25", "output.measures=max");
    case_set_integer(&one, GX_METHOD_DEGREE, degree);
    double order = log2(largest_error(one, "8", GX_RMS) / largest_error(one, "16", GX_RMS));
    CHECK(order >= least[degree - 2], "degree %d: order %.2f", degree, order);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(standard_mpm_keeps_its_order_through_crossings),
      cmocka_unit_test(the_hardest_case_of_the_papers_is_solved),
      cmocka_unit_test(two_dimensions_keep_their_order_too),
      cmocka_unit_test(uniform_particles_between_fixed_ends_are_mended),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
