/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One step from the exact state, and the idealisations between it and the exact solution (include/gridcross/budget.h). */
#include <gridcross/budget.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/large.h"
#include "../core/tensor.h"
#include "../core/vector.h"
#include "jump.h"
#include "truncation.h"

const struct gx_budget_column gx_budget_columns[GX_BUDGET_ENTRIES] = {
    [GX_BUDGET_VELOCITY_STEP] = {"velocity.step", "m/s"},
    [GX_BUDGET_VELOCITY_SUM] = {"velocity.sum", "m/s"},
    [GX_BUDGET_VELOCITY_TIME] = {"velocity.time", "m/s"},
    [GX_BUDGET_VELOCITY_INTERPOLATION] = {"velocity.interpolation", "m/s"},
    [GX_BUDGET_VELOCITY_LUMPING] = {"velocity.lumping", "m/s"},
    [GX_BUDGET_VELOCITY_PROJECTION] = {"velocity.projection", "m/s"},
    [GX_BUDGET_VELOCITY_QUADRATURE] = {"velocity.quadrature", "m/s"},
    [GX_BUDGET_VELOCITY_GRADIENT] = {"velocity.gradient", "m/s"},
    [GX_BUDGET_VELOCITY_REST] = {"velocity.rest", "m/s"},
    [GX_BUDGET_DISPLACEMENT_STEP] = {"displacement.step", "m"},
    [GX_BUDGET_DISPLACEMENT_SUM] = {"displacement.sum", "m"},
    [GX_BUDGET_DISPLACEMENT_TIME] = {"displacement.time", "m"},
    [GX_BUDGET_DISPLACEMENT_INTERPOLATION] = {"displacement.interpolation", "m"},
    [GX_BUDGET_DISPLACEMENT_LUMPING] = {"displacement.lumping", "m"},
    [GX_BUDGET_DISPLACEMENT_PROJECTION] = {"displacement.projection", "m"},
    [GX_BUDGET_DISPLACEMENT_REST] = {"displacement.rest", "m"},
    [GX_BUDGET_DISPLACEMENT_JUMP] = {"displacement.jump", "m"},
    [GX_BUDGET_INF_ACCELERATION] = {"inf.acceleration", "m/s^2"},
    [GX_BUDGET_INF_VELOCITY] = {"inf.velocity", "m/s"},
    [GX_BUDGET_INF_GRADIENT] = {"inf.gradient", "1/s"},
    [GX_BUDGET_L2_PROJECTED] = {"l2.projected", "m/s^2"},
    [GX_BUDGET_L2_FORCE] = {"l2.force", "m/s^2"},
    [GX_BUDGET_L2_METHOD] = {"l2.method", "m/s^2"},
    [GX_BUDGET_L2_VELOCITY] = {"l2.velocity", "m/s"},
    [GX_BUDGET_L2_INCREMENT] = {"l2.increment", "m/s"},
    [GX_BUDGET_L2_TIME] = {"l2.time", "m/s"},
};

enum { SUMS = GX_BUDGET_DISPLACEMENT_REST + 1 }; /* entries that are sums over particles come first */

/* Added up stage by stage. */
static bool is_stored(int entry)
{
  return entry < SUMS && entry != GX_BUDGET_VELOCITY_STEP && entry != GX_BUDGET_VELOCITY_SUM &&
         entry != GX_BUDGET_VELOCITY_REST && entry != GX_BUDGET_DISPLACEMENT_STEP && entry != GX_BUDGET_DISPLACEMENT_SUM &&
         entry != GX_BUDGET_DISPLACEMENT_REST;
}

struct vector_field {
  double *component[GX_MAX_DIM];
};

struct gx_budget {
  const struct gx_posed *posed; /* at the particles */
  const struct gx_space_kind *kind;
  struct gx_space_options options;
  const struct gx_clock *clock;
  struct gx_outcome outcome; /* of the steps taken here */
  struct gx_particles *particles;
  struct gx_integral *integral;
  struct gx_truncation *truncation;
  int stages;
  struct gx_clock_stage stage[GX_MAX_STAGES + 1];
  bool jumps; /* asked for */
  /* at particles, [n] */
  struct vector_field term[SUMS], exact, seen, before, moved, kicked;
  double *point[GX_MAX_DIM]; /* the exact field at the integral's points */
  double *gradient[GX_MAX_TENSOR], *F[GX_MAX_TENSOR];
  double taken, mean[GX_BUDGET_ENTRIES]; /* steps; sums of squares, or maxima */
  double *block;
};

/* Hands out every array from `block`; with NULL only counts them. */
static size_t place_arrays(struct gx_budget *budget, double *block)
{
  int dim = budget->particles->dim;
  size_t n = budget->particles->n, used = 0;
#define PLACE(array, count, length)                                                                                              \
  for (int i = 0; i < (count); i++, used += (length))                                                                            \
    if (block) (array)[i] = block + used
  for (int k = 0; k < SUMS; k++)
    if (is_stored(k)) PLACE(budget->term[k].component, dim, n);
  struct vector_field *at_particles[] = {&budget->exact, &budget->seen, &budget->before, &budget->moved, &budget->kicked};
  for (size_t k = 0; k < sizeof at_particles / sizeof *at_particles; k++) PLACE(at_particles[k]->component, dim, n);
  PLACE(budget->gradient, dim * dim, n);
  PLACE(budget->F, dim * dim, n);
  PLACE(budget->point, dim, budget->integral->points->n);
#undef PLACE
  return used;
}

static enum gx_status allocate(struct gx_budget *budget, const struct gx_space *space, struct gx_outcome *outcome)
{
  budget->particles = gx_particles_copy(space->particles);
  if (!budget->particles) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the budget");
  GX_TRY(gx_integral_create(&budget->integral, space, &budget->options, outcome));
  budget->integral->mesh->space.outcome = &budget->outcome;
  budget->block = gx_large_zeros(place_arrays(budget, NULL) * sizeof(double));
  budget->truncation = gx_truncation_create(budget->integral);
  if (!budget->block || !budget->truncation) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the budget");
  place_arrays(budget, budget->block);
  return GX_OK;
}

enum gx_status gx_budget_create(struct gx_budget **out, const struct gx_space *space, const struct gx_space_options *options,
                                const struct gx_clock *clock, struct gx_outcome *outcome)
{
  if (!space->kind->field) return gx_status_set(outcome, GX_REFUSED, -1, "%s has no grid, and so no budget", space->kind->name);
  struct gx_budget *budget = calloc(1, sizeof *budget);
  if (!budget) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the budget");
  *budget = (struct gx_budget){.posed = space->posed, .kind = space->kind, .options = *options, .clock = clock};
  budget->stages = gx_clock_stages(clock, !space->kind->fixed_grid, budget->stage);
  enum gx_status status = allocate(budget, space, outcome);
  if (status == GX_OK)
    *out = budget;
  else
    gx_budget_free(budget);
  return status;
}

void gx_budget_free(struct gx_budget *budget)
{
  if (!budget) return;
  gx_truncation_free(budget->truncation);
  gx_integral_free(budget->integral);
  gx_particles_free(budget->particles);
  free(budget->block);
  free(budget);
}

void gx_budget_jumps(struct gx_budget *budget)
{
  budget->jumps = true;
}

/* The case at time t, from the exact state there and the exact velocity at t_velocity. */
static enum gx_status build(struct gx_budget *budget, double t, double t_velocity, struct gx_space **space)
{
  struct gx_particles *particles = budget->particles;
  const struct gx_problem *problem = budget->posed->problem;
  problem->exact(budget->posed, t, particles->u, NULL, particles->F, NULL);
  problem->exact(budget->posed, t_velocity, NULL, particles->v, NULL, NULL);
  return budget->kind->create(budget->kind, space, &budget->options, particles, budget->posed, &budget->outcome);
}

/* Largest magnitude of a - b. */
static double largest(int components, size_t n, double *const *a, double *const *b)
{
  double most = 0;
  for (size_t p = 0; p < n; p++) {
    double square = 0;
    for (int k = 0; k < components; k++) square += (a[k][p] - b[k][p]) * (a[k][p] - b[k][p]);
    if (!(square <= most)) most = square;
  }
  return sqrt(most);
}

/* The first term: span times what is exact, which the next level is compared with. */
static void add_exact(struct gx_budget *budget, enum gx_budget_entry term, double span, double *const *exact)
{
  for (int d = 0; d < budget->particles->dim; d++) {
    memcpy(budget->before.component[d], exact[d], budget->particles->n * sizeof(double));
    gx_vector_add(budget->particles->n, span, exact[d], budget->term[term].component[d]);
  }
}

/* The term that lies between the level before and this one: term += span (S field - before). */
static void add_level(struct gx_budget *budget, struct gx_mesh *mesh, enum gx_budget_entry term, double span,
                      double *const *field)
{
  double **out = budget->term[term].component, **seen = budget->seen.component, **before = budget->before.component;
  gx_mesh_gather(mesh, field, seen, NULL);
  for (int d = 0; d < budget->particles->dim; d++)
    for (size_t p = 0; p < budget->particles->n; p++) out[d][p] += span * (seen[d][p] - before[d][p]);
  struct vector_field swap = budget->seen;
  budget->seen = budget->before;
  budget->before = swap;
}

/* The levels that accelerations and velocities share; `time` is the entry of their first term. The last is left in `field`. */
static enum gx_status add_projections(struct gx_budget *budget, struct gx_space *space, enum gx_budget_entry time, double span,
                                      double *const *exact, double *const *point, double *const *field)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space, *ideal = budget->integral->mesh;
  const int interpolation = 1, lumping = 2, projection = 3; /* after time */
  add_exact(budget, time, span, exact);
  GX_TRY(gx_integral_project(budget->integral, false, point, ideal->a));
  add_level(budget, mesh, time + interpolation, span, ideal->a);
  if (!budget->options.consistent) {
    GX_TRY(gx_integral_project(budget->integral, true, point, ideal->a));
    add_level(budget, mesh, time + lumping, span, ideal->a);
  }
  GX_TRY(gx_mesh_project(mesh, exact, field));
  add_level(budget, mesh, time + projection, span, field);
  return GX_OK;
}

/* Forces with the exact stress, which the particles have after build(). */
static enum gx_status force(const struct gx_budget *budget, struct gx_space *space, double t)
{
  return budget->kind->fixed_grid ? budget->kind->accelerate(space, t)
                                  : gx_mesh_accelerate((struct gx_mesh *)space, t, gx_mesh_load_nominal);
}

/* Every acceleration between the exact one and the method's, from the exact state at t. first: t is the start of the step. */
static enum gx_status kick(struct gx_budget *budget, struct gx_space *space, double t, double span, bool first, double *value)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  const struct gx_particles *particles = budget->particles;
  double **exact = budget->exact.component, **point = budget->point;
  budget->posed->problem->exact(budget->posed, t, NULL, NULL, NULL, exact);
  budget->posed->problem->exact(budget->integral->posed, t, NULL, NULL, NULL, point);
  GX_TRY(add_projections(budget, space, GX_BUDGET_VELOCITY_TIME, span, exact, point, mesh->a));
  if (first) value[GX_BUDGET_L2_PROJECTED] = gx_truncation_acceleration(budget->truncation, t, mesh->a);
  gx_truncation_add(budget->truncation, space, t, span);
  GX_TRY(force(budget, space, t));
  add_level(budget, mesh, GX_BUDGET_VELOCITY_QUADRATURE, span, mesh->a);
  if (first) value[GX_BUDGET_L2_FORCE] = gx_truncation_acceleration(budget->truncation, t, mesh->a);
  if (!budget->kind->fixed_grid) GX_TRY(budget->kind->accelerate(space, t));
  add_level(budget, mesh, GX_BUDGET_VELOCITY_GRADIENT, span, mesh->a);
  if (!first) return GX_OK;
  value[GX_BUDGET_L2_METHOD] = gx_truncation_acceleration(budget->truncation, t, mesh->a);
  value[GX_BUDGET_INF_ACCELERATION] = largest(particles->dim, particles->n, exact, budget->before.component);
  return GX_OK;
}

/* The velocities of time t at the positions where particles and points are. */
static enum gx_status drift(struct gx_budget *budget, struct gx_space *space, double t, double span)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  double **exact = budget->exact.component, **point = budget->point;
  budget->posed->problem->exact(budget->posed, t, NULL, exact, NULL, NULL);
  if (budget->options.particle_motion) {
    add_exact(budget, GX_BUDGET_DISPLACEMENT_TIME, span, exact);
    return GX_OK;
  }
  budget->posed->problem->exact(budget->integral->posed, t, NULL, point, NULL, NULL);
  return add_projections(budget, space, GX_BUDGET_DISPLACEMENT_TIME, span, exact, point, mesh->a);
}

/* gradient <- gradient F^-1 */
GX_CORE void divide_by_F(const int dim, size_t n, double *const *F, double *const *gradient)
{
  for (size_t p = 0; p < n; p++) {
    double f[GX_MAX_TENSOR], C[GX_MAX_TENSOR], rate[GX_MAX_TENSOR], L[GX_MAX_TENSOR] = {0};
    gx_tensor_load(dim, F, p, f);
    gx_tensor_load(dim, gradient, p, rate);
    double J = gx_tensor_cofactor(dim, f, C);
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++)
        for (int k = 0; k < dim; k++) L[i * dim + j] += rate[i * dim + k] * C[j * dim + k] / J;
    gx_tensor_store(dim, gradient, p, L);
  }
}

/* gradient <- grad v at the particles: dF/dt by a difference of fourth order, times F^-1 where the grid is fixed. */
static void exact_gradient(struct gx_budget *budget, double t)
{
  const struct gx_posed *posed = budget->posed;
  const double share[] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
  const double step = 1e-3 / (posed->speed * posed->options.mode); /* of a period that is 1 or 2 over these */
  const int dimension = budget->particles->dim;
  size_t n = budget->particles->n;
  for (int k = 0; k < dimension * dimension; k++) memset(budget->gradient[k], 0, n * sizeof(double));
  for (int i = 0; i < 4; i++) {
    posed->problem->exact(posed, t + (i < 2 ? i - 2 : i - 1) * step, NULL, NULL, budget->F, NULL);
    for (int k = 0; k < dimension * dimension; k++) gx_vector_add(n, share[i] / step, budget->F[k], budget->gradient[k]);
  }
  if (!budget->kind->fixed_grid) return;
  posed->problem->exact(posed, t, NULL, NULL, budget->F, NULL);
  GX_FOR_DIM(dimension, divide_by_F(dim, n, budget->F, budget->gradient))
}

/* berzins2022 eqs 63, 64 with the best nodal velocities; the points are at time t. */
static enum gx_status take_velocity(struct gx_budget *budget, struct gx_space *space, double t, double *value)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space, *ideal = budget->integral->mesh;
  const struct gx_problem *problem = budget->posed->problem;
  int dim = budget->particles->dim;
  size_t n = budget->particles->n;
  problem->exact(budget->integral->posed, t, NULL, budget->point, NULL, NULL);
  GX_TRY(gx_integral_project(budget->integral, false, budget->point, ideal->v));
  problem->exact(budget->posed, t, NULL, budget->exact.component, NULL, NULL);
  gx_mesh_gather(mesh, ideal->v, budget->seen.component, NULL);
  value[GX_BUDGET_INF_VELOCITY] = largest(dim, n, budget->exact.component, budget->seen.component);
  exact_gradient(budget, t);
  gx_mesh_gather(mesh, ideal->v, NULL, budget->F);
  value[GX_BUDGET_INF_GRADIENT] = largest(dim * dim, n, budget->gradient, budget->F);
  return GX_OK;
}

static double rms_of_jumps(struct gx_jump *jump, double dt)
{
  const struct gx_particles *particles = jump->space->particles;
  double sum = 0;
  gx_jump_step(jump, dt);
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) sum += jump->sum[d][p] * jump->sum[d][p];
  return sqrt(sum / (double)particles->n);
}

/* The step itself: kicked and moved <- the changes of velocity and displacement of the particles. */
static enum gx_status take_step(struct gx_budget *budget, struct gx_space *space, double t, double dt, double *value)
{
  struct gx_particles *particles = budget->particles;
  struct gx_stepper *stepper = gx_stepper_create(budget->clock, space, NULL);
  if (space->kind->settle) space->kind->settle(space);
  struct gx_jump *jump = budget->jumps ? gx_jump_create(space, budget->options.cells) : NULL;
  if (!stepper || (budget->jumps && !jump)) {
    gx_stepper_free(stepper);
    gx_jump_free(jump);
    return gx_status_set(&budget->outcome, GX_FAILED, -1, "out of memory for the budget");
  }
  for (int d = 0; d < particles->dim; d++) {
    memcpy(budget->kicked.component[d], particles->v[d], particles->n * sizeof(double));
    memcpy(budget->moved.component[d], particles->u[d], particles->n * sizeof(double));
  }
  enum gx_status status = gx_stepper_step(stepper, t, dt);
  if (jump && status == GX_OK) value[GX_BUDGET_DISPLACEMENT_JUMP] = rms_of_jumps(jump, dt);
  gx_jump_free(jump);
  if (status == GX_OK && space->kind->settle) space->kind->settle(space);
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) {
      budget->kicked.component[d][p] = status == GX_OK ? particles->v[d][p] - budget->kicked.component[d][p] : NAN;
      budget->moved.component[d][p] = status == GX_OK ? particles->u[d][p] - budget->moved.component[d][p] : NAN;
    }
  gx_stepper_free(stepper);
  return status;
}

static enum gx_status open_step(struct gx_budget *budget, double t)
{
  for (int d = 0; d < budget->particles->dim; d++)
    for (int k = 0; k < SUMS; k++)
      if (is_stored(k)) memset(budget->term[k].component[d], 0, budget->particles->n * sizeof(double));
  GX_TRY(gx_integral_place(budget->integral, t));
  if (!gx_truncation_open(budget->truncation, budget->stages > 1)) return GX_OK;
  return gx_status_set(&budget->outcome, GX_FAILED, -1, "out of memory for the budget");
}

static enum gx_status take_stage(struct gx_budget *budget, int j, double t, double dt, double *value, struct gx_space **space)
{
  const struct gx_clock_stage *stage = &budget->stage[j];
  double at = t + dt * stage->time, begin = t - (budget->clock->staggered ? 0.5 * dt : 0);
  GX_TRY(build(budget, at, begin, space));
  GX_TRY(gx_integral_place(budget->integral, at));
  GX_TRY(kick(budget, *space, at, dt * stage->kick, j == 0, value));
  return drift(budget, *space, begin + dt * stage->velocity_time, dt * stage->drift);
}

/* Later stages first: at the end the particles are those of the step's start, ready to be stepped. */
static enum gx_status take_stages(struct gx_budget *budget, double t, double dt, struct gx_space **start, double *value)
{
  for (int j = budget->stages - 1; j > 0; j--) {
    struct gx_space *space = NULL;
    enum gx_status status = take_stage(budget, j, t, dt, value, &space);
    if (space) budget->kind->free(space);
    GX_TRY(status);
  }
  GX_TRY(take_stage(budget, 0, t, dt, value, start));
  GX_TRY(take_velocity(budget, *start, t, value));
  gx_truncation_velocity(budget->truncation, ((const struct gx_mesh *)*start)->v);
  return GX_OK;
}

/* The entries from `step` to `rest`: the error of what was taken for the exact change, and the terms' sums of squares. */
static void close_terms(struct gx_budget *budget, enum gx_budget_entry step, enum gx_budget_entry rest, double *const *taken,
                        double *const *before, double *const *after, double *value)
{
  size_t n = budget->particles->n;
  const int first = step + 2; /* after the step and the sum: time */
  double square[SUMS] = {0};
  for (int d = 0; d < budget->particles->dim; d++)
    for (size_t p = 0; p < n; p++) {
      double exact = after[d][p] - before[d][p], sum = 0;
      for (int k = first; k < (int)rest; k++) {
        double term = budget->term[k].component[d][p] - (k == first ? exact : 0);
        sum += term;
        square[k] += term * term;
      }
      double error = taken[d][p] - exact;
      square[step] += error * error;
      square[step + 1] += sum * sum;
      square[rest] += (error - sum) * (error - sum);
    }
  for (int k = step; k <= (int)rest; k++) value[k] = sqrt(square[k] / (double)n);
}

static void close_particles(struct gx_budget *budget, double t, double begin, double dt, double *value)
{
  const struct gx_posed *posed = budget->posed;
  double **before = budget->exact.component, **after = budget->seen.component;
  posed->problem->exact(posed, begin, NULL, before, NULL, NULL);
  posed->problem->exact(posed, begin + dt, NULL, after, NULL, NULL);
  close_terms(budget, GX_BUDGET_VELOCITY_STEP, GX_BUDGET_VELOCITY_REST, budget->kicked.component, before, after, value);
  posed->problem->exact(posed, t, before, NULL, NULL, NULL);
  posed->problem->exact(posed, t + dt, after, NULL, NULL, NULL);
  close_terms(budget, GX_BUDGET_DISPLACEMENT_STEP, GX_BUDGET_DISPLACEMENT_REST, budget->moved.component, before, after, value);
}

static bool is_largest(int entry)
{
  return entry >= GX_BUDGET_INF_ACCELERATION && entry <= GX_BUDGET_INF_GRADIENT;
}

enum gx_status gx_budget_take(struct gx_budget *budget, double t, double dt, struct gx_budget_values *values)
{
  struct gx_space *start = NULL;
  double *value = values->value, begin = t - (budget->clock->staggered ? 0.5 * dt : 0);
  budget->outcome = (struct gx_outcome){.status = GX_OK, .particle = -1};
  values->time = t + dt;
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++) value[i] = NAN;
  enum gx_status status = open_step(budget, t);
  if (status == GX_OK) status = take_stages(budget, t, dt, &start, value);
  if (status == GX_OK) {
    struct gx_truncation_errors errors = gx_truncation_close(budget->truncation, begin, begin + dt);
    value[GX_BUDGET_L2_VELOCITY] = errors.velocity;
    value[GX_BUDGET_L2_INCREMENT] = errors.increment;
    value[GX_BUDGET_L2_TIME] = errors.time;
    status = take_step(budget, start, t, dt, value);
    close_particles(budget, t, begin, dt, value);
  }
  if (start) budget->kind->free(start);
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++)
    budget->mean[i] = is_largest(i) ? fmax(budget->mean[i], value[i]) : budget->mean[i] + value[i] * value[i];
  budget->taken++;
  return status == GX_FAILED ? GX_FAILED : GX_OK;
}

struct gx_budget_values gx_budget_mean(const struct gx_budget *budget)
{
  struct gx_budget_values mean = {.time = NAN};
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++)
    mean.value[i] = budget->taken == 0 ? NAN : is_largest(i) ? budget->mean[i] : sqrt(budget->mean[i] / budget->taken);
  return mean;
}

void gx_budget_image(struct gx_budget *budget, struct gx_image *image)
{
  GX_IMAGE(image, budget->taken);
  GX_IMAGE(image, budget->mean);
  gx_integral_image(budget->integral, image);
}

enum gx_budget_entry gx_budget_dominant(const struct gx_budget_values *values, enum gx_budget_entry of,
                                        enum gx_budget_entry *next)
{
  const double *value = values->value;
  int rest = of == GX_BUDGET_VELOCITY_STEP ? GX_BUDGET_VELOCITY_REST : GX_BUDGET_DISPLACEMENT_REST;
  int largest = GX_BUDGET_ENTRIES, second = GX_BUDGET_ENTRIES;
  for (int i = of + 2; i <= rest; i++) {
    if (largest == GX_BUDGET_ENTRIES ? value[i] > 0 : value[i] > value[largest]) {
      second = largest;
      largest = i;
    } else if (second == GX_BUDGET_ENTRIES ? value[i] > 0 : value[i] > value[second]) {
      second = i;
    }
  }
  *next = (enum gx_budget_entry)second;
  return (enum gx_budget_entry)largest;
}
