/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slabs are as thick as the support reaches, so that every other one may be scattered at once: first the even ones, then the odd. */
#include "blocks.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

#include "../core/aligned.h"
#include "../core/kernel.h"

enum {
  ROOM = 64,       /* particles of a block in 2-D and 3-D: what is made of them fits the innermost cache */
  SHARE = 512,     /* particles that are worth a part */
  MOST_PARTS = 64, /* of all particles */
  LEAST_THICKNESS = 2
};

static const int kinds = 2; /* of strays */

#define PLACE(array, count, length) used += gx_aligned_place(array, count, length, at ? at + used : NULL)

static size_t place_weights(const struct gx_grid *grid, size_t room, struct gx_weights *weights, double *at)
{
  const int dim = grid->dim, support = grid->axis[0].support;
  double *first[GX_MAX_DIM] = {NULL}; /* of half the size */
  size_t used = 0;
  *weights = (struct gx_weights){.dim = dim, .support = support, .n = room};
  PLACE(weights->S, dim, room * (size_t)support);
  PLACE(weights->D, dim, room * (size_t)support);
  PLACE(first, dim, (room + 1) / 2);
  for (int d = 0; d < dim; d++) {
    weights->stride[d] = grid->stride[d];
    weights->first[d] = (int *)first[d];
  }
  return used;
}

static size_t place_block(const struct gx_grid *grid, size_t room, struct gx_block *block, double *at)
{
  const int dim = grid->dim;
  size_t used = 0;
  PLACE(block->T, dim * dim, room);
  PLACE(block->body, dim, room);
  PLACE(block->a, dim, room);
  PLACE(block->v, dim, room);
  PLACE(block->gradient, dim * dim, room);
  PLACE(block->rate_P, dim * dim, room);
  block->n = room;
  return used;
}

static size_t place_arrays(struct gx_blocks *blocks, bool whole, double *at)
{
  const struct gx_grid *grid = blocks->grid;
  const bool line = grid->dim == 1;
  const size_t room = line ? blocks->n : ROOM;
  size_t used = 0;
  PLACE(blocks->moved, grid->dim, blocks->n);
  if (line || whole) used += place_weights(grid, blocks->n, &blocks->whole, at ? at + used : NULL);
  for (size_t w = 0; w < gx_team_size(blocks->team); w++) {
    struct gx_block *block = &blocks->block[w];
    used += place_block(grid, room, block, at ? at + used : NULL);
    if (line)
      block->weights = blocks->whole;
    else
      used += place_weights(grid, room, &block->weights, at ? at + used : NULL);
  }
  return used;
}

#undef PLACE

/* Slabs and the particles in them. */
static int allocate_order(struct gx_blocks *blocks)
{
  const struct gx_axis *last = &blocks->grid->axis[blocks->grid->dim - 1];
  blocks->thickness = last->support - 1 > LEAST_THICKNESS ? last->support - 1 : LEAST_THICKNESS;
  if (blocks->thickness <= last->stored / UINT16_MAX) blocks->thickness = last->stored / UINT16_MAX + 1;
  blocks->slabs = (size_t)((last->stored - last->support) / blocks->thickness + 1);
  blocks->parts = blocks->n < SHARE ? 1 : blocks->n / SHARE < MOST_PARTS ? blocks->n / SHARE : MOST_PARTS;
  size_t starts = blocks->slabs * (blocks->parts + 1) + 1;
  blocks->start = calloc(1, starts * sizeof *blocks->start + blocks->n * (sizeof *blocks->order + sizeof *blocks->slab));
  blocks->memory[1] = blocks->start;
  if (!blocks->start) return -1;
  blocks->order = (uint32_t *)(blocks->start + starts);
  blocks->slab = (uint16_t *)(blocks->order + blocks->n);
  return 0;
}

int gx_blocks_init(struct gx_blocks *blocks, const struct gx_grid *grid, const struct gx_basis *basis, size_t n, double *const *X,
                   bool whole, struct gx_team *team)
{
  const bool line = grid->dim == 1;
  *blocks = (struct gx_blocks){.grid = grid, .basis = basis, .X = X, .team = line ? NULL : team, .n = n, .parts = 1};
  blocks->block = calloc(gx_team_size(blocks->team), sizeof *blocks->block);
  if (!blocks->block) return -1;
  double *arrays = gx_aligned_zeros(place_arrays(blocks, whole, NULL) * sizeof(double), &blocks->memory[0]);
  if (!arrays) return -1;
  place_arrays(blocks, whole, arrays);
  return line ? 0 : allocate_order(blocks);
}

void gx_blocks_free(struct gx_blocks *blocks)
{
  free(blocks->block);
  for (int i = 0; i < 2; i++) free(blocks->memory[i]);
}

/* Weights of w->n particles along direction d; returns the index of one whose domain is too wide, or -1. */
static long evaluate(const struct gx_blocks *blocks, size_t from, const struct gx_weights *w, int d)
{
  const double *half = blocks->half[d] ? blocks->half[d] + from : NULL;
  return blocks->basis->evaluate(&blocks->grid->axis[d], w->n, blocks->x[d] + from, half, w->first[d], w->S[d], w->D[d]);
}

static void visit_run(struct gx_blocks *blocks, struct gx_block *block, size_t from, size_t n, gx_blocks_visit *visit,
                      void *context)
{
  block->from = from;
  block->n = block->weights.n = n;
  for (int d = 0; d < blocks->grid->dim; d++) evaluate(blocks, from, &block->weights, d);
  visit(context, block);
}

/* x = X + u; returns the first that does not lie within [low, high], or n. */
GX_CLONES static size_t move(size_t n, const double *restrict X, const double *restrict u, double low, double high,
                             double *restrict x)
{
  int outside = 0;
  for (size_t p = 0; p < n; p++) {
    double at = X[p] + u[p];
    x[p] = at;
    outside |= !(at >= low && at <= high);
  }
  size_t p = 0;
  while (outside && x[p] >= low && x[p] <= high) p++;
  return outside ? p : n;
}

struct placing {
  struct gx_blocks *blocks;
  double *const *u;
  const double *low, *high;
  _Atomic uint64_t first; /* stray: direction, kind and particle as one number */
};

static void note_stray(struct placing *placing, int d, int kind, size_t particle)
{
  uint64_t stray = (uint64_t)(d * kinds + kind) << 32 | particle, least = atomic_load(&placing->first);
  while (stray < least && !atomic_compare_exchange_weak(&placing->first, &least, stray)) continue;
}

static void move_part(void *context, size_t part, size_t worker)
{
  struct placing *placing = context;
  struct gx_blocks *blocks = placing->blocks;
  struct gx_block *block = &blocks->block[worker];
  const int dim = blocks->grid->dim, last = dim - 1;
  const size_t end = gx_team_bound(blocks->n, blocks->parts, part + 1), room = dim == 1 ? blocks->n : ROOM;
  size_t *count = dim > 1 ? blocks->start + blocks->slabs + 1 + part * blocks->slabs : NULL;
  for (size_t k = 0; count && k < blocks->slabs; k++) count[k] = 0;
  for (size_t from = gx_team_bound(blocks->n, blocks->parts, part); from < end; from += block->n) {
    block->from = from;
    block->n = block->weights.n = end - from < room ? end - from : room;
    bool located = false;
    for (int d = 0; d < dim; d++) {
      size_t outside = block->n;
      if (placing->u)
        outside =
            move(block->n, blocks->X[d] + from, placing->u[d] + from, placing->low[d], placing->high[d], blocks->moved[d] + from);
      if (outside < block->n) note_stray(placing, d, 0, from + outside);
      /* where nothing can be wrong the last direction is enough: it tells slabs apart */
      long wide =
          outside == block->n && (d == last || blocks->basis->has_domain) ? evaluate(blocks, from, &block->weights, d) : -1;
      if (wide >= 0) note_stray(placing, d, 1, from + (size_t)wide);
      located = outside == block->n;
    }
    for (size_t p = 0; count && located && p < block->n; p++) {
      size_t slab = (size_t)(block->weights.first[last][p] / blocks->thickness);
      blocks->slab[from + p] = (uint16_t)slab;
      count[slab]++;
    }
  }
}

static void sort_part(void *context, size_t part, size_t worker)
{
  (void)worker;
  struct gx_blocks *blocks = context;
  size_t *next = blocks->start + blocks->slabs + 1 + part * blocks->slabs;
  size_t end = gx_team_bound(blocks->n, blocks->parts, part + 1);
  for (size_t p = gx_team_bound(blocks->n, blocks->parts, part); p < end; p++)
    blocks->order[next[blocks->slab[p]]++] = (uint32_t)p;
}

/* From counts by part and slab to where each begins. */
static void sort_by_slab(struct gx_blocks *blocks)
{
  size_t *start = blocks->start, *of_part = start + blocks->slabs + 1, at = 0;
  for (size_t slab = 0; slab < blocks->slabs; slab++) {
    start[slab] = at;
    for (size_t part = 0; part < blocks->parts; part++) {
      size_t count = of_part[part * blocks->slabs + slab];
      of_part[part * blocks->slabs + slab] = at;
      at += count;
    }
  }
  start[blocks->slabs] = at;
  gx_team_run(blocks->team, blocks->parts, sort_part, blocks);
}

struct gx_blocks_stray gx_blocks_place(struct gx_blocks *blocks, double *const *u, const double *low, const double *high)
{
  struct placing placing = {.blocks = blocks, .u = u, .low = low, .high = high, .first = UINT64_MAX};
  for (int d = 0; d < blocks->grid->dim; d++) blocks->x[d] = u ? blocks->moved[d] : blocks->X[d];
  gx_team_run(blocks->team, blocks->parts, move_part, &placing);
  uint64_t first = placing.first;
  if (first != UINT64_MAX)
    return (struct gx_blocks_stray){(size_t)(first & UINT32_MAX), (int)(first >> 32) / kinds, (first >> 32) % (unsigned)kinds};
  if (blocks->grid->dim > 1) sort_by_slab(blocks);
  for (int d = 0; blocks->grid->dim > 1 && blocks->whole.n && d < blocks->grid->dim; d++) evaluate(blocks, 0, &blocks->whole, d);
  return (struct gx_blocks_stray){.d = -1};
}

struct pass {
  struct gx_blocks *blocks;
  gx_blocks_visit *visit;
  void *context;
  size_t odd;
};

static void visit_part(void *context, size_t part, size_t worker)
{
  const struct pass *pass = context;
  struct gx_blocks *blocks = pass->blocks;
  size_t end = gx_team_bound(blocks->n, blocks->parts, part + 1);
  for (size_t from = gx_team_bound(blocks->n, blocks->parts, part), n; from < end; from += n) {
    n = end - from < ROOM ? end - from : ROOM;
    visit_run(blocks, &blocks->block[worker], from, n, pass->visit, pass->context);
  }
}

/* Blocks are runs of particles that follow each other in the store as well. */
static void visit_slab(void *context, size_t part, size_t worker)
{
  const struct pass *pass = context;
  struct gx_blocks *blocks = pass->blocks;
  const uint32_t *order = blocks->order;
  size_t slab = 2 * part + pass->odd, end = blocks->start[slab + 1];
  for (size_t i = blocks->start[slab], n; i < end; i += n) {
    n = 1;
    while (n < ROOM && i + n < end && order[i + n] == order[i] + n) n++;
    visit_run(blocks, &blocks->block[worker], order[i], n, pass->visit, pass->context);
  }
}

void gx_blocks_each(struct gx_blocks *blocks, gx_blocks_visit *visit, void *context)
{
  struct pass pass = {.blocks = blocks, .visit = visit, .context = context};
  if (blocks->grid->dim == 1)
    visit(context, &blocks->block[0]);
  else
    gx_team_run(blocks->team, blocks->parts, visit_part, &pass);
}

void gx_blocks_each_apart(struct gx_blocks *blocks, gx_blocks_visit *visit, void *context)
{
  struct pass pass = {.blocks = blocks, .visit = visit, .context = context};
  if (blocks->grid->dim == 1) {
    visit(context, &blocks->block[0]);
    return;
  }
  gx_team_run(blocks->team, (blocks->slabs + 1) / 2, visit_slab, &pass);
  pass.odd = 1;
  gx_team_run(blocks->team, blocks->slabs / 2, visit_slab, &pass);
}
