/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Momentum by sums over component arrays. */
#include "momentum.h"

#include <math.h>

#include "../core/kernel.h"
#include "../core/vector.h"

/* x = X + u, moment = m x */
GX_CLONES static void weigh(size_t n, const double *restrict m, const double *restrict X, const double *restrict u,
                            double *restrict x, double *restrict moment)
{
  for (size_t p = 0; p < n; p++) {
    x[p] = X[p] + u[p];
    moment[p] = m[p] * x[p];
  }
}

/* Sums over the particles of one direction's moments: m x, m x^2 and m x times each component of velocity. */
struct moments {
  double first, second, with_v[GX_MAX_DIM];
};

static struct moments moments_along(const struct gx_particles *particles, int d, double *const *v)
{
  double first[GX_VECTOR_LANES] = {0}, second[GX_VECTOR_LANES] = {0}, with_v[GX_MAX_DIM][GX_VECTOR_LANES] = {{0}};
  double x[GX_VECTOR_PIECE], moment[GX_VECTOR_PIECE];
  for (size_t from = 0; from < particles->n; from += GX_VECTOR_PIECE) {
    const size_t n = gx_vector_piece(particles->n, from);
    weigh(n, particles->m + from, particles->X[d] + from, particles->u[d] + from, x, moment);
    gx_vector_sum_piece(n, moment, first);
    gx_vector_dot_piece(n, moment, x, second);
    for (int e = 0; e < particles->dim; e++)
      if (e != d) gx_vector_dot_piece(n, moment, v[e] + from, with_v[e]);
  }
  struct moments moments = {.first = gx_vector_total(first), .second = gx_vector_total(second)};
  for (int e = 0; e < particles->dim; e++) moments.with_v[e] = gx_vector_total(with_v[e]);
  return moments;
}

struct gx_momentum gx_momentum_of(const struct gx_particles *particles, double *const *v)
{
  struct gx_momentum momentum = {0};
  const int dim = particles->dim;
  const size_t n = particles->n;
  double mass = gx_vector_sum(n, particles->m), square = 0, inertia = 0;
  for (int d = 0; d < dim; d++) {
    momentum.linear[d] = gx_vector_dot(n, particles->m, v[d]);
    square += gx_vector_weighted(n, particles->m, v[d], v[d]);
  }
  momentum.kinetic = 0.5 * square;
  momentum.linear_size = sqrt(mass * square);
  for (int d = 0; d < dim && dim > 1; d++) {
    const struct moments moments = moments_along(particles, d, v);
    inertia += moments.second - moments.first * moments.first / mass;
    for (int e = 0; e < dim; e++) /* x_d v_e belongs to the third direction, with the sign of the permutation */
      if (e != d) momentum.angular[3 - d - e] += ((e - d + 3) % 3 == 1 ? 1 : -1) * moments.with_v[e];
  }
  momentum.angular_size = sqrt(fmax(inertia, 0) * square);
  return momentum;
}

double gx_momentum_distance(const double *a, const double *b)
{
  double square = 0;
  for (int d = 0; d < GX_MAX_DIM; d++) square += (a[d] - b[d]) * (a[d] - b[d]);
  return sqrt(square);
}
