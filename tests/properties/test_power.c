/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The transfers that the grid spaces really use, of lines, lattices, slots and blocks, are adjoint: what nodal forces do to the nodal
 * velocity is what the particles' stress does to its gradient there, v M a = -sum V0 P : dF/dt, dF/dt = L F on a fixed grid and L on a
 * moving one, at a random state. Where integrals are sums over particles. */
#include "trial.h"

#include "points.h"
#include "spaces/mass_cg.h"
#include "spaces/mesh.h"

static const double unit = 0x1p-53;

/* v M a, and its terms without signs: by row sums, or by what both fields are at the particles. */
static double power_of_nodes(struct gx_mesh *mesh, double *size, double *tolerance)
{
  const struct gx_particles *particles = mesh->space.particles;
  double power = 0, kinetic = 0, kick = 0;
  *size = *tolerance = 0;
  for (int d = 0; d < mesh->grid.dim; d++)
    for (size_t i = 0; i < mesh->grid.stored; i++) {
      power += mesh->mass[i] * mesh->v[d][i] * mesh->a[d][i];
      *size += fabs(mesh->mass[i] * mesh->v[d][i] * mesh->a[d][i]);
    }
  if (!mesh->consistent) return power;
  double **v = fields(GX_MAX_DIM, particles->n), **a = fields(GX_MAX_DIM, particles->n);
  gx_mesh_gather(mesh, mesh->v, v, NULL);
  gx_mesh_gather(mesh, mesh->a, a, NULL);
  power = 0;
  for (int d = 0; d < mesh->grid.dim; d++)
    for (size_t p = 0; p < particles->n; p++) {
      power += particles->m[p] * v[d][p] * a[d][p];
      kinetic += particles->m[p] * v[d][p] * v[d][p];
      kick += particles->m[p] * a[d][p] * a[d][p];
    }
  fields_free(v, GX_MAX_DIM);
  fields_free(a, GX_MAX_DIM);
  if (mesh->grid.dim > 1) *tolerance = GX_MASS_CG_TOLERANCE * sqrt(kinetic * kick);
  return power;
}

/* sum V0 P : dF/dt; |L| is at most the largest speed times the sum of |D|. */
static double power_of_stress(struct gx_mesh *mesh, double *size)
{
  const struct gx_particles *particles = mesh->space.particles;
  const int dim = mesh->grid.dim;
  const bool follows = mesh->space.kind->fixed_grid;
  double **L = fields(GX_MAX_TENSOR, particles->n), power = 0, fastest = 0;
  for (int d = 0; d < dim; d++)
    for (size_t i = 0; i < mesh->grid.stored; i++) fastest = fmax(fastest, fabs(mesh->v[d][i]));
  const double steepest = 2.0 * mesh->grid.axis[0].degree * mesh->grid.axis[0].cells * fastest;
  *size = 0;
  gx_mesh_gather(mesh, mesh->v, NULL, L);
  for (size_t p = 0; p < particles->n; p++)
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++) {
        double rate = follows ? 0 : L[i * dim + j][p], stretch = follows ? 0 : 1;
        for (int k = 0; follows && k < dim; k++) {
          rate += L[i * dim + k][p] * particles->F[k * dim + j][p];
          stretch += fabs(particles->F[k * dim + j][p]);
        }
        power += particles->V0[p] * particles->P[i * dim + j][p] * rate;
        *size += fabs(particles->V0[p] * particles->P[i * dim + j][p]) * stretch * steepest;
      }
  fields_free(L, GX_MAX_TENSOR);
  return power;
}

static enum property_verdict check(const struct property *property, const int *value, struct property_finding *finding)
{
  struct trial trial;
  enum gx_status status = trial_build(&trial, property->choice, value, NULL);
  for (int k = 0; k < value[TRIAL_STEPS] && status == GX_OK; k++) {
    struct gx_mesh *mesh = (struct gx_mesh *)trial.rig.simulation.space;
    double of_nodes, tolerance, of_stress;
    status = gx_stepper_accelerate(trial.rig.stepper, k * trial.rig.simulation.dt);
    if (status != GX_OK) break;
    trial_settle(&trial);
    const double power = power_of_nodes(mesh, &of_nodes, &tolerance) + power_of_stress(mesh, &of_stress);
    const double terms = trial_roundings(&trial) + (double)mesh->grid.stored;
    property_compare(finding, fabs(power), terms * unit * (of_nodes + of_stress) + tolerance, "power");
    if (k + 1 < value[TRIAL_STEPS]) status = trial_step(&trial);
  }
  enum property_verdict verdict = trial_judge(&trial, status, finding);
  trial_free(&trial);
  return verdict;
}

static void forces_do_what_stresses_do(void **state)
{
  (void)state;
  static const char *const particles[] = {"particles", NULL};
  struct property_choice summed[PROPERTY_CHOICES] = {TRIAL_CHOICES, {NULL, 0, 0, NULL}};
  summed[TRIAL_SPACE] = (struct property_choice){"method.space", 0, 1, trial_grids};
  summed[TRIAL_QUADRATURE] = (struct property_choice){"method.quadrature", 0, 0, particles};
  summed[TRIAL_STATE].least = 1;
  property_check(&(const struct property){"power", summed, 150, 30, check});
}

int main(void)
{
  gx_status_quiet_gsl();
  const struct CMUnitTest tests[] = {cmocka_unit_test(forces_do_what_stresses_do)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
