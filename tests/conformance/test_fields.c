/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grid's fields at points of its own coordinate: at particles they are what particles see, at nodes of hats the nodal values,
 * in every basis, space, dimension and boundary. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "rig.h"

static struct gx_case case_with(const char *space, const struct gx_basis *basis, int dim, bool periodic, int degree)
{
  struct gx_case one = case_draft("problem.name=axis-aligned", "problem.modulus=1", "mesh.cells=4", "mesh.particles_per_cell=3",
                                  "problem.poisson=0.2", "time.dt=0.01", "time.start=0.3", "time.steps=1");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_METHOD_BASIS, basis->name);
  case_set(&one, GX_PROBLEM_BOUNDARY, periodic ? "periodic" : "fixed");
  case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
  case_set_integer(&one, GX_METHOD_DEGREE, degree);
  gx_parameter_resolve(one.value);
  return one;
}

/* So narrow that what GIMP averages over a domain is the hat itself. */
static void narrow_domains(struct gx_particles *particles, void *context)
{
  (void)context;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) particles->half_length[d][p] *= 1e-9;
}

static void check_at_particles(const struct gx_case *one, bool moves)
{
  struct rig rig;
  if (!rig_build(&rig, one, NULL, narrow_domains, NULL)) return; /* cpgimp has no reference configuration */
  struct gx_space *space = rig.simulation.space;
  struct gx_particles *particles = rig.simulation.particles;
  size_t n = particles->n;
  double *block = calloc(3 * GX_MAX_DIM * n, sizeof(double)), *x[GX_MAX_DIM], *seen[GX_MAX_DIM], *value[GX_MAX_DIM];
  double largest = 0;
  for (int d = 0; d < GX_MAX_DIM; d++) {
    x[d] = block + (size_t)d * n;
    seen[d] = block + (size_t)(3 + d) * n;
    value[d] = block + (size_t)(6 + d) * n;
    for (size_t p = 0; d < particles->dim && p < n; p++) x[d][p] = particles->X[d][p] + (moves ? particles->u[d][p] : 0);
  }
  assert_int_equal(gx_stepper_accelerate(rig.stepper, 0.3), GX_OK);
  space->kind->particle_acceleration(space, seen);
  space->kind->field(space, GX_FIELD_ACCELERATION, n, x, value);
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < n; p++) largest = fmax(largest, fabs(seen[d][p]));
  CHECK(largest > 0.01, "%g", largest);
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < n; p++) NEAR(value[d][p], seen[d][p], 1e-6 * largest);
  free(block);
  rig_free(&rig);
}

static void particles_see_the_field(void **state)
{
  (void)state;
  for (int b = 0; gx_basis_family[b]; b++)
    for (int degree = 1; degree <= (gx_basis_family[b]->has_degree ? GX_MAX_DEGREE : 1); degree += 4)
      for (int dim = 1; dim <= GX_MAX_DIM; dim++)
        for (int periodic = 0; periodic < 2; periodic++)
          for (int moves = 0; moves < 2; moves++) {
            struct gx_case one = case_with(moves ? "standard" : "moving-mesh", gx_basis_family[b], dim, periodic, degree);
            check_at_particles(&one, moves);
          }
}

/* Hats interpolate: at a node the field is sum m v S / sum m S, and it is linear between nodes. */
static void hats_join_nodal_values(void **state)
{
  (void)state;
  static const char *const bases[] = {"linear", "ugimp", "cpgimp"};
  for (int b = 0; b < 3; b++) {
    struct gx_case one = case_with("standard", gx_basis_find(bases[b]), 1, true, 1);
    struct rig rig;
    rig_build(&rig, &one, NULL, narrow_domains, NULL);
    const struct gx_particles *particles = rig.simulation.particles;
    double node[4], mass[4] = {0}, momentum[4] = {0}, point[7], value[7];
    assert_int_equal(gx_stepper_accelerate(rig.stepper, 0.3), GX_OK);
    for (size_t p = 0; p < particles->n; p++) {
      double s = 4 * (particles->X[0][p] + particles->u[0][p]);
      int cell = (int)floor(s);
      for (int k = 0; k < 2; k++) {
        int i = (cell + k) & 3;
        double S = k ? s - cell : 1 - (s - cell);
        mass[i] += particles->m[p] * S;
        momentum[i] += particles->m[p] * particles->v[0][p] * S;
      }
    }
    for (int i = 0; i < 4; i++) node[i] = momentum[i] / mass[i];
    for (int i = 0; i < 7; i++) point[i] = 0.125 * i - 0.25;
    rig.simulation.kind->field(rig.simulation.space, GX_FIELD_VELOCITY, 7, (double *[]){point}, (double *[]){value});
    for (int i = 0; i < 7; i++) {
      int left = (i / 2 + 3) & 3;
      NEAR(value[i], i % 2 ? 0.5 * (node[left] + node[(left + 1) & 3]) : node[left], 1e-9);
    }
    rig_free(&rig);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(particles_see_the_field),
      cmocka_unit_test(hats_join_nodal_values),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
