/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples a run at ends of steps: error norms against the exact solution, energies, the energy defect of a step, momentum, crossings.
 * Velocities that live at half steps are brought to the end of step with half a kick. */
#include <gridcross/measure.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/kernel.h"
#include "../core/vector.h"
#include "jump.h"
#include "momentum.h"

const struct gx_measure_name gx_measure_quantity[GX_QUANTITIES] = {
    [GX_DISPLACEMENT] = {"displacement", "m"}, [GX_VELOCITY] = {"velocity", "m/s"}, [GX_STRESS] = {"stress", "Pa"}};

struct tensor_field {
  double *component[GX_MAX_TENSOR];
};
struct vector_field {
  double *component[GX_MAX_DIM];
};

struct gx_measure {
  struct gx_space *space;
  const struct gx_clock *clock;
  enum gx_measure_level level;
  bool started;
  int dim;
  size_t n;
  /* scratch and memory of the last sample, [n] each */
  struct vector_field v, a, v_before, a_before, exact_u, exact_v;
  struct tensor_field exact_F, exact_stress, stress, P;
  double *scratch;
  struct vector_field cell;  /* at the last sample, unwrapped */
  const int *cells;          /* per direction; NULL: particles do not move through cells */
  struct gx_jump *jump;      /* NULL: not measured */
  long followed;             /* -1: no probe */
  double beside[GX_MAX_DIM]; /* from its X to the place asked for, m */
  struct gx_probe probe;     /* at the last sample */
  double work;               /* of the kicks done so far, J */
  double start_energy;       /* kinetic and elastic at the first sample, J */
  double start_balance;      /* the same less work, J */
  bool linear, angular;      /* momenta that the problem keeps */
  double start_momentum[GX_MAX_DIM], start_angular[GX_MAX_DIM];
  double linear_change, angular_change; /* largest so far, kg m/s and kg m^2/s */
  double linear_size, angular_size;     /* likewise */
  struct gx_measured result;
  double *block;
};

/* Hands out the component arrays one after another. */
static double *place(double **component, int count, size_t n, double *at)
{
  for (int i = 0; i < count; i++, at += n) component[i] = at;
  return at;
}

struct gx_measure *gx_measure_create(struct gx_space *space, const struct gx_clock *clock, const int *cells,
                                     enum gx_measure_level level)
{
  struct gx_measure *measure = calloc(1, sizeof *measure);
  if (!measure) return NULL;
  const struct gx_material *material = space->posed->problem->material;
  int dim = space->particles->dim, tensor = dim * dim;
  size_t n = space->particles->n;
  if (level == GX_MEASURE_ALL && !space->kind->potential && !material->energy)
    level = GX_MEASURE_MAX; /* there is none to measure */
  *measure =
      (struct gx_measure){.space = space, .clock = clock, .level = level, .cells = cells, .followed = -1, .dim = dim, .n = n};
  measure->block = calloc(n * (size_t)(7 * dim + 4 * tensor + 1), sizeof(double));
  if (!measure->block) {
    free(measure);
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
  double *at = measure->block;
  struct vector_field *vectors[] = {&measure->v,       &measure->a,       &measure->v_before, &measure->a_before,
                                    &measure->exact_u, &measure->exact_v, &measure->cell};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) at = place(vectors[i]->component, dim, n, at);
  struct tensor_field *tensors[] = {&measure->exact_F, &measure->exact_stress, &measure->stress, &measure->P};
  for (size_t i = 0; i < sizeof tensors / sizeof *tensors; i++) at = place(tensors[i]->component, tensor, n, at);
  measure->scratch = at;
  return measure;
}

void gx_measure_free(struct gx_measure *measure)
{
  if (!measure) return;
  gx_jump_free(measure->jump);
  free(measure->block);
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

void gx_measure_follow(struct gx_measure *measure, size_t particle, const double *place)
{
  measure->followed = (long)particle;
  for (int d = 0; d < measure->dim; d++) measure->beside[d] = place[d] - measure->space->particles->X[d][particle];
  if (measure->level != GX_MEASURE_FINAL) measure->result.probe_change = measure->result.probe_displacement = 0;
}

const struct gx_probe *gx_measure_probe(const struct gx_measure *measure)
{
  return &measure->probe;
}

/* Power of the body force at the particles' present velocity, W. */
static double body_power(const struct gx_particles *particles, double *const *v)
{
  double power = 0;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) power += particles->m[p] * particles->b[d][p] * v[d][p];
  return power;
}

static void add_work(void *context, struct gx_space *space, double weight)
{
  struct gx_measure *measure = context;
  if (!space->posed->problem->body) return;
  if (space->kind->settle) space->kind->settle(space);
  measure->work += weight * body_power(space->particles, space->particles->v);
}

struct gx_work_observer gx_measure_work(struct gx_measure *measure)
{
  return (struct gx_work_observer){measure, measure->level == GX_MEASURE_ALL ? add_work : NULL};
}

/* square += (value - exact)^2 */
GX_CLONES static void add_square(size_t n, const double *restrict value, const double *restrict exact, double *restrict square)
{
  for (size_t p = 0; p < n; p++) square[p] += (value[p] - exact[p]) * (value[p] - exact[p]);
}

/* Of vectors whose squares are in scratch. */
static void norms_of_squares(const struct gx_measure *measure, double *error)
{
  size_t n = measure->n;
  double sum = gx_vector_sum(n, measure->scratch);
  error[GX_INF] = sqrt(gx_vector_max(n, measure->scratch));
  error[GX_RMS] = sqrt(sum / (double)n);
  error[GX_L2N] = sqrt(sum) / (double)n;
}

static void norms(const struct gx_measure *measure, int components, double *const *value, double *const *exact, double *error)
{
  memset(measure->scratch, 0, measure->n * sizeof(double));
  for (int k = 0; k < components; k++) add_square(measure->n, value[k], exact[k], measure->scratch);
  norms_of_squares(measure, error);
}

static void no_error(enum gx_quantity quantity, double error[GX_QUANTITIES][GX_NORMS])
{
  for (int k = 0; k < GX_NORMS; k++) error[quantity][k] = NAN;
}

/* Keeps the stress of the particles too, which a reference run is compared by. */
static void errors(struct gx_measure *measure, double t, double error[GX_QUANTITIES][GX_NORMS])
{
  const struct gx_particles *particles = measure->space->particles;
  const struct gx_posed *posed = measure->space->posed;
  const struct gx_material *material = posed->problem->material;
  int dim = measure->dim;
  size_t n = measure->n;
  double **P = measure->P.component;
  for (int q = 0; q < GX_QUANTITIES; q++) no_error((enum gx_quantity)q, error);
  if (material->piola) gx_material_cauchy(dim, n, particles->F, particles->P, measure->stress.component);
  if (!posed->problem->exact) return;
  posed->problem->exact(posed, t, measure->exact_u.component, measure->exact_v.component, measure->exact_F.component, NULL);
  norms(measure, dim, particles->u, measure->exact_u.component, error[GX_DISPLACEMENT]);
  norms(measure, dim, measure->v.component, measure->exact_v.component, error[GX_VELOCITY]);
  if (!material->piola) return;
  material->piola(&posed->options.moduli, dim, n, measure->exact_F.component, P);
  gx_material_cauchy(dim, n, measure->exact_F.component, P, measure->exact_stress.component);
  norms(measure, dim * dim, measure->stress.component, measure->exact_stress.component, error[GX_STRESS]);
}

void gx_measure_error(const struct gx_measure *measure, enum gx_quantity quantity, int component, double *error)
{
  double *const *u = measure->space->particles->u;
  const double *value = quantity == GX_DISPLACEMENT ? u[component]
                        : quantity == GX_VELOCITY   ? measure->v.component[component]
                                                    : measure->stress.component[component];
  const double *exact = quantity == GX_DISPLACEMENT ? measure->exact_u.component[component]
                        : quantity == GX_VELOCITY   ? measure->exact_v.component[component]
                                                    : measure->exact_stress.component[component];
  for (size_t p = 0; p < measure->n; p++) error[p] = value[p] - exact[p];
}

void gx_measure_difference(const struct gx_measure *measure, const struct gx_measure *other,
                           double error[GX_QUANTITIES][GX_NORMS])
{
  int dim = measure->dim;
  norms(measure, dim, measure->space->particles->u, other->space->particles->u, error[GX_DISPLACEMENT]);
  norms(measure, dim, measure->v.component, other->v.component, error[GX_VELOCITY]);
  no_error(GX_STRESS, error);
  if (measure->space->posed->problem->material->piola)
    norms(measure, dim * dim, measure->stress.component, other->stress.component, error[GX_STRESS]);
}

GX_CLONES static void multiply(size_t n, const double *restrict factor, double *restrict value)
{
  for (size_t p = 0; p < n; p++) value[p] *= factor[p];
}

static double potential(struct gx_measure *measure)
{
  const struct gx_space *space = measure->space;
  const struct gx_particles *particles = space->particles;
  const struct gx_posed *posed = space->posed;
  if (space->kind->potential) return space->kind->potential(space);
  posed->problem->material->energy(&posed->options.moduli, measure->dim, measure->n, particles->F, measure->scratch);
  multiply(measure->n, particles->V0, measure->scratch);
  return gx_vector_sum(measure->n, measure->scratch);
}

/* term = m (half v0, or a quarter of v - v0) (a - a0) */
GX_CLONES static void defect_terms(size_t n, bool first_order, const double *restrict m, const double *restrict v0,
                                   const double *restrict v, const double *restrict a0, const double *restrict a,
                                   double *restrict term)
{
  for (size_t p = 0; p < n; p++) term[p] = m[p] * (first_order ? 0.5 * v0[p] : 0.25 * (v[p] - v0[p])) * (a[p] - a0[p]);
}

static void energies(struct gx_measure *measure, double dt, struct gx_sample *sample)
{
  const struct gx_particles *particles = measure->space->particles;
  const struct gx_posed *posed = measure->space->posed;
  double kinetic = 0, defect = 0, *term = measure->scratch;
  size_t n = measure->n;
  for (int d = 0; d < measure->dim; d++) {
    const double *v = measure->v.component[d];
    kinetic += 0.5 * gx_vector_square(n, particles->m, v);
    defect_terms(n, measure->clock->first_order_defect, particles->m, measure->v_before.component[d], v,
                 measure->a_before.component[d], measure->a.component[d], term);
    defect += gx_vector_sum(n, term);
  }
  sample->kinetic = kinetic;
  sample->elastic = potential(measure);
  sample->kinetic_nodes = measure->space->kind->kinetic(measure->space);
  sample->defect = measure->started ? fabs(dt * defect) : NAN;
  sample->work = measure->work;
  if (measure->clock->staggered && posed->problem->body) /* the half kick that the sample's velocity is ahead of the run's */
    sample->work += 0.25 * dt * (body_power(particles, particles->v) + body_power(particles, measure->v.component));
}

static void swap(double **a, double **b)
{
  double *kept = *a;
  *a = *b;
  *b = kept;
}

/* Velocity and acceleration of the particles at the end of step, and the stress that belongs to their F. ahead: s that velocities are
 * behind. */
static enum gx_status synchronise(struct gx_measure *measure, struct gx_stepper *stepper, double t, double ahead)
{
  struct gx_space *space = measure->space;
  GX_TRY(gx_stepper_accelerate(stepper, t));
  if (space->kind->settle) space->kind->settle(space);
  for (int d = 0; d < measure->dim; d++) {
    swap(&measure->a_before.component[d], &measure->a.component[d]);
    swap(&measure->v_before.component[d], &measure->v.component[d]);
    memcpy(measure->v.component[d], space->particles->v[d], measure->n * sizeof(double));
  }
  if (!measure->clock->staggered && measure->level != GX_MEASURE_ALL && measure->followed < 0) return GX_OK;
  space->kind->particle_acceleration(space, measure->a.component);
  for (int d = 0; d < measure->dim; d++) gx_vector_add(measure->n, ahead, measure->a.component[d], measure->v.component[d]);
  return GX_OK;
}

GX_CLONES static double moved_cell(size_t n, const double *restrict X, const double *restrict u, double cells,
                                   double *restrict cell)
{
  double moved = 0;
  for (size_t p = 0; p < n; p++) {
    double now = floor((X[p] + u[p]) * cells);
    moved += now != cell[p];
    cell[p] = now;
  }
  return moved;
}

/* The same for cells that end at given edges. */
static double moved_edges(size_t n, const double *X, const double *u, const struct gx_space *space, double *cell)
{
  double moved = 0;
  for (size_t p = 0; p < n; p++) {
    size_t now = 0;
    while (now < space->edges && X[p] + u[p] >= space->edge[now]) now++;
    moved += (double)now != cell[p];
    cell[p] = (double)now;
  }
  return moved;
}

static double crossings(struct gx_measure *measure)
{
  const struct gx_space *space = measure->space;
  const struct gx_particles *particles = space->particles;
  if (!measure->cells || measure->level == GX_MEASURE_FINAL) return measure->result.last.crossings;
  double moved = 0;
  for (int d = 0; d < measure->dim; d++) {
    const double *X = particles->X[d], *u = particles->u[d];
    double *cell = measure->cell.component[d];
    moved += space->edge ? moved_edges(measure->n, X, u, space, cell) : moved_cell(measure->n, X, u, measure->cells[d], cell);
  }
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

/* cell: of the probe one sample before. */
static void follow(struct gx_measure *measure, const double *cell)
{
  const size_t p = (size_t)measure->followed;
  const struct gx_particles *particles = measure->space->particles;
  struct gx_probe *probe = &measure->probe;
  double square = 0;
  bool stayed = true, exact = measure->space->posed->problem->exact;
  for (int d = 0; d < measure->dim; d++) {
    stayed = stayed && measure->cell.component[d][p] == cell[d];
    double a = measure->a.component[d][p], change = a - probe->a[d];
    square += change * change;
    probe->a[d] = a;
    probe->u[d] = particles->u[d][p];
    probe->jump[d] = measure->jump ? measure->jump->sum[d][p] : NAN;
    probe->v[d] = measure->v.component[d][p];
    probe->u_error[d] = exact ? probe->u[d] - measure->exact_u.component[d][p] : NAN;
    probe->v_error[d] = exact ? probe->v[d] - measure->exact_v.component[d][p] : NAN;
  }
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
static void momenta(struct gx_measure *measure, double ahead, struct gx_sample *sample)
{
  double *const scratch[] = {measure->scratch, measure->P.component[0]};
  struct gx_space *space = measure->space;
  struct gx_momentum now = gx_momentum_of(space->particles, measure->v.component, scratch);
  if (space->kind->spin) space->kind->spin(space, ahead, now.angular);
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

static void jumps(const struct gx_measure *measure, struct gx_sample *sample)
{
  memset(measure->scratch, 0, measure->n * sizeof(double));
  for (int d = 0; d < measure->dim; d++)
    for (size_t p = 0; p < measure->n; p++) measure->scratch[p] += measure->jump->sum[d][p] * measure->jump->sum[d][p];
  norms_of_squares(measure, sample->jump);
  sample->jump_step = measure->jump->step;
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
  double ahead = measure->clock->staggered ? 0.5 * dt : 0;
  GX_TRY(synchronise(measure, stepper, t, ahead));
  errors(measure, t, sample.error);
  if (measure->level == GX_MEASURE_ALL) energies(measure, dt, &sample);
  if (measure->level == GX_MEASURE_ALL && !measure->space->posed->problem->space) momenta(measure, ahead, &sample);
  if (measure->jump) jumps(measure, &sample);
  if (measure->followed >= 0)
    for (int d = 0; d < measure->dim; d++) cell[d] = measure->cell.component[d][measure->followed];
  sample.crossings = crossings(measure);
  if (measure->followed >= 0) follow(measure, cell);
  keep_extremes(measure, &sample);
  measure->result.last = sample;
  measure->started = true;
  return GX_OK;
}
