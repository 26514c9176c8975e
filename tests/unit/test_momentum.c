/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Total momentum of particles against sums of cross products, and the sizes that it is compared with. */
#include <gridcross/particles.h>

#include "check.h"
#include "measures/momentum.h"

static struct gx_particles *moving_particles(int dim)
{
  const int cells[GX_MAX_DIM] = {3, 2, 2};
  struct gx_particles *particles = gx_particles_create(dim, cells, 2, GX_LAYOUT_UNIFORM, 1.5);
  uint64_t seed = 59;
  for (size_t p = 0; p < particles->n; p++) {
    particles->m[p] *= check_random(&seed, 0.5, 1.5);
    for (int d = 0; d < dim; d++) {
      particles->u[d][p] = check_random(&seed, -1, 1);
      particles->v[d][p] = check_random(&seed, -2, 3);
    }
  }
  return particles;
}

/* Position and velocity of a particle in three dimensions. */
static void load(const struct gx_particles *particles, size_t p, double *x, double *v)
{
  for (int d = 0; d < GX_MAX_DIM; d++) {
    x[d] = d < particles->dim ? particles->X[d][p] + particles->u[d][p] : 0;
    v[d] = d < particles->dim ? particles->v[d][p] : 0;
  }
}

static void check_sums(int dim)
{
  struct gx_particles *particles = moving_particles(dim);
  struct gx_momentum momentum = gx_momentum_of(particles, particles->v);
  double linear[GX_MAX_DIM] = {0}, angular[GX_MAX_DIM] = {0}, first[GX_MAX_DIM] = {0}, mass = 0, x[GX_MAX_DIM], v[GX_MAX_DIM];
  for (size_t p = 0; p < particles->n; p++) {
    double m = particles->m[p];
    load(particles, p, x, v);
    mass += m;
    for (int d = 0; d < GX_MAX_DIM; d++) {
      first[d] += m * x[d];
      linear[d] += m * v[d];
    }
    angular[0] += m * (x[1] * v[2] - x[2] * v[1]);
    angular[1] += m * (x[2] * v[0] - x[0] * v[2]);
    angular[2] += m * (x[0] * v[1] - x[1] * v[0]);
  }
  double speeds = 0, moments = 0;
  for (size_t p = 0; p < particles->n; p++) {
    load(particles, p, x, v);
    double speed = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), arm = 0;
    for (int d = 0; d < GX_MAX_DIM; d++) arm += (x[d] - first[d] / mass) * (x[d] - first[d] / mass);
    speeds += particles->m[p] * speed;
    moments += particles->m[p] * sqrt(arm) * speed;
  }
  for (int d = 0; d < GX_MAX_DIM; d++) {
    NEAR(momentum.linear[d], linear[d], 1e-13);
    NEAR(momentum.angular[d], angular[d], 1e-13);
  }
  assert_true(momentum.linear_size >= speeds && momentum.linear_size < 1.5 * speeds);
  if (dim > 1) assert_true(momentum.angular_size >= moments && momentum.angular_size < 1.5 * moments);
  if (dim == 1) NEAR(momentum.angular_size, 0, 0);
  gx_particles_free(particles);
}

static void totals_are_sums_over_particles(void **state)
{
  (void)state;
  for (int dim = 1; dim <= GX_MAX_DIM; dim++) check_sums(dim);
}

/* Sizes are those of the body's own motion: where it is does not matter. */
static void sizes_do_not_depend_on_the_origin(void **state)
{
  (void)state;
  struct gx_particles *particles = moving_particles(3);
  struct gx_momentum here = gx_momentum_of(particles, particles->v);
  for (int d = 0; d < 3; d++)
    for (size_t p = 0; p < particles->n; p++) particles->u[d][p] += 10 * (d + 1);
  struct gx_momentum there = gx_momentum_of(particles, particles->v);
  CLOSE(there.linear_size, here.linear_size, 0);
  CLOSE(there.angular_size, here.angular_size, 1e-11);
  assert_true(gx_momentum_distance(here.angular, there.angular) > 1);
  gx_particles_free(particles);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(totals_are_sums_over_particles),
      cmocka_unit_test(sizes_do_not_depend_on_the_origin),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
