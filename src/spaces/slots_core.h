/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the parts of gx_slots share. Cells are taken in stretches that stay in cache. */
#ifndef GRIDCROSS_SPACES_SLOTS_CORE_H
#define GRIDCROSS_SPACES_SLOTS_CORE_H

#include "force_series.h"
#include "slots.h"

/* Cells of a stretch; cells that one vector operation takes. Margins of zeros let rows of cells be shifted against each other. */
enum { GX_SLOTS_STRETCH = 256, GX_SLOTS_LANES = 8, GX_SLOTS_MARGIN = 16, GX_SLOTS_ROW = GX_SLOTS_STRETCH + 2 * GX_SLOTS_MARGIN };
/* Slots that kernels take at once, of functions so few that all weights stay in registers. */
enum { GX_SLOTS_GROUP = 4, GX_SLOTS_FEW = 4 };

/* Weights: [slots][support] where all cells have the same, else by stretch [slots][support][pitch]. Where the slots of a cell have the
 * same D too, as hats do, they have one F and P, and V0 is that of all of them: `strains` is 1. */
struct gx_slots {
  int cells, slots, support, nodes;
  int strains; /* slots with an F of their own: 1 or slots */
  int base;    /* lowest function that cell 0 meets */
  bool uniform;
  double *S, *D, *V0_D, *m_S; /* value, slope, -V0 slope of the strains, m value */
  double *V0;             /* of the strains, stretch by stretch from its first particle on, slot by slot; 0 where there is none */
  double *band;           /* [support][nodes] sum m_p S_ip S_i+k,p */
  double volume;          /* V0 of each of the strains, m; 0: they differ */
  struct gx_posed *posed; /* at the particles, stretch by stretch and slot by slot */
  struct gx_posed *parts; /* the same, of each stretch */
  struct gx_force_series *series; /* the nodes' share of the body force; NULL: by particles */
  /* of a stretch, [slots][pitch]; F and P of the strains */
  double *F, *P, *b;
  double *exact_u, *exact_v, *exact_F, *exact_P;
  double *u, *v;
  bool held;      /* F, P and, without a series, b are those of the last force, and all of them */
  double *shares; /* [support][ROW] sums over the slots of a cell; their margins are 0 */
  double *tally;  /* [2 GX_QUANTITIES][ROW] sums and maxima over the slots of the cells that far into a stretch */
  double *forms;  /* [4][nodes + GX_MAX_SUPPORT] of a survey; zeros behind the nodes */
  void *block;
};

struct gx_slots_stretch {
  int from, cells; /* of the grid */
  size_t pitch;    /* cells, and what fills up the last vector */
  size_t at;       /* of its first particle */
};

static inline struct gx_slots_stretch gx_slots_stretch_from(const struct gx_slots *slots, int from)
{
  const int cells = slots->cells - from < GX_SLOTS_STRETCH ? slots->cells - from : GX_SLOTS_STRETCH;
  return (struct gx_slots_stretch){.from = from,
                                   .cells = cells,
                                   .pitch = (size_t)(cells + GX_SLOTS_LANES - 1) / GX_SLOTS_LANES * GX_SLOTS_LANES,
                                   .at = (size_t)from * (size_t)slots->slots};
}

/* Where the weights of a slot start: [support], or [support][pitch]. */
static inline size_t gx_slots_weights_at(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, int slot)
{
  const size_t row = (size_t)(slot * slots->support);
  return slots->uniform ? row : stretch->at * (size_t)slots->support + row * stretch->pitch;
}

/* The problem at the particles of a stretch. */
static inline const struct gx_posed *gx_slots_posed(const struct gx_slots *slots, const struct gx_slots_stretch *stretch)
{
  return &slots->parts[stretch->from / GX_SLOTS_STRETCH];
}

/* values = start + sum_k weight_k field_k of the first `count` slots of a stretch; start itself where there is no particle. */
void gx_slots_values(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, int count, const double *weights,
                     double start, const double *field, double *values);
/* Last of creation: finds a series of the body force where there is one that is worth it. */
void gx_slots_force_prepare(struct gx_slots *slots);

/* F and P of a stretch. Returns whether every F is that of a body that is not tangled. */
static inline bool gx_slots_stress(const struct gx_slots *slots, const struct gx_slots_stretch *stretch, const double *u)
{
  const struct gx_posed *posed = slots->posed;
  const size_t n = stretch->pitch * (size_t)slots->strains;
  gx_slots_values(slots, stretch, slots->strains, slots->D, 1, u + slots->base + stretch->from, slots->F);
  return posed->problem->material->piola(&posed->options.moduli, 1, n, &slots->F, &slots->P) < 0;
}

#endif
