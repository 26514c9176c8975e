/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planning and running one case. A method that fails ends the case with a status; nothing here aborts. */
#include <gridcross/study.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <gsl/gsl_statistics_double.h>

#include "simulation.h"
#include "stability.h"

struct run {
  struct gx_simulation simulation;
  struct gx_stepper *stepper;
  struct gx_measure *measure;
  struct gx_result *result;
  enum gx_measure_level level;
  double history_every;   /* steps; 0: none */
  const char *accumulate; /* time.accumulate */
  double time, lost;      /* s; lost: what compensated summation carries */
  double kinetic_limit;   /* J */
  double samples, timed;  /* taken; whose cost was read from the clock */
  double timed_seconds;   /* of processor time */
  double jump_seconds;    /* the same, of measuring jumps */
};

/* Of this thread's own work: other cases and other programs do not count. */
static double seconds_now(void)
{
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static enum gx_measure_level level_of(const struct gx_case *one)
{
  const char *level = one->value[GX_OUTPUT_MEASURES].text;
  return !strcmp(level, "final") ? GX_MEASURE_FINAL : !strcmp(level, "max") ? GX_MEASURE_MAX : GX_MEASURE_ALL;
}

/* The particle whose reference position is nearest to the coordinates in a text of one number a dimension. */
static size_t nearest_particle(const struct gx_particles *particles, const char *text)
{
  double point[GX_MAX_DIM], least = INFINITY;
  size_t nearest = 0;
  for (int d = 0; d < particles->dim; d++) {
    char *rest;
    point[d] = strtod(text, &rest);
    text = rest;
  }
  for (size_t p = 0; p < particles->n; p++) {
    double square = 0;
    for (int d = 0; d < particles->dim; d++) square += (particles->X[d][p] - point[d]) * (particles->X[d][p] - point[d]);
    if (square < least) {
      least = square;
      nearest = p;
    }
  }
  return nearest;
}

static enum gx_status prepare_history(struct run *run)
{
  struct gx_history *history = &run->result->history;
  double samples = floor(run->simulation.steps / run->history_every) + 2;
  bool probed = run->result->probe >= 0, fits = samples < 1e9;
  history->jumps = run->simulation.jumps;
  history->dim = run->simulation.particles->dim;
  history->sample = fits ? malloc((size_t)samples * sizeof *history->sample) : NULL;
  history->probe = fits && probed ? malloc((size_t)samples * sizeof *history->probe) : NULL;
  if (history->sample && (history->probe || !probed)) return GX_OK;
  return gx_status_set(&run->result->outcome, GX_FAILED, -1, "out of memory for %.3g history samples", samples);
}

/* refine: divides the time step. */
static enum gx_status prepare(struct run *run, const struct gx_case *one, double refine)
{
  struct gx_simulation *simulation = &run->simulation;
  struct gx_outcome *outcome = &run->result->outcome;
  GX_TRY(gx_simulation_plan(simulation, one, outcome));
  simulation->dt /= refine;
  simulation->steps *= refine;
  run->result->dt = simulation->dt;
  run->result->time = run->time = simulation->start;
  GX_TRY(gx_simulation_build(simulation, outcome));
  run->level = level_of(one);
  run->history_every = (double)one->value[GX_OUTPUT_HISTORIES].integer;
  run->accumulate = one->value[GX_TIME_ACCUMULATE].text;
  const int *cells = simulation->space->through_cells ? simulation->space_options.cells : NULL;
  run->measure = gx_measure_create(simulation->space, simulation->clock, cells, run->level);
  if (!run->measure) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the measures");
  struct gx_work_observer observer = gx_measure_work(run->measure);
  run->stepper = gx_stepper_create(simulation->clock, simulation->space, &observer);
  if (!run->stepper) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the clock");
  if (one->value[GX_OUTPUT_PROBE].type == GX_TEXT) {
    run->result->probe = (long)nearest_particle(simulation->particles, one->value[GX_OUTPUT_PROBE].text);
    gx_measure_follow(run->measure, (size_t)run->result->probe);
  }
  if (simulation->jumps && gx_measure_jumps(run->measure))
    return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the jumps");
  if (run->history_every > 0) GX_TRY(prepare_history(run));
  double m = 0, c = simulation->posed->speed;
  for (size_t p = 0; p < simulation->particles->n; p++) m += simulation->particles->m[p];
  /* 5 times the exact solution's speed, and room for round-off when it does not move */
  run->kinetic_limit = 25 * gx_simulation_kinetic_bound(simulation) + 0.5 * m * 1e-12 * c * c;
  return GX_OK;
}

/* Reading the clock costs as much as a step of a hundred particles: after the first samples it is read at some only. */
static bool is_timed(double samples)
{
  const double some = 16;
  return samples < some || fmod(samples, some) == 0;
}

static double measuring_seconds(const struct run *run)
{
  return run->timed > 0 ? run->timed_seconds * run->samples / run->timed : 0;
}

static enum gx_status take_sample(struct run *run, double step)
{
  const struct gx_simulation *simulation = &run->simulation;
  bool last = step == simulation->steps;
  bool kept = run->history_every > 0 && (last || fmod(step, run->history_every) == 0);
  if (run->level == GX_MEASURE_FINAL && !last && !kept) return GX_OK;
  bool reused = gx_stepper_starts_accelerated(run->stepper); /* by the next step: not a cost of measuring */
  bool timed = is_timed(run->samples++);
  if (reused) GX_TRY(gx_stepper_accelerate(run->stepper, run->time));
  double reading = timed ? seconds_now() : 0, before = timed ? seconds_now() : 0;
  GX_TRY(gx_measure_take(run->measure, run->stepper, run->time, simulation->dt));
  if (timed) run->timed_seconds += seconds_now() - before - (before - reading);
  run->timed += timed;
  struct gx_history *history = &run->result->history;
  if (kept && history->probe) history->probe[history->samples] = *gx_measure_probe(run->measure);
  if (kept) history->sample[history->samples++] = gx_measure_result(run->measure)->last;
  return GX_OK;
}

static void advance_time(struct run *run, double step)
{
  double dt = run->simulation.dt;
  if (!strcmp(run->accumulate, "sum")) {
    run->time += dt;
  } else if (!strcmp(run->accumulate, "compensated")) {
    double correction = dt - run->lost, sum = run->time + correction;
    run->lost = (sum - run->time) - correction;
    run->time = sum;
  } else {
    run->time = run->simulation.start + step * dt;
  }
}

static void measure_jumps(struct run *run)
{
  double before = seconds_now();
  gx_measure_step(run->measure, run->simulation.dt);
  run->jump_seconds += seconds_now() - before;
}

static enum gx_status take_steps(struct run *run)
{
  const struct gx_simulation *simulation = &run->simulation;
  struct gx_result *result = run->result;
  GX_TRY(take_sample(run, 0));
  for (double step = 1; step <= simulation->steps; step++) {
    GX_TRY(gx_stepper_step(run->stepper, run->time, simulation->dt));
    if (simulation->jumps) measure_jumps(run);
    advance_time(run, step);
    result->steps = step;
    result->time = run->time;
    double kinetic = simulation->kind->kinetic(simulation->space);
    if (isnan(kinetic)) return gx_status_set(&result->outcome, GX_UNSTABLE, -1, "a velocity is not a number");
    if (!(kinetic <= run->kinetic_limit))
      return gx_status_set(&result->outcome, GX_UNSTABLE, -1, "kinetic energy %.4g J, over 25 times the exact solution's",
                           kinetic);
    GX_TRY(take_sample(run, step));
  }
  return GX_OK;
}

static enum gx_status march(struct run *run)
{
  struct gx_result *result = run->result;
  double before = seconds_now();
  enum gx_status status = take_steps(run);
  result->seconds = seconds_now() - before - measuring_seconds(run) - run->jump_seconds;
  if (result->steps > 0)
    result->ns_per_particle_step = 1e9 * result->seconds / (result->steps * (double)run->simulation.particles->n);
  return status;
}

static void finish(struct run *run)
{
  gx_stepper_free(run->stepper);
  gx_measure_free(run->measure);
  gx_simulation_free(&run->simulation);
}

/* What a step of a splitting drifts with kicks that no projection has seen, over dt^2 a. Beside the projected motion it damps where
 * it is positive; where it is negative (rkn3, pefrl) modes that projection weakens grow at any step. */
static double unprojected_drift(const struct gx_splitting *splitting)
{
  double sum = 0;
  for (int j = 0; j < splitting->stages; j++) sum += splitting->kick[j] * splitting->drift[j + 1];
  return sum;
}

/* Few steps of many particles cost less than the power iteration, whose answer they do not need. */
static bool is_worth_an_estimate(const struct gx_simulation *simulation)
{
  const double blink = 1e7; /* particle evaluations: tenths of a second */
  double particles = pow((double)simulation->space_options.cells[0] * simulation->per_cell, simulation->problem_options.dim);
  return simulation->steps >= GX_STABILITY_EVALUATIONS || particles * GX_STABILITY_EVALUATIONS <= blink;
}

/* The largest stable step, 0 when there is none, estimated on a fresh copy of the case; NaN where that would cost more than
 * the run. Projecting particle velocities to nodes multiplies a mode by
 * lambda in [0, 1]; with K its stiffness, rates see the frequency sqrt(lambda K). But a clock of kicks drifts with the kick it has
 * just given to the nodes, which is not projected: a step has trace 2 - dt^2 K and determinant 1 - dt^2 K (1 - lambda), and is
 * stable for dt^2 K (2 - lambda) < 4. Taken here: lambda = 0, which is safe, and K as if nodal velocities were
 * carried; with linear elements, whose highest frequency has lambda = 1/3, that is 9 % too small. */
static double estimate_stable_dt(const struct gx_case *one)
{
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  double dt = NAN;
  bool planned = gx_simulation_plan(&simulation, one, &outcome) == GX_OK;
  if (planned && simulation.problem->cycles > 0 && is_worth_an_estimate(&simulation)) { /* without period nothing vibrates */
    bool projected = simulation.space_options.each_step && !simulation.clock->tableau;
    if (projected) simulation.space_options.each_step = false;
    if (projected && simulation.clock->splitting && unprojected_drift(simulation.clock->splitting) < 0)
      dt = 0;
    else if (gx_simulation_build(&simulation, &outcome) == GX_OK)
      dt = simulation.clock->stability / gx_stability_frequency(simulation.space) * (projected ? M_SQRT1_2 : 1);
  }
  gx_simulation_free(&simulation);
  return dt;
}

static struct gx_case without_measures(const struct gx_case *one)
{
  struct gx_case bare = *one;
  bare.value[GX_OUTPUT_MEASURES].text = "final";
  bare.value[GX_OUTPUT_HISTORIES].integer = 0;
  bare.value[GX_OUTPUT_PROBE].type = bare.value[GX_OUTPUT_JUMPS].type = GX_NULL;
  return bare;
}

/* The same case with a finer step, up to the same end; result->reference is the difference of the final states. */
static void compare_with_reference(const struct run *run, const struct gx_case *one, double refine)
{
  struct gx_case bare = without_measures(one);
  struct gx_result result = {.outcome = {.status = GX_OK, .particle = -1}};
  struct run fine = {.result = &result};
  if (prepare(&fine, &bare, refine) == GX_OK && march(&fine) == GX_OK)
    gx_measure_difference(run->measure, fine.measure, run->result->reference);
  else
    snprintf(run->result->outcome.reason, GX_REASON_LENGTH, "no reference: at dt/%g %s, %.180s", refine,
             gx_status_name(result.outcome.status), result.outcome.reason);
  finish(&fine);
}

struct gx_result gx_case_run(const struct gx_case *one)
{
  struct gx_result result = {
      .outcome = {.status = GX_OK, .particle = -1}, .dt = NAN, .stable_dt = NAN, .probe = -1, .ns_per_particle_step = NAN};
  for (int q = 0; q < GX_QUANTITIES; q++)
    for (int k = 0; k < GX_NORMS; k++) result.reference[q][k] = NAN;
  struct run run = {.result = &result};
  if (prepare(&run, one, 1) == GX_OK) {
    double refine = (double)one->value[GX_OUTPUT_REFERENCE].integer;
    bool done = march(&run) == GX_OK;
    result.measured = *gx_measure_result(run.measure);
    if (done && refine > 0) compare_with_reference(&run, one, refine);
    result.stable_dt = estimate_stable_dt(one);
  }
  finish(&run);
  return result;
}

void gx_case_time(const struct gx_case *one, size_t repeats, struct gx_result *result)
{
  double *seconds = result->outcome.status == GX_OK && repeats ? calloc(2 * repeats, sizeof *seconds) : NULL;
  if (!seconds) return;
  double *cost = seconds + repeats;
  struct gx_case bare = without_measures(one);
  size_t done = 0;
  for (; done < repeats; done++) {
    struct gx_result again = {.outcome = {.status = GX_OK, .particle = -1}};
    struct run run = {.result = &again};
    bool failed = prepare(&run, &bare, 1) != GX_OK || march(&run) != GX_OK;
    finish(&run);
    if (failed) break; /* out of memory: the case itself ran */
    seconds[done] = again.seconds;
    cost[done] = again.ns_per_particle_step;
  }
  if (done == repeats) {
    result->seconds = gsl_stats_median(seconds, 1, repeats);
    result->ns_per_particle_step = gsl_stats_median(cost, 1, repeats);
  }
  free(seconds);
}

void gx_case_free(struct gx_result *result)
{
  free(result->history.sample);
  free(result->history.probe);
  result->history = (struct gx_history){0};
}

struct gx_plan gx_case_plan(const struct gx_case *one)
{
  struct gx_plan plan = {.outcome = {.status = GX_OK, .particle = -1}, .stable_dt = NAN, .growth = NAN};
  struct gx_simulation simulation;
  if (gx_simulation_plan(&simulation, one, &plan.outcome) == GX_OK && gx_simulation_build(&simulation, &plan.outcome) == GX_OK) {
    plan.particles = (double)simulation.particles->n;
    plan.stable_dt = estimate_stable_dt(one);
    if (!simulation.space->through_cells)
      plan.growth = gx_stability_growth(simulation.space); /* else it sees the flow's own stretching */
  }
  plan.dt = simulation.dt;
  plan.end = simulation.end;
  plan.steps = simulation.steps;
  gx_simulation_free(&simulation);
  return plan;
}
