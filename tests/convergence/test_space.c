/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of the moving mesh against those of an independent program: periodic bar with lumped and consistent mass, and a bar
 * between fixed ends with particles at Gauss points. The degree decides the order only with consistent mass and quadrature
 * to match. Each row: max over time of RMS u, cells 8, 16, 32, 64. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

enum { MESHES = 4 };

static void fill_row(struct gx_case one, double *error)
{
  for (int i = 0; i < MESHES; i++) {
    case_set_integer(&one, GX_MESH_CELLS, 8 << i);
    gx_parameter_resolve(one.value);
    error[i] = case_result(&one).measured.max_error[GX_DISPLACEMENT][GX_RMS];
  }
}

static void compare_row(struct gx_case one, const char *what, const double *expected)
{
  double error[MESHES];
  fill_row(one, error);
  for (int i = 0; i < MESHES; i++)
    CHECK(fabs(error[i] - expected[i]) <= 0.05 * expected[i], "%s, %d cells: %.4e, not %.4e", what, 8 << i, error[i],
          expected[i]);
}

static void periodic_bar_has_the_errors_of_an_independent_program(void **state)
{
  (void)state;
  static const struct {
    const char *mass, *degree;
    double error[MESHES];
  } rows[] = {
      {"lumped", "1", {3.63e-3, 9.41e-4, 2.37e-4, 5.95e-5}},      {"lumped", "3", {1.12e-2, 2.88e-3, 7.31e-4, 1.83e-4}},
      {"lumped", "5", {1.70e-2, 4.28e-3, 1.09e-3, 2.75e-4}},      {"consistent", "1", {4.71e-3, 1.21e-3, 3.05e-4, 7.62e-5}},
      {"consistent", "2", {2.75e-4, 7.04e-5, 1.77e-5, 4.44e-6}},  {"consistent", "3", {1.57e-5, 8.11e-7, 4.81e-8, 2.97e-9}},
      {"consistent", "4", {2.21e-6, 5.64e-8, 1.95e-9, 8.85e-11}}, {"consistent", "5", {3.08e-7, 3.49e-9, 6.30e-11, 2.66e-12}},
  };
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    struct gx_case one = case_draft("method.space=moving-mesh", "method.clock=rk4", "time.cfl=0.1", "output.measures=max");
    case_set(&one, GX_METHOD_MASS, rows[i].mass);
    case_set(&one, GX_METHOD_DEGREE, rows[i].degree);
    char what[64];
    snprintf(what, sizeof what, "%s mass, degree %s", rows[i].mass, rows[i].degree);
    compare_row(one, what, rows[i].error);
  }
}

static struct gx_case fixed_bar(const char *layout, const char *per_cell, const char *degree)
{
  struct gx_case one = case_draft("problem.name=bar-linear", "problem.modulus=16", "method.space=moving-mesh", "method.clock=rk4",
                                  "method.mass=consistent", "time.cfl=0.05", "time.end=0.25", "output.measures=max");
  case_set(&one, GX_MESH_LAYOUT, layout);
  case_set(&one, GX_MESH_PARTICLES_PER_CELL, per_cell);
  case_set(&one, GX_METHOD_DEGREE, degree);
  gx_parameter_resolve(one.value);
  return one;
}

static void fixed_bar_has_the_errors_of_an_independent_program(void **state)
{
  (void)state;
  static const struct {
    const char *layout, *per_cell, *degree;
    double error[MESHES];
  } rows[] = {
      {"gauss", "2", "1", {5.59e-3, 1.42e-3, 3.56e-4, 8.92e-5}},   {"gauss", "3", "2", {1.10e-4, 1.19e-5, 1.43e-6, 1.77e-7}},
      {"gauss", "4", "3", {1.63e-5, 8.69e-7, 5.20e-8, 3.21e-9}},   {"gauss", "6", "5", {2.97e-7, 3.60e-9, 5.20e-11, 1.08e-12}},
      {"uniform", "4", "3", {1.73e-4, 5.05e-5, 1.75e-5, 6.10e-6}},
  };
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    char what[64];
    snprintf(what, sizeof what, "degree %s, %s %s", rows[i].degree, rows[i].layout, rows[i].per_cell);
    compare_row(fixed_bar(rows[i].layout, rows[i].per_cell, rows[i].degree), what, rows[i].error);
  }
}

/* With Gauss points and consistent mass, degree p has order p + 1 between fixed ends: where no table reaches, too. */
static void degree_gives_order(void **state)
{
  (void)state;
  static const char *const digits[] = {"0", "1", "2", "3", "4", "5", "6", "7"};
  for (int degree = 1; degree <= 6; degree++) {
    struct gx_case one = fixed_bar("gauss", digits[degree + 1], digits[degree]);
    case_set_integer(&one, GX_MESH_CELLS, 6);
    double coarse = case_result(&one).measured.max_error[GX_DISPLACEMENT][GX_RMS];
    case_set_integer(&one, GX_MESH_CELLS, 12);
    double order = log2(coarse / case_result(&one).measured.max_error[GX_DISPLACEMENT][GX_RMS]);
    CHECK(order > degree + 1 - 0.25, "degree %d: order %.2f", degree, order);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periodic_bar_has_the_errors_of_an_independent_program),
      cmocka_unit_test(fixed_bar_has_the_errors_of_an_independent_program),
      cmocka_unit_test(degree_gives_order),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
