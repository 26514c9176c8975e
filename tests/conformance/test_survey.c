/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples of a space that is surveyed against samples of the same states by a measure that has not been told that it can be:
 * every basis of the moving mesh and the degrees that it has, periodic and fixed, both layouts, lumped and consistent mass, both
 * materials, staggered clocks, others and those of first order; bars shorter than a vector and longer than a stretch. */
#include <limits.h>

#include <gsl/gsl_errno.h>

#include <gridcross/measure.h>

#include "rig.h"

/* Both ways to look at a run. */
struct pair {
  struct rig rig;
  struct gx_measure *survey, *settled;
  struct gx_stepper *stepper;
};

static void random_velocity(struct gx_particles *particles, void *context)
{
  for (size_t p = 0; p < particles->n; p++) particles->v[0][p] += check_random(context, -5, 5);
}

static void add_work(void *context, struct gx_space *space, double weight)
{
  const struct pair *pair = context;
  struct gx_measure *const measures[] = {pair->survey, pair->settled};
  for (int i = 0; i < 2; i++) {
    const struct gx_work_observer work = gx_measure_work(measures[i]);
    work.power(work.context, space, weight);
  }
}

static void begin(struct pair *pair, const struct gx_case *one, enum gx_measure_level level)
{
  uint64_t seed = 7;
  *pair = (struct pair){.survey = NULL};
  assert_true(rig_build(&pair->rig, one, NULL, random_velocity, &seed));
  const struct gx_simulation *simulation = &pair->rig.simulation;
  assert_true(simulation->space->surveyed > 0);
  pair->survey = gx_measure_create(simulation->space, simulation->clock, NULL, level);
  simulation->space->surveyed = 0;
  pair->settled = gx_measure_create(simulation->space, simulation->clock, NULL, level);
  struct gx_work_observer both = {pair, level == GX_MEASURE_ALL ? add_work : NULL};
  pair->stepper = gx_stepper_create(simulation->clock, simulation->space, &both);
}

static void end(struct pair *pair)
{
  gx_measure_free(pair->survey);
  gx_measure_free(pair->settled);
  gx_stepper_free(pair->stepper);
  rig_free(&pair->rig);
}

/* Equal up to round-off, or neither is a number. */
static void check_equal(double here, double there, double size, const char *name, const char *what)
{
  CHECK(isnan(here) ? isnan(there) : fabs(here - there) <= 1e-11 * size, "%s: %s is %.17g, not %.17g", what, name, here, there);
}

static void check_samples(const struct pair *pair, const char *what)
{
  const struct gx_measured *here = gx_measure_result(pair->survey), *there = gx_measure_result(pair->settled);
  const double energy = there->last.kinetic + there->last.elastic;
  for (int q = 0; q < GX_QUANTITIES; q++)
    for (int k = 0; k < GX_NORMS; k++) {
      check_equal(here->last.error[q][k], there->last.error[q][k], there->last.error[q][k], gx_measure_quantity[q].name, what);
      check_equal(here->max_error[q][k], there->max_error[q][k], there->max_error[q][k], gx_measure_quantity[q].name, what);
    }
  check_equal(here->last.kinetic, there->last.kinetic, energy, "kinetic", what);
  check_equal(here->last.elastic, there->last.elastic, energy, "elastic", what);
  check_equal(here->last.work, there->last.work, energy, "work", what);
  check_equal(here->last.defect, there->last.defect, energy, "defect", what);
  check_equal(here->last.momentum[0], there->last.momentum[0], sqrt(2 * energy), "momentum", what);
  check_equal(here->momentum_change, there->momentum_change, 1, "momentum change", what);
  check_equal(here->drift, there->drift, 1, "drift", what);
}

/* Takes the settled sample too: until somebody wants them, the particles are where they were. */
static void check_particles(struct pair *pair, double t, const char *what)
{
  const struct gx_simulation *simulation = &pair->rig.simulation;
  const size_t n = simulation->particles->n;
  double *before = malloc(5 * n * sizeof *before), *error[] = {before + n, before + 2 * n, before + 3 * n},
         *other = before + 4 * n;
  memcpy(before, simulation->particles->u[0], n * sizeof *before);
  for (int q = 0; q < GX_QUANTITIES; q++) gx_measure_error(pair->survey, (enum gx_quantity)q, 0, error[q]);
  double change = 0;
  for (size_t p = 0; p < n; p++) change = fmax(change, fabs(simulation->particles->u[0][p] - before[p]));
  CHECK(change > 0, "%s: particles have been settled", what);
  assert_int_equal(gx_measure_take(pair->settled, pair->stepper, t, simulation->dt), GX_OK);
  for (int q = 0; q < GX_QUANTITIES; q++) {
    gx_measure_error(pair->settled, (enum gx_quantity)q, 0, other);
    for (size_t p = 0; p < n; p++) check_equal(error[q][p], other[p], 0, gx_measure_quantity[q].name, what);
  }
  free(before);
}

static void check_run(const struct gx_case *one, enum gx_measure_level level, const char *what)
{
  struct pair pair;
  begin(&pair, one, level);
  const struct gx_simulation *simulation = &pair.rig.simulation;
  for (int step = 0; step <= 6; step++) {
    const double t = step * simulation->dt;
    if (step) assert_int_equal(gx_stepper_step(pair.stepper, t - simulation->dt, simulation->dt), GX_OK);
    assert_int_equal(gx_measure_take(pair.survey, pair.stepper, t, simulation->dt), GX_OK);
    if (step == 5)
      check_particles(&pair, t, what);
    else
      assert_int_equal(gx_measure_take(pair.settled, pair.stepper, t, simulation->dt), GX_OK);
    check_samples(&pair, what);
  }
  end(&pair);
}

static const char *text_of(char *text, const char *path, int value)
{
  snprintf(text, 40, "%s=%d", path, value);
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
      case_of("method.space=moving-mesh", name, boundary, layout, mass, text_of(size[0], "mesh.cells", cells),
              text_of(size[1], "mesh.particles_per_cell", per_cell), "time.cfl=0.2", "time.landing=past",
              basis->has_degree ? text_of(size[2], "method.degree", degree) : "time.periods=1");
  check_run(&one, GX_MEASURE_ALL, what);
}

static void surveys_are_samples_of_settled_particles(void **state)
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
        check_basis(gx_basis_family[i], degree, boundary, layout, mass, 16, 8);
        check_basis(gx_basis_family[i], degree, boundary, layout, mass, 525, 2);
      }
}

static void surveys_of_other_runs(void **state)
{
  (void)state;
  static const enum gx_measure_level levels[] = {GX_MEASURE_MAX, GX_MEASURE_ALL};
  static const char *const problems[] = {"problem.name=bar-linear", "problem.name=bar-neo-hookean", "problem.poisson=0.3"};
  for (size_t c = 0; gx_clock_family[c]; c++)
    for (size_t p = 0; p < 3; p++)
      for (size_t l = 0; l < 2; l++) {
        char clock[60], what[120];
        snprintf(clock, sizeof clock, "method.clock=%s", gx_clock_family[c]->name);
        snprintf(what, sizeof what, "%s, %s, level %zu", clock, problems[p], l);
        const struct gx_case one = case_of("problem.name=axis-aligned", problems[p], "method.space=moving-mesh", clock,
                                           "mesh.cells=13", "time.cfl=0.2", "mesh.particles_per_cell=5", "time.landing=past");
        check_run(&one, levels[l], what);
      }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(surveys_are_samples_of_settled_particles),
      cmocka_unit_test(surveys_of_other_runs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
