/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weights of the slots, and gathering by them. The core is inlined with the support constant. */
#include "slots_core.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include <gridcross/basis.h>

#include "../core/aligned.h"
#include "../core/kernel.h"

/* Particles, with those that fill up the last vectors. */
static size_t padded(const struct gx_slots *slots)
{
  return (size_t)(slots->cells + GX_SLOTS_LANES - 1) / GX_SLOTS_LANES * GX_SLOTS_LANES * (size_t)slots->slots;
}

/* Hands out the arrays of the block; returns the doubles they take. */
static size_t place(struct gx_slots *slots, double *at)
{
  const struct gx_slots_stretch longest = gx_slots_stretch_from(slots, 0);
  const size_t scratch = longest.pitch * (size_t)slots->slots;
  const size_t weights = (slots->uniform ? (size_t)slots->slots : padded(slots)) * (size_t)slots->support;
  size_t used = 0;
#define PLACE(array, length) used += gx_aligned_place(array, 1, length, at ? at + used : NULL)
  PLACE(&slots->S, weights);
  PLACE(&slots->D, weights);
  PLACE(&slots->V0_D, weights);
  PLACE(&slots->m_S, weights);
  PLACE(&slots->V0, padded(slots));
  PLACE(&slots->band, (size_t)(slots->support * slots->nodes));
  double **const of_stretch[] = {&slots->F,       &slots->b,       &slots->exact_u, &slots->exact_v,
                                 &slots->exact_F, &slots->exact_P, &slots->u,       &slots->v};
  for (size_t i = 0; i < sizeof of_stretch / sizeof *of_stretch; i++) PLACE(of_stretch[i], scratch);
  PLACE(&slots->P, scratch + 2 * GX_SLOTS_MARGIN);
  slots->P = at ? slots->P + GX_SLOTS_MARGIN : NULL;
  PLACE(&slots->shares, (size_t)slots->support * GX_SLOTS_ROW);
  PLACE(&slots->tally, 2 * GX_QUANTITIES * GX_SLOTS_ROW);
  PLACE(&slots->forms, 4 * ((size_t)slots->nodes + GX_MAX_SUPPORT));
#undef PLACE
  return used;
}

/* Weights of all particles with a factor: [support][points], scale * factor * weight; factor NULL: scale * weight. */
struct weights {
  const struct gx_lattice_line *line;
  const double *weight, *factor;
  double scale;
};

/* What the lowest function that a slot meets lies above that of the first slot. */
static int offset_of(const struct gx_lattice_line *line, int slot)
{
  return line->first[slot] - line->first[0];
}

/* Of the functions that some particle of a cell meets; 0 for those that this one does not. */
static int support_of(const struct gx_lattice_line *line)
{
  return line->support + offset_of(line, line->period - 1);
}

static double weight_at(const struct weights *weights, int k, int p)
{
  const int met = k - offset_of(weights->line, p % weights->line->period);
  if (met < 0 || met >= weights->line->support) return 0;
  return weights->scale * (weights->factor ? weights->factor[p] : 1) * weights->weight[met * weights->line->points + p];
}

/* Whether the weights of a place in a cell differ between cells by the round-off of positions alone. */
static bool alike(const struct weights *weights)
{
  const int period = weights->line->period, cells = weights->line->points / period;
  double most = 0;
  for (int k = 0; k < support_of(weights->line); k++)
    for (int p = 0; p < weights->line->points; p++) most = fmax(most, fabs(weight_at(weights, k, p)));
  for (int k = 0; k < support_of(weights->line); k++)
    for (int p = period; p < weights->line->points; p++)
      if (fabs(weight_at(weights, k, p) - weight_at(weights, k, p % period)) > 64 * DBL_EPSILON * cells * most) return false;
  return true;
}

static void copy_weights(const struct gx_slots *slots, const struct weights *weights, double *to)
{
  const int period = slots->slots;
  for (int slot = 0; slot < period; slot++)
    for (int k = 0; k < slots->support; k++) {
      double sum = 0;
      for (int cell = 0; cell < slots->cells; cell++) {
        const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, cell / GX_SLOTS_STRETCH * GX_SLOTS_STRETCH);
        const double value = weight_at(weights, k, cell * period + slot);
        sum += value;
        if (!slots->uniform)
          to[stretch.at * (size_t)slots->support + (size_t)(slot * slots->support + k) * stretch.pitch +
             (size_t)(cell - stretch.from)] = value;
      }
      if (slots->uniform) to[slot * slots->support + k] = sum / slots->cells;
    }
}

/* Adds what the particles have, in the order of slots, [padded], the first `count` of a cell one by one, the others again from the first
 * one on. */
static void put_in_slots(const struct gx_slots *slots, int count, const double *from, double *to)
{
  for (int p = 0; p < slots->cells * slots->slots; p++) {
    const int cell = p / slots->slots, slot = p % slots->slots % count;
    const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, cell / GX_SLOTS_STRETCH * GX_SLOTS_STRETCH);
    to[stretch.at + (size_t)slot * stretch.pitch + (size_t)(cell - stretch.from)] += from[p];
  }
}

/* The problem at the particles in the order of slots, and stretch by stretch. */
static int pose(struct gx_slots *slots, const struct gx_particles *particles, const struct gx_posed *posed)
{
  double *X = calloc(padded(slots), sizeof *X);
  slots->parts = calloc((size_t)(slots->cells / GX_SLOTS_STRETCH + 1), sizeof *slots->parts);
  if (X) put_in_slots(slots, slots->slots, particles->X[0], X);
  if (X) slots->posed = gx_problem_pose(posed->problem, &posed->options, padded(slots), &X);
  free(X);
  if (!slots->posed || !slots->parts) return -1;
  for (int from = 0; from < slots->cells; from += GX_SLOTS_STRETCH) {
    const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, from);
    slots->parts[from / GX_SLOTS_STRETCH] = gx_problem_part(slots->posed, stretch.at, stretch.pitch * (size_t)slots->slots);
  }
  return 0;
}

/* Whether the slots of a cell have the same D up to round-off. */
static bool same_slopes(const struct gx_slots *slots)
{
  double most = 0;
  for (int i = 0; i < slots->slots * slots->support; i++) most = fmax(most, fabs(slots->D[i]));
  for (int i = slots->support; i < slots->slots * slots->support; i++)
    if (fabs(slots->D[i] - slots->D[i % slots->support]) > 64 * DBL_EPSILON * slots->cells * most) return false;
  return true;
}

static void merge_strains(struct gx_slots *slots)
{
  slots->strains = slots->slots;
  if (!slots->uniform || !same_slopes(slots)) return;
  slots->strains = 1;
  for (int i = slots->support; i < slots->slots * slots->support; i++) slots->V0_D[i % slots->support] += slots->V0_D[i];
}

/* A weight of a cell. */
static double weight_of(const struct gx_slots *slots, const double *weights, int cell, int slot, int k)
{
  const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, cell / GX_SLOTS_STRETCH * GX_SLOTS_STRETCH);
  const double *first = weights + gx_slots_weights_at(slots, &stretch, slot);
  return slots->uniform ? first[k] : first[(size_t)k * stretch.pitch + (size_t)(cell - stretch.from)];
}

static void fill_band(struct gx_slots *slots)
{
  for (int cell = 0; cell < slots->cells; cell++)
    for (int slot = 0; slot < slots->slots; slot++)
      for (int i = 0; i < slots->support; i++)
        for (int k = 0; i + k < slots->support; k++)
          slots->band[k * slots->nodes + slots->base + cell + i] +=
              weight_of(slots, slots->m_S, cell, slot, i) * weight_of(slots, slots->S, cell, slot, i + k);
}

struct gx_slots *gx_slots_create(const struct gx_lattice_line *line, const struct gx_particles *particles,
                                 const struct gx_posed *posed)
{
  if (support_of(line) > GX_MAX_SUPPORT) return NULL;
  struct gx_slots *slots = calloc(1, sizeof *slots);
  if (!slots) return NULL;
  const struct weights S = {line, line->S, NULL, 1}, D = {line, line->D, NULL, 1}, V0_D = {line, line->D, particles->V0, -1},
                       m_S = {line, line->S, particles->m, 1};
  slots->slots = line->period;
  slots->cells = line->points / line->period;
  slots->support = support_of(line);
  slots->base = line->first[0];
  slots->nodes = line->nodes;
  slots->uniform = alike(&S) && alike(&D) && alike(&V0_D) && alike(&m_S);
  double *arrays = gx_aligned_zeros(place(slots, NULL) * sizeof(double), &slots->block);
  if (!arrays || pose(slots, particles, posed)) {
    gx_slots_free(slots);
    return NULL;
  }
  place(slots, arrays);
  copy_weights(slots, &S, slots->S);
  copy_weights(slots, &D, slots->D);
  copy_weights(slots, &V0_D, slots->V0_D);
  copy_weights(slots, &m_S, slots->m_S);
  merge_strains(slots);
  put_in_slots(slots, slots->strains, particles->V0, slots->V0);
  slots->volume = gx_particles_volume(particles) * (slots->slots / slots->strains);
  fill_band(slots);
  gx_slots_force_prepare(slots);
  return slots;
}

void gx_slots_free(struct gx_slots *slots)
{
  if (!slots) return;
  gx_force_series_free(slots->series);
  gx_problem_free(slots->posed);
  free(slots->parts);
  free(slots->block);
  free(slots);
}

/* value = start + sum_k w_k field_k of the cells of a slot. */
GX_CORE void gather_alike(const int support, double start, size_t n, const double *restrict weight, const double *restrict field,
                          double *restrict value)
{
  double w[GX_MAX_SUPPORT];
  for (int k = 0; k < support; k++) w[k] = weight[k];
  for (size_t i = 0; i < n; i++) {
    double sum = start;
    for (int k = 0; k < support; k++) sum += w[k] * field[i + (size_t)k];
    value[i] = sum;
  }
}

/* The same of any support, with one weight for all cells or one for each. */
GX_CORE void gather_any(const int support, const bool uniform, double start, size_t n, const double *restrict w,
                        const double *restrict field, double *restrict value)
{
  for (size_t i = 0; i < n; i++) value[i] = start;
  for (size_t k = 0; k < (size_t)support; k++)
    for (size_t i = 0; i < n; i++) value[i] += (uniform ? w[k] : w[k * n + i]) * field[i + k];
}

GX_CLONES void gx_slots_values(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, int count,
                               const double *weights, double start, const double *field, double *values)
{
  const size_t n = stretch->pitch;
  for (int slot = 0; slot < count; slot++) {
    const double *w = weights + gx_slots_weights_at(slots, stretch, slot);
    double *value = values + (size_t)slot * n;
    if (!slots->uniform)
      gather_any(slots->support, false, start, n, w, field, value);
    else if (slots->support == 2)
      gather_alike(2, start, n, w, field, value);
    else if (slots->support == 3)
      gather_alike(3, start, n, w, field, value);
    else if (slots->support == 4)
      gather_alike(4, start, n, w, field, value);
    else
      gather_any(slots->support, true, start, n, w, field, value);
    for (size_t i = (size_t)stretch->cells; i < n; i++) value[i] = start;
  }
}

/* From slots to particles. */
GX_CORE void order(const int count, const struct gx_slots_stretch *stretch, const double *restrict values, double *restrict to)
{
  for (int i = 0; i < stretch->cells; i++)
    for (int slot = 0; slot < count; slot++) to[i * count + slot] = values[(size_t)slot * stretch->pitch + (size_t)i];
}

GX_CLONES static void put_in_order(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, const double *values,
                                   double *to)
{
  if (slots->slots == 2)
    order(2, stretch, values, to);
  else if (slots->slots == 4)
    order(4, stretch, values, to);
  else
    order(slots->slots, stretch, values, to);
}

static void gather_in_order(const struct gx_slots *slots, const double *weights, double start, const double *field, double *to)
{
  for (int from = 0; from < slots->cells; from += GX_SLOTS_STRETCH) {
    const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, from);
    gx_slots_values(slots, &stretch, slots->slots, weights, start, field + slots->base + from, slots->u);
    put_in_order(slots, &stretch, slots->u, to + stretch.at);
  }
}

void gx_slots_gather(const struct gx_slots *slots, const double *field, double *value, double *F)
{
  if (value) gather_in_order(slots, slots->S, 0, field, value);
  if (F) gather_in_order(slots, slots->D, 1, field, F);
}
