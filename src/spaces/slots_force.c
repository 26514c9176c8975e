/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces stretch by stretch: F of all its slots, P and the body force, then for every function k that a cell meets the sum of its
 * shares over the slots, and last these sums shifted by k. Where the slots of a cell have the same F, its P takes the place of the sums;
 * a body force that is a series needs none. Cores are inlined with the support constant. */
#include "slots_core.h"

#include <string.h>

#include "../core/kernel.h"

/* Numbers of a series that stay in a first-level cache, from where they take less time than a particle in every cell; more of them, from
 * the next level, take that of three. */
enum { SERIES = 3072 };

/* What is shared out. */
enum { STRESS = 1, BODY = 2, BOTH = STRESS | BODY };

/* Particles whose shares are taken, from a slot on. Weights as they start there. */
struct loads {
  size_t n;
  const double *P, *b, *V0_D, *m_S;
};

/* shares[k] = or += -V0 D_k P, m S_k b or both of `group` slots at once, whose sums stay in registers. */
GX_CORE void share_alike(const int support, const int group, const int what, const bool add, const struct loads *loads,
                         double *restrict shares)
{
  double V0_D[GX_SLOTS_GROUP][GX_SLOTS_FEW], m_S[GX_SLOTS_GROUP][GX_SLOTS_FEW];
  const double *restrict P = loads->P, *restrict b = loads->b;
  const size_t n = loads->n;
  for (int g = 0; g < group; g++)
    for (int k = 0; k < support; k++) {
      V0_D[g][k] = loads->V0_D[g * support + k];
      m_S[g][k] = loads->m_S[g * support + k];
    }
  for (size_t i = 0; i < n; i++) {
    double sum[GX_SLOTS_FEW];
    for (int k = 0; k < support; k++) sum[k] = add ? shares[(size_t)k * GX_SLOTS_ROW + i] : 0;
    for (int g = 0; g < group; g++)
      for (int k = 0; k < support; k++) {
        const size_t at = (size_t)g * n + i;
        sum[k] += what == BOTH ? V0_D[g][k] * P[at] + m_S[g][k] * b[at] : what == STRESS ? V0_D[g][k] * P[at] : m_S[g][k] * b[at];
      }
    for (int k = 0; k < support; k++) shares[(size_t)k * GX_SLOTS_ROW + i] = sum[k];
  }
}

/* The same of one slot and any support, with one weight for all cells or one for each. */
GX_CORE void share_any(const int support, const bool uniform, const int what, const bool add, const struct loads *loads,
                       double *restrict shares)
{
  const double *restrict P = loads->P, *restrict b = loads->b;
  const size_t n = loads->n, weights = uniform ? 1 : n, cell = uniform ? 0 : 1;
  for (size_t k = 0; k < (size_t)support; k++) {
    const double *restrict V0_D = loads->V0_D + k * weights, *restrict m_S = loads->m_S + k * weights;
    double *restrict to = shares + k * GX_SLOTS_ROW;
    for (size_t i = 0; i < n; i++) {
      const double sum = what == BOTH     ? V0_D[cell * i] * P[i] + m_S[cell * i] * b[i]
                         : what == STRESS ? V0_D[cell * i] * P[i]
                                          : m_S[cell * i] * b[i];
      to[i] = add ? to[i] + sum : sum;
    }
  }
}

GX_CORE void share_slot(const bool uniform, const int what, const bool add, int support, const struct loads *loads,
                        double *shares)
{
  if (uniform && support == 2)
    share_alike(2, 1, what, add, loads, shares);
  else if (uniform && support == 3)
    share_alike(3, 1, what, add, loads, shares);
  else if (uniform && support == 4)
    share_alike(4, 1, what, add, loads, shares);
  else
    share_any(support, uniform, what, add, loads, shares);
}

GX_CORE void share_four(const int what, const bool add, int support, const struct loads *loads, double *shares)
{
  if (support == 2)
    share_alike(2, 4, what, add, loads, shares);
  else if (support == 3)
    share_alike(3, 4, what, add, loads, shares);
  else
    share_alike(4, 4, what, add, loads, shares);
}

/* Zeros behind the cells of a stretch, unless they are there. */
GX_CORE void clear_behind(const struct gx_slots_stretch *stretch, double *row)
{
  const bool dirty = stretch->from > 0 || (size_t)stretch->cells < stretch->pitch;
  for (int i = stretch->cells; dirty && i < stretch->cells + GX_SLOTS_MARGIN; i++) row[i] = 0;
}

/* Shares of every cell of a stretch, and zeros behind. */
GX_CORE void share(const bool uniform, const int what, const struct gx_slots *slots, const struct gx_slots_stretch *stretch)
{
  double *shares = slots->shares + GX_SLOTS_MARGIN;
  const bool fours = uniform && slots->support >= 2 && slots->support <= GX_SLOTS_FEW;
  int slot = 0;
  while (slot < slots->slots) {
    const size_t from = (size_t)slot * stretch->pitch, weights = gx_slots_weights_at(slots, stretch, slot);
    const struct loads loads = {stretch->pitch, slots->P + from, slots->b + from, slots->V0_D + weights, slots->m_S + weights};
    const bool four = fours && slot + 4 <= slots->slots;
    if (four && slot > 0)
      share_four(what, true, slots->support, &loads, shares);
    else if (four)
      share_four(what, false, slots->support, &loads, shares);
    else if (slot > 0)
      share_slot(uniform, what, true, slots->support, &loads, shares);
    else
      share_slot(uniform, what, false, slots->support, &loads, shares);
    slot += four ? 4 : 1;
  }
  for (int k = 0; k < slots->support; k++) clear_behind(stretch, shares + k * GX_SLOTS_ROW);
}

GX_CLONES static void share_out(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, int what)
{
#define SHARE(uniform)                                                                                                           \
  if (what == BOTH)                                                                                                              \
    share(uniform, BOTH, slots, stretch);                                                                                        \
  else if (what == STRESS)                                                                                                       \
    share(uniform, STRESS, slots, stretch);                                                                                      \
  else                                                                                                                           \
    share(uniform, BODY, slots, stretch);
  if (slots->uniform) {
    SHARE(true)
  } else {
    SHARE(false)
  }
#undef SHARE
}

/* Rows of the cells of a stretch, with zeros on both sides, one for every k, or of equal ones that have different weights the first. */
struct shifted {
  int cells;
  const double *row, *weight; /* weight: NULL: 1 */
};

/* force[i] += sum_k weight_k row_k[i - k] */
GX_CORE void shift(const int support, const bool weighted, const struct shifted *shifted, double *restrict force)
{
  const double *restrict row = shifted->row;
  const int nodes = shifted->cells + support - 1, pitch = weighted ? 0 : GX_SLOTS_ROW;
  double w[GX_MAX_SUPPORT];
  for (int k = 0; k < support; k++) w[k] = weighted ? shifted->weight[k] : 1;
  for (int i = 0; i < nodes; i++) {
    double sum = w[0] * row[i];
    for (int k = 1; k < support; k++) sum += w[k] * row[k * pitch + i - k];
    force[i] += sum;
  }
}

GX_CLONES static void add_up(int support, const struct shifted *shifted, double *force)
{
#define SHIFT(support)                                                                                                           \
  if (shifted->weight)                                                                                                           \
    shift(support, true, shifted, force);                                                                                        \
  else                                                                                                                           \
    shift(support, false, shifted, force);
  if (support == 2) {
    SHIFT(2)
  } else if (support == 3) {
    SHIFT(3)
  } else {
    SHIFT(support)
  }
#undef SHIFT
}

/* The body force of a stretch at time t. */
static void find_body(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, double t)
{
  const struct gx_posed *posed = gx_slots_posed(slots, stretch);
  posed->problem->body(posed, t, (double *[]){slots->b});
}

/* To the force, what the slots of a stretch share out. */
static void add_shares(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, int what, double *force)
{
  share_out(slots, stretch, what);
  add_up(slots->support, &(struct shifted){stretch->cells, slots->shares + GX_SLOTS_MARGIN, NULL},
         force + slots->base + stretch->from);
}

/* The same of P that slots have together. */
static void add_common_stress(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, double *force)
{
  clear_behind(stretch, slots->P);
  add_up(slots->support, &(struct shifted){stretch->cells, slots->P, slots->V0_D}, force + slots->base + stretch->from);
}

/* force = that of the series, or 0 */
static void start(const struct gx_slots *slots, double t, double *force)
{
  if (slots->series)
    gx_force_series_at(slots->series, slots->posed->problem->body_angle(slots->posed, t), force);
  else
    memset(force, 0, (size_t)slots->nodes * sizeof *force);
}

bool gx_slots_force(struct gx_slots *slots, const double *u, double t, double *force)
{
  const bool body = slots->posed->problem->body && !slots->series, common = slots->uniform && slots->strains == 1;
  bool sound = true;
  for (int from = 0; from < slots->cells; from += GX_SLOTS_STRETCH) {
    const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, from);
    sound = gx_slots_stress(slots, &stretch, u) && sound;
    if (from == 0) start(slots, t, force); /* here, where the processor waits for divisions meanwhile */
    if (body) find_body(slots, &stretch, t);
    if (common) add_common_stress(slots, &stretch, force);
    if (body || !common) add_shares(slots, &stretch, common ? BODY : body ? BOTH : STRESS, force);
  }
  slots->held = slots->cells <= GX_SLOTS_STRETCH;
  return sound;
}

void gx_slots_force_body(struct gx_slots *slots, double t, double *force)
{
  start(slots, t, force);
  for (int from = 0; from < slots->cells && !slots->series; from += GX_SLOTS_STRETCH) {
    const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, from);
    if (!slots->held) find_body(slots, &stretch, t);
    add_shares(slots, &stretch, BODY, force);
  }
}

/* The angle of the problem is start + rate t. */
struct sampling {
  struct gx_slots *slots;
  double start, rate;
};

static void sample(void *context, double angle, double *force)
{
  const struct sampling *sampling = context;
  gx_slots_force_body(sampling->slots, (angle - sampling->start) / sampling->rate, force);
}

void gx_slots_force_prepare(struct gx_slots *slots)
{
  const struct gx_posed *posed = slots->posed;
  if (!posed->problem->body || !posed->problem->body_angle) return;
  const double start = posed->problem->body_angle(posed, 0), rate = posed->problem->body_angle(posed, 1) - start;
  struct sampling sampling = {slots, start, rate};
  const size_t nodes = (size_t)slots->nodes;
  slots->series = gx_force_series_create(nodes, SERIES / nodes, sample, &sampling);
}
