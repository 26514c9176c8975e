/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running one case. A method that fails ends the case with a status; nothing here aborts. */
#include <gridcross/study.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_statistics_double.h>

#include "../measures/restitution.h"
#include "history.h"
#include "kept.h"
#include "simulation_plan.h"
#include "stable_dt.h"
#include "stopwatch.h"
#include "watch.h"

struct run {
  struct gx_case_means means;
  struct gx_simulation simulation;
  struct gx_stepper *stepper;
  struct gx_measure *measure;
  struct gx_budget *budget;         /* NULL: not asked */
  struct gx_budget_values budgeted; /* of the step under way; NaN: not due */
  struct gx_result *result;
  enum gx_measure_level level;
  double history_every; /* steps; 0: none; the same below */
  double spectra_every;
  double frequency_every;
  double budget_every;
  double samples_kept, spectra_kept; /* room for so many */
  struct gx_watch watch;
  struct gx_spectrum *spectrum;
  struct gx_restitution *restitution; /* NULL: there are no two bodies */
  struct gx_frequency frequency;
  bool summed, compensated; /* time.accumulate; neither: product */
  double time, lost;        /* s; lost: what compensated summation carries */
  double kinetic_limit;     /* J */
  double kept;              /* steps, at the last checkpoint */
  struct gx_stopwatch stopwatch;
};

static bool is_cancelled(const struct gx_case_means *means)
{
  return means->cancel && atomic_load_explicit(means->cancel, memory_order_relaxed);
}

static enum gx_measure_level level_of(const struct gx_case *one)
{
  const char *level = one->value[GX_OUTPUT_MEASURES].text;
  return !strcmp(level, "final") ? GX_MEASURE_FINAL : !strcmp(level, "max") ? GX_MEASURE_MAX : GX_MEASURE_ALL;
}

/* The particle whose reference position is nearest to the coordinates in a text of one number a dimension. point: them. */
static size_t nearest_particle(const struct gx_particles *particles, const char *text, double *point)
{
  double least = INFINITY;
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

/* refine: divides the time step. */
static enum gx_status prepare(struct run *run, const struct gx_case *one, double refine)
{
  struct gx_simulation *simulation = &run->simulation;
  struct gx_outcome *outcome = &run->result->outcome;
  GX_TRY(gx_simulation_plan(simulation, one, outcome));
  simulation->space_options.team = run->means.team;
  simulation->dt /= refine;
  simulation->steps *= refine;
  run->result->dt = simulation->dt;
  run->result->time = run->time = simulation->start;
  GX_TRY(gx_simulation_build(simulation, outcome));
  GX_TRY(gx_kept_refuse(simulation, one, outcome));
  run->level = level_of(one);
  run->stopwatch = gx_stopwatch_of(run->means.team, simulation->steps * (double)simulation->particles->n);
  run->history_every = (double)one->value[GX_OUTPUT_HISTORIES].integer;
  run->spectra_every = (double)one->value[GX_OUTPUT_SPECTRA].integer;
  run->frequency_every = (double)one->value[GX_OUTPUT_FREQUENCY].integer;
  run->budget_every = one->value[GX_OUTPUT_BUDGET].type == GX_INTEGER ? (double)one->value[GX_OUTPUT_BUDGET].integer : 0;
  run->summed = !strcmp(one->value[GX_TIME_ACCUMULATE].text, "sum");
  run->compensated = !strcmp(one->value[GX_TIME_ACCUMULATE].text, "compensated");
  const int *cells = simulation->space->through_cells ? simulation->space_options.cells : NULL;
  run->measure = gx_measure_create(simulation->space, simulation->clock, cells, run->level);
  if (!run->measure) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the measures");
  bool linear, angular;
  gx_simulation_conserves(simulation, &linear, &angular);
  gx_measure_momentum(run->measure, linear, angular);
  struct gx_work_observer observer = gx_measure_work(run->measure);
  run->stepper = gx_stepper_create(simulation->clock, simulation->space, &observer);
  if (!run->stepper) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the clock");
  if (one->value[GX_OUTPUT_PROBE].type == GX_TEXT) {
    double place[GX_MAX_DIM];
    run->result->probe = (long)nearest_particle(simulation->particles, one->value[GX_OUTPUT_PROBE].text, place);
    if (gx_measure_follow(run->measure, (size_t)run->result->probe, place))
      return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the probe");
  }
  if (simulation->jumps && gx_measure_jumps(run->measure))
    return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the jumps");
  if (run->budget_every > 0)
    GX_TRY(gx_budget_create(&run->budget, simulation->space, &simulation->space_options, simulation->clock, outcome));
  if (run->budget && simulation->jumps) gx_budget_jumps(run->budget);
  if (simulation->problem->second && !(run->restitution = gx_restitution_create(simulation->space)))
    return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the restitution");
  run->samples_kept = gx_kept_samples(simulation, one);
  run->spectra_kept = gx_kept_spectra(simulation, one);
  if (run->samples_kept > 0) GX_TRY(gx_history_begin(run->result, simulation, run->samples_kept, run->budget));
  if (run->spectra_kept > 0) GX_TRY(gx_history_begin_spectra(run->result, simulation, run->spectra_kept, &run->spectrum));
  GX_TRY(gx_watch_begin(&run->watch, simulation, one, run->measure, run->means.observer, outcome));
  run->frequency.interval = run->frequency_every * simulation->dt;
  double m = 0, c = simulation->posed->speed;
  for (size_t p = 0; p < simulation->particles->n; p++) m += simulation->particles->m[p];
  /* 5 times the exact solution's speed, and room for round-off when it does not move */
  run->kinetic_limit = 25 * gx_simulation_kinetic_bound(simulation) + 0.5 * m * 1e-12 * c * c;
  return GX_OK;
}

static bool is_due(double every, double step)
{
  return every > 0 && fmod(step, every) == 0;
}

static void take_spectrum(struct run *run)
{
  struct gx_spectra *spectra = &run->result->spectra;
  if ((double)spectra->samples >= run->spectra_kept) return;
  const double before = gx_stopwatch_now(&run->stopwatch);
  spectra->time[spectra->samples] = run->time;
  gx_spectrum_take(run->spectrum, run->measure, spectra->rms + spectra->samples * GX_QUANTITIES * spectra->bins);
  spectra->samples++;
  gx_stopwatch_observed(&run->stopwatch, before);
}

static enum gx_status show(struct run *run, double step)
{
  const double before = gx_stopwatch_now(&run->stopwatch);
  enum gx_status status = gx_watch_show(&run->watch, step, run->time, run->simulation.dt, &run->result->outcome);
  gx_stopwatch_observed(&run->stopwatch, before);
  return status;
}

/* The step that ends there, whose budget was taken. */
static bool is_budgeted(const struct run *run, double step)
{
  return run->budget && step > 0 && (is_due(run->budget_every, step) || step == run->simulation.steps);
}

/* Of the step to come, before the run can fail in it. */
static enum gx_status take_budget(struct run *run, double step)
{
  const struct gx_simulation *simulation = &run->simulation;
  run->budgeted = (struct gx_budget_values){.time = NAN};
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++) run->budgeted.value[i] = NAN;
  if (!is_budgeted(run, step)) return GX_OK;
  const double before = gx_stopwatch_now(&run->stopwatch);
  if (gx_budget_take(run->budget, run->time, simulation->dt, &run->budgeted))
    return gx_status_set(&run->result->outcome, GX_FAILED, -1, "out of memory for the budget");
  gx_stopwatch_observed(&run->stopwatch, before);
  return GX_OK;
}

/* Sums of squares over all particles: one that is not a number shows in them. */
static enum gx_status refuse_nonsense(struct run *run)
{
  const struct gx_problem *problem = run->simulation.problem;
  const struct gx_sample *sample = &gx_measure_result(run->measure)->last;
  for (int q = 0; q < GX_QUANTITIES && problem->exact; q++)
    if ((q != GX_STRESS || problem->material->piola) && !isfinite(sample->error[q][GX_RMS]))
      return gx_status_set(&run->result->outcome, GX_UNSTABLE, -1, "the error of %s is not a finite number",
                           gx_measure_quantity[q].name);
  return GX_OK;
}

static enum gx_status take_sample(struct run *run, double step)
{
  const struct gx_simulation *simulation = &run->simulation;
  bool last = step == simulation->steps;
  bool kept = is_due(run->history_every, step) || (last && run->history_every > 0) || is_budgeted(run, step);
  bool transformed = is_due(run->spectra_every, step) || (last && run->spectra_every > 0);
  bool shown = gx_watch_is_due(&run->watch, step, last);
  if (run->level == GX_MEASURE_FINAL && !last && !kept && !transformed && !shown) return GX_OK;
  bool reused = gx_stepper_starts_accelerated(run->stepper); /* by the next step: not a cost of measuring */
  if (reused) GX_TRY(gx_stepper_accelerate(run->stepper, run->time));
  const struct gx_stopwatch_sample taken = gx_stopwatch_sample_begin(&run->stopwatch);
  GX_TRY(gx_measure_take(run->measure, run->stepper, run->time, simulation->dt));
  gx_stopwatch_sample_end(&run->stopwatch, &taken);
  GX_TRY(refuse_nonsense(run));
  struct gx_history *history = &run->result->history;
  kept = kept && (double)history->samples < run->samples_kept; /* a checkpoint may claim more */
  if (kept && history->probe) history->probe[history->samples] = *gx_measure_probe(run->measure);
  if (kept && history->budget) history->budget[history->samples] = run->budgeted;
  if (kept) history->sample[history->samples++] = gx_measure_result(run->measure)->last;
  if (transformed) take_spectrum(run);
  return shown ? show(run, step) : GX_OK;
}

static void sample_frequency(struct run *run, double step)
{
  if (!is_due(run->frequency_every, step)) return;
  const double before = gx_stopwatch_now(&run->stopwatch);
  gx_frequency_add(&run->frequency, gx_frequency_project(run->simulation.space));
  gx_stopwatch_observed(&run->stopwatch, before);
}

static void advance_time(struct run *run, double step)
{
  double dt = run->simulation.dt;
  if (run->summed) {
    run->time += dt;
  } else if (run->compensated) {
    double correction = dt - run->lost, sum = run->time + correction;
    run->lost = (sum - run->time) - correction;
    run->time = sum;
  } else {
    run->time = run->simulation.start + step * dt;
  }
}

static void measure_jumps(struct run *run)
{
  const double before = gx_stopwatch_now(&run->stopwatch);
  gx_measure_step(run->measure, run->simulation.dt);
  gx_stopwatch_observed(&run->stopwatch, before);
}

/* Of the nodes by row sums, which bound what the full mass matrix gives but overstate waves of few cells: where it matters that
 * is summed over the particles. */
static double kinetic_energy(const struct run *run)
{
  struct gx_space *space = run->simulation.space;
  const struct gx_particles *particles = space->particles;
  double kinetic = space->kind->kinetic(space);
  if (kinetic <= run->kinetic_limit || !run->simulation.space_options.consistent) return kinetic;
  if (space->kind->settle) space->kind->settle(space);
  kinetic = 0;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) kinetic += 0.5 * particles->m[p] * particles->v[d][p] * particles->v[d][p];
  return kinetic;
}

/* Everything that changes from step to step; restitution, limits and rooms are those of the start. */
static void image_run(void *context, struct gx_image *image)
{
  struct run *run = context;
  GX_IMAGE(image, run->result->steps);
  GX_IMAGE(image, run->result->time);
  GX_IMAGE(image, run->time);
  GX_IMAGE(image, run->lost);
  GX_IMAGE(image, run->frequency);
  gx_stopwatch_image(&run->stopwatch, image);
  gx_history_image(run->result, run->samples_kept, run->spectra_kept, image);
  gx_measure_image(run->measure, image);
  if (run->budget) gx_budget_image(run->budget, image);
  if (gx_stepper_image(run->stepper, image) != GX_OK) image->failed = true;
  image->failed |= !(run->result->steps >= 0) || run->result->steps != floor(run->result->steps);
}

static struct gx_checkpoint checkpoint_of(struct run *run)
{
  return (struct gx_checkpoint){.step = run->result->steps, .run = run, .image = image_run};
}

/* The start, or where an earlier run of the case was. */
static enum gx_status begin_steps(struct run *run)
{
  const struct gx_checkpoint checkpoint = checkpoint_of(run);
  bool loaded;
  gx_stopwatch_begin(&run->stopwatch);
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++) run->budgeted.value[i] = NAN;
  GX_TRY(gx_watch_restore(&run->watch, &checkpoint, &loaded, &run->result->outcome));
  run->kept = run->result->steps;
  if (loaded) return GX_OK;
  GX_TRY(take_sample(run, 0));
  sample_frequency(run, 0);
  return GX_OK;
}

static enum gx_status keep(struct run *run)
{
  const struct gx_checkpoint checkpoint = checkpoint_of(run);
  const double before = gx_stopwatch_now(&run->stopwatch);
  enum gx_status status = gx_watch_keep(&run->watch, &checkpoint, &run->result->outcome);
  gx_stopwatch_observed(&run->stopwatch, before);
  run->kept = checkpoint.step;
  return status;
}

/* Before its last step; no step is lost that was taken since the last checkpoint. */
static enum gx_status leave(struct run *run)
{
  if (run->watch.keep_every > 0 && run->result->steps > run->kept) GX_TRY(keep(run));
  return gx_status_set(&run->result->outcome, GX_CANCELLED, -1, "cancelled");
}

static enum gx_status take_steps(struct run *run)
{
  const struct gx_simulation *simulation = &run->simulation;
  struct gx_result *result = run->result;
  GX_TRY(begin_steps(run));
  for (double step = result->steps + 1; step <= simulation->steps; step++) {
    if (is_cancelled(&run->means)) return leave(run);
    GX_TRY(take_budget(run, step));
    GX_TRY(gx_stepper_step(run->stepper, run->time, simulation->dt));
    if (simulation->jumps) measure_jumps(run);
    advance_time(run, step);
    result->steps = step;
    result->time = run->time;
    double kinetic = kinetic_energy(run);
    if (!isfinite(kinetic)) return gx_status_set(&result->outcome, GX_UNSTABLE, -1, "the kinetic energy is not a finite number");
    if (!(kinetic <= run->kinetic_limit))
      return gx_status_set(&result->outcome, GX_UNSTABLE, -1, "kinetic energy %.4g J, over 25 times %s", kinetic,
                           simulation->problem->exact ? "the exact solution's" : "the energy that there is");
    GX_TRY(take_sample(run, step));
    sample_frequency(run, step);
    if (step < simulation->steps && is_due(run->watch.keep_every, step)) GX_TRY(keep(run));
  }
  return GX_OK;
}

static enum gx_status march(struct run *run)
{
  struct gx_result *result = run->result;
  enum gx_status status = take_steps(run);
  result->seconds = gx_stopwatch_seconds(&run->stopwatch);
  if (result->steps > 0)
    result->ns_per_particle_step = 1e9 * result->seconds / (result->steps * (double)run->simulation.particles->n);
  return status;
}

static void finish(struct run *run)
{
  gx_watch_end(&run->watch, &run->result->outcome);
  gx_stepper_free(run->stepper);
  gx_measure_free(run->measure);
  gx_spectrum_free(run->spectrum);
  gx_budget_free(run->budget);
  gx_restitution_free(run->restitution);
  gx_simulation_free(&run->simulation);
}

static struct gx_case without_measures(const struct gx_case *one)
{
  struct gx_case bare = *one;
  bare.value[GX_OUTPUT_MEASURES].text = "final";
  bare.value[GX_OUTPUT_HISTORIES].integer = 0;
  bare.value[GX_OUTPUT_PROBE].type = bare.value[GX_OUTPUT_JUMPS].type = GX_NULL;
  bare.value[GX_OUTPUT_SPECTRA].integer = 0;
  bare.value[GX_OUTPUT_FREQUENCY].integer = 0;
  bare.value[GX_OUTPUT_BUDGET].type = bare.value[GX_OUTPUT_SNAPSHOTS].type = GX_NULL;
  bare.value[GX_OUTPUT_CHECKPOINT].type = GX_NULL;
  return bare;
}

/* The same case with a finer step, up to the same end; result->reference is the difference of the final states. */
static void compare_with_reference(const struct run *run, const struct gx_case *one, double refine)
{
  struct gx_case bare = without_measures(one);
  struct gx_result result = {.outcome = {.status = GX_OK, .particle = -1}};
  struct run fine = {.means = run->means, .result = &result};
  if (prepare(&fine, &bare, refine) == GX_OK && march(&fine) == GX_OK)
    gx_measure_difference(run->measure, fine.measure, run->result->reference);
  else if (result.outcome.status == GX_CANCELLED)
    run->result->outcome = result.outcome;
  else
    snprintf(run->result->outcome.reason, GX_REASON_LENGTH, "no reference: at dt/%g %s, %.180s", refine,
             gx_status_name(result.outcome.status), result.outcome.reason);
  finish(&fine);
}

struct gx_result gx_case_run(const struct gx_case *one)
{
  return gx_case_run_by(one, &(struct gx_case_means){0});
}

struct gx_result gx_case_run_by(const struct gx_case *one, const struct gx_case_means *means)
{
  struct gx_result result = {.outcome = {.status = GX_OK, .particle = -1},
                             .dt = NAN,
                             .stable_dt = NAN,
                             .left_cells = NAN,
                             .probe = -1,
                             .restitution = NAN,
                             .ns_per_particle_step = NAN,
                             .vibration = {NAN, NAN}};
  for (int q = 0; q < GX_QUANTITIES; q++)
    for (int k = 0; k < GX_NORMS; k++) result.reference[q][k] = NAN;
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++) result.budget.value[i] = NAN;
  struct run run = {.means = *means, .result = &result};
  const bool prepared = prepare(&run, one, 1) == GX_OK;
  if (prepared) {
    double refine = (double)one->value[GX_OUTPUT_REFERENCE].integer;
    bool done = march(&run) == GX_OK;
    result.measured = *gx_measure_result(run.measure);
    if (run.restitution) result.restitution = gx_restitution_value(run.restitution);
    if (run.simulation.space_options.reconstructed) result.left_cells = (double)run.simulation.space->left_cells;
    if (run.budget) result.budget = gx_budget_mean(run.budget);
    result.frequency = gx_simulation_frequency(&run.simulation);
    result.kh = 2 * M_PI * run.simulation.problem_options.mode / run.simulation.space_options.cells[0];
    result.vibration = gx_frequency_fit(&run.frequency, 1e-9 * fabs(run.simulation.problem_options.amplitude));
    if (done && refine > 0) compare_with_reference(&run, one, refine);
  }
  finish(&run); /* first: the estimate takes as much memory as a run */
  if (prepared && result.outcome.status != GX_CANCELLED) result.stable_dt = gx_stable_dt(one, true, means->team);
  return result;
}

void gx_case_time(const struct gx_case *one, const struct gx_case_means *means, size_t repeats, struct gx_result *result)
{
  double *seconds = result->outcome.status == GX_OK && repeats ? calloc(2 * repeats, sizeof *seconds) : NULL;
  if (!seconds) return;
  double *cost = seconds + repeats;
  struct gx_case bare = without_measures(one);
  size_t done = 0, known = 0; /* a cost lost in noise is not */
  for (; done < repeats; done++) {
    struct gx_result again = {.outcome = {.status = GX_OK, .particle = -1}};
    struct run run = {.means = *means, .result = &again};
    bool failed = prepare(&run, &bare, 1) != GX_OK || march(&run) != GX_OK;
    finish(&run);
    if (again.outcome.status == GX_CANCELLED) result->outcome = again.outcome;
    if (failed) break; /* cancelled, or out of memory: the case itself ran */
    if (isnan(again.seconds)) continue;
    seconds[known] = again.seconds;
    cost[known++] = again.ns_per_particle_step;
  }
  if (done == repeats && known > 0) {
    result->seconds = gsl_stats_median(seconds, 1, known);
    result->ns_per_particle_step = gsl_stats_median(cost, 1, known);
  }
  free(seconds);
}

void gx_case_free(struct gx_result *result)
{
  free(result->history.sample);
  free(result->history.probe);
  free(result->spectra.time);
  free(result->spectra.rms);
  free(result->history.budget);
  result->history = (struct gx_history){0};
  result->spectra = (struct gx_spectra){0};
}
