/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Times gridcross beside the plain loops: both in one process, one after the other in every repetition, so that a machine that
 * slows down slows both; in processor time, which other programs do not lengthen. Prints ns per particle-step and the ratios; fails
 * when the two disagree, never on time.
 * usage: bench [REPETITIONS [NAME]]; the short 1-D runs are repeated SHORT times as often. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "plain.h"
#include "study/simulation_plan.h"

enum { SHORT = 8, MOST_REPETITIONS = 1000 };

struct contest {
  const char *name;
  const char *problem, *space, *basis, *clock;
  int dim, cells, per_cell, degree;
  bool periodic;
  long steps;
  void (*start)(struct plain *plain); /* NULL: nothing to do */
  void (*step)(struct plain *plain);
  void (*sample)(struct plain *plain); /* NULL: particles are up to date */
  bool general;                        /* transfers for any particles, as if they were no lattice */
};

static const double modulus = 1e4, density = 1, amplitude = 0.05, cfl = 0.4, tolerance = 1e-12;

/* The steps are few enough for round-off not to have grown to what agreement is judged by: cpGIMP multiplies it by a hundred in
 * 500 steps, and the linear basis is unstable from about step 3000. */
static const struct contest contests[] = {
    {"1-D standard linear", "bar-neo-hookean", "standard", "linear", "central-difference", 1, 64, 4, 1, true, 2000, NULL,
     plain_standard_linear, NULL, false},
    {"1-D standard quadratic", "bar-neo-hookean", "standard", "bspline", "central-difference", 1, 64, 4, 2, true, 2000, NULL,
     plain_standard_quadratic, NULL, false},
    {"1-D cpGIMP Euler", "bar-linear", "standard", "cpgimp", "euler-stress-first", 1, 64, 4, 1, false, 500, NULL, plain_cpgimp,
     NULL, false},
    {"1-D moving mesh linear", "bar-neo-hookean", "moving-mesh", "linear", "central-difference", 1, 64, 4, 1, true, 2000,
     plain_moving_mesh_linear_start, plain_moving_mesh_linear, NULL, false},
    {"1-D mm linear, nodal", "bar-neo-hookean", "moving-mesh", "linear", "central-difference", 1, 64, 4, 1, true, 2000,
     plain_nodal_linear_start, plain_nodal_linear, plain_nodal_linear_sample, false},
    {"1-D moving mesh quadratic", "bar-neo-hookean", "moving-mesh", "bspline", "central-difference", 1, 64, 4, 2, true, 2000,
     plain_moving_mesh_quadratic_start, plain_moving_mesh_quadratic, NULL, false},
    {"1-D mm quadratic, nodal", "bar-neo-hookean", "moving-mesh", "bspline", "central-difference", 1, 64, 4, 2, true, 2000,
     plain_nodal_quadratic_start, plain_nodal_quadratic, plain_nodal_quadratic_sample, false},
    {"3-D standard quadratic", "axis-aligned", "standard", "bspline", "central-difference", 3, 24, 2, 2, true, 20, NULL,
     plain_standard_3d, NULL, false},
    {"3-D moving mesh quadratic", "axis-aligned", "moving-mesh", "bspline", "central-difference", 3, 24, 2, 2, true, 20,
     plain_moving_mesh_3d_start, plain_moving_mesh_3d, NULL, false},
    {"3-D mm quadratic, nodal", "axis-aligned", "moving-mesh", "bspline", "central-difference", 3, 24, 2, 2, true, 20,
     plain_nodal_3d_start, plain_nodal_3d, plain_nodal_3d_sample, false},
    {"3-D moving mesh, general", "axis-aligned", "moving-mesh", "bspline", "central-difference", 3, 24, 2, 2, true, 20,
     plain_moving_mesh_3d_start, plain_moving_mesh_3d, NULL, true},
};

static struct gx_case case_of(const struct contest *contest)
{
  struct gx_case one = {0};
  one.value[GX_PROBLEM_NAME] = bench_text(contest->problem);
  one.value[GX_PROBLEM_DIMENSION] = bench_integer(contest->dim);
  one.value[GX_PROBLEM_AMPLITUDE] = bench_real(amplitude);
  one.value[GX_PROBLEM_MODULUS] = bench_real(modulus);
  one.value[GX_PROBLEM_DENSITY] = bench_real(density);
  one.value[GX_PROBLEM_POISSON] = bench_real(0);
  one.value[GX_PROBLEM_BOUNDARY] = bench_text(contest->periodic ? "periodic" : "fixed");
  one.value[GX_MESH_CELLS] = bench_integer(contest->cells);
  one.value[GX_MESH_PARTICLES_PER_CELL] = bench_integer(contest->per_cell);
  one.value[GX_MESH_LAYOUT] = bench_text("uniform");
  one.value[GX_METHOD_SPACE] = bench_text(contest->space);
  one.value[GX_METHOD_BASIS] = bench_text(contest->basis);
  one.value[GX_METHOD_DEGREE] = bench_integer(contest->degree);
  one.value[GX_METHOD_MASS] = bench_text("lumped");
  one.value[GX_METHOD_TRANSFER] = bench_text("flip");
  one.value[GX_METHOD_CLOCK] = bench_text(contest->clock);
  one.value[GX_METHOD_POSITION] = bench_text("nodal");
  one.value[GX_METHOD_PROJECTION] = bench_text(strcmp(contest->space, "standard") ? "once" : "each-step");
  one.value[GX_METHOD_STRESS] = bench_text("F");
  one.value[GX_TIME_CFL] = bench_real(cfl);
  one.value[GX_TIME_PERIODS] = bench_real(1);
  one.value[GX_TIME_LANDING] = bench_text("past");
  return one;
}

/* ns for the steps, or -1 with a message. */
static double time_gridcross(const struct contest *contest, struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  struct gx_stepper *stepper = gx_stepper_create(simulation->clock, simulation->space, NULL);
  if (!stepper) return -1;
  double before = bench_now(CLOCK_THREAD_CPUTIME_ID);
  for (long step = 0; step < contest->steps && outcome->status == GX_OK; step++)
    gx_stepper_step(stepper, (double)step * simulation->dt, simulation->dt);
  double spent = bench_now(CLOCK_THREAD_CPUTIME_ID) - before;
  gx_stepper_free(stepper);
  if (outcome->status != GX_OK) return -1;
  if (simulation->kind->settle) simulation->kind->settle(simulation->space);
  return spent;
}

static double time_plain(const struct contest *contest, struct plain *plain)
{
  if (contest->start) contest->start(plain);
  double before = bench_now(CLOCK_THREAD_CPUTIME_ID);
  for (long step = 0; step < contest->steps; step++) contest->step(plain);
  double spent = bench_now(CLOCK_THREAD_CPUTIME_ID) - before;
  if (contest->sample) contest->sample(plain);
  return spent;
}

/* Largest difference of displacements over the amplitude; infinite when one is NaN. */
static double difference(const struct gx_particles *particles, const struct plain *plain)
{
  double largest = 0;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) {
      double apart = fabs(particles->u[d][p] - plain->u[p * (size_t)particles->dim + (size_t)d]) / amplitude;
      if (!(apart <= largest)) largest = isnan(apart) ? INFINITY : apart;
    }
  return largest;
}

static enum gx_status build(const struct contest *contest, struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  GX_TRY(gx_simulation_lay_out(simulation, outcome));
  if (contest->general) memset(simulation->particles->lattice, 0, sizeof simulation->particles->lattice);
  GX_TRY(gx_simulation_pose(simulation, outcome));
  return gx_simulation_open(simulation, outcome);
}

/* One repetition: ns of both and how far apart they end. Returns 0, or -1 with a message. */
static int compete(const struct contest *contest, double *ours, double *theirs, double *apart)
{
  struct gx_outcome outcome = {.status = GX_OK, .particle = -1};
  struct gx_case one = case_of(contest);
  struct gx_simulation simulation;
  struct plain *plain = NULL;
  *ours = -1;
  if (gx_simulation_plan(&simulation, &one, &outcome) == GX_OK && build(contest, &simulation, &outcome) == GX_OK)
    plain = plain_create(simulation.particles, contest->cells, modulus, density, amplitude, simulation.dt);
  if (plain) {
    *ours = time_gridcross(contest, &simulation, &outcome);
    *theirs = time_plain(contest, plain);
    *apart = difference(simulation.particles, plain);
  }
  if (*ours < 0) printf("%s: %s\n", contest->name, outcome.status == GX_OK ? "out of memory" : outcome.reason);
  plain_free(plain);
  gx_simulation_free(&simulation);
  return *ours < 0 ? -1 : 0;
}

static int ascending(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Prints a line of the table; returns whether gridcross and the plain loop agree. */
static bool report(const struct contest *contest, int repetitions)
{
  double ours[MOST_REPETITIONS], theirs[MOST_REPETITIONS], worst = 0, apart = INFINITY;
  for (int r = 0; r < repetitions; r++) {
    if (compete(contest, &ours[r], &theirs[r], &apart)) return false;
    worst = fmax(worst, apart);
  }
  qsort(ours, (size_t)repetitions, sizeof *ours, ascending);
  qsort(theirs, (size_t)repetitions, sizeof *theirs, ascending);
  double particles = pow(contest->cells * contest->per_cell, contest->dim);
  double scale = 1 / (particles * (double)contest->steps);
  int middle = repetitions / 2;
  bool agree = worst <= tolerance;
  printf("%-26s %7.2f %7.2f %6.2f   %7.2f %7.2f %6.2f   %.1e%s\n", contest->name, scale * theirs[0], scale * ours[0],
         ours[0] / theirs[0], scale * theirs[middle], scale * ours[middle], ours[middle] / theirs[middle], worst,
         agree ? "" : "  DISAGREE");
  fflush(stdout);
  return agree;
}

int main(int count, char **argument)
{
  int repetitions = count > 1 ? atoi(argument[1]) : 12;
  if (repetitions < 1 || repetitions > MOST_REPETITIONS / SHORT || count > 3) {
    fprintf(stderr, "usage: bench [REPETITIONS [NAME]]; 1 to %d repetitions\n", MOST_REPETITIONS / SHORT);
    return 2;
  }
  printf("ns per particle-step, %d repetitions (1-D: %d); apart: largest difference of u over the amplitude\n", repetitions,
         SHORT * repetitions);
  printf("%-26s %7s %7s %6s   %7s %7s %6s\n", "", "minimum", "", "", "median", "", "");
  printf("%-26s %7s %7s %6s   %7s %7s %6s   %s\n", "", "plain", "ours", "ratio", "plain", "ours", "ratio", "apart");
  bool agree = true;
  for (size_t i = 0; i < sizeof contests / sizeof *contests; i++)
    if (count < 3 || strstr(contests[i].name, argument[2]))
      agree = report(&contests[i], contests[i].dim == 1 ? SHORT * repetitions : repetitions) && agree;
  return !agree;
}
