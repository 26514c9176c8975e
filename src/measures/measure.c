/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples a run at ends of steps: error norms against the exact solution, energies, the energy defect of a step, momentum, crossings.
 * Velocities that live at half steps are brought to the end of step with half a kick. */
#include <gridcross/measure.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/kernel.h"
#include "../core/large.h"
#include "../core/vector.h"
#include "bring.h"
#include "crossings.h"
#include "errors.h"
#include "jump.h"
#include "momentum.h"
#include "potential.h"

const struct gx_measure_name gx_measure_quantity[GX_QUANTITIES] = {
    [GX_DISPLACEMENT] = {"displacement", "m"}, [GX_VELOCITY] = {"velocity", "m/s"}, [GX_STRESS] = {"stress", "Pa"}};

struct vector_field {
  double *component[GX_MAX_DIM]; /* [n] each, in one block; NULL: not needed */
};

struct gx_measure {
  struct gx_space *space;
  const struct gx_clock *clock;
  enum gx_measure_level level;
  bool started;
  int dim;
  size_t n;
  double *kept;   /* [space->surveyed] of the last survey; NULL: particles are settled for samples */
  bool unsettled; /* the last sample left the particles where they were */
  double ahead;   /* s that velocities were behind then */
  double mass;    /* of all particles, kg */
  double volume;  /* gx_particles_volume */
  /* at the last sample */
  struct vector_field v;           /* of the end of step, where that is not the particles'; before it is known, a */
  struct vector_field a, a_before; /* for the energy defect; a_before: one sample earlier */
  struct vector_field cell;        /* for crossings, unwrapped */
  const int *cells;                /* per direction; NULL: particles do not move through cells */
  struct gx_jump *jump;            /* NULL: not measured */
  long followed;                   /* -1: no probe */
  double beside[GX_MAX_DIM];       /* from its X to the place asked for, m */
  struct gx_probe probe;           /* at the last sample */
  double work;                     /* of the kicks done so far, J */
  double start_energy;             /* kinetic and elastic at the first sample, J */
  double start_balance;            /* the same less work, J */
  bool linear, angular;            /* momenta that the problem keeps */
  double start_momentum[GX_MAX_DIM], start_angular[GX_MAX_DIM];
  double linear_change, angular_change; /* largest so far, kg m/s and kg m^2/s */
  double linear_size, angular_size;     /* likewise */
  double probe_a[GX_MAX_DIM];           /* at the present sample, m/s^2 */
  struct gx_measured result;
};

static int take_room(const struct gx_measure *measure, struct vector_field *field)
{
  double *block = gx_large_zeros(((size_t)measure->dim * measure->n + 1) * sizeof(double));
  for (int d = 0; block && d < measure->dim; d++) field->component[d] = block + (size_t)d * measure->n;
  return block ? 0 : -1;
}

/* Only what the level asks for: in 3-D a field takes as much as a quantity of the particles. */
static int take_rooms(struct gx_measure *measure)
{
  const bool all = measure->level == GX_MEASURE_ALL, counted = measure->cells && measure->level != GX_MEASURE_FINAL;
  if ((measure->clock->staggered || all) && take_room(measure, &measure->v)) return -1;
  if (!measure->kept && all && (take_room(measure, &measure->a) || take_room(measure, &measure->a_before))) return -1;
  return counted ? take_room(measure, &measure->cell) : 0;
}

struct gx_measure *gx_measure_create(struct gx_space *space, const struct gx_clock *clock, const int *cells,
                                     enum gx_measure_level level)
{
  struct gx_measure *measure = calloc(1, sizeof *measure);
  if (!measure) return NULL;
  const struct gx_material *material = space->posed->problem->material;
  int dim = space->particles->dim;
  size_t n = space->particles->n;
  if (level == GX_MEASURE_ALL && !space->kind->potential && !material->energy)
    level = GX_MEASURE_MAX; /* there is none to measure */
  *measure =
      (struct gx_measure){.space = space, .clock = clock, .level = level, .cells = cells, .followed = -1, .dim = dim, .n = n};
  measure->mass = gx_vector_sum(n, space->particles->m);
  measure->volume = gx_particles_volume(space->particles);
  if (space->surveyed > 0 && !cells) measure->kept = calloc(space->surveyed, sizeof(double)); /* else does without */
  if (take_rooms(measure)) {
    gx_measure_free(measure);
    return NULL;
  }
  struct gx_measured *result = &measure->result;
  for (int q = 0; q < GX_QUANTITIES; q++)
    for (int k = 0; k < GX_NORMS; k++)
      if (level == GX_MEASURE_FINAL || !space->posed->problem->exact || (q == GX_STRESS && !material->piola))
        result->max_error[q][k] = NAN;
  if (level != GX_MEASURE_ALL) result->max_defect = result->drift = NAN;
  result->momentum_change = result->angular_change = NAN;
  result->probe_change = result->probe_displacement = result->last_jump = result->estimated_jump = NAN;
  for (int k = 0; k < GX_NORMS; k++) result->max_jump[k] = NAN;
  result->last.crossings = level == GX_MEASURE_FINAL ? NAN : 0;
  return measure;
}

void gx_measure_free(struct gx_measure *measure)
{
  if (!measure) return;
  gx_jump_free(measure->jump);
  free(measure->kept);
  free(measure->v.component[0]);
  free(measure->a.component[0]);
  free(measure->a_before.component[0]);
  free(measure->cell.component[0]);
  free(measure);
}

const struct gx_measured *gx_measure_result(const struct gx_measure *measure)
{
  return &measure->result;
}

int gx_measure_jumps(struct gx_measure *measure)
{
  measure->jump = gx_jump_create(measure->space, measure->cells);
  for (int k = 0; k < GX_NORMS && measure->level != GX_MEASURE_FINAL; k++) measure->result.max_jump[k] = 0;
  return measure->jump ? 0 : -1;
}

void gx_measure_momentum(struct gx_measure *measure, bool linear, bool angular)
{
  measure->linear = linear && measure->level == GX_MEASURE_ALL;
  measure->angular = angular && measure->level == GX_MEASURE_ALL;
}

void gx_measure_step(struct gx_measure *measure, double dt)
{
  gx_jump_step(measure->jump, dt);
  measure->result.last_jump = measure->jump->last;
  measure->result.estimated_jump = measure->jump->estimate;
}

int gx_measure_follow(struct gx_measure *measure, size_t particle, const double *place)
{
  if (!measure->v.component[0] && take_room(measure, &measure->v)) return -1;
  measure->followed = (long)particle;
  for (int d = 0; d < measure->dim; d++) measure->beside[d] = place[d] - measure->space->particles->X[d][particle];
  if (measure->level != GX_MEASURE_FINAL) measure->result.probe_change = measure->result.probe_displacement = 0;
  return 0;
}

const struct gx_probe *gx_measure_probe(const struct gx_measure *measure)
{
  return &measure->probe;
}

/* Power of the body force at velocities that are v or, on nodes, `ahead` seconds further on than the space's, W; v NULL: the particles',
 * settled. */
static double body_power(const struct gx_measure *measure, double ahead, double *const *v)
{
  struct gx_space *space = measure->space;
  const struct gx_particles *particles = space->particles;
  double power = 0;
  if (space->kind->power && space->kind->power(space, ahead, &power)) return power;
  if (!v && space->kind->settle) space->kind->settle(space);
  for (int d = 0; d < particles->dim; d++)
    power += gx_vector_weighted(particles->n, particles->m, particles->b[d], v ? v[d] : particles->v[d]);
  return power;
}

static void add_work(void *context, struct gx_space *space, double weight)
{
  struct gx_measure *measure = context;
  if (space->posed->problem->body) measure->work += weight * body_power(measure, 0, NULL);
}

struct gx_work_observer gx_measure_work(struct gx_measure *measure)
{
  return (struct gx_work_observer){measure, measure->level == GX_MEASURE_ALL ? add_work : NULL};
}

/* Velocities at the end of step. */
static double *const *velocity(const struct gx_measure *measure)
{
  return measure->v.component[0] ? measure->v.component : measure->space->particles->v;
}

static struct gx_errors_state state_of(const struct gx_measure *measure, double t)
{
  return (struct gx_errors_state){.space = measure->space, .v = velocity(measure), .t = t};
}

void gx_measure_settle(struct gx_measure *measure)
{
  struct gx_space *space = measure->space;
  if (!measure->unsettled) return;
  measure->unsettled = false;
  if (space->kind->settle) space->kind->settle(space);
  if (!measure->v.component[0]) return;
  space->kind->particle_acceleration(space, measure->v.component);
  for (int d = 0; d < measure->dim; d++) {
    double *v = measure->v.component[d];
    if (measure->followed >= 0) measure->probe_a[d] = v[measure->followed];
    gx_bring(measure->n, measure->ahead, space->particles->v[d], v, v);
  }
}

void gx_measure_error(struct gx_measure *measure, enum gx_quantity quantity, int component, double *error)
{
  gx_measure_settle(measure);
  const struct gx_errors_state state = state_of(measure, measure->result.last.time);
  gx_errors_component(&state, quantity, component, error);
}

void gx_measure_difference(struct gx_measure *measure, struct gx_measure *other, double error[GX_QUANTITIES][GX_NORMS])
{
  gx_measure_settle(measure);
  gx_measure_settle(other);
  const struct gx_errors_state state = state_of(measure, measure->result.last.time),
                               others = state_of(other, other->result.last.time);
  gx_errors_difference(&state, &others, error);
}

/* Of a sample, over the particles. */
struct totals {
  struct gx_momentum momentum;
  double elastic, defect; /* defect: W, of the step's energy */
};

static void energies(const struct gx_measure *measure, double dt, const struct totals *totals, struct gx_sample *sample)
{
  const struct gx_particles *particles = measure->space->particles;
  sample->kinetic = totals->momentum.kinetic;
  sample->elastic = totals->elastic;
  sample->kinetic_nodes = measure->space->kind->kinetic(measure->space);
  sample->defect = measure->started ? fabs(dt * totals->defect) : NAN;
  sample->work = measure->work;
  if (measure->clock->staggered && measure->space->posed->problem->body)
    /* the half kick that the sample's velocity is ahead of the run's */
    sample->work += 0.25 * dt * (body_power(measure, 0, particles->v) + body_power(measure, 0.5 * dt, measure->v.component));
}

/* Velocities at the end of step, where energies are measured. Returns the sum of terms of the step's energy defect. */
static double bring_all(struct gx_measure *measure)
{
  const struct gx_particles *particles = measure->space->particles;
  double defect = 0;
  for (int d = 0; d < measure->dim; d++) {
    const struct gx_bring_step step = {measure->n,
                                       particles->m,
                                       particles->v[d],
                                       measure->a_before.component[d],
                                       measure->a.component[d],
                                       measure->v.component[d]};
    defect += gx_bring_on(&step, measure->ahead, measure->clock->first_order_defect);
  }
  return defect;
}

/* Velocity and acceleration of the particles at the end of step, and the stress that belongs to their F. Returns as bring_all. */
static double synchronise(struct gx_measure *measure)
{
  struct gx_space *space = measure->space;
  const bool all = measure->level == GX_MEASURE_ALL;
  measure->unsettled = false;
  if (space->kind->settle) space->kind->settle(space);
  if (!measure->v.component[0]) return 0;
  if (all) {
    const struct vector_field before = measure->a;
    measure->a = measure->a_before;
    measure->a_before = before;
  }
  double *const *a = all ? measure->a.component : measure->v.component;
  space->kind->particle_acceleration(space, a);
  for (int d = 0; d < measure->dim && measure->followed >= 0; d++) measure->probe_a[d] = a[d][measure->followed];
  if (all) return bring_all(measure);
  for (int d = 0; d < measure->dim; d++)
    gx_bring(measure->n, measure->ahead, space->particles->v[d], a[d], measure->v.component[d]);
  return 0;
}

/* Errors and, where energies are measured, totals of the particles as they are settled for it; */
static void take_particles(struct gx_measure *measure, double t, struct gx_sample *sample, struct totals *totals)
{
  totals->defect = synchronise(measure);
  const struct gx_errors_state state = state_of(measure, t);
  gx_errors_norms(&state, sample->error);
  if (measure->level != GX_MEASURE_ALL) return;
  totals->momentum = gx_momentum_of(measure->space->particles, measure->v.component);
  totals->elastic = gx_potential_of(measure->space, measure->volume);
}

/* or of the space alone. */
static void take_survey(struct gx_measure *measure, double t, struct gx_sample *sample, struct totals *totals)
{
  struct gx_survey survey = {.t = t,
                             .ahead = measure->ahead,
                             .energies = measure->level == GX_MEASURE_ALL,
                             .first_order = measure->clock->first_order_defect,
                             .kept = measure->kept};
  measure->unsettled = true;
  measure->space->kind->survey(measure->space, &survey);
  if (measure->followed >= 0) gx_measure_settle(measure);
  for (int q = 0; q < GX_QUANTITIES; q++) gx_errors_finish(survey.square[q], survey.most[q], measure->n, sample->error[q]);
  *totals = (struct totals){.elastic = survey.elastic, .defect = survey.defect};
  memcpy(totals->momentum.linear, survey.momentum, sizeof survey.momentum);
  totals->momentum.kinetic = survey.kinetic;
  totals->momentum.linear_size = sqrt(2 * measure->mass * survey.kinetic);
}

static double crossings(struct gx_measure *measure)
{
  if (!measure->cell.component[0]) return measure->result.last.crossings;
  const double moved = gx_crossings_count(measure->space, measure->cells, measure->cell.component);
  return measure->started ? measure->result.last.crossings + moved : 0;
}

/* Length of the displacement u + (F - I) (place - X) of the place that the probe stands for. */
static double displacement_of_place(const struct gx_measure *measure)
{
  const size_t p = (size_t)measure->followed;
  const struct gx_particles *particles = measure->space->particles;
  double square = 0;
  for (int d = 0; d < measure->dim; d++) {
    double u = particles->u[d][p];
    for (int e = 0; e < measure->dim; e++) u += (particles->F[d * measure->dim + e][p] - (d == e)) * measure->beside[e];
    square += u * u;
  }
  return sqrt(square);
}

/* u_error, v_error */
static void follow_exact(struct gx_measure *measure, double t)
{
  const struct gx_posed posed = gx_problem_part(measure->space->posed, (size_t)measure->followed, 1);
  struct gx_probe *probe = &measure->probe;
  double exact[2][GX_MAX_DIM], *u[GX_MAX_DIM], *v[GX_MAX_DIM];
  for (int d = 0; d < measure->dim; d++) {
    u[d] = &exact[0][d];
    v[d] = &exact[1][d];
  }
  if (posed.problem->exact) posed.problem->exact(&posed, t, u, v, NULL, NULL);
  for (int d = 0; d < measure->dim; d++) {
    probe->u_error[d] = posed.problem->exact ? probe->u[d] - exact[0][d] : NAN;
    probe->v_error[d] = posed.problem->exact ? probe->v[d] - exact[1][d] : NAN;
  }
}

/* The probe's cell along d. */
static double cell_of_probe(const struct gx_measure *measure, int d)
{
  return measure->cell.component[0] ? measure->cell.component[d][measure->followed] : 0;
}

/* cell: of the probe one sample before. */
static void follow(struct gx_measure *measure, double t, const double *cell)
{
  const size_t p = (size_t)measure->followed;
  const struct gx_particles *particles = measure->space->particles;
  struct gx_probe *probe = &measure->probe;
  double square = 0;
  bool stayed = true;
  for (int d = 0; d < measure->dim; d++) {
    stayed = stayed && cell_of_probe(measure, d) == cell[d];
    double a = measure->probe_a[d], change = a - probe->a[d];
    square += change * change;
    probe->a[d] = a;
    probe->u[d] = particles->u[d][p];
    probe->jump[d] = measure->jump ? measure->jump->sum[d][p] : NAN;
    probe->v[d] = measure->v.component[d][p];
  }
  follow_exact(measure, t);
  struct gx_measured *result = &measure->result;
  if (measure->started && stayed && measure->level != GX_MEASURE_FINAL)
    result->probe_change = fmax(result->probe_change, sqrt(square));
  if (measure->level != GX_MEASURE_FINAL)
    result->probe_displacement = fmax(result->probe_displacement, displacement_of_place(measure));
}

static const double round_off = 1e-20; /* of energies, squares */

static void keep_extremes(struct gx_measure *measure, const struct gx_sample *sample)
{
  struct gx_measured *result = &measure->result;
  bool end_of_step = measure->started && measure->level != GX_MEASURE_FINAL;
  for (int q = 0; q < GX_QUANTITIES && end_of_step; q++)
    for (int k = 0; k < GX_NORMS; k++) result->max_error[q][k] = fmax(result->max_error[q][k], sample->error[q][k]);
  for (int k = 0; k < GX_NORMS && end_of_step; k++) result->max_jump[k] = fmax(result->max_jump[k], sample->jump[k]);
  if (measure->level != GX_MEASURE_ALL) return;
  double balance = sample->kinetic + sample->elastic - sample->work;
  if (!measure->started) {
    measure->start_balance = balance;
    measure->start_energy = sample->kinetic + sample->elastic;
    result->drift = measure->start_energy > 0 ? 0 : NAN;
    return;
  }
  result->max_defect = fmax(result->max_defect, sample->defect);
  if (measure->start_energy <= round_off * (sample->kinetic + sample->elastic)) { /* from rest: there is no E0 */
    measure->start_energy = 0;
    result->drift = NAN;
  }
  if (measure->start_energy > 0)
    result->drift = fmax(result->drift, fabs(balance - measure->start_balance) / measure->start_energy);
}

/* Of the sample and, largest so far, relative to the largest sizes so far. */
static void momenta(struct gx_measure *measure, struct gx_momentum now, struct gx_sample *sample)
{
  struct gx_space *space = measure->space;
  if (space->kind->spin) space->kind->spin(space, measure->ahead, now.angular);
  memcpy(sample->momentum, now.linear, sizeof sample->momentum);
  memcpy(sample->angular, now.angular, sizeof sample->angular);
  if (!measure->started) {
    memcpy(measure->start_momentum, now.linear, sizeof measure->start_momentum);
    memcpy(measure->start_angular, now.angular, sizeof measure->start_angular);
  }
  measure->linear_size = fmax(measure->linear_size, now.linear_size);
  measure->angular_size = fmax(measure->angular_size, now.angular_size);
  measure->linear_change = fmax(measure->linear_change, gx_momentum_distance(now.linear, measure->start_momentum));
  measure->angular_change = fmax(measure->angular_change, gx_momentum_distance(now.angular, measure->start_angular));
  if (measure->linear && measure->linear_size > 0)
    measure->result.momentum_change = measure->linear_change / measure->linear_size;
  if (measure->angular && measure->angular_size > 0)
    measure->result.angular_change = measure->angular_change / measure->angular_size;
}

enum gx_status gx_measure_take(struct gx_measure *measure, struct gx_stepper *stepper, double t, double dt)
{
  double cell[GX_MAX_DIM]; /* of the probe at the last sample */
  struct gx_sample sample = {.time = t,
                             .kinetic = NAN,
                             .kinetic_nodes = NAN,
                             .elastic = NAN,
                             .work = NAN,
                             .defect = NAN,
                             .momentum = {NAN, NAN, NAN},
                             .angular = {NAN, NAN, NAN},
                             .jump = {NAN, NAN, NAN},
                             .jump_step = NAN};
  struct totals totals = {.defect = 0};
  measure->ahead = measure->clock->staggered ? 0.5 * dt : 0;
  GX_TRY(gx_stepper_accelerate(stepper, t));
  if (measure->kept)
    take_survey(measure, t, &sample, &totals);
  else
    take_particles(measure, t, &sample, &totals);
  if (measure->level == GX_MEASURE_ALL) {
    energies(measure, dt, &totals, &sample);
    if (!measure->space->posed->problem->space) momenta(measure, totals.momentum, &sample);
  }
  if (measure->jump) {
    gx_errors_of_vectors(measure->n, measure->dim, measure->jump->sum, sample.jump);
    sample.jump_step = measure->jump->step;
  }
  for (int d = 0; d < measure->dim && measure->followed >= 0; d++) cell[d] = cell_of_probe(measure, d);
  sample.crossings = crossings(measure);
  if (measure->followed >= 0) follow(measure, t, cell);
  keep_extremes(measure, &sample);
  measure->result.last = sample;
  measure->started = true;
  return GX_OK;
}

void gx_measure_image(struct gx_measure *measure, struct gx_image *image)
{
  struct vector_field *const field[] = {&measure->v, &measure->a, &measure->cell};
  for (size_t i = 0; i < sizeof field / sizeof *field; i++)
    if (field[i]->component[0]) gx_image_reals(image, measure->dim, field[i]->component, measure->n);
  if (measure->kept) gx_image_reals(image, 1, &measure->kept, measure->space->surveyed);
  if (measure->jump) gx_jump_image(measure->jump, image);
  GX_IMAGE(image, measure->started);
  GX_IMAGE(image, measure->unsettled);
  GX_IMAGE(image, measure->ahead);
  GX_IMAGE(image, measure->probe);
  GX_IMAGE(image, measure->work);
  GX_IMAGE(image, measure->start_energy);
  GX_IMAGE(image, measure->start_balance);
  GX_IMAGE(image, measure->start_momentum);
  GX_IMAGE(image, measure->start_angular);
  GX_IMAGE(image, measure->linear_change);
  GX_IMAGE(image, measure->angular_change);
  GX_IMAGE(image, measure->linear_size);
  GX_IMAGE(image, measure->angular_size);
  GX_IMAGE(image, measure->result);
}
