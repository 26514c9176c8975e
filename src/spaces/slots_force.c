/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces stretch by stretch: F of all its slots, P and the body force, then for every function k that a cell meets the sum of its
 * shares over the slots, and last these sums shifted by k. Cores are inlined with the support constant. */
#include "slots_core.h"

#include "../core/kernel.h"

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
  const bool dirty = stretch->from > 0 || (size_t)stretch->cells < stretch->pitch;
  for (int k = 0; dirty && k < slots->support; k++)
    for (int i = stretch->cells; i < stretch->cells + GX_SLOTS_MARGIN; i++) shares[k * GX_SLOTS_ROW + i] = 0;
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

/* force[i] = sum_k shares[k][i - k]; the first support - 1 nodes have what the stretch before left there. */
GX_CORE void shift(const int support, const struct gx_slots_stretch *stretch, const double *restrict shares,
                   double *restrict force)
{
  const int nodes = stretch->cells + support - 1, begun = stretch->from > 0 ? support - 1 : 0;
  for (int i = 0; i < begun; i++)
    for (int k = 0; k < support; k++) force[i] += shares[k * GX_SLOTS_ROW + i - k];
  for (int i = begun; i < nodes; i++) {
    double sum = shares[i];
    for (int k = 1; k < support; k++) sum += shares[k * GX_SLOTS_ROW + i - k];
    force[i] = sum;
  }
}

GX_CLONES static void add_up(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, double *force)
{
  const double *shares = slots->shares + GX_SLOTS_MARGIN;
  if (slots->support == 2)
    shift(2, stretch, shares, force);
  else if (slots->support == 3)
    shift(3, stretch, shares, force);
  else
    shift(slots->support, stretch, shares, force);
}

static void clear_beside(const struct gx_slots *slots, double *force)
{
  for (int i = 0; i < slots->base; i++) force[i] = 0;
  for (int i = slots->base + slots->cells + slots->support - 1; i < slots->nodes; i++) force[i] = 0;
}

static void find_body(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, double t)
{
  const struct gx_posed *posed = gx_slots_posed(slots, stretch);
  posed->problem->body(posed, t, (double *[]){slots->b});
}

bool gx_slots_force(struct gx_slots *slots, const double *u, double t, double *force)
{
  const struct gx_problem *problem = slots->posed->problem;
  bool sound = true;
  clear_beside(slots, force);
  for (int from = 0; from < slots->cells; from += GX_SLOTS_STRETCH) {
    const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, from);
    sound = gx_slots_stress(slots, &stretch, u) && sound;
    if (problem->body) find_body(slots, &stretch, t);
    share_out(slots, &stretch, problem->body ? BOTH : STRESS);
    add_up(slots, &stretch, force + slots->base + from);
  }
  slots->held = slots->cells <= GX_SLOTS_STRETCH;
  return sound;
}

void gx_slots_force_body(struct gx_slots *slots, double t, double *force)
{
  clear_beside(slots, force);
  for (int from = 0; from < slots->cells; from += GX_SLOTS_STRETCH) {
    const struct gx_slots_stretch stretch = gx_slots_stretch_from(slots, from);
    if (!slots->held) find_body(slots, &stretch, t);
    share_out(slots, &stretch, BODY);
    add_up(slots, &stretch, force + slots->base + from);
  }
}
