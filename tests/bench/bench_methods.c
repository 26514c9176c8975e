/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every space with every basis in 1-D to 3-D: ns per particle-step, beside the plain loop where there is one, beside what the machine
 * can do, and what a second thread gains. Peaks are measured in the same process by one thread: products and sums that wait for
 * nothing (no FMA, which gridcross does not use either), and a = b + s c out of memory. Against them stand
 *   the flops of the sums over weights as written, those of the weights themselves, of stress and of body force not counted: sums that
 *   are factored by direction make fewer, and so can pass 1;
 *   the bytes of the state that a step has to read and to write once; a problem that fits in cache is not held up by them.
 * Spline spaces solve for their fields, and are not counted in flops.
 * usage: bench_methods [REPETITIONS] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "core/kernel.h"
#include "core/team.h"
#include "plain.h"
#include "study/simulation_plan.h"

static const double modulus = 1e4, density = 1, amplitude = 0.05;
static const int cells_of[] = {0, 256, 64, 20}, per_cell_of[] = {0, 4, 2, 2}, steps_of[] = {0, 400, 20, 4};

struct loop {
  const char *space, *basis;
  int dim;
  void (*start)(struct plain *plain); /* NULL: nothing to do */
  void (*step)(struct plain *plain);
};

static const struct loop loops[] = {
    {"standard", "linear", 1, NULL, plain_standard_linear},
    {"standard", "bspline", 1, NULL, plain_standard_quadratic},
    {"standard", "bspline", 3, NULL, plain_standard_3d},
    {"moving-mesh", "linear", 1, plain_moving_mesh_linear_start, plain_moving_mesh_linear},
    {"moving-mesh", "bspline", 1, plain_moving_mesh_quadratic_start, plain_moving_mesh_quadratic},
    {"moving-mesh", "bspline", 3, plain_moving_mesh_3d_start, plain_moving_mesh_3d},
};

struct peaks {
  double flops, bytes; /* 1/ns */
};

struct row {
  const char *space, *basis;
  int dim;
  double ours, on_wall, of_two, plain; /* least ns per particle-step; INFINITY: not measured */
};

typedef double lanes __attribute__((vector_size(64)));

/* Chains of a product and a sum each. */
GX_CORE double multiply_and_add(const int chains, long rounds)
{
  enum { WIDTH = sizeof(lanes) / sizeof(double), MOST = 12 };
  lanes value[MOST], factor, addend, sum = {0};
  for (int i = 0; i < WIDTH; i++) {
    factor[i] = 0.999;
    addend[i] = 1e-3;
  }
  for (int c = 0; c < chains; c++) value[c] = c * addend;
  for (long k = 0; k < rounds; k++)
    for (int c = 0; c < chains; c++) value[c] = value[c] * factor + addend;
  for (int c = 0; c < chains; c++) sum += value[c];
  return sum[0] + sum[WIDTH - 1];
}

/* As many as registers hold, of 16 and of 32: the more there are, the less do units wait. */
GX_CLONES static double six_chains(long rounds)
{
  return multiply_and_add(6, rounds);
}

GX_CLONES static double twelve_chains(long rounds)
{
  return multiply_and_add(12, rounds);
}

GX_CLONES static void triad(size_t n, const double *restrict b, const double *restrict c, double *restrict a)
{
  for (size_t i = 0; i < n; i++) a[i] = b[i] + 3 * c[i];
}

static struct peaks measure_peaks(void)
{
  const long rounds = 1000000, flops = 2 * (long)(sizeof(lanes) / sizeof(double)); /* of a link of a chain */
  const size_t n = 8u << 20;
  struct peaks peaks = {0};
  double *array = calloc(3 * n, sizeof *array);
  volatile double keep = 0;
  if (!array) exit(1);
  for (int r = 0; r < 8; r++) {
    double before = bench_now(CLOCK_THREAD_CPUTIME_ID);
    keep += six_chains(rounds);
    peaks.flops = fmax(peaks.flops, (double)(6 * rounds * flops) / (bench_now(CLOCK_THREAD_CPUTIME_ID) - before));
    before = bench_now(CLOCK_THREAD_CPUTIME_ID);
    keep += twelve_chains(rounds);
    peaks.flops = fmax(peaks.flops, (double)(12 * rounds * flops) / (bench_now(CLOCK_THREAD_CPUTIME_ID) - before));
    before = bench_now(CLOCK_THREAD_CPUTIME_ID);
    triad(n, array, array + n, array + 2 * n);
    peaks.bytes = fmax(peaks.bytes, (double)(3 * n * sizeof(double)) / (bench_now(CLOCK_THREAD_CPUTIME_ID) - before));
    keep += array[2 * n + (size_t)r];
  }
  free(array);
  if (isnan(keep)) exit(1);
  return peaks;
}

static struct gx_case case_of(const struct row *row)
{
  struct gx_case one = {0};
  one.value[GX_PROBLEM_NAME] = bench_text("axis-aligned");
  one.value[GX_PROBLEM_DIMENSION] = bench_integer(row->dim);
  one.value[GX_PROBLEM_AMPLITUDE] = bench_real(amplitude);
  one.value[GX_PROBLEM_MODULUS] = bench_real(modulus);
  one.value[GX_PROBLEM_DENSITY] = bench_real(density);
  one.value[GX_MESH_CELLS] = bench_integer(cells_of[row->dim]);
  one.value[GX_MESH_PARTICLES_PER_CELL] = bench_integer(per_cell_of[row->dim]);
  one.value[GX_METHOD_SPACE] = bench_text(row->space);
  one.value[GX_TIME_CFL] = bench_real(0.1); /* stable for splines through particles, which are closer than nodes */
  if (*row->basis) one.value[GX_METHOD_BASIS] = bench_text(row->basis);
  gx_parameter_resolve(one.value);
  return one;
}

static void time_plain(struct row *row, const struct gx_simulation *simulation)
{
  const struct loop *loop = loops, *end = loops + sizeof loops / sizeof *loops;
  while (loop < end && (strcmp(loop->space, row->space) || strcmp(loop->basis, row->basis) || loop->dim != row->dim)) loop++;
  if (loop == end) return;
  struct plain *plain = plain_create(simulation->particles, cells_of[row->dim], modulus, density, amplitude, simulation->dt);
  if (!plain) exit(1);
  if (loop->start) loop->start(plain);
  loop->step(plain);
  const double before = bench_now(CLOCK_THREAD_CPUTIME_ID);
  for (int k = 0; k < steps_of[row->dim]; k++) loop->step(plain);
  row->plain = fmin(row->plain, (bench_now(CLOCK_THREAD_CPUTIME_ID) - before) / (steps_of[row->dim] * (double)plain->n));
  plain_free(plain);
}

/* One run of the method, of the plain loop too if without team. Returns whether there is such a method. */
static bool time_once(struct row *row, struct gx_team *team)
{
  struct gx_case one = case_of(row);
  struct gx_simulation simulation;
  struct gx_outcome outcome = {.status = GX_OK, .particle = -1};
  struct gx_stepper *stepper = NULL;
  bool is = gx_simulation_plan(&simulation, &one, &outcome) == GX_OK;
  if (is) simulation.space_options.team = team;
  is = is && gx_simulation_build(&simulation, &outcome) == GX_OK;
  if (is && !team) time_plain(row, &simulation); /* while the particles are where they start */
  if (is) stepper = gx_stepper_create(simulation.clock, simulation.space, NULL);
  is = is && stepper && gx_stepper_step(stepper, 0, simulation.dt) == GX_OK; /* touches all memory */
  if (is) {
    const double processor = bench_now(CLOCK_THREAD_CPUTIME_ID), wall = bench_now(CLOCK_MONOTONIC);
    for (int k = 1; k <= steps_of[row->dim] && is; k++) is = gx_stepper_step(stepper, k * simulation.dt, simulation.dt) == GX_OK;
    const double particle_steps = steps_of[row->dim] * (double)simulation.particles->n;
    double *least = team ? &row->of_two : &row->on_wall;
    *least = fmin(*least, (bench_now(CLOCK_MONOTONIC) - wall) / particle_steps);
    if (!team) row->ours = fmin(row->ours, (bench_now(CLOCK_THREAD_CPUTIME_ID) - processor) / particle_steps);
  }
  gx_stepper_free(stepper);
  gx_simulation_free(&simulation);
  if (outcome.status != GX_OK && outcome.status != GX_REFUSED) {
    printf("%s %s %d-D: %s\n", row->space, row->basis, row->dim, outcome.reason);
    exit(1);
  }
  return is;
}

/* Sums over the functions that a particle meets: components of mass, momentum, force, velocity, acceleration and gradient. */
static double flops_of(const struct row *row)
{
  const int dim = row->dim, support = !strcmp(row->basis, "linear") ? 2 : 3;
  const int sums = strcmp(row->space, "standard") ? 2 * dim * dim + dim : 1 + 4 * dim + 2 * dim * dim;
  return *row->basis ? 2 * sums * pow(support, dim) : 0;
}

/* u, v and F of a particle, there and back, its mass and volume; on the moving mesh u, v of its share of the nodes, there and back,
 * and a; both with two tables of the problem. */
static double bytes_of(const struct row *row)
{
  const int dim = row->dim, fixed = 2 + 2 * dim;
  const double nodes = 1 / pow(per_cell_of[dim], dim);
  return 8 * (fixed + (strcmp(row->space, "moving-mesh") ? 2 * (2 * dim + dim * dim) : 5 * dim * nodes));
}

static void print_cell(int width, int digits, double value, bool known)
{
  if (known)
    printf(" %*.*f", width, digits, value);
  else
    printf(" %*s", width, "-");
}

static void report(struct row row, const struct peaks *peaks, int repetitions, struct gx_team *team)
{
  row.ours = row.on_wall = row.of_two = row.plain = INFINITY;
  for (int r = 0; r < repetitions; r++) {
    if (!time_once(&row, NULL)) return;
    if (row.dim > 1) time_once(&row, team);
  }
  printf("%-16s %-8s %d-D", row.space, *row.basis ? row.basis : "-", row.dim);
  print_cell(8, 2, row.ours, true);
  print_cell(8, 2, row.plain, isfinite(row.plain));
  print_cell(6, 2, row.ours / row.plain, isfinite(row.plain));
  print_cell(7, 3, flops_of(&row) / row.ours / peaks->flops, *row.basis);
  print_cell(7, 3, bytes_of(&row) / row.ours / peaks->bytes, true);
  print_cell(8, 2, row.on_wall / row.of_two, row.dim > 1);
  printf("\n");
  fflush(stdout);
}

int main(int count, char **argument)
{
  static const char *const spaces[] = {"standard", "moving-mesh", "spline-grid", "spline-particle"};
  const int repetitions = count > 1 ? atoi(argument[1]) : 5;
  if (repetitions < 1 || count > 2) {
    fputs("usage: bench_methods [REPETITIONS]\n", stderr);
    return 2;
  }
  gx_status_quiet_gsl();
  const struct peaks peaks = measure_peaks();
  struct gx_team *team = gx_team_create(2);
  printf("peaks of one thread: %.1f Gflop/s, %.1f GB/s; lumped mass, degree 2, splines of degree 5; minima of %d\n"
         "%-16s %-8s %3s %8s %8s %6s %7s %7s %8s\n%-16s %-8s %3s %8s %8s %6s %7s %7s %8s\n",
         peaks.flops, peaks.bytes, repetitions, "", "", "", "ns", "plain", "ratio", "of peak", "of peak", "speed-up", "space",
         "basis", "", "", "", "", "flops", "bytes", "of two");
  for (int s = 0; s < 4; s++)
    for (int dim = 1; dim <= GX_MAX_DIM; dim++)
      for (size_t b = 0; s < 2 ? gx_basis_family[b] != NULL : b < 1; b++)
        report((struct row){.space = spaces[s], .basis = s < 2 ? gx_basis_family[b]->name : "", .dim = dim}, &peaks, repetitions,
               team);
  gx_team_free(team);
  return 0;
}
