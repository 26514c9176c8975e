/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine of every clock: runs rows of primitives, or a Runge-Kutta tableau, on any space. */
#include <gridcross/clock.h>

#include <stdlib.h>
#include <string.h>

#include "../core/vector.h"

struct gx_stepper {
  const struct gx_clock *clock;
  struct gx_space *space;
  struct gx_work_observer observer;
  bool accelerated;                          /* W, P, A hold for the current state */
  struct gx_state state;                     /* tableau: what is combined */
  double *start[GX_MAX_STATE];               /* state at the start of the step */
  double *rate[GX_MAX_STAGES][GX_MAX_STATE]; /* rates of each stage */
  double *block;
};

static int allocate_stages(struct gx_stepper *stepper)
{
  struct gx_state *state = &stepper->state;
  int stages = stepper->clock->tableau->stages;
  stepper->space->kind->state(stepper->space, state);
  size_t total = 0;
  for (int i = 0; i < state->count; i++) total += state->length[i];
  stepper->block = malloc(total * (size_t)(stages + 1) * sizeof(double));
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

enum gx_status gx_stepper_accelerate(struct gx_stepper *stepper, double t)
{
  if (stepper->accelerated) return GX_OK;
  struct gx_space *space = stepper->space;
  GX_TRY(space->kind->weights(space));
  GX_TRY(space->kind->project(space));
  GX_TRY(space->kind->accelerate(space, t));
  stepper->accelerated = true;
  return GX_OK;
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
  for (; row->primitive > last; row++) {
    span[row->primitive] = row->coefficient * dt;
    last = row->primitive;
  }
  observe(stepper, 0.5 * span[GX_KICK]);
  stepper->space->kind->advance(stepper->space, span[GX_KICK], span[GX_STRAIN], span[GX_DRIFT]);
  observe(stepper, 0.5 * span[GX_KICK]);
  *drifted += span[GX_DRIFT];
  return row;
}

static enum gx_status step_rows(struct gx_stepper *stepper, double t, double dt)
{
  struct gx_space *space = stepper->space;
  const struct gx_row *row = stepper->clock->rows;
  double drifted = 0;
  if (stepper->accelerated) /* leading W, P, A were done when the last step was observed */
    for (enum gx_primitive done = GX_WEIGHTS; done <= GX_ACCELERATE && row->primitive == done; done++) row++;
  stepper->accelerated = false;
  while (row->primitive != GX_END) {
    switch (row->primitive) {
    case GX_WEIGHTS:
      GX_TRY(space->kind->weights(space));
      row++;
      break;
    case GX_PROJECT:
      GX_TRY(space->kind->project(space));
      row++;
      break;
    case GX_ACCELERATE:
      GX_TRY(space->kind->accelerate(space, t + drifted));
      row++;
      break;
    default:
      row = advance(stepper, row, dt, &drifted);
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
}

static enum gx_status step_tableau(struct gx_stepper *stepper, double t, double dt)
{
  const struct gx_tableau *tableau = stepper->clock->tableau;
  struct gx_space *space = stepper->space;
  for (int i = 0; i < stepper->state.count; i++)
    memcpy(stepper->start[i], stepper->state.array[i], stepper->state.length[i] * sizeof(double));
  for (int s = 0; s < tableau->stages; s++) {
    if (s) {
      set_state(stepper, s, tableau->a[s], dt);
      stepper->accelerated = false;
    }
    GX_TRY(gx_stepper_accelerate(stepper, t + tableau->c[s] * dt));
    observe(stepper, tableau->b[s] * dt);
    space->kind->rates(space, stepper->rate[s]);
  }
  set_state(stepper, tableau->stages, tableau->b, dt);
  stepper->accelerated = false;
  return GX_OK;
}

enum gx_status gx_stepper_step(struct gx_stepper *stepper, double t, double dt)
{
  return stepper->clock->rows ? step_rows(stepper, t, dt) : step_tableau(stepper, t, dt);
}
