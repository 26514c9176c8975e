/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cost of the spline spaces by degree, ns per particle-step (one acceleration a step), beside the moving mesh of the same degree
 * in the same process, and beside what GSL takes for the values and first derivatives of one point; then in boxes. Minimum of the repetitions. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <gsl/gsl_bspline.h>
#include <gsl/gsl_errno.h>

#include "bench.h"
#include "study/simulation_plan.h"

enum { REPETITIONS = 15, BOX_REPETITIONS = 5, CELLS = 40, PER_CELL = 2 };

/* One run of so many steps; ns per particle-step. */
static double time_of(struct gx_case *one, int steps)
{
  gx_parameter_resolve(one->value);
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  struct gx_stepper *stepper = NULL;
  if (gx_simulation_plan(&simulation, one, &outcome) || gx_simulation_build(&simulation, &outcome) ||
      !(stepper = gx_stepper_create(simulation.clock, simulation.space, NULL)))
    exit(1);
  double before = bench_now(CLOCK_THREAD_CPUTIME_ID);
  for (int k = 0; k < steps; k++)
    if (gx_stepper_step(stepper, k * simulation.dt, simulation.dt)) exit(1);
  double ns = (bench_now(CLOCK_THREAD_CPUTIME_ID) - before) / ((double)steps * (double)simulation.particles->n);
  gx_stepper_free(stepper);
  gx_simulation_free(&simulation);
  return ns;
}

static double run(const char *space, const char *frame, const char *boundary, int degree)
{
  struct gx_case one = {0};
  one.value[GX_PROBLEM_NAME] = bench_text("bar-linear");
  one.value[GX_PROBLEM_AMPLITUDE] = bench_real(0.005);
  one.value[GX_MESH_CELLS] = bench_integer(CELLS);
  one.value[GX_MESH_PARTICLES_PER_CELL] = bench_integer(PER_CELL);
  one.value[GX_PROBLEM_BOUNDARY] = bench_text(boundary);
  one.value[GX_METHOD_SPACE] = bench_text(space);
  one.value[GX_METHOD_FRAME] = bench_text(frame);
  one.value[GX_METHOD_DEGREE] = bench_integer(degree);
  one.value[GX_TIME_CFL] = bench_real(0.05);
  return time_of(&one, 400);
}

/* 65536 particles in 2-D, 110592 in 3-D */
static double box(const char *space, const char *boundary, int dim, int degree)
{
  struct gx_case one = {0};
  one.value[GX_PROBLEM_NAME] = bench_text("axis-aligned");
  one.value[GX_PROBLEM_DIMENSION] = bench_integer(dim);
  one.value[GX_MESH_CELLS] = bench_integer(dim == 2 ? 128 : 24);
  one.value[GX_MESH_PARTICLES_PER_CELL] = bench_integer(PER_CELL);
  one.value[GX_PROBLEM_BOUNDARY] = bench_text(boundary);
  one.value[GX_METHOD_SPACE] = bench_text(space);
  one.value[GX_METHOD_DEGREE] = bench_integer(degree);
  one.value[GX_TIME_CFL] = bench_real(0.05);
  return time_of(&one, 4);
}

static void boxes(void)
{
  static const char *const spaces[] = {"moving-mesh", "spline-particle", "spline-grid"}, *const boundaries[] = {"fixed",
                                                                                                                "periodic"};
  printf("\ndimension  ends      degree  moving-mesh  spline-particle  ratio  spline-grid\n");
  for (int dim = 2; dim <= 3; dim++)
    for (int b = 0; b < 2; b++)
      for (int degree = 3; degree <= (b ? 3 : 7); degree += 2) {
        double least[3] = {INFINITY, INFINITY, INFINITY};
        for (int r = 0; r < BOX_REPETITIONS; r++)
          for (int i = 0; i < 3; i++) least[i] = fmin(least[i], box(spaces[i], boundaries[b], dim, degree));
        printf("%9d  %-8s %7d %12.1f %16.1f %6.2f %12.1f\n", dim, boundaries[b], degree, least[0], least[1], least[1] / least[0],
               least[2]);
      }
}

/* Values and first derivatives at one point, in order of the points. */
static double gsl_point(int degree)
{
  enum { POINTS = 20000 };
  gsl_bspline_workspace *workspace = gsl_bspline_alloc((size_t)degree + 1, CELLS + 1);
  gsl_matrix *values = gsl_matrix_alloc((size_t)degree + 1, 2);
  size_t first, last;
  if (!workspace || !values) exit(1);
  gsl_bspline_knots_uniform(0, 1, workspace);
  double before = bench_now(CLOCK_THREAD_CPUTIME_ID);
  for (int k = 0; k < POINTS; k++) gsl_bspline_deriv_eval_nonzero((k + 0.5) / POINTS, 1, values, &first, &last, workspace);
  double ns = (bench_now(CLOCK_THREAD_CPUTIME_ID) - before) / POINTS;
  gsl_matrix_free(values);
  gsl_bspline_free(workspace);
  return ns;
}

int main(void)
{
  gsl_set_error_handler_off();
  static const char *const boundaries[] = {"fixed", "periodic"};
  printf("ends      degree  moving-mesh  spline-particle reference  ratio  current  spline-grid reference  current  gsl point\n");
  for (int b = 0; b < 2; b++)
    for (int degree = 3; degree <= 9; degree += 2) {
      const char *ends = boundaries[b];
      double least[6] = {INFINITY, INFINITY, INFINITY, INFINITY, INFINITY, INFINITY};
      for (int r = 0; r < REPETITIONS; r++) {
        const double ns[6] = {run("moving-mesh", "", ends, degree),
                              run("spline-particle", "reference", ends, degree),
                              run("spline-particle", "current", ends, degree),
                              run("spline-grid", "reference", ends, degree),
                              run("spline-grid", "current", ends, degree),
                              gsl_point(degree)};
        for (int i = 0; i < 6; i++) least[i] = fmin(least[i], ns[i]);
      }
      printf("%-8s %7d %12.2f %26.2f %6.2f %8.1f %22.2f %8.1f %10.1f\n", ends, degree, least[0], least[1], least[1] / least[0],
             least[2], least[3], least[4], least[5]);
    }
  boxes();
  return 0;
}
