/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What measures cost beside the step: whole cases at each level of output.measures, less the time of shorter ones, so that set-up and the
 * estimate of the stable step do not count; ns of processor time per particle-step, minima of runs that take turns.
 * usage: bench_measures [REPETITIONS] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "study/simulation_plan.h"

static const int cells_of[] = {0, 64, 32, 12}, per_cell_of[] = {0, 4, 2, 2}, steps_of[] = {0, 2000, 400, 200};
static const char *const spaces[] = {"standard", "moving-mesh"}, *const bases[] = {"linear", "bspline"},
                         *const levels[] = {"final", "max", "all"};

enum { LEVELS = sizeof levels / sizeof *levels };

static struct gx_case case_of(const char *space, const char *basis, int dim, const char *level, int steps)
{
  struct gx_case one = {0};
  one.value[GX_PROBLEM_NAME] = bench_text("axis-aligned");
  one.value[GX_PROBLEM_DIMENSION] = bench_integer(dim);
  one.value[GX_MESH_CELLS] = bench_integer(cells_of[dim]);
  one.value[GX_MESH_PARTICLES_PER_CELL] = bench_integer(per_cell_of[dim]);
  one.value[GX_METHOD_SPACE] = bench_text(space);
  one.value[GX_METHOD_BASIS] = bench_text(basis);
  one.value[GX_TIME_CFL] = bench_real(0.1);
  one.value[GX_TIME_STEPS] = bench_integer(steps);
  one.value[GX_OUTPUT_MEASURES] = bench_text(level);
  gx_parameter_resolve(one.value);
  return one;
}

static double run_case(const struct gx_case *one)
{
  const double before = bench_now(CLOCK_THREAD_CPUTIME_ID);
  struct gx_result result = gx_case_run(one);
  const double spent = bench_now(CLOCK_THREAD_CPUTIME_ID) - before;
  if (result.outcome.status != GX_OK) exit(1);
  gx_case_free(&result);
  return spent;
}

/* ns of steps alone */
static double run_steps(const struct gx_case *one, int steps)
{
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  struct gx_stepper *stepper = NULL;
  if (gx_simulation_plan(&simulation, one, &outcome) || gx_simulation_build(&simulation, &outcome) ||
      !(stepper = gx_stepper_create(simulation.clock, simulation.space, NULL)))
    exit(1);
  if (gx_stepper_step(stepper, 0, simulation.dt)) exit(1); /* touches all memory */
  const double before = bench_now(CLOCK_THREAD_CPUTIME_ID);
  for (int k = 1; k <= steps; k++)
    if (gx_stepper_step(stepper, k * simulation.dt, simulation.dt)) exit(1);
  const double spent = bench_now(CLOCK_THREAD_CPUTIME_ID) - before;
  gx_stepper_free(stepper);
  gx_simulation_free(&simulation);
  return spent;
}

static void report(const char *space, const char *basis, int dim, int repetitions)
{
  const int few = steps_of[dim] / 8, many = steps_of[dim];
  const double particles = pow(cells_of[dim] * per_cell_of[dim], dim), each = 1 / (particles * (many - few));
  double alone = INFINITY, shorter[LEVELS], longer[LEVELS];
  for (int l = 0; l < LEVELS; l++) shorter[l] = longer[l] = INFINITY;
  for (int r = 0; r < repetitions; r++) {
    for (int l = 0; l < LEVELS; l++) {
      const struct gx_case less = case_of(space, basis, dim, levels[l], few), more = case_of(space, basis, dim, levels[l], many);
      if (l == 0) alone = fmin(alone, run_steps(&more, many) / (particles * many));
      shorter[l] = fmin(shorter[l], run_case(&less));
      longer[l] = fmin(longer[l], run_case(&more));
    }
  }
  printf("%-12s %-8s %d-D %8.2f", space, basis, dim, alone);
  for (int l = 0; l < LEVELS; l++) {
    const double whole = (longer[l] - shorter[l]) * each;
    printf(" %8.2f (%5.2f)", whole, whole / alone - 1);
  }
  printf("\n");
  fflush(stdout);
}

int main(int count, char **argument)
{
  const int repetitions = count > 1 ? atoi(argument[1]) : 9;
  if (repetitions < 1 || count > 2) {
    fputs("usage: bench_measures [REPETITIONS]\n", stderr);
    return 2;
  }
  gx_status_quiet_gsl();
  printf("ns per particle-step; in brackets what measures cost, in steps; minima of %d\n%-12s %-8s %3s %8s", repetitions, "space",
         "basis", "", "alone");
  for (int l = 0; l < LEVELS; l++) printf(" %8s %7s", levels[l], "");
  printf("\n");
  for (size_t s = 0; s < sizeof spaces / sizeof *spaces; s++)
    for (int dim = 1; dim <= GX_MAX_DIM; dim++)
      for (size_t b = 0; b < sizeof bases / sizeof *bases; b++) report(spaces[s], bases[b], dim, repetitions);
  return 0;
}
