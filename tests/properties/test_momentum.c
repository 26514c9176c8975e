/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run of a random method from a random state keeps: mass, linear and angular momentum, uniform motion.
 * Linear momentum is kept by every grid method where no end holds a particle, and in strong form through the particles alone at equal
 * distances on a periodic line, where its derivatives are antisymmetric.
 * Angular momentum of a body with no images in reach is kept by
 * - APIC, where particles drift with the velocity that the kick before left them: a projection in between makes the nodes' another
 *   one. Not with hats on a fixed grid, whose affine part is the gradient, and not with stress by rate, which turns with F to the
 *   order of the clock alone;
 * - FLIP with the full mass matrix, where weights do not change within a step, particles stay with the nodes that carry them, and no
 *   stages are averaged: a Runge-Kutta method of order 4 keeps no products.
 * FLIP and PIC with lumped mass keep none: row sums smooth a rotation at the edge of the body. */
#include "trial.h"

#include "measures/momentum.h"
#include "spaces/mass_cg.h"
#include "spaces/mesh.h"

static const double unit = 0x1p-53;

static double sum_of(int count, double *const *field, const double *weight, size_t n)
{
  double sum = 0;
  for (int k = 0; k < count; k++)
    for (size_t i = 0; i < n; i++) sum += weight[i] * fabs(field[k][i]);
  return sum;
}

/* All that a step of dt adds to and takes from momentum, without signs: what nodes and particles carry, kicks, and forces before
 * they cancel. |D| sums to less than `steep`. */
static double turnover(const struct trial *trial)
{
  const struct gx_simulation *simulation = &trial->rig.simulation;
  const struct gx_particles *particles = simulation->particles;
  const int dim = particles->dim;
  const double steep = 2.0 * simulation->space_options.degree * simulation->space_options.cells[0];
  double stretch = 1, force = sum_of(dim * dim, particles->P, particles->V0, particles->n);
  for (int k = 0; k < dim * dim; k++)
    for (size_t p = 0; p < particles->n; p++) stretch = fmax(stretch, fabs(particles->F[k][p]));
  double size = sum_of(dim, particles->v, particles->m, particles->n);
  if (case_on_grid(simulation->kind)) {
    const struct gx_mesh *mesh = (const struct gx_mesh *)simulation->space;
    size += sum_of(dim, mesh->v, mesh->mass, mesh->grid.stored);
    size += simulation->dt * sum_of(dim, mesh->a, mesh->mass, mesh->grid.stored);
    for (int k = 0; mesh->reconstruction && k < dim * dim; k++)
      for (size_t q = 0; q < mesh->reconstruction->points->n; q++) force += fabs(mesh->reconstruction->points->P[k][q]);
  }
  return size + simulation->dt * steep * dim * stretch * force;
}

/* Roundings of a step, each of them of its whole turnover; a solve of the full matrix in 2-D and 3-D ends at its own tolerance. */
static double error_of_step(const struct trial *trial)
{
  const struct gx_simulation *simulation = &trial->rig.simulation;
  double each = trial_roundings(trial) * unit;
  if (case_on_grid(simulation->kind)) {
    const struct gx_mesh *mesh = (const struct gx_mesh *)simulation->space;
    each += (double)mesh->grid.stored * unit;
    if (mesh->consistent && mesh->grid.dim > 1) each += GX_MASS_CG_TOLERANCE;
  }
  return each * (simulation->clock->stages + 1) * turnover(trial);
}

static bool keeps_linear(const struct trial *trial, const int *value)
{
  const struct gx_space_kind *kind = trial->rig.simulation.kind;
  if (!kind->collocation) return true;
  return !kind->nodal && value[TRIAL_ENDS] == 0 && value[TRIAL_LAYOUT] == 0;
}

static enum property_verdict check_linear(const struct property *property, const int *value, struct property_finding *finding)
{
  struct trial trial;
  enum gx_status status = trial_build(&trial, property->choice, value, NULL);
  double before[GX_MAX_DIM] = {0}, bound = 0;
  if (status == GX_OK && !keeps_linear(&trial, value)) status = GX_REFUSED;
  if (status == GX_OK) {
    trial_settle(&trial);
    memcpy(before, gx_momentum_of(trial.rig.simulation.particles, trial.rig.simulation.particles->v).linear, sizeof before);
    bound = error_of_step(&trial);
  }
  for (int k = 0; k < value[TRIAL_STEPS] && status == GX_OK; k++) {
    status = trial_step(&trial);
    trial_settle(&trial);
    bound += error_of_step(&trial);
  }
  if (status == GX_OK) {
    const struct gx_particles *particles = trial.rig.simulation.particles;
    struct gx_momentum after = gx_momentum_of(particles, particles->v);
    property_compare(finding, gx_momentum_distance(after.linear, before), bound, "momentum");
  }
  enum property_verdict verdict = trial_judge(&trial, status, finding);
  trial_free(&trial);
  return verdict;
}

static void linear_momentum(void **state)
{
  (void)state;
  struct property_choice apart[PROPERTY_CHOICES] = {TRIAL_CHOICES, {NULL, 0, 0, NULL}};
  apart[TRIAL_ENDS].most = 1; /* nothing held */
  property_check(&(const struct property){"linear momentum", apart, 150, 20, check_linear});
}

/* Nodes have the particles' mass: sums over these, or fields scaled to it; splines through a line come as near as their order. */
static enum property_verdict check_mass(const struct property *property, const int *value, struct property_finding *finding)
{
  struct trial trial;
  enum gx_status status = trial_build(&trial, property->choice, value, NULL);
  if (status == GX_OK && !case_on_grid(trial.rig.simulation.kind)) status = GX_REFUSED;
  const struct gx_mesh *mesh = (const struct gx_mesh *)trial.rig.simulation.space;
  if (status == GX_OK && mesh->reconstruction && !mesh->reconstruction->fit->kind->scales) status = GX_REFUSED;
  for (int k = 0; k <= value[TRIAL_STEPS] && status == GX_OK; k++) {
    const struct gx_particles *particles = trial.rig.simulation.particles;
    double nodes = 0, mass = 0, terms = trial_roundings(&trial) + (double)mesh->grid.stored;
    status = gx_stepper_accelerate(trial.rig.stepper, k * trial.rig.simulation.dt);
    for (size_t i = 0; i < mesh->grid.stored; i++) nodes += mesh->mass[i];
    for (size_t p = 0; p < particles->n; p++) mass += particles->m[p];
    if (status == GX_OK) property_compare(finding, fabs(nodes - mass), terms * unit * mass, "mass");
    if (status == GX_OK && k < value[TRIAL_STEPS]) status = trial_step(&trial);
  }
  enum property_verdict verdict = trial_judge(&trial, status, finding);
  trial_free(&trial);
  return verdict;
}

static void mass(void **state)
{
  (void)state;
  struct property_choice grids[PROPERTY_CHOICES] = {TRIAL_CHOICES, {NULL, 0, 0, NULL}};
  grids[TRIAL_SPACE] = (struct property_choice){"method.space", 0, 1, trial_grids};
  property_check(&(const struct property){"mass", grids, 100, 20, check_mass});
}

static bool is(const struct trial *trial, enum gx_parameter_id id, const char *text)
{
  return trial->one.value[id].type == GX_TEXT && !strcmp(trial->one.value[id].text, text);
}

/* Whether each drift of a step comes after a kick, with no other weights in between. */
static bool drifts_as_kicked(const struct trial *trial)
{
  const struct gx_clock *clock = trial->rig.simulation.clock;
  const bool plain = clock->plain_rows && !trial->rig.simulation.kind->fixed_grid;
  if (clock->tableau) return false;
  if (clock->splitting) return clock->splitting->drift[0] == 0;
  bool kicked = false;
  for (const struct gx_row *row = plain ? clock->plain_rows : clock->rows; row->primitive != GX_END; row++) {
    kicked = kicked || row->primitive == GX_KICK;
    if (row->primitive > GX_DRIFT || (row->primitive == GX_DRIFT && !kicked)) return false;
  }
  return true;
}

/* Whether a step keeps the weights that it began with for each kick: no rows of two positions. */
static bool is_plain(const struct trial *trial)
{
  const struct gx_clock *clock = trial->rig.simulation.clock;
  const bool plain = clock->plain_rows && !trial->rig.simulation.kind->fixed_grid;
  for (const struct gx_row *row = plain ? clock->plain_rows : clock->rows; row && row->primitive != GX_END; row++)
    if (row->primitive > GX_DRIFT) return false;
  return !clock->tableau;
}

static bool keeps_angular(const struct trial *trial)
{
  const struct gx_space_options *options = &trial->rig.simulation.space_options;
  const bool fixed = trial->rig.simulation.kind->fixed_grid;
  if (!case_on_grid(trial->rig.simulation.kind) || !options->each_step || options->reconstructed || options->stress_rate)
    return false;
  if (options->particle_motion && !fixed) return false;
  if (options->apic && fixed && (is(trial, GX_METHOD_BASIS, "linear") || (options->basis->has_degree && options->degree == 1)))
    return false;
  if (options->apic) return drifts_as_kicked(trial) || (options->particle_motion && is_plain(trial));
  return !options->pic && options->flip == 1 && options->consistent && is_plain(trial);
}

static void angular_of(struct trial *trial, double *angular)
{
  struct gx_space *space = trial->rig.simulation.space;
  trial_settle(trial);
  memcpy(angular, gx_momentum_of(space->particles, space->particles->v).angular, GX_MAX_DIM * sizeof *angular);
  if (space->kind->spin) space->kind->spin(space, 0, angular);
}

/* The affine part is divided by the spread of weights about a particle, which near a node is a part of the particle's distance or
 * width: no less than 1/(20 particles a cell) cells squared, of 1/4 at most. */
static double loss_of_spread(const struct trial *trial)
{
  return trial->rig.simulation.space_options.apic ? 5.0 * trial->rig.simulation.per_cell : 1;
}

static enum property_verdict check_angular(const struct property *property, const int *value, struct property_finding *finding)
{
  struct trial trial;
  const struct trial_view view = {.body = 0.5};
  enum gx_status status = trial_build(&trial, property->choice, value, &view);
  double before[GX_MAX_DIM], after[GX_MAX_DIM], bound = 0;
  if (status == GX_OK && !keeps_angular(&trial)) status = GX_REFUSED;
  if (status == GX_OK) angular_of(&trial, before);
  for (int k = 0; k < value[TRIAL_STEPS] && status == GX_OK; k++) {
    bound += error_of_step(&trial);
    status = trial_step(&trial);
    trial_settle(&trial);
    bound += error_of_step(&trial);
  }
  if (status == GX_OK) {
    angular_of(&trial, after);
    const double arms = 2 * trial.rig.simulation.problem_options.dim; /* in a box of width 1, and two products each */
    property_compare(finding, gx_momentum_distance(after, before), arms * loss_of_spread(&trial) * bound, "angular momentum");
  }
  enum property_verdict verdict = trial_judge(&trial, status, finding);
  trial_free(&trial);
  return verdict;
}

/* A body with free ends in more than one dimension, velocity from the particles at each step. */
static void check_turning(const char *title, const char *transfer, const char *mass)
{
  const char *const particles[] = {"particles", NULL}, *const each_step[] = {"each-step", NULL}, *const F[] = {"F", NULL};
  const char *const transfers[] = {transfer, NULL}, *const masses[] = {mass, NULL};
  struct property_choice turning[PROPERTY_CHOICES] = {TRIAL_CHOICES, {NULL, 0, 0, NULL}};
  turning[TRIAL_DIMENSION].least = 2;
  turning[TRIAL_CELLS].least = 4;
  turning[TRIAL_SPACE] = (struct property_choice){"method.space", 0, 1, trial_grids};
  turning[TRIAL_MASS] = (struct property_choice){"method.mass", 0, 0, masses};
  turning[TRIAL_QUADRATURE] = (struct property_choice){"method.quadrature", 0, 0, particles};
  turning[TRIAL_TRANSFER] = (struct property_choice){"method.transfer", 0, 0, transfers};
  turning[TRIAL_DAMPING].most = 0;
  turning[TRIAL_PROJECTION] = (struct property_choice){"method.projection", 0, 0, each_step};
  turning[TRIAL_STRESS] = (struct property_choice){"method.stress", 0, 0, F};
  turning[TRIAL_ENDS].least = turning[TRIAL_ENDS].most = 1; /* free */
  turning[TRIAL_STATE].least = 1;
  property_check(&(const struct property){title, turning, 60, 15, check_angular});
}

static void angular_momentum_of_apic(void **state)
{
  (void)state;
  check_turning("angular momentum of APIC", "apic", "lumped");
}

static void angular_momentum_of_flip(void **state)
{
  (void)state;
  check_turning("angular momentum of FLIP", "flip", "consistent");
}

/* No stress arises where all particles move alike: v and F stay, and u = v t. Bound: what roundings do from there. */
static enum property_verdict check_uniform(const struct property *property, const int *value, struct property_finding *finding)
{
  struct trial trial;
  enum gx_status status = trial_run(&trial, property->choice, value, NULL);
  if (status == GX_OK) {
    const struct gx_particles *particles = trial.rig.simulation.particles;
    const double t = value[TRIAL_STEPS] * trial.rig.simulation.dt, cells = trial.rig.simulation.space_options.cells[0];
    const double bound = trial_sensitivity(&trial, property->choice, value);
    for (size_t p = 0; p < particles->n; p++)
      for (int d = 0; d < particles->dim; d++) {
        const double v = 0.6 / (d + 1);
        property_compare(finding, fabs(particles->v[d][p] - v) / 0.2, bound, "velocity");
        property_compare(finding, fabs(particles->u[d][p] - v * t) * cells, bound, "displacement");
        for (int e = 0; e < particles->dim; e++)
          property_compare(finding, fabs(particles->F[d * particles->dim + e][p] - (d == e)), bound, "F");
      }
    if (isnan(bound)) status = GX_UNSTABLE;
  }
  enum property_verdict verdict = trial_judge(&trial, status, finding);
  trial_free(&trial);
  return verdict;
}

static void uniform_motion(void **state)
{
  (void)state;
  struct property_choice uniform[PROPERTY_CHOICES] = {TRIAL_CHOICES, {NULL, 0, 0, NULL}};
  uniform[TRIAL_ENDS].most = 0;  /* periodic */
  uniform[TRIAL_STATE].most = 0; /* moving */
  property_check(&(const struct property){"uniform motion", uniform, 60, 30, check_uniform});
}

int main(void)
{
  gx_status_quiet_gsl();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mass),
      cmocka_unit_test(linear_momentum),
      cmocka_unit_test(angular_momentum_of_apic),
      cmocka_unit_test(angular_momentum_of_flip),
      cmocka_unit_test(uniform_motion),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
