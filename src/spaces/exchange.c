/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes are far fewer than particles, so that copying fields costs little beside what it saves at every particle. */
#include "exchange.h"

#include <stdlib.h>
#include <string.h>

#include "../core/aligned.h"
#include "packed.h"

int gx_exchange_init(struct gx_exchange *exchange, const struct gx_grid *grid, struct gx_team *team)
{
  enum { SHARE = 2048, MOST_PARTS = 16 }; /* nodes that are worth a part */
  const size_t shares = grid->stored / SHARE;
  *exchange = (struct gx_exchange){.grid = grid, .team = grid->dim > 1 ? team : NULL};
  exchange->parts = grid->dim == 1 || shares < 1 ? 1 : shares < MOST_PARTS ? shares : MOST_PARTS;
  if (grid->dim == 1) return 0;
  double *packed = gx_aligned_zeros(2 * grid->stored * GX_PACKED * sizeof(double), &exchange->block);
  if (!packed) return -1;
  for (int i = 0; i < 2; i++) exchange->packed[i] = packed + (size_t)i * grid->stored * GX_PACKED;
  return 0;
}

void gx_exchange_free(struct gx_exchange *exchange)
{
  free(exchange->block);
}

struct range {
  size_t from, nodes;
};

static struct range range_of(const struct gx_exchange *exchange, size_t part)
{
  size_t from = gx_team_bound(exchange->grid->stored, exchange->parts, part);
  return (struct range){from, gx_team_bound(exchange->grid->stored, exchange->parts, part + 1) - from};
}

static void lend_part(void *context, size_t part, size_t worker)
{
  (void)worker;
  const struct gx_exchange *exchange = context;
  double *const *field[2] = {exchange->velocity, exchange->acceleration};
  const struct range range = range_of(exchange, part);
  for (int i = 0; i < 2; i++) {
    const double *at[GX_MAX_DIM];
    for (int d = 0; field[i] && d < exchange->grid->dim; d++) at[d] = field[i][d] + range.from;
    if (field[i]) gx_packed_pack(exchange->grid->dim, range.nodes, at, exchange->packed[i] + range.from * GX_PACKED);
  }
}

void gx_exchange_lend(struct gx_exchange *exchange, double *const *velocity, double *const *acceleration)
{
  exchange->velocity = velocity;
  exchange->acceleration = acceleration;
  if (exchange->grid->dim > 1) gx_team_run(exchange->team, exchange->parts, lend_part, exchange);
}

void gx_exchange_gather(const struct gx_exchange *exchange, const struct gx_block *block, double *const *acceleration,
                        double *const *velocity, double *const *gradient)
{
  const struct gx_weights *weights = &block->weights;
  const bool line = exchange->grid->dim == 1, all = acceleration && velocity && gradient;
  if (all && line)
    gx_transfer_gather_all(weights, exchange->acceleration, exchange->velocity, acceleration, velocity, gradient);
  else if (all)
    gx_packed_gather_all(weights, exchange->packed[1], exchange->packed[0], acceleration, velocity, gradient);
  if (all) return;
  if (acceleration && line) gx_transfer_gather(weights, exchange->acceleration, acceleration);
  if (acceleration && !line) gx_packed_gather(weights, exchange->packed[1], acceleration);
  if (velocity && line) gx_transfer_gather(weights, exchange->velocity, velocity);
  if (velocity && !line) gx_packed_gather(weights, exchange->packed[0], velocity);
  if (gradient && line) gx_transfer_gather_gradient(weights, exchange->velocity, gradient);
  if (gradient && !line) gx_packed_gather_gradient(weights, exchange->packed[0], gradient);
}

static void clear_part(void *context, size_t part, size_t worker)
{
  (void)worker;
  const struct gx_exchange *exchange = context;
  const struct range range = range_of(exchange, part);
  double *field[2 + 2 * GX_MAX_DIM];
  size_t length = range.nodes, from = range.from;
  int count = 0;
  if (exchange->grid->dim > 1) {
    length *= GX_PACKED;
    from *= GX_PACKED;
    if (exchange->mass || exchange->moment) field[count++] = exchange->packed[0];
    if (exchange->force) field[count++] = exchange->packed[1];
  } else {
    if (exchange->mass) field[count++] = exchange->mass;
    if (exchange->moment) field[count++] = exchange->moment[0];
    if (exchange->force) field[count++] = exchange->force[0];
  }
  for (int i = 0; i < count; i++) memset(field[i] + from, 0, length * sizeof(double));
}

void gx_exchange_collect(struct gx_exchange *exchange, double *mass, double *const *moment, double *const *force)
{
  exchange->mass = mass;
  exchange->moment = moment;
  exchange->force = force;
  gx_team_run(exchange->team, exchange->parts, clear_part, exchange);
}

void gx_exchange_scatter(const struct gx_exchange *exchange, const struct gx_block *block, const double *m, double *const *value,
                         double *const *T, double *const *body)
{
  const struct gx_weights *weights = &block->weights;
  const bool carried = exchange->mass || exchange->moment;
  if (exchange->grid->dim > 1) {
    gx_packed_scatter(weights, m, value, carried ? exchange->packed[0] : NULL, T, body,
                      exchange->force ? exchange->packed[1] : NULL);
    return;
  }
  if (carried) gx_transfer_scatter(weights, m, exchange->moment ? value : NULL, exchange->mass, exchange->moment);
  if (exchange->force) gx_transfer_scatter_force(weights, T, body, exchange->force);
}

static void deliver_part(void *context, size_t part, size_t worker)
{
  (void)worker;
  const struct gx_exchange *exchange = context;
  const int dim = exchange->grid->dim;
  const struct range range = range_of(exchange, part);
  const double *packed[2];
  double *field[1 + GX_MAX_DIM] = {NULL};
  for (int i = 0; i < 2; i++) packed[i] = exchange->packed[i] + range.from * GX_PACKED;
  if (exchange->mass) field[0] = exchange->mass + range.from;
  for (int d = 0; exchange->moment && d < dim; d++) field[1 + d] = exchange->moment[d] + range.from;
  if (exchange->mass || exchange->moment) gx_packed_unpack(1 + dim, range.nodes, packed[0], field);
  for (int d = 0; exchange->force && d < dim; d++) field[d] = exchange->force[d] + range.from;
  if (exchange->force) gx_packed_unpack(dim, range.nodes, packed[1], field);
}

void gx_exchange_deliver(struct gx_exchange *exchange)
{
  if (exchange->grid->dim > 1) gx_team_run(exchange->team, exchange->parts, deliver_part, exchange);
}
