/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spline spaces in 2-D and 3-D: orders, walls as mirrors, shear beside the moving mesh, energy. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "rig.h"

static const char *const spaces[] = {"spline-particle", "spline-grid"};

static struct gx_case wave(const char *space, const char *boundary, const char *poisson, int dim, long degree, long cells)
{
  struct gx_case one = case_draft("problem.name=axis-aligned", "problem.amplitude=0.02", "mesh.particles_per_cell=2",
                                  "method.clock=blanes-moan6", "time.cfl=0.1", "time.periods=0.2", "output.measures=final");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_PROBLEM_BOUNDARY, boundary);
  case_set(&one, GX_PROBLEM_POISSON, poisson);
  case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
  case_set_integer(&one, GX_METHOD_DEGREE, degree);
  case_set_integer(&one, GX_MESH_CELLS, cells);
  gx_parameter_resolve(one.value);
  return one;
}

static void check_order(const char *space, const char *boundary, const char *poisson, int dim, long degree, long cells,
                        double least)
{
  double error[2];
  for (int i = 0; i < 2; i++) {
    struct gx_case one = wave(space, boundary, poisson, dim, degree, cells << i);
    error[i] = case_result(&one).measured.last.error[GX_DISPLACEMENT][GX_RMS];
  }
  double order = log2(error[0] / error[1]);
  CHECK(order > least, "%s, %s, nu %s, %d-D, degree %ld: order %g (%g, %g)", space, boundary, poisson, dim, degree, order,
        error[0], error[1]);
}

/* As in 1-D: degree + 1 through the particles, degree - 1 by way of the nodes. */
static void degree_gives_order(void **state)
{
  (void)state;
  static const char *const boundaries[] = {"periodic", "fixed"}, *const ratios[] = {"0", "0.3"};
  for (int b = 0; b < 2; b++)
    for (int nu = 0; nu < 2; nu++)
      for (long degree = 3; degree <= 7; degree += 2) {
        check_order(spaces[0], boundaries[b], ratios[nu], 2, degree, 8, (double)degree + 0.75);
        check_order(spaces[1], boundaries[b], ratios[nu], 2, degree, 12, (double)degree - 1.25);
      }
  check_order(spaces[0], "fixed", "0.3", 3, 5, 5, 5.75);
}

/* A box at rest with a bulk modulus, no body force since the wave has no height, and a velocity given below. */
static struct gx_case plain_box(const char *space, const char *boundary, const char *layout, int dim, long cells)
{
  struct gx_case one = case_draft("problem.name=axis-aligned", "problem.amplitude=0", "problem.poisson=0.3", "problem.modulus=1",
                                  "method.clock=rk4", "mesh.particles_per_cell=3");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_PROBLEM_BOUNDARY, boundary);
  case_set(&one, GX_MESH_LAYOUT, layout);
  case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
  case_set_integer(&one, GX_MESH_CELLS, cells);
  return one;
}

/* Component d is odd across faces of direction d, even across the others, has no other symmetry and shears; half waves: the box is
 * that of the walls, whole ones: the periodic box that walls at 0 and 1/2 cut in two. */
struct motion {
  double waves, height;
};

static void sheared(struct gx_particles *particles, void *context)
{
  const struct motion *motion = context;
  const double k = 2 * M_PI * motion->waves;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) {
      double v = motion->height * (d + 1) * (sin(k * particles->X[d][p]) + 0.4 * sin(2 * k * particles->X[d][p]));
      for (int e = 0; e < particles->dim; e++)
        if (e != d) v *= 0.3 + cos(k * particles->X[e][p]) + 0.2 * (d + 1) * cos(2 * k * particles->X[e][p]);
      particles->v[d][p] = v;
    }
}

/* Walls at which the normal component is zero are mirrors: between them a body does what half of a periodic one does. Lengths are
 * halved there, and with a quarter of the modulus accelerations are too. */
static void check_mirror(const char *space, const char *layout, int dim)
{
  struct rig rig[2];
  for (int periodic = 0; periodic < 2; periodic++) {
    struct gx_case one = plain_box(space, periodic ? "periodic" : "fixed", layout, dim, periodic ? 10 : 5);
    struct motion motion = periodic ? (struct motion){1, 0.05} : (struct motion){0.5, 0.1};
    case_set(&one, GX_PROBLEM_MODULUS, periodic ? "0.25" : "1");
    case_set(&one, GX_METHOD_DEGREE, "4");
    case_set(&one, GX_TIME_DT, "0.01");
    case_set_integer(&one, GX_TIME_STEPS, 20);
    gx_parameter_resolve(one.value);
    assert_true(rig_build(&rig[periodic], &one, NULL, sheared, &motion));
    rig_run(&rig[periodic], -1);
  }
  const struct gx_particles *walls = rig[0].simulation.particles, *ring = rig[1].simulation.particles;
  double shear = 0;
  for (size_t p = 0; p < walls->n; p++) {
    size_t q = 0, stride = 1, rest = p;
    for (int d = 0; d < dim; d++) {
      q += stride * (rest % (size_t)walls->lattice[d]);
      rest /= (size_t)walls->lattice[d];
      stride *= (size_t)ring->lattice[d];
    }
    for (int d = 0; d < dim; d++) {
      NEAR(2 * ring->X[d][q], walls->X[d][p], 1e-15);
      NEAR(2 * ring->u[d][q], walls->u[d][p], 1e-13);
      NEAR(2 * ring->v[d][q], walls->v[d][p], 1e-12);
      for (int e = 0; e < dim; e++) NEAR(ring->F[d * dim + e][q], walls->F[d * dim + e][p], 1e-12);
    }
    shear = fmax(shear, fabs(walls->F[1][p]));
  }
  CHECK(shear > 0.02, "%g", shear);
  for (int k = 0; k < 2; k++) rig_free(&rig[k]);
}

static void walls_are_mirrors(void **state)
{
  (void)state;
  for (int s = 0; s < 2; s++)
    for (int dim = 2; dim <= GX_MAX_DIM; dim++) {
      check_mirror(spaces[s], "uniform", dim);
      check_mirror(spaces[s], "gauss", dim);
    }
}

/* Largest difference of F and u of a sheared box between two spaces. */
static double difference(const char *space, const char *boundary, int dim, long cells, double *strain)
{
  struct rig rig[2];
  double worst = 0;
  *strain = 0;
  for (int k = 0; k < 2; k++) {
    struct gx_case one = plain_box(k ? "moving-mesh" : space, boundary, k ? "gauss" : "uniform", dim, cells);
    struct motion motion = {strcmp(boundary, "fixed") ? 1 : 0.5, 0.06};
    case_set(&one, GX_METHOD_DEGREE, k ? "4" : "5");
    case_set(&one, GX_METHOD_MASS, "consistent");
    case_set(&one, GX_MESH_PARTICLES_PER_CELL, k ? "5" : "3");
    case_set(&one, GX_TIME_DT, "0.01");
    case_set_integer(&one, GX_TIME_STEPS, 20);
    gx_parameter_resolve(one.value);
    assert_true(rig_build(&rig[k], &one, NULL, sheared, &motion));
    rig_run(&rig[k], -1);
  }
  /* the third of five Gauss points of a cell is its middle, as is the second of three equal parts */
  const struct gx_particles *few = rig[0].simulation.particles, *many = rig[1].simulation.particles;
  for (size_t p = 0; p < few->n; p++) {
    size_t q = 0, stride = 1, rest = p;
    bool middle = true;
    for (int d = 0; d < dim; d++) {
      size_t k = rest % (size_t)few->lattice[d];
      middle &= k % 3 == 1;
      q += stride * (k / 3 * 5 + 2);
      rest /= (size_t)few->lattice[d];
      stride *= (size_t)many->lattice[d];
    }
    if (!middle) continue;
    for (int d = 0; d < dim; d++) NEAR(many->X[d][q], few->X[d][p], 1e-15);
    for (int d = 0; d < dim; d++) worst = fmax(worst, fabs(many->u[d][q] - few->u[d][p]));
    for (int k = 0; k < dim * dim; k++) {
      worst = fmax(worst, fabs(many->F[k][q] - few->F[k][p]));
      *strain = fmax(*strain, fabs(few->F[k][p] - (k % (dim + 1) == 0)));
    }
  }
  for (int k = 0; k < 2; k++) rig_free(&rig[k]);
  return worst;
}

/* Weak and strong form follow one continuum through shear: what lies between them falls with the cells. In 3-D one mesh says it. */
static void shear_is_that_of_the_moving_mesh(void **state)
{
  (void)state;
  static const char *const boundaries[] = {"periodic", "fixed"};
  for (int s = 0; s < 2; s++)
    for (int b = 0; b < 2; b++) {
      double strain, coarse = difference(spaces[s], boundaries[b], 2, 8, &strain);
      double fine = difference(spaces[s], boundaries[b], 2, 16, &strain), order = log2(coarse / fine);
      CHECK(strain > 0.1 && fine < 1e-3 * strain && order > 2.5, "%s, %s: %g of %g, order %g", spaces[s], boundaries[b], fine,
            strain, order);
    }
  double strain, apart = difference(spaces[0], "fixed", 3, 6, &strain);
  CHECK(strain > 0.1 && apart < 2e-3 * strain, "3-D: %g of %g", apart, strain);
}

/* Largest difference of u and P between stress from F and stress by rate. */
static double apart_by_rate(const char *space, int dim, int steps, double *shear)
{
  struct rig rig[2];
  struct motion motion = {0.5, 0.1};
  double worst = 0;
  for (int k = 0; k < 2; k++) {
    struct gx_case one = plain_box(space, "fixed", "uniform", dim, 5);
    case_set(&one, GX_METHOD_DEGREE, "4");
    case_set(&one, GX_METHOD_STRESS, k ? "rate" : "F");
    case_set_real(&one, GX_TIME_DT, 0.1 / steps);
    case_set_integer(&one, GX_TIME_STEPS, steps);
    gx_parameter_resolve(one.value);
    assert_true(rig_build(&rig[k], &one, NULL, sheared, &motion));
    rig_run(&rig[k], -1);
    assert_int_equal(gx_stepper_accelerate(rig[k].stepper, 0.1), GX_OK); /* P of the end state */
  }
  const struct gx_particles *exact = rig[0].simulation.particles, *summed = rig[1].simulation.particles;
  *shear = 0;
  for (size_t p = 0; p < exact->n; p++) {
    for (int d = 0; d < dim; d++) worst = fmax(worst, fabs(exact->u[d][p] - summed->u[d][p]));
    for (int k = 0; k < dim * dim; k++) worst = fmax(worst, fabs(exact->P[k][p] - summed->P[k][p]));
    *shear = fmax(*shear, fabs(exact->P[1][p]));
  }
  for (int k = 0; k < 2; k++) rig_free(&rig[k]);
  return worst;
}

/* dP/dt at F for grad v, integrated, is P(F) but for the clock's error, of order 4, and moves the box alike. */
static void stress_by_rate_is_that_of_F(void **state)
{
  (void)state;
  for (int s = 0; s < 2; s++)
    for (int dim = 2; dim <= GX_MAX_DIM; dim++) {
      double shear, coarse = apart_by_rate(spaces[s], dim, 10, &shear), fine = apart_by_rate(spaces[s], dim, 20, &shear);
      CHECK(shear > 0.01 && fine < 1e-5 * shear && log2(coarse / fine) > 3.75, "%s %d-D: %g and %g of %g, order %g", spaces[s],
            dim, coarse, fine, shear, log2(coarse / fine));
    }
}

static double energy_of(const struct rig *rig)
{
  const struct gx_particles *particles = rig->simulation.particles;
  const struct gx_posed *posed = rig->simulation.posed;
  double *W = malloc(particles->n * sizeof(double)), energy = 0;
  posed->problem->material->energy(&posed->options.moduli, particles->dim, particles->n, particles->F, W);
  for (size_t p = 0; p < particles->n; p++) {
    energy += particles->V0[p] * W[p];
    for (int d = 0; d < particles->dim; d++) energy += 0.5 * particles->m[p] * particles->v[d][p] * particles->v[d][p];
  }
  free(W);
  return energy;
}

/* Largest change of the energy of a sheared box, of that which it begins with; by steps that err by 1e-12 of it. */
static double drift_of(const char *space, const char *boundary, const char *layout, int dim)
{
  struct gx_case one = plain_box(space, boundary, layout, dim, dim == 2 ? 8 : 5);
  struct motion motion = {strcmp(boundary, "fixed") ? 1 : 0.5, 0.06};
  struct rig rig;
  case_set(&one, GX_METHOD_CLOCK, "blanes-moan6");
  case_set(&one, GX_METHOD_DEGREE, "4");
  case_set(&one, GX_TIME_DT, "0.005");
  case_set_integer(&one, GX_TIME_STEPS, 1);
  gx_parameter_resolve(one.value);
  assert_true(rig_build(&rig, &one, NULL, sheared, &motion));
  double first = energy_of(&rig), worst = 0;
  for (int k = 0; k < 60; k++) {
    rig_run(&rig, 2);
    worst = fmax(worst, fabs(energy_of(&rig) - first) / first);
  }
  rig_free(&rig);
  return worst;
}

/* Derivatives of splines through uniform particles are antisymmetric on a ring, and so from odd to even and back between mirrors:
 * the sum of V0 P : dF/dt is minus that of m v . a, and kinetic and elastic energy of the particles sum to a constant that only the
 * clock changes. Nothing says so of Gauss points or of a way there and back through nodes. */
static void energy_is_kept_through_uniform_particles(void **state)
{
  (void)state;
  static const char *const boundaries[] = {"periodic", "fixed"};
  for (int b = 0; b < 2; b++)
    for (int dim = 1; dim <= GX_MAX_DIM; dim++) {
      double drift = drift_of(spaces[0], boundaries[b], "uniform", dim);
      double gauss = drift_of(spaces[0], boundaries[b], "gauss", dim), grid = drift_of(spaces[1], boundaries[b], "uniform", dim);
      CHECK(drift < 1e-12 && gauss > 1e4 * drift && grid > 1e4 * drift, "%s, %d-D: %g, at Gauss points %g, through nodes %g",
            boundaries[b], dim, drift, gauss, grid);
    }
}

/* At F = I cubic splines through uniform particles d apart have i (3 sin w / (2 + cos w)) / d for derivative, at most sqrt(3) / d, so
 * that the highest frequency is c sqrt(3 dim) / d: of the wave along the diagonal, since it is as long in every direction. */
static void the_stable_step_is_that_of_the_diagonal(void **state)
{
  (void)state;
  for (int dim = 1; dim <= GX_MAX_DIM; dim++) {
    struct gx_case one = case_draft("problem.name=axis-aligned", "problem.modulus=4", "problem.poisson=0.3", "mesh.cells=6",
                                    "problem.amplitude=1e-6", "mesh.particles_per_cell=2", "method.space=spline-particle",
                                    "method.degree=3", "time.cfl=0.05");
    case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
    gx_parameter_resolve(one.value);
    const struct gx_moduli moduli = gx_material_moduli(4, 0.3, 1);
    const double c = sqrt(moduli.lambda + 2 * moduli.mu);
    CLOSE(gx_case_plan(&one).stable_dt, 2 / (c * sqrt(3 * dim) * 12), 0.02);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(degree_gives_order),
      cmocka_unit_test(walls_are_mirrors),
      cmocka_unit_test(shear_is_that_of_the_moving_mesh),
      cmocka_unit_test(stress_by_rate_is_that_of_F),
      cmocka_unit_test(energy_is_kept_through_uniform_particles),
      cmocka_unit_test(the_stable_step_is_that_of_the_diagonal),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
