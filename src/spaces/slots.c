/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells are taken in stretches that stay in cache: F of all its slots, P and the body force, then for every function k that a cell
 * meets the sum of its shares over the slots, and last these sums shifted by k. The core is inlined with the support constant. */
#include "slots.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/basis.h>

#include "../core/aligned.h"
#include "../core/kernel.h"

/* Cells of a stretch; cells that one vector operation takes. */
enum { STRETCH = 256, LANES = 8 };

/* Weights: [slots][support] where all cells have the same, else by stretch [slots][support][pitch]. */
struct gx_slots {
  int cells, slots, support, nodes;
  int base; /* lowest function that cell 0 meets */
  bool uniform;
  double *S, *D, *V0_D, *m_S; /* value, slope, -V0 slope, m value */
  struct gx_posed *posed;     /* at the particles, stretch by stretch and slot by slot */
  double *F, *P, *b;          /* of a stretch, [slots][pitch] */
  double *shares;             /* [support][ROW] sums over the slots of a cell; their margins are 0 */
  void *block;
};

/* Margins of zeros let rows of cells be shifted against each other. */
enum { MARGIN = 16, ROW = MARGIN + STRETCH + MARGIN };

struct stretch {
  int from, cells; /* of the grid */
  size_t pitch;    /* cells, and what fills up the last vector */
  size_t at;       /* of its first particle */
};

static struct stretch stretch_from(const struct gx_slots *slots, int from)
{
  const int cells = slots->cells - from < STRETCH ? slots->cells - from : STRETCH;
  return (struct stretch){from, cells, (size_t)(cells + LANES - 1) / LANES * LANES, (size_t)from * (size_t)slots->slots};
}

/* Particles, with those that fill up the last vectors. */
static size_t padded(const struct gx_slots *slots)
{
  return (size_t)(slots->cells + LANES - 1) / LANES * LANES * (size_t)slots->slots;
}

/* Hands out the arrays of the block; returns the doubles they take. */
static size_t place(struct gx_slots *slots, double *at)
{
  const struct stretch longest = stretch_from(slots, 0);
  const size_t scratch = longest.pitch * (size_t)slots->slots;
  const size_t weights = (slots->uniform ? (size_t)slots->slots : padded(slots)) * (size_t)slots->support;
  size_t used = 0;
#define PLACE(array, length) used += gx_aligned_place(array, 1, length, at ? at + used : NULL)
  PLACE(&slots->S, weights);
  PLACE(&slots->D, weights);
  PLACE(&slots->V0_D, weights);
  PLACE(&slots->m_S, weights);
  PLACE(&slots->F, scratch);
  PLACE(&slots->P, scratch);
  PLACE(&slots->b, scratch);
  PLACE(&slots->shares, (size_t)slots->support * ROW);
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
        const struct stretch stretch = stretch_from(slots, cell / STRETCH * STRETCH);
        const double value = weight_at(weights, k, cell * period + slot);
        sum += value;
        if (!slots->uniform)
          to[stretch.at * (size_t)slots->support + (size_t)(slot * slots->support + k) * stretch.pitch +
             (size_t)(cell - stretch.from)] = value;
      }
      if (slots->uniform) to[slot * slots->support + k] = sum / slots->cells;
    }
}

/* The problem at the particles in the order of slots; those that fill up vectors sit at 0. */
static struct gx_posed *pose(const struct gx_slots *slots, const struct gx_particles *particles, const struct gx_posed *posed)
{
  double *X = calloc(padded(slots), sizeof *X);
  if (!X) return NULL;
  for (int p = 0; p < slots->cells * slots->slots; p++) {
    const int cell = p / slots->slots, slot = p % slots->slots;
    const struct stretch stretch = stretch_from(slots, cell / STRETCH * STRETCH);
    X[stretch.at + (size_t)slot * stretch.pitch + (size_t)(cell - stretch.from)] = particles->X[0][p];
  }
  struct gx_posed *own = gx_problem_pose(posed->problem, &posed->options, padded(slots), &X);
  free(X);
  return own;
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
  slots->posed = pose(slots, particles, posed);
  if (!arrays || !slots->posed) {
    gx_slots_free(slots);
    return NULL;
  }
  place(slots, arrays);
  copy_weights(slots, &S, slots->S);
  copy_weights(slots, &D, slots->D);
  copy_weights(slots, &V0_D, slots->V0_D);
  copy_weights(slots, &m_S, slots->m_S);
  return slots;
}

void gx_slots_free(struct gx_slots *slots)
{
  if (!slots) return;
  gx_problem_free(slots->posed);
  free(slots->block);
  free(slots);
}

/* Where the weights of a slot start: [support], or [support][pitch]. */
static size_t weights_at(const struct gx_slots *slots, const struct stretch *stretch, int slot)
{
  const size_t row = (size_t)(slot * slots->support);
  return slots->uniform ? row : stretch->at * (size_t)slots->support + row * stretch->pitch;
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

/* Of every slot of a stretch; start itself where there is no particle. value: [slots][pitch] */
GX_CLONES static void gather(const struct gx_slots *slots, const struct stretch *stretch, const double *weights, double start,
                             const double *field, double *values)
{
  const size_t n = stretch->pitch;
  for (int slot = 0; slot < slots->slots; slot++) {
    const double *w = weights + weights_at(slots, stretch, slot);
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
GX_CORE void order(const int count, const struct stretch *stretch, const double *restrict values, double *restrict to)
{
  for (int i = 0; i < stretch->cells; i++)
    for (int slot = 0; slot < count; slot++) to[i * count + slot] = values[(size_t)slot * stretch->pitch + (size_t)i];
}

GX_CLONES static void put_in_order(const struct gx_slots *slots, const struct stretch *stretch, const double *values, double *to)
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
  for (int from = 0; from < slots->cells; from += STRETCH) {
    const struct stretch stretch = stretch_from(slots, from);
    gather(slots, &stretch, weights, start, field + slots->base + from, slots->F);
    put_in_order(slots, &stretch, slots->F, to + stretch.at);
  }
}

void gx_slots_gather(const struct gx_slots *slots, const double *field, double *value, double *F)
{
  if (value) gather_in_order(slots, slots->S, 0, field, value);
  if (F) gather_in_order(slots, slots->D, 1, field, F);
}

/* Particles whose shares are taken, from a slot on. Weights as they start there. */
struct loads {
  size_t n;
  const double *P, *b, *V0_D, *m_S;
};

/* shares[k] = or += -V0 D_k P + m S_k b of `group` slots at once, whose sums stay in registers. */
GX_CORE void share_alike(const int support, const int group, const bool body, const bool add, const struct loads *loads,
                         double *restrict shares)
{
  enum { MOST_SUPPORT = 4, MOST_GROUP = 4 };
  double V0_D[MOST_GROUP][MOST_SUPPORT], m_S[MOST_GROUP][MOST_SUPPORT];
  const double *restrict P = loads->P, *restrict b = loads->b;
  const size_t n = loads->n;
  for (int g = 0; g < group; g++)
    for (int k = 0; k < support; k++) {
      V0_D[g][k] = loads->V0_D[g * support + k];
      m_S[g][k] = loads->m_S[g * support + k];
    }
  for (size_t i = 0; i < n; i++) {
    double sum[MOST_SUPPORT];
    for (int k = 0; k < support; k++) sum[k] = add ? shares[(size_t)k * ROW + i] : 0;
    for (int g = 0; g < group; g++)
      for (int k = 0; k < support; k++) {
        const size_t at = (size_t)g * n + i;
        sum[k] += body ? V0_D[g][k] * P[at] + m_S[g][k] * b[at] : V0_D[g][k] * P[at];
      }
    for (int k = 0; k < support; k++) shares[(size_t)k * ROW + i] = sum[k];
  }
}

/* The same of one slot and any support, with one weight for all cells or one for each. */
GX_CORE void share_any(const int support, const bool uniform, const bool body, const bool add, const struct loads *loads,
                       double *restrict shares)
{
  const double *restrict P = loads->P, *restrict b = loads->b;
  const size_t n = loads->n, weights = uniform ? 1 : n, cell = uniform ? 0 : 1;
  for (size_t k = 0; k < (size_t)support; k++) {
    const double *restrict V0_D = loads->V0_D + k * weights, *restrict m_S = loads->m_S + k * weights;
    double *restrict to = shares + k * ROW;
    for (size_t i = 0; i < n; i++) {
      const double sum = body ? V0_D[cell * i] * P[i] + m_S[cell * i] * b[i] : V0_D[cell * i] * P[i];
      to[i] = add ? to[i] + sum : sum;
    }
  }
}

GX_CORE void share_slot(const bool uniform, const bool body, const bool add, int support, const struct loads *loads,
                        double *shares)
{
  if (uniform && support == 2)
    share_alike(2, 1, body, add, loads, shares);
  else if (uniform && support == 3)
    share_alike(3, 1, body, add, loads, shares);
  else if (uniform && support == 4)
    share_alike(4, 1, body, add, loads, shares);
  else
    share_any(support, uniform, body, add, loads, shares);
}

GX_CORE void share_four(const bool body, const bool add, int support, const struct loads *loads, double *shares)
{
  if (support == 2)
    share_alike(2, 4, body, add, loads, shares);
  else if (support == 3)
    share_alike(3, 4, body, add, loads, shares);
  else
    share_alike(4, 4, body, add, loads, shares);
}

/* Shares of every cell of a stretch, and zeros behind. */
GX_CORE void share(const bool uniform, const bool body, const struct gx_slots *slots, const struct stretch *stretch)
{
  double *shares = slots->shares + MARGIN;
  const bool fours = uniform && slots->support >= 2 && slots->support <= 4;
  int slot = 0;
  while (slot < slots->slots) {
    const size_t from = (size_t)slot * stretch->pitch, weights = weights_at(slots, stretch, slot);
    const struct loads loads = {stretch->pitch, slots->P + from, slots->b + from, slots->V0_D + weights, slots->m_S + weights};
    const bool four = fours && slot + 4 <= slots->slots;
    if (four && slot > 0)
      share_four(body, true, slots->support, &loads, shares);
    else if (four)
      share_four(body, false, slots->support, &loads, shares);
    else if (slot > 0)
      share_slot(uniform, body, true, slots->support, &loads, shares);
    else
      share_slot(uniform, body, false, slots->support, &loads, shares);
    slot += four ? 4 : 1;
  }
  const bool dirty = stretch->from > 0 || (size_t)stretch->cells < stretch->pitch;
  for (int k = 0; dirty && k < slots->support; k++)
    for (int i = stretch->cells; i < stretch->cells + MARGIN; i++) shares[k * ROW + i] = 0;
}

GX_CLONES static void share_out(const struct gx_slots *slots, const struct stretch *stretch, bool body)
{
  if (slots->uniform && body)
    share(true, true, slots, stretch);
  else if (slots->uniform)
    share(true, false, slots, stretch);
  else if (body)
    share(false, true, slots, stretch);
  else
    share(false, false, slots, stretch);
}

/* force[i] = sum_k shares[k][i - k]; the first support - 1 nodes have what the stretch before left there. */
GX_CORE void shift(const int support, const struct stretch *stretch, const double *restrict shares, double *restrict force)
{
  const int nodes = stretch->cells + support - 1, begun = stretch->from > 0 ? support - 1 : 0;
  for (int i = 0; i < begun; i++)
    for (int k = 0; k < support; k++) force[i] += shares[k * ROW + i - k];
  for (int i = begun; i < nodes; i++) {
    double sum = shares[i];
    for (int k = 1; k < support; k++) sum += shares[k * ROW + i - k];
    force[i] = sum;
  }
}

GX_CLONES static void add_up(const struct gx_slots *slots, const struct stretch *stretch, double *force)
{
  const double *shares = slots->shares + MARGIN;
  if (slots->support == 2)
    shift(2, stretch, shares, force);
  else if (slots->support == 3)
    shift(3, stretch, shares, force);
  else
    shift(slots->support, stretch, shares, force);
}

bool gx_slots_force(struct gx_slots *slots, const double *u, double t, double *force)
{
  const struct gx_problem *problem = slots->posed->problem;
  const int last = slots->base + slots->cells + slots->support - 1;
  bool sound = true;
  for (int i = 0; i < slots->base; i++) force[i] = 0;
  for (int i = last; i < slots->nodes; i++) force[i] = 0;
  for (int from = 0; from < slots->cells; from += STRETCH) {
    const struct stretch stretch = stretch_from(slots, from);
    const size_t n = stretch.pitch * (size_t)slots->slots;
    if (u) {
      gather(slots, &stretch, slots->D, 1, u + slots->base + from, slots->F);
      sound = problem->material->piola(&slots->posed->options.moduli, 1, n, &slots->F, &slots->P) < 0 && sound;
    } else {
      memset(slots->P, 0, n * sizeof *slots->P);
    }
    if (problem->body && n == slots->posed->n) {
      problem->body(slots->posed, t, &slots->b);
    } else if (problem->body) {
      const struct gx_posed part = gx_problem_part(slots->posed, stretch.at, n);
      problem->body(&part, t, &slots->b);
    }
    share_out(slots, &stretch, problem->body);
    add_up(slots, &stretch, force + slots->base + from);
  }
  return sound;
}
