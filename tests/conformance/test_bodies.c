/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that do not fill the domain: which points of the lattice they take, in which order and with which volumes; what is refused
 * of them; problems that have no exact solution, by one that a test makes of another. */
#include "case_of.h"
#include "rig.h"

/* The points of the whole lattice that `inside` accepts, in the lattice's order, with its volumes. */
static void check_fill(const char *shape, int dim, bool (*inside)(int dim, const double *X))
{
  struct gx_case one = case_draft("problem.name=free-flight", "mesh.cells=8", "mesh.particles_per_cell=3", "mesh.layout=gauss",
                                  "body.radius=0.3", "body.inner_radius=0.15");
  const char *const centre[] = {"0.4", "0.4 0.5", "0.4 0.5 0.6"}, *const size[] = {"0.5", "0.5 0.3", "0.5 0.3 0.7"};
  case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
  case_set(&one, GX_BODY_SHAPE, shape);
  case_set(&one, GX_BODY_CENTRE, centre[dim - 1]);
  case_set(&one, GX_BODY_SIZE, size[dim - 1]);
  gx_parameter_resolve(one.value);
  struct rig rig;
  assert_true(rig_build(&rig, &one, NULL, NULL, NULL));
  const struct gx_particles *body = rig.simulation.particles;
  struct gx_particles *box = gx_particles_create(dim, (int[]){8, 8, 8}, 3, GX_LAYOUT_GAUSS, 1);
  size_t p = 0;
  for (size_t q = 0; q < box->n; q++) {
    double X[GX_MAX_DIM];
    for (int d = 0; d < dim; d++) X[d] = box->X[d][q];
    if (!inside(dim, X)) continue;
    CHECK(p < body->n, "%s in %d-D has %zu particles", shape, dim, body->n);
    for (int d = 0; d < dim; d++) {
      NEAR(body->X[d][p], X[d], 0);
      NEAR(body->half_length[d][p], box->half_length[d][q], 0);
    }
    NEAR(body->V0[p], box->V0[q], 0);
    NEAR(body->m[p], box->m[q], 0);
    p++;
  }
  CHECK(p == body->n && p > 0 && p < box->n, "%s in %d-D has %zu particles, not %zu", shape, dim, body->n, p);
  gx_particles_free(box);
  rig_free(&rig);
}

static double from_centre(int dim, const double *X)
{
  double square = 0;
  for (int d = 0; d < dim; d++) square += (X[d] - 0.4 - 0.1 * d) * (X[d] - 0.4 - 0.1 * d);
  return sqrt(square);
}

static bool in_box(int dim, const double *X)
{
  const double half[] = {0.25, 0.15, 0.35};
  for (int d = 0; d < dim; d++)
    if (fabs(X[d] - 0.4 - 0.1 * d) > half[d]) return false;
  return true;
}

static bool in_disk(int dim, const double *X)
{
  return from_centre(dim, X) <= 0.3;
}

static bool in_ring(int dim, const double *X)
{
  return in_disk(dim, X) && from_centre(dim, X) >= 0.15;
}

static void a_body_is_the_lattice_inside_it(void **state)
{
  (void)state;
  for (int dim = 1; dim <= GX_MAX_DIM; dim++) {
    check_fill("box", dim, in_box);
    check_fill("disk", dim, in_disk);
    check_fill("ring", dim, in_ring);
  }
}

static void refused(const struct gx_case *one, const char *part)
{
  struct gx_result result = gx_case_run(one);
  gx_case_free(&result);
  CHECK(result.outcome.status == GX_REFUSED && strstr(result.outcome.reason, part), "%s: %s, not: %s",
        gx_status_name(result.outcome.status), result.outcome.reason, part);
}

static void what_makes_no_sense_of_a_body_is_refused(void **state)
{
  (void)state;
#define FLIGHT "problem.name=free-flight", "problem.dimension=2", "mesh.cells=8", "mesh.particles_per_cell=2"
  struct gx_case one = case_of(FLIGHT, "body.size=0.01 0.01");
  refused(&one, "no particle is inside the body");
  one = case_of(FLIGHT, "body.centre=0.2 0.5");
  refused(&one, "reaches from -0.05 to 0.45 along x");
  one = case_of(FLIGHT, "body.centre=0.5 0.9", "body.shape=disk");
  refused(&one, "along y, out of the domain");
  one = case_of(FLIGHT, "body.shape=ring", "body.inner_radius=0.25");
  refused(&one, "is empty");
  one = case_of(FLIGHT, "output.spectra=1");
  refused(&one, "free-flight does not fill it");
  one = case_of(FLIGHT, "output.budget=1");
  refused(&one, "output.budget is of errors over the whole domain");
  one = case_of(FLIGHT, "output.frequency=1");
  refused(&one, "free-flight is none");
  one = case_of("problem.name=spinning-block", "body.file=list.csv");
  refused(&one, "in place of a list of points");
  one = case_of("problem.name=free-flight", "method.space=spline-particle");
  refused(&one, "spline-particle is for bodies from end to end");
}

/* The deformed bar as a problem of which no more is known than its start. */
static void start_deformed(const struct gx_posed *posed, double *const *u, double *const *v, double *const *F)
{
  gx_problem_find("bar-neo-hookean")->exact(posed, 0, u, NULL, F, NULL);
  for (size_t p = 0; p < posed->n; p++) v[0][p] = 0.1 + posed->X[0][p];
}

static void pull(const struct gx_posed *posed, double t, double *const *b)
{
  for (size_t p = 0; p < posed->n; p++) b[0][p] = -3 - t;
}

static struct gx_problem unknown(void)
{
  struct gx_problem problem = *gx_problem_find("bar-neo-hookean");
  problem.exact = NULL;
  problem.initial = start_deformed;
  problem.body = pull;
  return problem;
}

static struct gx_case unknown_case(const char *space, const char *clock)
{
  struct gx_case one = case_draft("mesh.cells=8", "method.degree=3", "problem.density=2");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_METHOD_CLOCK, clock);
  gx_parameter_resolve(one.value);
  return one;
}

/* Particle velocities after the set-up, and their acceleration there. */
static void set_up(const struct gx_problem *problem, const char *space, const char *clock, double *v, double *a, double *dt)
{
  struct gx_case one = unknown_case(space, clock);
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  assert_int_equal(gx_simulation_plan(&simulation, &one, &outcome), GX_OK);
  simulation.problem = problem;
  assert_int_equal(gx_simulation_build(&simulation, &outcome), GX_OK);
  const struct gx_space_kind *kind = simulation.kind;
  assert_int_equal(kind->accelerate(simulation.space, 0), GX_OK);
  if (kind->settle) kind->settle(simulation.space);
  kind->particle_acceleration(simulation.space, (double *[]){a});
  memcpy(v, simulation.particles->v[0], simulation.particles->n * sizeof *v);
  *dt = simulation.dt;
  gx_simulation_free(&simulation);
}

static void staggered_clocks_start_half_a_kick_back(void **state)
{
  (void)state;
  enum { N = 32 };
  const struct gx_problem problem = unknown();
  for (int s = 0; gx_space_family[s]; s++) {
    const char *space = gx_space_family[s]->name;
    double plain[N], staggered[N], a[N], dt;
    if (gx_space_family[s]->of_problem) continue;
    set_up(&problem, space, "central-difference", staggered, a, &dt);
    set_up(&problem, space, "euler-stress-last", plain, a, &dt);
    double moved = 0;
    for (int p = 0; p < N; p++) {
      NEAR(staggered[p], plain[p] - 0.5 * dt * a[p], 1e-14);
      moved = fmax(moved, fabs(staggered[p] - plain[p]));
    }
    assert_true(moved > 0.01);
  }
}

/* sum m v^2/2, sum V0 W(F), and the largest pull over the length of the bar or, where there are no ends, its free fall. */
static void energy_that_there_is_bounds_the_kinetic_one(void **state)
{
  (void)state;
  for (int fixed = 0; fixed < 2; fixed++) {
    const struct gx_problem problem = unknown();
    struct gx_case one = unknown_case("standard", "euler-stress-last");
    case_set(&one, GX_PROBLEM_BOUNDARY, fixed ? "fixed" : "periodic");
    struct gx_simulation simulation;
    struct gx_outcome outcome;
    assert_int_equal(gx_simulation_plan(&simulation, &one, &outcome), GX_OK);
    simulation.problem = &problem;
    assert_int_equal(gx_simulation_build(&simulation, &outcome), GX_OK);
    double energy = 0, end = simulation.end, force = 3 + end;
    for (int p = 0; p < 32; p++) {
      double X = (p + 0.5) / 32, F = 1 + 0.1 * M_PI * cos(2 * M_PI * X), v = 0.1 + X;
      energy += v * v / 32 + 0.5e4 * ((F * F - 1) / 2 - log(F)) / 32;
    }
    energy += fixed ? 2 * force : force * force * end * end;
    CLOSE(gx_simulation_kinetic_bound(&simulation), energy, 1e-12);
    gx_simulation_free(&simulation);
  }
}

static void without_exact_solution_errors_are_unknown(void **state)
{
  (void)state;
  const struct gx_problem problem = unknown();
  struct gx_case one = unknown_case("standard", "central-difference");
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  assert_int_equal(gx_simulation_plan(&simulation, &one, &outcome), GX_OK);
  simulation.problem = &problem;
  assert_int_equal(gx_simulation_build(&simulation, &outcome), GX_OK);
  struct gx_measure *measure = gx_measure_create(simulation.space, simulation.clock, (int[]){8}, GX_MEASURE_ALL);
  struct gx_work_observer observer = gx_measure_work(measure);
  struct gx_stepper *stepper = gx_stepper_create(simulation.clock, simulation.space, &observer);
  gx_measure_follow(measure, 3, (double[]){0.4, 0.4, 0.4});
  for (int i = 0; i < 3; i++) {
    double t = i * simulation.dt;
    assert_int_equal(gx_measure_take(measure, stepper, t, simulation.dt), GX_OK);
    assert_int_equal(gx_stepper_step(stepper, t, simulation.dt), GX_OK);
  }
  const struct gx_measured *measured = gx_measure_result(measure);
  for (int q = 0; q < GX_QUANTITIES; q++)
    for (int k = 0; k < GX_NORMS; k++) {
      assert_true(isnan(measured->last.error[q][k]));
      assert_true(isnan(measured->max_error[q][k]));
    }
  assert_true(isnan(gx_measure_probe(measure)->u_error[0]) && isnan(gx_measure_probe(measure)->v_error[0]));
  assert_true(isfinite(gx_measure_probe(measure)->u[0]));
  double difference[GX_QUANTITIES][GX_NORMS]; /* with itself: all that a reference run asks for is there */
  gx_measure_difference(measure, measure, difference);
  for (int q = 0; q < GX_QUANTITIES; q++) NEAR(difference[q][GX_INF], 0, 0);
  assert_true(isfinite(measured->drift) && measured->last.work != 0);
  gx_stepper_free(stepper);
  gx_measure_free(measure);
  gx_simulation_free(&simulation);
}

/* The energy of a beam at rest is 0, or round-off where the velocity of a clock lives at half steps; it is no measure of drift. */
static void nothing_drifts_from_rest(void **state)
{
  (void)state;
  const char *const spaces[] = {"standard", "moving-mesh"}, *const clocks[] = {"central-difference", "rk4"};
  for (int k = 0; k < 4; k++) {
    struct gx_case one = case_draft("problem.name=cantilever", "time.steps=20");
    case_set(&one, GX_METHOD_SPACE, spaces[k % 2]);
    case_set(&one, GX_METHOD_CLOCK, clocks[k / 2]);
    gx_parameter_resolve(one.value);
    struct gx_result result = case_result(&one);
    CHECK(isnan(result.measured.drift), "%s %s: %g", spaces[k % 2], clocks[k / 2], result.measured.drift);
    assert_true(result.measured.last.kinetic > 0 && result.measured.max_defect > 0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_body_is_the_lattice_inside_it),
      cmocka_unit_test(staggered_clocks_start_half_a_kick_back),
      cmocka_unit_test(energy_that_there_is_bounds_the_kinetic_one),
      cmocka_unit_test(without_exact_solution_errors_are_unknown),
      cmocka_unit_test(what_makes_no_sense_of_a_body_is_refused),
      cmocka_unit_test(nothing_drifts_from_rest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
