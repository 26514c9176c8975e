/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between blocks of particles and nodal fields, whatever the dimension: in 1-D component arrays are scattered to and gathered from
 * (transfer.h), in 2-D and 3-D copies of them whose components lie together (packed.h). */
#ifndef GRIDCROSS_SPACES_EXCHANGE_H
#define GRIDCROSS_SPACES_EXCHANGE_H

#include "blocks.h"

struct gx_exchange {
  const struct gx_grid *grid; /* borrowed, as is the team */
  struct gx_team *team;
  size_t parts; /* of the nodes */
  /* 2-D and 3-D: lent velocity, or mass and momentum collected; lent acceleration, or force collected. Owned by block */
  double *packed[2];
  /* the fields of a pass, NULL: none */
  double *const *velocity, *const *acceleration; /* lent */
  double *mass, *const *moment, *const *force;   /* collected */
  void *block;
};

/* Returns 0, or -1 when memory runs out. */
int gx_exchange_init(struct gx_exchange *exchange, const struct gx_grid *grid, struct gx_team *team);
void gx_exchange_free(struct gx_exchange *exchange);

/* Makes fields ready to be gathered: [grid.stored] a component, as they are now. Either may be NULL. */
void gx_exchange_lend(struct gx_exchange *exchange, double *const *velocity, double *const *acceleration);
/* At the particles of a block: S-sums of the lent acceleration and velocity and D-sums of velocity, into arrays of the block's
 * length; NULL: not this one. All three in one pass. */
void gx_exchange_gather(const struct gx_exchange *exchange, const struct gx_block *block, double *const *acceleration,
                        double *const *velocity, double *const *gradient);

/* Zeroes what is to be scattered to; any may be NULL. Mass and moment take the place of a lent velocity, force that of an
 * acceleration. */
void gx_exchange_collect(struct gx_exchange *exchange, double *mass, double *const *moment, double *const *force);
/* Adds a block's mass and moments m (1, value), value NULL: mass alone, and forces T D + body S, body may be NULL; what is not
 * collected is not looked at. Arrays of the block's length. */
void gx_exchange_scatter(const struct gx_exchange *exchange, const struct gx_block *block, const double *m, double *const *value,
                         double *const *T, double *const *body);
/* What was scattered, to the fields. */
void gx_exchange_deliver(struct gx_exchange *exchange);

#endif
