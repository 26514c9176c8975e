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

struct gx_momentum gx_momentum_of(const struct gx_particles *particles, double *const *v, double *const *scratch)
{
  struct gx_momentum momentum = {0};
  const int dim = particles->dim;
  const size_t n = particles->n;
  double *x = scratch[0], *moment = scratch[1], mass = gx_vector_sum(n, particles->m), square = 0, inertia = 0;
  for (int d = 0; d < dim; d++) {
    momentum.linear[d] = gx_vector_dot(n, particles->m, v[d]);
    square += gx_vector_square(n, particles->m, v[d]);
  }
  momentum.linear_size = sqrt(mass * square);
  for (int d = 0; d < dim && dim > 1; d++) {
    weigh(n, particles->m, particles->X[d], particles->u[d], x, moment);
    double sum = gx_vector_sum(n, moment);
    inertia += gx_vector_dot(n, moment, x) - sum * sum / mass;
    for (int e = 0; e < dim; e++) /* x_d v_e belongs to the third direction, with the sign of the permutation */
      if (e != d) momentum.angular[3 - d - e] += ((e - d + 3) % 3 == 1 ? 1 : -1) * gx_vector_dot(n, moment, v[e]);
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
