/* SPDX-License-Identifier: GPL-3.0-or-later */
/* With lambda = 0 a wave along one axis of 2-D and 3-D is the 1-D wave to round-off, in every space: with every clock, basis and
 * mass, every degree of the spline spaces, periodic and between fixed ends. All particles on a line across move alike. With lambda,
 * 2-D is plane strain. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "rig.h"

static const double within = 1e-13; /* of the largest displacement, speed and strain */

/* As the particle of the line at the same X along the axis, and nothing across it. */
static void compare(const struct gx_particles *thin, const struct gx_particles *thick, int along, const char *what)
{
  double u = 0, v = 0;
  for (size_t q = 0; q < thin->n; q++) {
    u = fmax(u, fabs(thin->u[0][q]));
    v = fmax(v, fabs(thin->v[0][q]));
  }
  assert_true(u > 0 && v > 0);
  for (size_t p = 0; p < thick->n; p++) {
    size_t q = 0;
    while (q < thin->n && fabs(thin->X[0][q] - thick->X[along][p]) > 1e-12) q++;
    assert_true(q < thin->n);
    for (int d = 0; d < thick->dim; d++) {
      double u_off = fabs(thick->u[d][p] - (d == along ? thin->u[0][q] : 0));
      double v_off = fabs(thick->v[d][p] - (d == along ? thin->v[0][q] : 0));
      CHECK(u_off <= within * u && v_off <= within * v, "%s: u_%d of particle %zu is off by %g of %g, v by %g of %g", what, d, p,
            u_off, u, v_off, v);
      for (int e = 0; e < thick->dim; e++)
        NEAR(thick->F[d * thick->dim + e][p], d == along && e == along ? thin->F[0][q] : d == e, within);
    }
  }
}

/* The 1-D bar, then an axis-aligned wave along each axis of 2-D up to `most` dimensions. steps: negative for all of the case. */
static void check_reduction(const struct gx_case *bar, int most, double steps, const char *what)
{
  static const char *const axes[] = {"x", "y", "z"};
  struct rig line, box;
  assert_true(rig_build(&line, bar, NULL, NULL, NULL));
  rig_run(&line, steps);
  for (int dim = 2; dim <= most; dim++)
    for (int along = 0; along < dim; along++) {
      struct gx_case one = *bar;
      case_set(&one, GX_PROBLEM_NAME, "axis-aligned");
      case_set(&one, GX_PROBLEM_ACTIVE, axes[along]);
      case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
      assert_true(rig_build(&box, &one, NULL, NULL, NULL));
      NEAR(box.simulation.dt, line.simulation.dt, 0);
      rig_run(&box, steps);
      compare(line.simulation.particles, box.simulation.particles, along, what);
      rig_free(&box);
    }
  rig_free(&line);
}

static struct gx_case bar_on(const struct gx_space_kind *space, const struct gx_clock *clock)
{
  struct gx_case one = case_draft("mesh.cells=8", "mesh.particles_per_cell=2", "method.degree=2", "time.periods=0.2");
  case_set(&one, GX_METHOD_SPACE, space->name);
  case_set(&one, GX_METHOD_CLOCK, clock->name);
  if (space->collocation) case_set(&one, GX_TIME_CFL, "0.05"); /* its particles are denser than nodes */
  return one;
}

static void with_every_clock(void **state)
{
  (void)state;
  for (int s = 0; gx_space_family[s]; s++)
    for (int k = 0; gx_clock_family[k] && !gx_space_family[s]->of_problem; k++) {
      struct gx_case one = bar_on(gx_space_family[s], gx_clock_family[k]);
      gx_parameter_resolve(one.value);
      check_reduction(&one, GX_MAX_DIM, -1, gx_clock_family[k]->name);
    }
}

/* Most dimensions that are compared. A consistent mass solve loses the digits of the condition number of M, which grows with the
 * degree, faster between fixed ends, and as its power with the dimension: lumped mass is compared at every degree. */
static int most_dimensions(int degree, bool consistent)
{
  return !consistent || degree == 1 ? GX_MAX_DIM : degree <= 3 ? 2 : 1;
}

/* With consistent mass the layout is that which integrates M: of few uniform particles it is nearly singular at fixed ends. */
static void check_basis(const struct gx_space_kind *space, const struct gx_basis *basis, int degree, bool consistent,
                        const char *boundary)
{
  char what[160];
  snprintf(what, sizeof what, "%s %s degree %d, %s, %s", space->name, basis->name, degree, consistent ? "consistent" : "lumped",
           boundary);
  struct gx_case one = bar_on(space, gx_clock_find("rk4"));
  case_set(&one, GX_MESH_CELLS, "6");
  case_set(&one, GX_METHOD_BASIS, basis->name);
  case_set_integer(&one, GX_METHOD_DEGREE, degree);
  case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, consistent ? degree + 1 : 2);
  case_set(&one, GX_MESH_LAYOUT, consistent && !strcmp(basis->name, "bspline") ? "gauss" : "uniform");
  case_set(&one, GX_METHOD_MASS, consistent ? "consistent" : "lumped");
  case_set(&one, GX_PROBLEM_BOUNDARY, boundary);
  gx_parameter_resolve(one.value);
  check_reduction(&one, most_dimensions(degree, consistent), 2, what);
}

static void with_every_basis_and_mass(void **state)
{
  (void)state;
  const char *const boundary[] = {"periodic", "fixed"};
  for (int s = 0; gx_space_family[s]; s++)
    for (int b = 0; gx_basis_family[b] && case_on_grid(gx_space_family[s]); b++)
      for (int k = 0; k < 4; k++) {
        const struct gx_basis *basis = gx_basis_family[b];
        const int highest = strcmp(basis->name, "bspline") ? 1 : 5;
        if (basis->deforms && !gx_space_family[s]->fixed_grid) continue;
        for (int degree = 1; degree <= highest; degree++) check_basis(gx_space_family[s], basis, degree, k / 2, boundary[k % 2]);
      }
}

static void with_every_degree_of_splines(void **state)
{
  (void)state;
  const char *const boundary[] = {"periodic", "fixed"}, *const stress[] = {"F", "rate"}, *const layout[] = {"uniform", "gauss"};
  for (int s = 0; gx_space_family[s]; s++)
    for (int k = 0; k < 8 && gx_space_family[s]->collocation; k++)
      for (int degree = 2; degree <= GX_MAX_DEGREE; degree++) {
        char what[160];
        snprintf(what, sizeof what, "%s degree %d, %s, %s, stress %s", gx_space_family[s]->name, degree, boundary[k & 1],
                 layout[k >> 2], stress[k >> 1 & 1]);
        struct gx_case one = bar_on(gx_space_family[s], gx_clock_find("rk4"));
        case_set(&one, GX_MESH_CELLS, "10");
        case_set(&one, GX_MESH_LAYOUT, layout[k >> 2]);
        case_set(&one, GX_PROBLEM_BOUNDARY, boundary[k & 1]);
        case_set(&one, GX_METHOD_STRESS, stress[k >> 1 & 1]);
        case_set_integer(&one, GX_METHOD_DEGREE, degree);
        gx_parameter_resolve(one.value);
        check_reduction(&one, degree % 4 == 1 ? GX_MAX_DIM : 2, 2, what);
      }
}

/* The vortex with large shear in 2-D, and as a tube from wall to wall in 3-D, where nothing moves along the axis. */
static void check_plane_strain(const char *space)
{
  struct rig plane, tube;
  struct gx_case one = case_draft("problem.name=generalized-vortex", "problem.boundary=fixed", "mesh.cells=8", "time.cfl=0.1",
                                  "mesh.particles_per_cell=3", "method.clock=rk4", "method.basis=linear");
  case_set(&one, GX_METHOD_SPACE, space);
  gx_parameter_resolve(one.value);
  assert_true(rig_build(&plane, &one, NULL, NULL, NULL));
  case_set_integer(&one, GX_PROBLEM_DIMENSION, 3);
  assert_true(rig_build(&tube, &one, NULL, NULL, NULL));
  rig_run(&plane, 6);
  rig_run(&tube, 6);
  const struct gx_particles *flat = plane.simulation.particles, *solid = tube.simulation.particles;
  assert_int_equal(solid->n, 24 * flat->n);
  double strain = 0;
  for (size_t p = 0; p < solid->n; p++) {
    const size_t q = p % flat->n;
    NEAR(solid->X[0][p], flat->X[0][q], 0);
    NEAR(solid->u[2][p], 0, 1e-15);
    for (int d = 0; d < 3; d++)
      for (int e = 0; e < 3; e++) {
        const double F = d < 2 && e < 2 ? flat->F[2 * d + e][q] : d == e;
        NEAR(solid->F[3 * d + e][p], F, within);
        strain = fmax(strain, fabs(F - (d == e)));
      }
    for (int d = 0; d < 2; d++) {
      NEAR(solid->u[d][p], flat->u[d][q], 0.1 * within);
      NEAR(solid->v[d][p], flat->v[d][q], 10 * within); /* speeds are up to 80 m/s */
    }
  }
  CHECK(strain > 0.1, "%s: %g", space, strain);
  rig_free(&plane);
  rig_free(&tube);
}

static void plane_strain_is_a_tube_between_walls(void **state)
{
  (void)state;
  check_plane_strain("standard");
  check_plane_strain("moving-mesh");
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(with_every_clock),
      cmocka_unit_test(with_every_basis_and_mass),
      cmocka_unit_test(with_every_degree_of_splines),
      cmocka_unit_test(plane_strain_is_a_tube_between_walls),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
