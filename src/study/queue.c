/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cases of a study in the order in which they are begun: longest first, so that none of the long ones is left to the end, when the
 * other threads have nothing to do. What a case costs is guessed from its parameters alone: the order of beginning changes no result. */
#include <gridcross/study.h>

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "simulation_plan.h"

struct entry {
  double cost, share; /* share: of the cost of what is left then */
  size_t index;
};

struct gx_queue {
  pthread_mutex_t lock;
  size_t count, next;
  struct entry *entry; /* [count], owned */
};

/* Of a step of one particle, in those of the standard method in 1-D, roughly as README.md measures them. */
static double cost_of_step(const struct gx_simulation *simulation)
{
  const struct gx_space_options *options = &simulation->space_options;
  const bool fixed = simulation->kind->fixed_grid;
  const int support = options->basis && !options->basis->has_degree ? 3 : options->degree + 1;
  double cost = simulation->clock->stages * pow(support, simulation->problem_options.dim - 1);
  if (simulation->kind->collocation) return cost * (options->reference ? 1.5 : 15);
  if (!fixed) cost *= 0.3;
  if (options->consistent) cost *= fixed ? 7 : 1.2;
  return options->reconstructed ? 3 * cost : cost;
}

static double cost_of_case(const struct gx_case *one)
{
  enum { BUDGET = 30 }; /* steps that one with its budget takes */
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  if (gx_simulation_plan(&simulation, one, &outcome) != GX_OK) return 0;
  const struct gx_value *budget = &one->value[GX_OUTPUT_BUDGET], *measures = &one->value[GX_OUTPUT_MEASURES];
  double particles = pow((double)simulation.space_options.cells[0] * simulation.per_cell, simulation.problem_options.dim);
  if (simulation.points) particles = (double)simulation.points->n;
  double steps = simulation.steps * (measures->type == GX_TEXT && !strcmp(measures->text, "final") ? 1 : 2);
  if (budget->type == GX_INTEGER) steps += BUDGET * ceil(simulation.steps / (double)budget->integer);
  steps += simulation.steps * (double)one->value[GX_OUTPUT_REFERENCE].integer;
  return particles * steps * cost_of_step(&simulation);
}

static int by_cost(const void *left, const void *right)
{
  const struct entry *a = left, *b = right;
  if (a->cost != b->cost) return a->cost < b->cost ? 1 : -1;
  return (a->index > b->index) - (a->index < b->index);
}

struct gx_queue *gx_queue_create(const struct gx_study *study, const bool *skip, bool sorted)
{
  struct gx_queue *queue = calloc(1, sizeof *queue);
  if (!queue) return NULL;
  queue->entry = malloc((study->count + 1) * sizeof *queue->entry);
  if (!queue->entry || pthread_mutex_init(&queue->lock, NULL)) {
    free(queue->entry);
    free(queue);
    return NULL;
  }
  for (size_t i = 0; i < study->count; i++)
    if (!skip || !skip[i])
      queue->entry[queue->count++] = (struct entry){.cost = sorted ? cost_of_case(&study->cases[i]) : 0, .index = i};
  qsort(queue->entry, queue->count, sizeof *queue->entry, by_cost);
  double left = 0;
  for (size_t i = queue->count; i-- > 0;) {
    struct entry *entry = &queue->entry[i];
    left += entry->cost;
    entry->share = entry->cost > 0 ? entry->cost / left : 1 / (double)(queue->count - i);
  }
  return queue;
}

void gx_queue_free(struct gx_queue *queue)
{
  if (!queue) return;
  pthread_mutex_destroy(&queue->lock);
  free(queue->entry);
  free(queue);
}

size_t gx_queue_count(const struct gx_queue *queue)
{
  return queue->count;
}

static bool take(void *context, size_t *index, double *share)
{
  struct gx_queue *queue = context;
  pthread_mutex_lock(&queue->lock);
  const bool any = queue->next < queue->count;
  if (any) {
    *index = queue->entry[queue->next].index;
    *share = queue->entry[queue->next++].share;
  }
  pthread_mutex_unlock(&queue->lock);
  return any;
}

struct gx_source gx_queue_source(struct gx_queue *queue)
{
  return (struct gx_source){.context = queue, .take = take};
}
