/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layouts of particles: volumes, masses, positions, and what the Gauss layout integrates. */
#include <gridcross/particles.h>

#include "check.h"

static const int cells[GX_MAX_DIM] = {5, 3, 2};

static void volume_and_mass_are_those_of_the_box(void **state)
{
  (void)state;
  for (int dim = 1; dim <= GX_MAX_DIM; dim++)
    for (int layout = GX_LAYOUT_UNIFORM; layout <= GX_LAYOUT_GAUSS; layout++)
      for (int per_cell = 1; per_cell <= 4; per_cell++) {
        struct gx_particles *particles = gx_particles_create(dim, cells, per_cell, (enum gx_layout)layout, 2.5);
        size_t n = 1;
        for (int d = 0; d < dim; d++) n *= (size_t)(cells[d] * per_cell);
        assert_int_equal(particles->n, n);
        assert_int_equal(particles->dim, dim);
        long double volume = 0, mass = 0;
        for (size_t p = 0; p < n; p++) {
          volume += particles->V0[p];
          mass += particles->m[p];
          double box = 1;
          for (int d = 0; d < dim; d++) box *= 2 * particles->half_length[d][p];
          CLOSE(particles->V0[p], box, 1e-15);
          NEAR(gx_particles_jacobian(particles, p), 1, 0);
          for (int k = 0; k < dim * dim; k++) NEAR(particles->F[k][p], k % (dim + 1) == 0, 0);
          for (int d = 0; d < dim; d++) {
            NEAR(particles->u[d][p], 0, 0);
            NEAR(particles->v[d][p], 0, 0);
            assert_int_equal((uintptr_t)particles->X[d] % 64, 0);
          }
        }
        NEAR((double)volume, 1, 1e-15);
        NEAR((double)mass, 2.5, 2e-15);
        const bool alike = layout == GX_LAYOUT_UNIFORM || per_cell <= 2;
        CLOSE(gx_particles_volume(particles), alike ? 1.0 / (double)n : 0, 1e-13);
        gx_particles_free(particles);
      }
}

/* Row by row of the whole box, first direction fastest. */
static void uniform_positions_by_hand(void **state)
{
  (void)state;
  struct gx_particles *particles = gx_particles_create(2, (int[]){2, 3}, 2, GX_LAYOUT_UNIFORM, 1);
  assert_int_equal(particles->n, 24);
  const double first[6][2] = {{1 / 8., 1 / 12.}, {3 / 8., 1 / 12.}, {5 / 8., 1 / 12.},
                              {7 / 8., 1 / 12.}, {1 / 8., 3 / 12.}, {3 / 8., 3 / 12.}};
  assert_int_equal(particles->lattice[0], 4);
  assert_int_equal(particles->lattice[1], 6);
  for (size_t p = 0; p < 6; p++)
    for (int d = 0; d < 2; d++) NEAR(particles->X[d][p], first[p][d], 1e-16);
  NEAR(particles->X[0][23], 7 / 8., 1e-16);
  NEAR(particles->X[1][23], 11 / 12., 2e-16);
  gx_particles_free(particles);
}

/* X and half_length of a particle are those of its place along each direction. */
static void a_lattice_is_a_product(void **state)
{
  (void)state;
  struct gx_particles *made = gx_particles_create(3, cells, 3, GX_LAYOUT_GAUSS, 1), *copy = gx_particles_copy(made);
  const int *n = copy->lattice;
  for (int d = 0; d < 3; d++) assert_int_equal(n[d], 3 * cells[d]);
  for (int k2 = 0, p = 0; k2 < n[2]; k2++)
    for (int k1 = 0; k1 < n[1]; k1++)
      for (int k0 = 0; k0 < n[0]; k0++, p++) {
        const int first[] = {k0, k1 * n[0], k2 * n[1] * n[0]};
        for (int d = 0; d < 3; d++) {
          NEAR(copy->X[d][p], copy->X[d][first[d]], 0);
          NEAR(copy->half_length[d][p], copy->half_length[d][first[d]], 0);
          assert_true(first[d] == 0 || copy->X[d][p] > copy->X[d][0]);
        }
      }
  gx_particles_free(made);
  gx_particles_free(copy);
}

/* n Gauss points a cell integrate x^(2n-1) over the box, and not x^(2n). */
static void gauss_points_integrate_polynomials(void **state)
{
  (void)state;
  for (int n = 1; n <= 6; n++)
    for (int dim = 1; dim <= GX_MAX_DIM; dim++) {
      struct gx_particles *particles = gx_particles_create(dim, (int[]){1, 2, 1}, n, GX_LAYOUT_GAUSS, 1);
      for (int power = 0; power <= 2 * n; power++) {
        double exact = 1, sum = 0;
        for (int d = 0; d < dim; d++) exact /= power + 1;
        for (size_t p = 0; p < particles->n; p++) {
          double term = particles->V0[p];
          for (int d = 0; d < dim; d++) term *= pow(particles->X[d][p], power);
          sum += term;
        }
        if (power < 2 * n)
          NEAR(sum, exact, 3e-15);
        else
          assert_true(fabs(sum - exact) > 1e-11);
      }
      gx_particles_free(particles);
    }
}

static void gauss_points_by_hand(void **state)
{
  (void)state;
  struct gx_particles *particles = gx_particles_create(1, (int[]){4}, 3, GX_LAYOUT_GAUSS, 1);
  for (size_t p = 0; p < 12; p++) {
    double place = p % 3 == 1 ? 0 : p % 3 ? sqrt(0.6) : -sqrt(0.6);
    NEAR(particles->X[0][p], ((double)(p / 3) + 0.5 * (1 + place)) / 4, 1e-15);
    NEAR(particles->V0[p], (p % 3 == 1 ? 4 / 9. : 5 / 18.) / 4, 1e-15);
  }
  gx_particles_free(particles);
}

static void too_many_particles_are_refused(void **state)
{
  (void)state;
  const int many[] = {2000000000, 2000000000, 2000000000};
  assert_null(gx_particles_create(3, many, 1000, GX_LAYOUT_UNIFORM, 1));
  assert_null(gx_particles_create(2, many, 1, GX_LAYOUT_UNIFORM, 1));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(volume_and_mass_are_those_of_the_box),
      cmocka_unit_test(uniform_positions_by_hand),
      cmocka_unit_test(a_lattice_is_a_product),
      cmocka_unit_test(gauss_points_integrate_polynomials),
      cmocka_unit_test(gauss_points_by_hand),
      cmocka_unit_test(too_many_particles_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
