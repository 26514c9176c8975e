/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What threads inside a case gain, and what a particle takes of memory: 3-D, degree 2, eight particles a cell. Teams take turns, and
 * minima are compared; seconds are those of the clock on the wall, so that other programs on the machine are seen too.
 * usage: bench_threads [REPETITIONS] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"
#include "core/team.h"
#include "study/simulation_plan.h"

enum { CELLS = 32, CELLS_FOR_MEMORY = 24, PER_CELL = 2, STEPS = 8, MOST_THREADS = 2 };

static const char *const spaces[] = {"standard", "moving-mesh"};

static struct gx_case case_of(const char *space, int cells)
{
  struct gx_case one = {0};
  one.value[GX_PROBLEM_NAME] = bench_text("axis-aligned");
  one.value[GX_PROBLEM_DIMENSION] = bench_integer(3);
  one.value[GX_MESH_CELLS] = bench_integer(cells);
  one.value[GX_MESH_PARTICLES_PER_CELL] = bench_integer(PER_CELL);
  one.value[GX_METHOD_SPACE] = bench_text(space);
  one.value[GX_METHOD_DEGREE] = bench_integer(2);
  return one;
}

/* ns per particle-step of a run; exits when it fails. */
static double run(const char *space, int cells, struct gx_team *team)
{
  struct gx_case one = case_of(space, cells);
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  struct gx_stepper *stepper = NULL;
  gx_parameter_resolve(one.value);
  if (gx_simulation_plan(&simulation, &one, &outcome)) exit(1);
  simulation.space_options.team = team;
  if (gx_simulation_build(&simulation, &outcome) || !(stepper = gx_stepper_create(simulation.clock, simulation.space, NULL)))
    exit(1);
  if (gx_stepper_step(stepper, 0, simulation.dt)) exit(1); /* touches all memory */
  double before = bench_now(CLOCK_MONOTONIC);
  for (int k = 1; k <= STEPS; k++)
    if (gx_stepper_step(stepper, k * simulation.dt, simulation.dt)) exit(1);
  double ns = (bench_now(CLOCK_MONOTONIC) - before) / ((double)STEPS * (double)simulation.particles->n);
  gx_stepper_free(stepper);
  gx_simulation_free(&simulation);
  return ns;
}

/* The same as a whole case of a few steps, as `gridcross run` runs it. */
static void run_case(const char *space, const char *measures, int cells)
{
  struct gx_case one = case_of(space, cells);
  one.value[GX_TIME_STEPS] = bench_integer(STEPS);
  one.value[GX_OUTPUT_MEASURES] = bench_text(measures);
  gx_parameter_resolve(one.value);
  struct gx_result result = gx_case_run(&one);
  if (result.outcome.status != GX_OK) exit(1);
  gx_case_free(&result);
}

static double most_bytes(void)
{
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * (double)usage.ru_maxrss;
}

/* What a process grows by from a run of two cells along each direction. measures: output.measures; NULL: without, particles,
 * problem, space and clock alone. */
static int print_bytes_per_particle(const char *space, const char *measures)
{
  fflush(stdout);
  pid_t child = fork();
  if (child == 0) {
    double bytes[2];
    for (int i = 0; i < 2; i++) {
      int cells = i ? CELLS_FOR_MEMORY : 2;
      if (measures)
        run_case(space, measures, cells);
      else
        run(space, cells, NULL);
      bytes[i] = most_bytes();
    }
    printf(" %9.0f", (bytes[1] - bytes[0]) / pow(CELLS_FOR_MEMORY * PER_CELL, 3));
    fflush(stdout);
    _exit(0);
  }
  int status = 1;
  return child < 0 || waitpid(child, &status, 0) < 0 || status ? -1 : 0;
}

static int print_memory(void)
{
  static const char *const measures[] = {NULL, "final", "max", "all"};
  printf("%d particles: bytes a particle at most, by output.measures\n%-12s", (int)pow(CELLS_FOR_MEMORY * PER_CELL, 3), "");
  for (size_t k = 0; k < sizeof measures / sizeof *measures; k++) printf(" %9s", measures[k] ? measures[k] : "without");
  for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++) {
    printf("\n%-12s", spaces[i]);
    for (size_t k = 0; k < sizeof measures / sizeof *measures; k++)
      if (print_bytes_per_particle(spaces[i], measures[k])) return -1;
  }
  printf("\n");
  return 0;
}

int main(int count, char **argument)
{
  int repetitions = count > 1 ? atoi(argument[1]) : 7;
  if (repetitions < 1 || count > 2) {
    fputs("usage: bench_threads [REPETITIONS]\n", stderr);
    return 2;
  }
  if (print_memory()) return 1;
  printf("\n%d particles: ns per particle-step on the wall, minimum of %d\n%-12s %9s %9s %9s\n", (int)pow(CELLS * PER_CELL, 3),
         repetitions, "", "1 thread", "2 threads", "speed-up");
  struct gx_team *team = gx_team_create(MOST_THREADS);
  for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++) {
    double least[2] = {INFINITY, INFINITY};
    for (int r = 0; r < repetitions; r++) {
      least[0] = fmin(least[0], run(spaces[i], CELLS, NULL));
      least[1] = fmin(least[1], run(spaces[i], CELLS, team));
    }
    printf("%-12s %9.1f %9.1f %9.2f\n", spaces[i], least[0], least[1], least[0] / least[1]);
    fflush(stdout);
  }
  gx_team_free(team);
  return 0;
}
