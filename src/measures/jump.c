/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Jump errors, steffen2010 eqs 83-86: a particle that a step moves from x0 to x1 = x0 + dt v(x0), across a cell edge that it meets at
 * x_e = x0 + dt1 v(x0), would have come to xbar = x_e + (dt - dt1) v(x_e) with two steps. The jump is x1 - xbar, its estimate
 * -(dv/dx v + a) dt^2 / 4, with dv/dx v = (v(x_e) - v(x0)) / dt1 along the way. In 2-D and 3-D the first edge on the way counts. */
#include "jump.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/large.h"

struct gx_jump *gx_jump_create(const struct gx_space *space, const int *cells)
{
  struct gx_jump *jump = calloc(1, sizeof *jump);
  if (!jump) return NULL;
  const struct gx_particles *particles = space->particles;
  size_t n = particles->n, dim = (size_t)particles->dim;
  *jump = (struct gx_jump){.space = space, .cells = cells, .last = NAN, .estimate = NAN};
  jump->block = gx_large_zeros(2 * dim * n * sizeof(double));
  if (!jump->block) {
    free(jump);
    return NULL;
  }
  for (size_t d = 0; d < dim; d++) {
    jump->before[d] = jump->block + 2 * d * n;
    jump->sum[d] = jump->before[d] + n;
    memcpy(jump->before[d], particles->u[d], n * sizeof(double));
  }
  return jump;
}

void gx_jump_free(struct gx_jump *jump)
{
  if (!jump) return;
  free(jump->block);
  free(jump);
}

void gx_jump_image(struct gx_jump *jump, struct gx_image *image)
{
  const struct gx_particles *particles = jump->space->particles;
  gx_image_reals(image, particles->dim, jump->before, particles->n);
  gx_image_reals(image, particles->dim, jump->sum, particles->n);
  GX_IMAGE(image, jump->step);
  GX_IMAGE(image, jump->last);
  GX_IMAGE(image, jump->estimate);
}

/* The first edge along d between x and y, which lie in different cells; NaN: they do not. An edge belongs to the cell on its right. */
static double edge_between(const struct gx_jump *jump, int d, double x, double y)
{
  const struct gx_space *space = jump->space;
  if (!space->edge) {
    double cells = jump->cells[d], cell = floor(x * cells), other = floor(y * cells);
    return cell == other ? NAN : (cell + (other > cell)) / cells;
  }
  size_t below = 0, other = 0;
  while (below < space->edges && space->edge[below] <= x) below++;
  while (other < space->edges && space->edge[other] <= y) other++;
  return below == other ? NAN : space->edge[other > below ? below : below - 1];
}

struct crossing {
  int along;   /* direction crossed */
  double edge; /* m, there */
  double part; /* of the step up to the edge */
};

static bool crosses(const struct gx_jump *jump, size_t p, struct crossing *crossing)
{
  const struct gx_particles *particles = jump->space->particles;
  bool found = false;
  for (int d = 0; d < particles->dim; d++) {
    double moved = particles->u[d][p] - jump->before[d][p], x = particles->X[d][p] + jump->before[d][p];
    double edge = edge_between(jump, d, x, particles->X[d][p] + particles->u[d][p]);
    double part = (edge - x) / moved;
    if (!(part > 0) || (found && part >= crossing->part)) continue; /* NaN: no edge; 0: on it already */
    *crossing = (struct crossing){d, edge, fmin(part, 1)};          /* round-off */
    found = true;
  }
  return found;
}

static void add_jump(struct gx_jump *jump, size_t p, double dt, const struct crossing *crossing)
{
  const struct gx_particles *particles = jump->space->particles;
  const struct gx_space_kind *kind = jump->space->kind;
  double start[GX_MAX_DIM], edge[GX_MAX_DIM], v[GX_MAX_DIM], a[GX_MAX_DIM];
  double *start_at[GX_MAX_DIM], *edge_at[GX_MAX_DIM], *v_at[GX_MAX_DIM], *a_at[GX_MAX_DIM];
  for (int d = 0; d < particles->dim; d++) {
    start[d] = particles->X[d][p] + jump->before[d][p];
    edge[d] = start[d] + crossing->part * (particles->u[d][p] - jump->before[d][p]);
    start_at[d] = &start[d];
    edge_at[d] = &edge[d];
    v_at[d] = &v[d];
    a_at[d] = &a[d];
  }
  edge[crossing->along] = crossing->edge;
  kind->field(jump->space, GX_FIELD_VELOCITY, 1, edge_at, v_at);
  kind->field(jump->space, GX_FIELD_ACCELERATION, 1, start_at, a_at);
  for (int d = 0; d < particles->dim; d++) {
    double difference = (particles->u[d][p] - jump->before[d][p]) / dt - v[d];
    double error = (1 - crossing->part) * dt * difference;
    jump->sum[d][p] += error;
    if (d != crossing->along || !(fabs(error) > fabs(jump->step))) continue;
    jump->step = jump->last = error;
    jump->estimate = 0.25 * dt * (difference / crossing->part - a[d] * dt);
  }
}

void gx_jump_step(struct gx_jump *jump, double dt)
{
  const struct gx_particles *particles = jump->space->particles;
  struct crossing crossing = {0};
  jump->step = 0;
  for (size_t p = 0; p < particles->n; p++)
    if (crosses(jump, p, &crossing)) add_jump(jump, p, dt, &crossing);
  for (int d = 0; d < particles->dim; d++) memcpy(jump->before[d], particles->u[d], particles->n * sizeof(double));
}
