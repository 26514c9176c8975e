/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces of the 1-D moving mesh slot by slot against the general transfers, which a body has whose particles are no lattice: every
 * basis of the moving mesh and the degrees that it has, periodic and fixed, both layouts, lumped and consistent mass, with and without body force; bars
 * shorter than a vector and longer than a stretch; and bars that tangle. The body force as a series in time against its sums over particles. */
#include <float.h>
#include <limits.h>

#include <gsl/gsl_errno.h>

#include "core/vector.h"
#include "rig.h"
#include "spaces/mesh.h"
#include "spaces/slots_core.h"

struct ending {
  struct gx_outcome outcome;
  double steps;
  size_t n;
  double *value[4]; /* u, v, F, b */
};

static const char *const names[] = {"u", "v", "F", "b"};
static const double scale[] = {0.05, 5, 1, 1e5};

/* A wave whose two halves differ, of so many m/s. */
static void set_velocity(struct gx_particles *particles, void *context)
{
  const double *speed = context;
  for (size_t p = 0; p < particles->n; p++) {
    const double X = particles->X[0][p];
    particles->v[0][p] = *speed * sin(M_PI * X) * sin(M_PI * X) * cos(5 * X);
  }
}

static struct ending run(const struct gx_case *one, bool general, double most, double speed, const char *what)
{
  struct rig rig;
  struct ending end = {.steps = 0};
  const size_t n = (size_t)(one->value[GX_MESH_CELLS].integer * one->value[GX_MESH_PARTICLES_PER_CELL].integer);
  size_t *order = calloc(n, sizeof *order);
  for (size_t p = 0; p < n; p++) order[p] = p;
  CHECK(rig_build(&rig, one, general ? order : NULL, speed != 0 ? set_velocity : NULL, &speed), "%s: %s", what,
        rig.outcome.reason);
  const struct gx_particles *particles = rig.simulation.particles;
  while (end.steps < most && gx_stepper_step(rig.stepper, end.steps * rig.simulation.dt, rig.simulation.dt) == GX_OK) end.steps++;
  rig.simulation.kind->settle(rig.simulation.space);
  end.outcome = rig.outcome;
  end.n = particles->n;
  const double *const from[] = {particles->u[0], particles->v[0], particles->F[0], particles->b[0]};
  for (int i = 0; i < 4; i++) {
    end.value[i] = malloc(end.n * sizeof(double));
    memcpy(end.value[i], from[i], end.n * sizeof(double));
  }
  free(order);
  rig_free(&rig);
  return end;
}

/* Runs a case both ways and compares; returns how it ended. */
static enum gx_status compare(const struct gx_case *one, double most, double speed, const char *what)
{
  struct ending slots = run(one, false, most, speed, what), general = run(one, true, most, speed, what);
  CHECK(slots.outcome.status == general.outcome.status && slots.outcome.particle == general.outcome.particle &&
            slots.steps == general.steps,
        "%s: %s of particle %ld after %g steps, not %s of %ld after %g", what, gx_status_name(slots.outcome.status),
        slots.outcome.particle, slots.steps, gx_status_name(general.outcome.status), general.outcome.particle, general.steps);
  for (int i = 0; i < 4; i++) {
    for (size_t p = 0; p < general.n && general.outcome.status == GX_OK; p++)
      CHECK(fabs(slots.value[i][p] - general.value[i][p]) <= 1e-11 * scale[i], "%s: %s of particle %zu is %.17g, not %.17g", what,
            names[i], p, slots.value[i][p], general.value[i][p]);
    free(slots.value[i]);
    free(general.value[i]);
  }
  return slots.outcome.status;
}

static const char *text_of(char *text, size_t size, const char *path, int value)
{
  snprintf(text, size, "%s=%d", path, value);
  return text;
}

static void check_basis(const struct gx_basis *basis, int degree, const char *boundary, const char *layout, const char *mass,
                        int cells, int per_cell)
{
  char name[40], what[160], size[3][40];
  snprintf(name, sizeof name, "method.basis=%s", basis->name);
  snprintf(what, sizeof what, "%s degree %d, %s, %s, %s, %d cells of %d", basis->name, degree, boundary, layout, mass, cells,
           per_cell);
  const struct gx_case one =
      case_of("method.space=moving-mesh", name, boundary, layout, mass, text_of(size[0], 40, "mesh.cells", cells),
              text_of(size[1], 40, "mesh.particles_per_cell", per_cell), "time.cfl=0.2", "time.landing=past",
              basis->has_degree ? text_of(size[2], 40, "method.degree", degree) : "time.periods=1");
  CHECK(compare(&one, 50, 0, what) == GX_OK, "%s tangles", what);
}

static void slots_are_the_general_transfers(void **state)
{
  (void)state;
  static const char *const boundaries[] = {"problem.boundary=periodic", "problem.boundary=fixed"};
  static const char *const layouts[] = {"mesh.layout=uniform", "mesh.layout=gauss"};
  static const char *const masses[] = {"method.mass=lumped", "method.mass=consistent"};
  for (size_t i = 0; gx_basis_family[i]; i++)
    for (int degree = strcmp(gx_basis_family[i]->name, "cpgimp") ? 1 : INT_MAX;
         /* refused */ degree <= (gx_basis_family[i]->has_degree ? 5 : 1); degree++)
      for (int kind = 0; kind < 8; kind++) {
        const char *boundary = boundaries[kind & 1], *layout = layouts[kind >> 1 & 1], *mass = masses[kind >> 2];
        check_basis(gx_basis_family[i], degree, boundary, layout, mass, 7, 3);
        check_basis(gx_basis_family[i], degree, boundary, layout, mass, 13, 9);
        check_basis(gx_basis_family[i], degree, boundary, layout, mass, 525, 2);
        check_basis(gx_basis_family[i], degree, boundary, layout, mass, 264, 2); /* the second stretch fills its last vector */
        if (kind < 4) check_basis(gx_basis_family[i], degree, boundary, layout, mass, 8, 1); /* full mass is singular */
      }
}

/* Linear material, no body force. */
static void slots_without_body_force(void **state)
{
  (void)state;
  const struct gx_case one = case_of("problem.name=bar-linear", "method.space=moving-mesh", "mesh.cells=300", "time.cfl=0.2",
                                     "mesh.particles_per_cell=5", "time.landing=past");
  CHECK(compare(&one, 200, 0, "bar-linear") == GX_OK, "bar-linear tangles");
}

/* One particle, the first that is seen, whichever slot and stretch it is in; and one in the last vector, which is not full. */
static void slots_tangle_alike(void **state)
{
  (void)state;
  for (int degree = 1; degree <= 3; degree++)
    for (int fixed = 0; fixed < 2; fixed++)
      for (int size = 0; size < 2; size++) {
        char what[80], set[40];
        snprintf(what, sizeof what, "degree %d, boundary %d, size %d, fast", degree, fixed, size);
        const struct gx_case one = case_of("method.space=moving-mesh", text_of(set, 40, "method.degree", degree),
                                           fixed ? "problem.boundary=fixed" : "problem.boundary=periodic", "time.cfl=0.1",
                                           size ? "mesh.cells=301" : "mesh.cells=13", "time.landing=past");
        CHECK(compare(&one, 2000, 400, what) == GX_TANGLED, "%s does not tangle", what);
      }
}

/* Both sums of the body force at random times: what is cut, as in force_series.h, and the round-off of so many operations, relative to
 * the terms of the body force without their signs. */
static void check_series(const struct gx_case *one, bool expected, const char *what)
{
  struct rig rig;
  CHECK(rig_build(&rig, one, NULL, NULL, NULL), "%s: %s", what, rig.outcome.reason);
  const struct gx_mesh *mesh = (const struct gx_mesh *)rig.simulation.space;
  const struct gx_posed *posed = mesh->space.posed;
  struct gx_slots *slots = gx_slots_create(gx_lattice_line(mesh->lattice), mesh->space.particles, posed);
  struct gx_force_series *series = slots->series;
  CHECK(!series == !expected, "%s: %s", what, series ? "a series" : "no series");
  const double A = fabs(posed->options.amplitude), s = 2 * M_PI * A, rho = (1 + sqrt(1 - s * s)) / s;
  const struct gx_moduli *moduli = &posed->options.moduli;
  const double most =
      A * 4 * M_PI * M_PI / moduli->density *
      (moduli->mu + (moduli->mu + moduli->lambda * (1 - log(1 - s))) / ((1 - s) * (1 - s)) + moduli->lambda + moduli->mu);
  const double operations = 4 / (rho - 1) + 1 + 16 + 10 + slots->support * slots->slots;
  const double bound = operations * DBL_EPSILON * most * gx_vector_max(mesh->grid.stored, mesh->mass), period = 2 / posed->speed;
  double *force = calloc(2 * (mesh->grid.stored + GX_SLOTS_ROOM), sizeof *force),
         *sums = force + mesh->grid.stored + GX_SLOTS_ROOM;
  uint64_t seed = 11;
  for (int k = 0; series && k < 200; k++) {
    const double t = period * check_random(&seed, -1, k % 2 ? 1 : 40);
    gx_slots_force_body(slots, t, force);
    slots->series = NULL;
    gx_slots_force_body(slots, t, sums);
    slots->series = series;
    for (size_t i = 0; i < mesh->grid.stored; i++) NEAR(force[i], sums[i], bound);
  }
  free(force);
  gx_slots_free(slots);
  rig_free(&rig);
}

static void body_force_as_a_series(void **state)
{
  (void)state;
  static const char *const amplitudes[] = {"problem.amplitude=1e-4", "problem.amplitude=-0.05", "problem.amplitude=0.1"};
  static const char *const phases[] = {"problem.phases=0", "problem.phases=0.3", "problem.phases=-41.7"};
  static const char *const poissons[] = {"problem.poisson=0", "problem.poisson=0.3"};
  static const char *const cells[] = {"mesh.cells=7", "mesh.cells=64", "mesh.cells=200"};
  for (int kind = 0; kind < 3 * 3 * 2 * 3 * 2; kind++) {
    const char *amplitude = amplitudes[kind % 3], *phase = phases[kind / 3 % 3], *poisson = poissons[kind / 9 % 2];
    const char *size = cells[kind / 18 % 3], *boundary = kind / 54 ? "problem.boundary=fixed" : "problem.boundary=periodic";
    char what[160];
    snprintf(what, sizeof what, "%s, %s, %s, %s, %s", amplitude, phase, poisson, size, boundary);
    const struct gx_case one =
        case_of("problem.name=axis-aligned", "problem.dimension=1", "method.space=moving-mesh",
                kind % 2 ? "method.degree=1" : "method.degree=2", "mesh.particles_per_cell=3",
                kind % 5 ? "mesh.layout=uniform" : "mesh.layout=gauss", amplitude, phase, poisson, size, boundary);
    check_series(&one, true, what);
  }
}

/* Too steep; too long; no body force. */
static void no_series(void **state)
{
  (void)state;
  const struct gx_case steep = case_of("method.space=moving-mesh", "problem.amplitude=0.155"),
                       large = case_of("method.space=moving-mesh", "mesh.cells=1000"),
                       free = case_of("problem.name=bar-linear", "method.space=moving-mesh");
  check_series(&steep, false, "steep");
  check_series(&large, false, "large");
  check_series(&free, false, "free");
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(slots_are_the_general_transfers),
      cmocka_unit_test(slots_without_body_force),
      cmocka_unit_test(slots_tangle_alike),
      cmocka_unit_test(body_force_as_a_series),
      cmocka_unit_test(no_series),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
