/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine of every clock: runs rows of primitives, or a Runge-Kutta tableau, on any space. */
#include <gridcross/clock.h>

#include <stdlib.h>
#include <string.h>

#include "../core/large.h"
#include "../core/vector.h"

/* First weights, projection and drift; six rows a stage; the end. */
enum { MOST_ROWS = 4 + 6 * GX_MAX_STAGES + 1 };

struct gx_stepper {
  const struct gx_clock *clock;
  struct gx_space *space;
  struct gx_work_observer observer;
  bool fresh[GX_ACCELERATE + 1];             /* W, P, A hold for the current state and need not be repeated */
  double accelerated;                        /* s, the time of the last A */
  const struct gx_row *rows;                 /* NULL: a tableau */
  struct gx_row expanded[MOST_ROWS];         /* what a splitting means */
  struct gx_state state;                     /* tableau: what is combined */
  double *start[GX_MAX_STATE];               /* state at the start of the step */
  double *rate[GX_MAX_STAGES][GX_MAX_STATE]; /* rates of each stage */
  double *block;
};

static void append_row(struct gx_row **row, enum gx_primitive primitive, double coefficient)
{
  *(*row)++ = (struct gx_row){primitive, coefficient};
}

/* Weights and nodal velocities are renewed wherever positions have changed. */
static void append_drift(struct gx_row **row, double coefficient)
{
  if (coefficient == 0) return;
  append_row(row, GX_STRAIN, coefficient);
  append_row(row, GX_DRIFT, coefficient);
}

static void append_position(struct gx_row **row)
{
  append_row(row, GX_WEIGHTS, 0);
  append_row(row, GX_PROJECT, 0);
}

static void expand(const struct gx_splitting *splitting, struct gx_row *row)
{
  append_position(&row);
  append_drift(&row, splitting->drift[0]);
  for (int j = 0; j < splitting->stages; j++) {
    if (splitting->drift[j] != 0) append_position(&row);
    append_row(&row, GX_ACCELERATE, 0);
    append_row(&row, GX_KICK, splitting->kick[j]);
    append_drift(&row, splitting->drift[j + 1]);
  }
  append_row(&row, GX_END, 0);
}

static int allocate_stages(struct gx_stepper *stepper)
{
  struct gx_state *state = &stepper->state;
  int stages = stepper->clock->tableau->stages;
  stepper->space->kind->state(stepper->space, state);
  size_t total = 0;
  for (int i = 0; i < state->count; i++) total += state->length[i];
  stepper->block = gx_large_zeros(total * (size_t)(stages + 1) * sizeof(double));
  if (!stepper->block) return -1;
  double *at = stepper->block;
  for (int i = 0; i < state->count; i++, at += state->length[i - 1]) stepper->start[i] = at;
  for (int s = 0; s < stages; s++)
    for (int i = 0; i < state->count; i++, at += state->length[i - 1]) stepper->rate[s][i] = at;
  return 0;
}

struct gx_stepper *gx_stepper_create(const struct gx_clock *clock, struct gx_space *space,
                                     const struct gx_work_observer *observer)
{
  struct gx_stepper *stepper = calloc(1, sizeof *stepper);
  if (!stepper) return NULL;
  *stepper = (struct gx_stepper){.clock = clock, .space = space};
  if (observer) stepper->observer = *observer;
  stepper->rows = clock->plain_rows && !space->kind->fixed_grid ? clock->plain_rows : clock->rows;
  if (clock->splitting) {
    expand(clock->splitting, stepper->expanded);
    stepper->rows = stepper->expanded;
  }
  if (clock->tableau && allocate_stages(stepper)) {
    free(stepper);
    return NULL;
  }
  return stepper;
}

void gx_stepper_free(struct gx_stepper *stepper)
{
  if (!stepper) return;
  free(stepper->block);
  free(stepper);
}

/* Does W, P or A unless it holds already. */
static enum gx_status ensure(struct gx_stepper *stepper, enum gx_primitive primitive, double t)
{
  struct gx_space *space = stepper->space;
  const struct gx_space_kind *kind = space->kind;
  if (stepper->fresh[primitive]) return GX_OK;
  if (primitive == GX_WEIGHTS) GX_TRY(kind->weights(space));
  if (primitive == GX_PROJECT) GX_TRY(kind->project(space));
  if (primitive == GX_ACCELERATE) {
    GX_TRY(kind->accelerate(space, t));
    stepper->accelerated = t;
  }
  stepper->fresh[primitive] = true;
  return GX_OK;
}

static void expire(struct gx_stepper *stepper, enum gx_primitive first, enum gx_primitive last)
{
  for (enum gx_primitive p = first; p <= last; p++) stepper->fresh[p] = false;
}

enum gx_status gx_stepper_accelerate(struct gx_stepper *stepper, double t)
{
  for (enum gx_primitive p = GX_WEIGHTS; p <= GX_ACCELERATE; p++) GX_TRY(ensure(stepper, p, t));
  return GX_OK;
}

/* P may have been outdated by a kick since; A then stands on the mass and the weights that are the same as now. */
enum gx_status gx_stepper_image(struct gx_stepper *stepper, struct gx_image *image)
{
  bool fresh[GX_ACCELERATE + 1];
  memcpy(fresh, stepper->fresh, sizeof fresh);
  GX_IMAGE(image, fresh);
  GX_IMAGE(image, stepper->accelerated);
  gx_space_image(stepper->space, image);
  if (!image->loading || image->failed) return GX_OK;
  expire(stepper, GX_WEIGHTS, GX_ACCELERATE);
  if (fresh[GX_ACCELERATE])
    GX_TRY(gx_stepper_accelerate(stepper, stepper->accelerated));
  else if (fresh[GX_WEIGHTS])
    GX_TRY(ensure(stepper, GX_WEIGHTS, stepper->accelerated));
  memcpy(stepper->fresh, fresh, sizeof fresh);
  return GX_OK;
}

bool gx_stepper_starts_accelerated(const struct gx_stepper *stepper)
{
  const struct gx_row *row = stepper->rows;
  while (row && row->primitive > GX_END && row->primitive < GX_ACCELERATE) row++;
  return !row || row->primitive == GX_ACCELERATE;
}

static void observe(const struct gx_stepper *stepper, double weight)
{
  if (stepper->observer.power && weight != 0) stepper->observer.power(stepper->observer.context, stepper->space, weight);
}

/* Kick, strain and drift rows that follow each other share one pass over the weights; returns the row after them. */
static const struct gx_row *advance(struct gx_stepper *stepper, const struct gx_row *row, double dt, double *drifted)
{
  double span[GX_DRIFT + 1] = {0};
  enum gx_primitive last = GX_ACCELERATE;
  for (; row->primitive > last && row->primitive <= GX_DRIFT; row++) {
    span[row->primitive] = row->coefficient * dt;
    last = row->primitive;
  }
  observe(stepper, 0.5 * span[GX_KICK]);
  stepper->space->kind->advance(stepper->space, span[GX_KICK], span[GX_STRAIN], span[GX_DRIFT]);
  observe(stepper, 0.5 * span[GX_KICK]);
  if (span[GX_KICK] != 0) expire(stepper, GX_PROJECT, GX_PROJECT);
  if (span[GX_STRAIN] != 0 || span[GX_DRIFT] != 0) expire(stepper, GX_WEIGHTS, GX_ACCELERATE);
  *drifted += span[GX_DRIFT];
  return row;
}

static enum gx_status step_rows(struct gx_stepper *stepper, double t, double dt)
{
  struct gx_space *space = stepper->space;
  double drifted = 0;
  for (const struct gx_row *row = stepper->rows; row->primitive != GX_END;) {
    if (row->primitive <= GX_ACCELERATE) {
      GX_TRY(ensure(stepper, (row++)->primitive, t + drifted));
    } else if (row->primitive <= GX_DRIFT) {
      row = advance(stepper, row, dt, &drifted);
    } else {
      GX_TRY(space->kind->twofold(space, row->primitive, row->coefficient * dt));
      if (row->primitive == GX_CLOSE) expire(stepper, GX_WEIGHTS, GX_ACCELERATE);
      row++;
    }
  }
  return GX_OK;
}

/* state = start + dt sum_j weight_j rate_j */
static void set_state(struct gx_stepper *stepper, int stages, const double *weight, double dt)
{
  const struct gx_state *state = &stepper->state;
  for (int i = 0; i < state->count; i++) {
    memcpy(state->array[i], stepper->start[i], state->length[i] * sizeof(double));
    for (int s = 0; s < stages; s++)
      if (weight[s] != 0) gx_vector_add(state->length[i], dt * weight[s], stepper->rate[s][i], state->array[i]);
  }
  expire(stepper, GX_WEIGHTS, GX_ACCELERATE);
}

static enum gx_status step_tableau(struct gx_stepper *stepper, double t, double dt)
{
  const struct gx_tableau *tableau = stepper->clock->tableau;
  struct gx_space *space = stepper->space;
  for (int i = 0; i < stepper->state.count; i++)
    memcpy(stepper->start[i], stepper->state.array[i], stepper->state.length[i] * sizeof(double));
  for (int s = 0; s < tableau->stages; s++) {
    if (s) set_state(stepper, s, tableau->a[s], dt);
    GX_TRY(gx_stepper_accelerate(stepper, t + tableau->c[s] * dt));
    observe(stepper, tableau->b[s] * dt);
    space->kind->rates(space, stepper->rate[s]);
  }
  set_state(stepper, tableau->stages, tableau->b, dt);
  return GX_OK;
}

enum gx_status gx_stepper_step(struct gx_stepper *stepper, double t, double dt)
{
  return stepper->clock->tableau ? step_tableau(stepper, t, dt) : step_rows(stepper, t, dt);
}
