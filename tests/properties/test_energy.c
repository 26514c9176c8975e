/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energy under symplectic clocks below their limit. On the moving mesh that projects once, with sums over particles and stress that is
 * linear in F, nodes are oscillators coupled by constant matrices, and every vibration of frequency omega takes the same step
 * T(theta), theta = omega dt, in (omega u, v). det T = 1 and |trace T| < 2, so that T keeps the quadratic form
 * -T10 x^2 + (T00 - T11) x v + T01 v^2: its ellipses. Energy x^2 + v^2 then stays, for all time, within the ratio of the axes of the
 * longest of them squared, which is the bound here. The same holds in strong form through the particles of a periodic box at equal
 * distances, where derivatives commute and are antisymmetric.
 * Nothing of that is promised where velocity is projected each step, which damps; on a fixed grid, where weights change with the
 * particles' cells; with fields reconstructed for their integrals, whose forces have no potential; or by rk4, trgimp and rates of stress
 * that lead by a step. */
#include "trial.h"

#include "study/stability.h"

enum { STEPS = 100, SAMPLES = 4000, FRACTION = TRIAL_SEED + 1 };
static const double overestimate = 1.05; /* of the frequency, which power iteration approaches from below */

static const struct gx_material *linear(void);

/* P = E (F - I), by component. */
static long piola(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *const *P)
{
  for (int k = 0; k < dim * dim; k++)
    for (size_t p = 0; p < n; p++) P[k][p] = moduli->young * (F[k][p] - (k / dim == k % dim));
  return -1;
}

static void energy(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *W)
{
  for (size_t p = 0; p < n; p++) {
    W[p] = 0;
    for (int k = 0; k < dim * dim; k++) W[p] += 0.5 * moduli->young * pow(F[k][p] - (k / dim == k % dim), 2);
  }
}

static double wave_speed(const struct gx_moduli *moduli)
{
  return sqrt(moduli->young / moduli->density);
}

static const struct gx_material *linear(void)
{
  static const struct gx_material material = {.name = "linear", .piola = piola, .energy = energy, .wave_speed = wave_speed};
  return &material;
}

/* A step of the oscillator from (x, v), x in lengths of v / omega. */
static void oscillate(const struct gx_clock *clock, double theta, double *x, double *v)
{
  double a = 0;
  const struct gx_splitting *splitting = clock->splitting;
  for (int j = 0; splitting && j < splitting->stages; j++) {
    *x += splitting->drift[j] * theta * *v;
    *v -= splitting->kick[j] * theta * *x;
  }
  if (splitting) *x += splitting->drift[splitting->stages] * theta * *v;
  for (const struct gx_row *row = clock->plain_rows ? clock->plain_rows : clock->rows; row && row->primitive != GX_END; row++) {
    if (row->primitive == GX_ACCELERATE) a = -theta * *x;
    if (row->primitive == GX_KICK) *v += row->coefficient * a;
    if (row->primitive == GX_DRIFT) *x += row->coefficient * theta * *v;
  }
}

/* Largest ratio of the form's eigenvalues up to theta; infinite where the step is not stable. */
static double ellipse(const struct gx_clock *clock, double most)
{
  double ratio = 1;
  for (int i = 1; i <= SAMPLES; i++) {
    const double theta = most * i / SAMPLES;
    double x[] = {1, 0}, v[] = {0, 1};
    oscillate(clock, theta, &x[0], &v[0]);
    oscillate(clock, theta, &x[1], &v[1]);
    const double p = -v[0], q = 0.5 * (x[0] - v[1]), r = x[1]; /* x and v of the images of the two unit vectors */
    const double mean = 0.5 * (p + r), radius = hypot(0.5 * (p - r), q);
    ratio = fmax(ratio, fabs(mean) > radius ? (fabs(mean) + radius) / (fabs(mean) - radius) : INFINITY);
  }
  return ratio;
}

static double energy_of(struct trial *trial, double *W)
{
  const struct gx_simulation *simulation = &trial->rig.simulation;
  const struct gx_particles *particles = simulation->particles;
  double sum = 0;
  gx_stepper_accelerate(trial->rig.stepper, 0);
  trial_settle(trial);
  linear()->energy(&simulation->problem_options.moduli, particles->dim, particles->n, particles->F, W);
  for (size_t p = 0; p < particles->n; p++) sum += particles->V0[p] * W[p];
  if (case_on_grid(simulation->kind) && !simulation->space_options.consistent)
    return sum + simulation->kind->kinetic(simulation->space);
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) sum += 0.5 * particles->m[p] * particles->v[d][p] * particles->v[d][p];
  return sum;
}

static bool is_promised(const struct trial *trial, const int *value)
{
  const struct gx_simulation *simulation = &trial->rig.simulation;
  if (!simulation->clock->symplectic) return false;
  if (simulation->kind->collocation)
    return !simulation->kind->nodal && simulation->space_options.periodic && value[TRIAL_LAYOUT] == 0;
  return true;
}

static enum property_verdict check(const struct property *property, const int *value, struct property_finding *finding)
{
  struct trial trial;
  enum gx_status status = trial_build(&trial, property->choice, value, &(struct trial_view){.material = linear()});
  if (status == GX_OK && !is_promised(&trial, value)) status = GX_REFUSED;
  const double omega = status == GX_OK ? overestimate * gx_stability_frequency(trial.rig.simulation.space) : NAN;
  const double wave = status == GX_OK ? linear()->wave_speed(&trial.rig.simulation.problem_options.moduli) : NAN;
  if (status == GX_OK && !(omega > 1e-6 * wave)) status = GX_REFUSED; /* nothing vibrates, but for round-off on a cell or two */
  double *W = status == GX_OK ? malloc(trial.rig.simulation.particles->n * sizeof *W) : NULL;
  const double start = status == GX_OK ? energy_of(&trial, W) : NAN;
  if (status == GX_OK && !(start > 1e-20)) status = GX_REFUSED; /* J; the wave has its zeros at the nodes */
  if (status == GX_OK) {
    const struct gx_clock *clock = trial.rig.simulation.clock;
    const double theta = clock->stability * value[FRACTION] / 20, within = ellipse(clock, theta) * (1 + 1e-9);
    trial.rig.simulation.dt = theta / omega;
    for (int k = 0; k < STEPS && status == GX_OK; k++) {
      status = trial_step(&trial);
      const double now = energy_of(&trial, W);
      property_compare(finding, now / start, within, "energy grew");
      property_compare(finding, start / now, within, "energy was lost");
    }
  }
  free(W);
  enum property_verdict verdict = trial_judge(&trial, status, finding);
  trial_free(&trial);
  return verdict;
}

/* Symplectic clocks on the grid back end whose nodes keep their velocity, and where the strong form has an energy. */
static void choose(struct property_choice *swinging)
{
  static const struct property_choice all[] = {TRIAL_CHOICES, {"fraction", 1, 19, NULL}, {NULL, 0, 0, NULL}};
  static const char *const particles[] = {"particles", NULL}, *const once[] = {"once", NULL}, *const F[] = {"F", NULL},
                           *const flip[] = {"flip", NULL};
  static const char *const spaces[] = {"moving-mesh", "moving-mesh", "moving-mesh", "spline-particle", NULL};
  memcpy(swinging, all, sizeof all);
  swinging[TRIAL_SPACE] = (struct property_choice){"method.space", 0, 3, spaces};
  swinging[TRIAL_QUADRATURE] = (struct property_choice){"method.quadrature", 0, 0, particles};
  swinging[TRIAL_PROJECTION] = (struct property_choice){"method.projection", 0, 0, once};
  swinging[TRIAL_STRESS] = (struct property_choice){"method.stress", 0, 0, F};
  swinging[TRIAL_TRANSFER] = (struct property_choice){"method.transfer", 0, 0, flip};
  swinging[TRIAL_DAMPING].most = swinging[TRIAL_POISSON].most = 0;
  swinging[TRIAL_STEPS].most = 1;
  swinging[TRIAL_STATE].least = 1;
}

static void bounded(void **state)
{
  (void)state;
  struct property_choice swinging[PROPERTY_CHOICES];
  choose(swinging);
  property_check(&(const struct property){"energy", swinging, 20, 20, check});
}

/* Of leapfrog v^2 + x^2 - theta x v is kept, of the Verlet method v^2 + (1 - theta^2/4) x^2. */
static void ellipses_by_hand(void **state)
{
  (void)state;
  CLOSE(ellipse(gx_clock_find("central-difference"), 1), 3.0, 1e-9);
  CLOSE(ellipse(gx_clock_find("stormer-verlet"), 1), 4.0 / 3, 1e-9);
  assert_true(isinf(ellipse(gx_clock_find("central-difference"), 2.001)));
  for (int k = 0; gx_clock_family[k]; k++) {
    const struct gx_clock *clock = gx_clock_family[k];
    if (clock->symplectic) assert_true(isfinite(ellipse(clock, 0.95 * clock->stability)));
    if (clock->symplectic) CHECK(isinf(ellipse(clock, 1.01 * clock->stability)), "%s", clock->name);
  }
}

/* Functions that particles hardly reach have next to no mass, and with the full matrix their velocities are mostly round-off: the
 * largest frequency is to be found all the same. */
static void bounded_at_edges(void **state)
{
  (void)state;
  static const char *const moving[] = {"moving-mesh", NULL}, *const gimp[] = {"ugimp", NULL},
                           *const consistent[] = {"consistent", NULL};
  struct property_choice swinging[PROPERTY_CHOICES];
  choose(swinging);
  swinging[TRIAL_SPACE] = (struct property_choice){"method.space", 0, 0, moving};
  swinging[TRIAL_BASIS] = (struct property_choice){"method.basis", 0, 0, gimp};
  swinging[TRIAL_MASS] = (struct property_choice){"method.mass", 0, 0, consistent};
  swinging[TRIAL_LAYOUT].most = 1;
  swinging[TRIAL_ENDS].least = swinging[TRIAL_ENDS].most = 1; /* free */
  property_check(&(const struct property){"energy at edges", swinging, 8, 20, check});
}

int main(void)
{
  gx_status_quiet_gsl();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ellipses_by_hand),
      cmocka_unit_test(bounded),
      cmocka_unit_test(bounded_at_edges),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
