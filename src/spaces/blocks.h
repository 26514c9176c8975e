/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Passes over the particles of a grid. In 2-D and 3-D in blocks whose weights are evaluated where they are needed and stay in
 * cache with all else that is made of them: to keep them for every particle would take more memory than the particles, and more
 * time to fetch than to make. In 1-D all particles are one block, whose weights are kept. A team shares the blocks out. */
#ifndef GRIDCROSS_SPACES_BLOCKS_H
#define GRIDCROSS_SPACES_BLOCKS_H

#include <stdbool.h>
#include <stdint.h>

#include <gridcross/basis.h>

#include "../core/team.h"
#include "transfer.h"

struct gx_block {
  size_t from, n;            /* first particle, number of them */
  struct gx_weights weights; /* of these n */
  /* scratch, [n] */
  double *T[GX_MAX_TENSOR];                                /* what the force scatters by gradients */
  double *body[GX_MAX_DIM];                                /* what it scatters by weights: body force on a particle, N */
  double *a[GX_MAX_DIM], *v[GX_MAX_DIM];                   /* gathered */
  double *gradient[GX_MAX_TENSOR], *rate_P[GX_MAX_TENSOR]; /* of velocity; of P */
};

struct gx_blocks {
  const struct gx_grid *grid; /* borrowed, as are the next three */
  const struct gx_basis *basis;
  double *const *X;
  struct gx_team *team;
  size_t n;
  const double *x[GX_MAX_DIM], *half[GX_MAX_DIM]; /* where the weights are taken, and half lengths of particle domains */
  double *moved[GX_MAX_DIM];                      /* [n] X + u */
  struct gx_weights whole;                        /* of all particles; n is 0 unless in 1-D or asked for */
  struct gx_block *block;                         /* by worker */
  /* 2-D and 3-D: particles by slabs of cells across the last direction, those of a slab in ascending order */
  size_t slabs, parts;
  int thickness;   /* of a slab, in functions */
  uint32_t *order; /* [n] */
  uint16_t *slab;  /* [n] */
  size_t *start;   /* [slabs + 1], then [parts][slabs]: entries of order */
  void *memory[2];
};

/* A particle out of bounds along direction d, or whose domain is wider than its cell. */
struct gx_blocks_stray {
  size_t particle;
  int d; /* -1: there is none */
  bool wide;
};

/* whole: keeps the weights of all particles as well. Returns 0, or -1 when memory runs out. n below 2^32. */
int gx_blocks_init(struct gx_blocks *blocks, const struct gx_grid *grid, const struct gx_basis *basis, size_t n, double *const *X,
                   bool whole, struct gx_team *team);
void gx_blocks_free(struct gx_blocks *blocks);

/* Takes weights at X + u (u NULL: at X), which must lie in [low[d], high[d]], with domains of blocks->half. Returns what is wrong
 * first: by direction, by kind, by particle. */
struct gx_blocks_stray gx_blocks_place(struct gx_blocks *blocks, double *const *u, const double *low, const double *high);

typedef void gx_blocks_visit(void *context, struct gx_block *block);

/* Visits every particle once; blocks may be visited at once. */
void gx_blocks_each(struct gx_blocks *blocks, gx_blocks_visit *visit, void *context);
/* The same, but no two blocks that are visited at once share a node, and additions to a node are made in the same order for any
 * team. */
void gx_blocks_each_apart(struct gx_blocks *blocks, gx_blocks_visit *visit, void *context);

/* The block's part of arrays over all particles. */
static inline void gx_block_part(const struct gx_block *block, int count, double *const *array, double **part)
{
  for (int k = 0; k < count; k++) part[k] = array[k] + block->from;
}

#endif
