/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What options mean, on every clock: velocities that move particles, integrated stress, projection once or each step, the ends
 * of the domain, histories and their maxima, the time after many steps, reference runs. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "rig.h"

/* The bar starts straight; a velocity that the grid cannot hold tells particles from nodes. */
static void add_rough_velocity(struct gx_particles *particles, void *context)
{
  (void)context;
  for (size_t p = 0; p < particles->n; p++) particles->v[0][p] += p % 2 ? 0.01 : -0.01;
}

static struct gx_case bar(const char *space, const char *clock)
{
  struct gx_case one = case_draft("problem.name=bar-linear", "problem.modulus=4", "problem.amplitude=0.02", "mesh.cells=12",
                                  "mesh.particles_per_cell=3", "time.cfl=0.2", "time.periods=0.25");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_METHOD_CLOCK, clock);
  return one;
}

/* One stress-last Euler step: x moves by dt times the new velocity of the particle, or of the nodes. */
static void particles_move_by_the_velocity_asked_for(void **state)
{
  (void)state;
  static const char *const spaces[] = {"standard", "moving-mesh"};
  for (int s = 0; s < 2; s++)
    for (int own = 0; own < 2; own++) {
      struct gx_case one = bar(spaces[s], "euler-stress-last");
      struct rig rig;
      case_set(&one, GX_METHOD_PROJECTION, "each-step");
      case_set(&one, GX_METHOD_POSITION, own ? "particle" : "nodal");
      gx_parameter_resolve(one.value);
      rig_build(&rig, &one, NULL, add_rough_velocity, NULL);
      const struct gx_particles *particles = rig.simulation.particles;
      struct gx_state view;
      double *rate[GX_MAX_STATE], slip = 0, rate_slip = 0;
      assert_int_equal(gx_stepper_accelerate(rig.stepper, 0), GX_OK);
      rig.simulation.kind->state(rig.simulation.space, &view);
      for (int i = 0; i < view.count; i++) rate[i] = calloc(view.length[i], sizeof(double));
      rig.simulation.kind->rates(rig.simulation.space, rate);
      for (int i = 0; i < view.count; i++)
        for (size_t p = 0; view.array[i] == particles->u[0] && p < particles->n; p++)
          rate_slip = fmax(rate_slip, fabs(rate[i][p] - particles->v[0][p]));
      for (int i = 0; i < view.count; i++) free(rate[i]);
      rig_run(&rig, 1);
      for (size_t p = 0; p < particles->n; p++)
        slip = fmax(slip, fabs(particles->u[0][p] / rig.simulation.dt - particles->v[0][p]));
      CHECK(own ? slip < 1e-13 : slip > 5e-3, "%s: the step moves %g beside the particle's velocity", spaces[s], slip);
      CHECK(own ? rate_slip == 0 : rate_slip > 5e-3, "%s: the rate is %g beside the particle's velocity", spaces[s], rate_slip);
      rig_free(&rig);
    }
}

/* P = E (F - 1) is linear, so that integrating its rate adds nothing but round-off, whatever the clock. */
static void integrated_stress_is_that_of_F(void **state)
{
  (void)state;
  for (int k = 0; gx_clock_family[k]; k++) {
    struct gx_case one = bar("standard", gx_clock_family[k]->name);
    struct rig rig;
    case_set(&one, GX_METHOD_STRESS, "rate");
    gx_parameter_resolve(one.value);
    rig_build(&rig, &one, NULL, NULL, NULL);
    rig_run(&rig, -1);
    const struct gx_particles *particles = rig.simulation.particles;
    double worst = 0, strained = 0;
    for (size_t p = 0; p < particles->n; p++) {
      worst = fmax(worst, fabs(particles->P[0][p] - 4 * (particles->F[0][p] - 1)));
      strained = fmax(strained, fabs(particles->F[0][p] - 1));
    }
    CHECK(worst < 1e-13 && strained > 0.05, "%s: stress off by %g at strain %g", gx_clock_family[k]->name, worst, strained);
    rig_free(&rig);
  }
}

/* With consistent mass a velocity that nodes gave to particles is projected back to the same nodes, so that on the moving mesh
 * projection each step and once give the same F and u from a straight start. */
static void projections_agree_with_consistent_mass(void **state)
{
  (void)state;
  for (int k = 0; gx_clock_family[k]; k++) {
    struct rig rig[2];
    for (int each = 0; each < 2; each++) {
      struct gx_case one = bar("moving-mesh", gx_clock_family[k]->name);
      case_set(&one, GX_METHOD_MASS, "consistent");
      case_set(&one, GX_METHOD_PROJECTION, each ? "each-step" : "once");
      gx_parameter_resolve(one.value);
      rig_build(&rig[each], &one, NULL, NULL, NULL);
      rig_run(&rig[each], -1);
      const struct gx_particles *particles = rig[each].simulation.particles;
      double settled[36];
      memcpy(settled, particles->F[0], sizeof settled);
      assert_int_equal(gx_stepper_accelerate(rig[each].stepper, rig[each].steps * rig[each].simulation.dt), GX_OK);
      assert_memory_equal(particles->F[0], settled, sizeof settled); /* settled particles have the F of their nodes */
    }
    const struct gx_particles *a = rig[0].simulation.particles, *b = rig[1].simulation.particles;
    double worst = 0, moved = 0;
    for (size_t p = 0; p < a->n; p++) {
      worst = fmax(worst, fmax(fabs(a->u[0][p] - b->u[0][p]), fabs(a->F[0][p] - b->F[0][p])));
      moved = fmax(moved, fabs(a->u[0][p]));
    }
    CHECK(worst < 1e-12 && moved > 0.01, "%s: they differ by %g, particles moved %g", gx_clock_family[k]->name, worst, moved);
    for (int each = 0; each < 2; each++) rig_free(&rig[each]);
  }
}

/* A fixed grid whose nodes keep their velocity between steps: every clock advances all of the state. */
static void a_fixed_grid_may_project_once(void **state)
{
  (void)state;
  for (int k = 0; gx_clock_family[k]; k++) {
    struct gx_case one = bar("standard", gx_clock_family[k]->name);
    case_set(&one, GX_METHOD_PROJECTION, "once");
    gx_parameter_resolve(one.value);
    struct gx_result result = case_result(&one);
    double error = result.measured.max_error[GX_DISPLACEMENT][GX_INF];
    CHECK(error < 0.3 * 0.02, "%s: error %g of amplitude 0.02", gx_clock_family[k]->name, error);
  }
  struct gx_case pic = bar("standard", "euler-stress-last"); /* nodes have moved on from the weights of what they carry */
  case_set(&pic, GX_METHOD_PROJECTION, "once");
  case_set(&pic, GX_METHOD_TRANSFER, "pic");
  gx_parameter_resolve(pic.value);
  assert_int_equal(gx_case_plan(&pic).outcome.status, GX_REFUSED);
}

static void fast(struct gx_particles *particles, void *context)
{
  (void)context;
  for (size_t p = 0; p < particles->n; p++) particles->v[0][p] = 3e4;
}

/* Round-off beyond a fixed end is inside, more is not; on a periodic grid a thousand domains are no distance. */
static void the_domain_ends_where_it_should(void **state)
{
  (void)state;
  struct gx_case one = bar("standard", "rk4");
  gx_parameter_resolve(one.value);
  struct rig rig;
  rig_build(&rig, &one, NULL, NULL, NULL);
  const struct gx_particles *particles = rig.simulation.particles;
  struct gx_space *space = rig.simulation.space;
  size_t last = particles->n - 1;
  particles->u[0][last] = 1 + 1e-13 - particles->X[0][last];
  assert_int_equal(space->kind->weights(space), GX_OK);
  particles->u[0][last] = 1 + 1e-9 - particles->X[0][last];
  assert_int_equal(space->kind->weights(space), GX_LEFT_DOMAIN);
  assert_int_equal(rig.outcome.particle, last);
  particles->u[0][last] = 0;
  particles->u[0][0] = -1e-9 - particles->X[0][0];
  assert_int_equal(space->kind->weights(space), GX_LEFT_DOMAIN);
  assert_int_equal(rig.outcome.particle, 0);
  rig_free(&rig);
  one = case_of("problem.name=axis-aligned", "problem.amplitude=0", "time.dt=0.01", "time.end=0.04");
  rig_build(&rig, &one, NULL, fast, NULL);
  rig_run(&rig, -1);
  for (size_t p = 0; p < rig.simulation.particles->n; p++) {
    NEAR(rig.simulation.particles->u[0][p], 1200, 1e-8);
    NEAR(rig.simulation.particles->F[0][p], 1, 1e-8);
  }
  rig_free(&rig);
}

/* A clock of either defect formula, and one whose velocity is staggered. */
static void maxima_are_those_of_the_history(void **state)
{
  (void)state;
  static const char *const clocks[] = {"euler-stress-last", "central-difference", "stormer-verlet"};
  for (int k = 0; k < 3; k++) {
    struct gx_case one = case_draft("mesh.cells=16", "output.histories=1", "time.periods=0.9");
    case_set(&one, GX_METHOD_CLOCK, clocks[k]);
    gx_parameter_resolve(one.value);
    struct gx_result result = gx_case_run(&one);
    assert_int_equal(result.outcome.status, GX_OK);
    const struct gx_sample *sample = result.history.sample;
    assert_int_equal(result.history.samples, (size_t)result.steps + 1);
    double most[GX_QUANTITIES][GX_NORMS] = {0}, defect = 0, drift = 0;
    double start = sample[0].kinetic + sample[0].elastic;
    for (size_t i = 1; i < result.history.samples; i++) {
      NEAR(sample[i].time, (double)i * result.dt, 0);
      for (int q = 0; q < GX_QUANTITIES; q++)
        for (int n = 0; n < GX_NORMS; n++) most[q][n] = fmax(most[q][n], sample[i].error[q][n]);
      defect = fmax(defect, sample[i].defect);
      drift = fmax(drift, fabs(sample[i].kinetic + sample[i].elastic - sample[i].work - (start - sample[0].work)) / start);
    }
    assert_memory_equal(most, result.measured.max_error, sizeof most);
    NEAR(result.measured.max_defect, defect, 0);
    CLOSE(result.measured.drift, drift, 1e-9);
    assert_true(defect > sample[result.history.samples - 1].defect);
    gx_case_free(&result);
  }
}

/* Every third sample and the last one. */
static void histories_are_thinned(void **state)
{
  (void)state;
  struct gx_case one = case_of("mesh.cells=8", "output.histories=3", "time.dt=0.001", "time.end=0.008");
  struct gx_result result = gx_case_run(&one);
  const double steps[] = {0, 3, 6, 8};
  assert_int_equal(result.history.samples, 4);
  for (int i = 0; i < 4; i++) NEAR(result.history.sample[i].time, steps[i] * 0.001, 1e-15);
  gx_case_free(&result);
}

/* The time after 10^5 steps of 10^-5: a plain sum drifts by more than round-off, the others do not. */
static void time_is_accumulated_as_asked(void **state)
{
  (void)state;
  static const struct {
    const char *accumulate;
    double least, most;
  } rows[] = {{"product", 0, 0}, {"sum", 1e-13, 1e-10}, {"compensated", 0, 2.3e-16}};
  for (int i = 0; i < 3; i++) {
    struct gx_case one = case_draft("problem.name=oscillator", "time.dt=1e-5", "time.end=1", "output.measures=final");
    case_set(&one, GX_TIME_ACCUMULATE, rows[i].accumulate);
    gx_parameter_resolve(one.value);
    double off = fabs(case_result(&one).time - 1);
    CHECK(off >= rows[i].least && off <= rows[i].most, "%s: off by %g", rows[i].accumulate, off);
  }
}

/* On the oscillator there is no error but the clock's: the difference to a much finer step is that to the exact solution. */
static void a_reference_run_has_a_finer_step(void **state)
{
  (void)state;
  struct gx_case one = case_of("problem.name=oscillator", "problem.modulus=64", "method.clock=rkn4", "time.dt=0.005",
                               "time.end=0.9", "output.reference=16");
  struct gx_result result = case_result(&one);
  for (int q = 0; q < GX_QUANTITIES; q++) CLOSE(result.reference[q][GX_INF], result.measured.last.error[q][GX_INF], 1e-3);
  assert_true(result.reference[GX_DISPLACEMENT][GX_INF] > 1e-9);
}

/* 2.1/0.3 is 7 and a round-off in floating point; 0.75/0.3 is 2.5. */
static void steps_meet_or_pass_the_end(void **state)
{
  (void)state;
  static const struct {
    const char *end, *landing;
    double steps, dt;
  } rows[] = {{"2.1", "exact", 7, 0.3},
              {"2.1", "past", 7, 0.3},
              {"0.75", "exact", 3, 0.25},
              {"0.75", "past", 3, 0.3},
              {"0.03", "exact", 1, 0.03}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    struct gx_case one = case_draft("time.dt=0.3");
    case_set(&one, GX_TIME_END, rows[i].end);
    case_set(&one, GX_TIME_LANDING, rows[i].landing);
    gx_parameter_resolve(one.value);
    struct gx_plan plan = gx_case_plan(&one);
    NEAR(plan.steps, rows[i].steps, 0);
    CLOSE(plan.dt, rows[i].dt, 1e-15);
  }
}

/* The start counts towards the end, not towards periods or steps; a number of steps keeps its step, whatever the landing. */
static void runs_start_where_asked(void **state)
{
  (void)state;
  static const struct {
    const char *until, *landing;
    double steps, dt, end;
  } rows[] = {{"time.end=4.1", "time.landing=exact", 4, 0.275, 4.1},
              {"time.end=4.1", "time.landing=past", 4, 0.3, 4.1},
              {"time.periods=2", "time.landing=exact", 14, 4.0 / 14, 7},
              {"time.steps=5", "time.landing=exact", 5, 0.3, 4.5}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    struct gx_case one = case_of("problem.modulus=1", "time.dt=0.3", "time.start=3", rows[i].until, rows[i].landing);
    struct gx_plan plan = gx_case_plan(&one);
    NEAR(plan.steps, rows[i].steps, 0);
    CLOSE(plan.dt, rows[i].dt, 1e-15);
    CLOSE(plan.end, rows[i].end, 1e-15);
  }
}

/* The state at the start is the exact one, and the clock reads the start's time; later by whole periods it is the same run. */
static void runs_start_from_the_exact_state(void **state)
{
  (void)state;
  static const char *const accumulate[] = {"time.accumulate=product", "time.accumulate=sum", "time.accumulate=compensated"};
  for (int k = 0; k < 3; k++)
    for (int later = 0; later < 2; later++) {
      struct gx_case one = case_of("problem.modulus=1", "mesh.cells=16", "time.dt=0.02", "time.steps=20", "output.histories=20",
                                   "method.clock=rk4", accumulate[k], later ? "time.start=2.3" : "time.start=0.3");
      struct gx_result result = gx_case_run(&one);
      static double error;
      assert_int_equal(result.history.samples, 2);
      NEAR(result.history.sample[0].time, later ? 2.3 : 0.3, 0);
      NEAR(result.history.sample[0].error[GX_DISPLACEMENT][GX_INF], 0, 1e-16);
      NEAR(result.history.sample[0].error[GX_VELOCITY][GX_INF], 0, 1e-16);
      CLOSE(result.time, later ? 2.7 : 0.7, 1e-14);
      if (later) CLOSE(result.measured.last.error[GX_DISPLACEMENT][GX_INF], error, 1e-9);
      error = result.measured.last.error[GX_DISPLACEMENT][GX_INF];
      CHECK(error > 1e-5 && error < 1e-3, "error %g", error);
      gx_case_free(&result);
    }
}

static double stable_step_of_run(const struct gx_case *one)
{
  struct gx_result result = gx_case_run(one);
  gx_case_free(&result);
  return result.stable_dt;
}

/* A step of many particles is not worth the hundreds that the power iteration may take, nor is a run of twenty steps of few the twenty-one
 * that it takes at least. */
static void the_stable_step_costs_no_more_than_the_run(void **state)
{
  (void)state;
  struct gx_case one = case_of("mesh.cells=13000", "time.dt=1e-6", "time.steps=200");
  assert_true(isnan(gx_case_plan(&one).stable_dt));
  one.value[GX_TIME_STEPS].integer = 201;
  assert_true(gx_case_plan(&one).stable_dt > 0);
  one.value[GX_TIME_STEPS].integer = 1;
  one.value[GX_MESH_CELLS].integer = 120; /* too small to matter */
  assert_true(gx_case_plan(&one).stable_dt > 0);
  one.value[GX_TIME_STEPS].integer = 20;
  assert_true(isnan(stable_step_of_run(&one)));
  one.value[GX_TIME_STEPS].integer = 21;
  assert_true(stable_step_of_run(&one) > 0);
  one.value[GX_TIME_STEPS].integer = 1;
  one.value[GX_OUTPUT_BUDGET] = (struct gx_value){.type = GX_INTEGER, .integer = 1}; /* a step with its budget takes longer */
  assert_true(stable_step_of_run(&one) > 0);
}

/* u_d = A sin(2 pi X_d) cos(phi_d) at the start, phases in multiples of pi. */
static void phases_are_multiples_of_pi(void **state)
{
  (void)state;
  const double cosine[] = {1, 0.5, -1};
  struct gx_case one = case_of("problem.name=axis-aligned", "problem.dimension=3", "problem.phases=0 0.333333333333333333 -1",
                               "mesh.cells=3", "mesh.particles_per_cell=2");
  struct rig rig;
  rig_build(&rig, &one, NULL, NULL, NULL);
  const struct gx_particles *particles = rig.simulation.particles;
  for (size_t p = 0; p < particles->n; p++)
    for (int d = 0; d < 3; d++) NEAR(particles->u[d][p], 0.05 * sin(2 * M_PI * particles->X[d][p]) * cosine[d], 1e-15);
  rig_free(&rig);
}

/* A period is 2/c for the waves that start deformed and the oscillator, 1/c for the bar that starts straight; c = 8. */
static void periods_are_those_of_the_problem(void **state)
{
  (void)state;
  static const struct {
    const char *name;
    double period;
  } rows[] = {{"bar-neo-hookean", 0.25}, {"axis-aligned", 0.25}, {"oscillator", 0.25}, {"bar-linear", 0.125}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    struct gx_case one = case_draft("problem.modulus=64", "time.periods=3");
    case_set(&one, GX_PROBLEM_NAME, rows[i].name);
    gx_parameter_resolve(one.value);
    CLOSE(gx_case_plan(&one).end, 3 * rows[i].period, 1e-15);
  }
}

/* Linear elements with lumped mass: omega = (2 c/h) sin(k h/2), at most 2 c/h; each clock's limit over that is the stable step. */
static void the_stable_step_is_that_of_the_highest_frequency(void **state)
{
  (void)state;
  for (int k = 0; gx_clock_family[k]; k++) {
    struct gx_case one = case_draft("problem.name=bar-linear", "problem.modulus=4", "problem.boundary=periodic", "mesh.cells=16",
                                    "problem.amplitude=0.001", "method.basis=linear", "method.space=moving-mesh");
    case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
    gx_parameter_resolve(one.value);
    CLOSE(gx_case_plan(&one).stable_dt, gx_clock_family[k]->stability / (2 * 2 * 16), 0.02);
  }
}

/* Re-projected velocities: the stated bound of linear elements is dt^2 (2c/h)^2 2 = 4, CFL 1/sqrt 2. Runs at the bound stay, runs at
 * 1.25 of it do not. */
static void the_stable_step_knows_of_projection(void **state)
{
  (void)state;
  static const struct {
    const char *space, *basis;
    double least, most; /* CFL numbers, where theory has them */
  } rows[] = {{"standard", "linear", 0.70, 0.72},
              {"moving-mesh", "linear", 0.70, 0.72},
              {"standard", "bspline", 0.5, 3},
              {"moving-mesh", "bspline", 0.5, 3},
              {"standard", "ugimp", 0.5, 3}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    struct gx_case one = case_draft("problem.name=bar-linear", "problem.modulus=1", "problem.boundary=periodic", "mesh.cells=16",
                                    "problem.amplitude=1e-5", "time.periods=40", "method.projection=each-step");
    case_set(&one, GX_METHOD_SPACE, rows[i].space);
    case_set(&one, GX_METHOD_BASIS, rows[i].basis);
    gx_parameter_resolve(one.value);
    double stable = gx_case_plan(&one).stable_dt;
    CHECK(stable * 16 > rows[i].least && stable * 16 < rows[i].most, "%s %s: CFL %g", rows[i].space, rows[i].basis, stable * 16);
    for (int above = 0; above < 2; above++) {
      one.value[GX_TIME_CFL] = (struct gx_value){.type = GX_NULL};
      case_set_real(&one, GX_TIME_DT, (above ? 1.25 : 1) * stable);
      struct gx_result result = gx_case_run(&one);
      CHECK((result.outcome.status == GX_OK) == !above, "%s %s at %g of the stable step: %s", rows[i].space, rows[i].basis,
            above ? 1.25 : 1.0, gx_status_name(result.outcome.status));
    }
  }
}

/* The bound holds for every clock, not for one kick a step alone; where it says that no step is stable, none is. */
static void every_clock_is_stable_at_its_stable_step(void **state)
{
  (void)state;
  static const char *const spaces[] = {"standard", "moving-mesh"}, *const bases[] = {"linear", "bspline"};
  static const char *const projections[] = {"each-step", "once"};
  int none = 0;
  for (int k = 0; gx_clock_family[k]; k++)
    for (int i = 0; i < 8; i++) {
      struct gx_case one = case_draft("problem.name=bar-linear", "problem.modulus=1", "problem.boundary=periodic",
                                      "mesh.cells=16", "problem.amplitude=1e-5", "time.periods=40");
      case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
      case_set(&one, GX_METHOD_SPACE, spaces[i & 1]);
      case_set(&one, GX_METHOD_BASIS, bases[i >> 1 & 1]);
      case_set(&one, GX_METHOD_PROJECTION, projections[i >> 2 & 1]);
      gx_parameter_resolve(one.value);
      double stable = gx_case_plan(&one).stable_dt;
      if (stable == 0) { /* growth slows with the step, but does not end */
        case_set(&one, GX_TIME_CFL, "0.6");
        case_set(&one, GX_TIME_PERIODS, "400");
        CHECK(gx_case_run(&one).outcome.status == GX_UNSTABLE, "%s runs", gx_clock_family[k]->name);
        none++;
        continue;
      }
      one.value[GX_TIME_CFL] = (struct gx_value){.type = GX_NULL};
      case_set_real(&one, GX_TIME_DT, 0.98 * stable); /* the frequency comes from below, to 2 % */
      struct gx_result result = gx_case_run(&one);
      CHECK(result.outcome.status == GX_OK, "%s, %s, %s, %s: %s", gx_clock_family[k]->name, spaces[i & 1], bases[i >> 1 & 1],
            projections[i >> 2 & 1], result.outcome.reason);
    }
  assert_int_equal(none, 8); /* rkn3 and pefrl with their velocities re-projected */
}

/* u = e (X - 2 X^3 + X^4) is a spline of degree 4, and it and its second derivative vanish at the ends; its first does not. With
 * P = E (F - 1), a = 12 E e (X^2 - X) / rho. */
static void bend_to_a_quartic(struct gx_particles *particles, void *context)
{
  (void)context;
  for (size_t p = 0; p < particles->n; p++) {
    const double X = particles->X[0][p];
    particles->u[0][p] = 1e-3 * (X - 2 * X * X * X + X * X * X * X);
    particles->F[0][p] = 1 + 1e-3 * (1 - 6 * X * X + 4 * X * X * X);
    particles->v[0][p] = 0;
  }
}

static void the_papers_closure_takes_the_stress_at_the_ends(void **state)
{
  (void)state;
  for (int i = 0; i < 4; i++) {
    struct gx_case one = case_of("problem.name=bar-linear", "problem.modulus=4", "problem.density=2", "mesh.cells=9",
                                 "mesh.particles_per_cell=2", "time.dt=1e-3", "method.clock=euler-stress-last",
                                 "method.frame=reference", "method.closure=papers", "method.space=spline-particle");
    struct rig rig;
    case_set(&one, GX_METHOD_SPACE, i % 2 ? "spline-grid" : "spline-particle");
    case_set_integer(&one, GX_METHOD_DEGREE, 4 + i / 2);
    rig_build(&rig, &one, NULL, bend_to_a_quartic, NULL);
    rig_run(&rig, 1);
    const struct gx_particles *particles = rig.simulation.particles;
    for (size_t p = 0; p < particles->n; p++) {
      const double X = particles->X[0][p];
      NEAR(particles->v[0][p], rig.simulation.dt * 12 * 4 * 1e-3 * (X * X - X) / 2, 1e-15);
    }
    rig_free(&rig);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(particles_move_by_the_velocity_asked_for),
      cmocka_unit_test(integrated_stress_is_that_of_F),
      cmocka_unit_test(projections_agree_with_consistent_mass),
      cmocka_unit_test(a_fixed_grid_may_project_once),
      cmocka_unit_test(the_domain_ends_where_it_should),
      cmocka_unit_test(the_papers_closure_takes_the_stress_at_the_ends),
      cmocka_unit_test(maxima_are_those_of_the_history),
      cmocka_unit_test(histories_are_thinned),
      cmocka_unit_test(time_is_accumulated_as_asked),
      cmocka_unit_test(a_reference_run_has_a_finer_step),
      cmocka_unit_test(steps_meet_or_pass_the_end),
      cmocka_unit_test(runs_start_where_asked),
      cmocka_unit_test(runs_start_from_the_exact_state),
      cmocka_unit_test(the_stable_step_costs_no_more_than_the_run),
      cmocka_unit_test(phases_are_multiples_of_pi),
      cmocka_unit_test(periods_are_those_of_the_problem),
      cmocka_unit_test(the_stable_step_is_that_of_the_highest_frequency),
      cmocka_unit_test(the_stable_step_knows_of_projection),
      cmocka_unit_test(every_clock_is_stable_at_its_stable_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
