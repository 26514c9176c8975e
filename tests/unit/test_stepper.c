/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine of clocks on a space of three numbers, a driven oscillator: orders, stage times, work weights, reuse. Tableaux are
 * also held against the order conditions of rooted trees. */
#include <gridcross/clock.h>

#include <float.h>
#include <string.h>

#include "check.h"

/* x'' = -(1 - share) x - share s + drive cos 2t, where s' = x': position and stress of one spring, so that G and X are told apart. */
struct oscillator {
  struct gx_space space;
  double x, s, v, a, opened, drive, share;
  int weighed, projected, accelerated;
  double when[64]; /* of each acceleration */
};

static struct oscillator *of(struct gx_space *space)
{
  return (struct oscillator *)space;
}

static enum gx_status weights(struct gx_space *space)
{
  of(space)->weighed++;
  return GX_OK;
}

static enum gx_status project(struct gx_space *space)
{
  of(space)->projected++;
  return GX_OK;
}

static enum gx_status accelerate(struct gx_space *space, double t)
{
  struct oscillator *one = of(space);
  if (!(fabs(one->x) < 1e3)) return gx_status_set(space->outcome, GX_UNSTABLE, 0, "too far");
  one->when[one->accelerated++ % 64] = t;
  one->a = one->drive * cos(2 * t) - (1 - one->share) * one->x - one->share * one->s;
  return GX_OK;
}

static void advance(struct gx_space *space, double kick, double strain, double drift)
{
  struct oscillator *one = of(space);
  one->v += kick * one->a;
  one->s += strain * one->v;
  one->x += drift * one->v;
}

static enum gx_status twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct oscillator *one = of(space);
  if (primitive == GX_KICK_NODES) one->v += span * one->a;
  if (primitive == GX_STRAIN_BACK) one->s += span * one->v;
  if (primitive == GX_OPEN) one->opened = one->x + span * one->v;
  if (primitive == GX_CLOSE) one->x = one->opened + span * one->v;
  return GX_OK;
}

static void state_of(struct gx_space *space, struct gx_state *state)
{
  struct oscillator *one = of(space);
  *state = (struct gx_state){.count = 3, .array = {&one->x, &one->s, &one->v}, .length = {1, 1, 1}};
}

static void rates(struct gx_space *space, double *const *rate)
{
  *rate[0] = *rate[1] = of(space)->v;
  *rate[2] = of(space)->a;
}

/* The second one says that weights change, for clocks with rows for that. */
static const struct gx_space_kind kinds[] = {
    {.weights = weights,
     .project = project,
     .accelerate = accelerate,
     .advance = advance,
     .twofold = twofold,
     .state = state_of,
     .rates = rates},
    {.fixed_grid = true,
     .weights = weights,
     .project = project,
     .accelerate = accelerate,
     .advance = advance,
     .twofold = twofold,
     .state = state_of,
     .rates = rates},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* Exact: x = cos t + sin t - (1/3) cos 2t. */
static double exact_x(double t)
{
  return cos(t) + sin(t) - cos(2 * t) / 3;
}

static double exact_v(double t)
{
  return cos(t) - sin(t) + 2 * sin(2 * t) / 3;
}

static struct oscillator start(const struct gx_clock *clock, int kind, double dt, struct gx_outcome *outcome)
{
  *outcome = (struct gx_outcome){.particle = -1};
  return (struct oscillator){
      .space = {.kind = &kinds[kind], .outcome = outcome},
      .drive = 1,
      .share = 0.5,
      .x = exact_x(0),
      .s = exact_x(0),
      .v = exact_v(clock->staggered ? -0.5 * dt : 0),
  };
}

/* Error in position and velocity after `steps` steps to time 1. */
static double error_after(const struct gx_clock *clock, int kind, int steps)
{
  double dt = 1.0 / steps;
  struct gx_outcome outcome;
  struct oscillator one = start(clock, kind, dt, &outcome);
  struct gx_stepper *stepper = gx_stepper_create(clock, &one.space, NULL);
  for (int i = 0; i < steps; i++) assert_int_equal(gx_stepper_step(stepper, i * dt, dt), GX_OK);
  assert_int_equal(gx_stepper_accelerate(stepper, 1), GX_OK);
  double v = one.v + (clock->staggered ? 0.5 * dt * one.a : 0);
  gx_stepper_free(stepper);
  return hypot(one.x - exact_x(1), v - exact_v(1));
}

static void clocks_have_the_order_they_claim(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++)
    for (int kind = 0; kind < KINDS; kind++) {
      const struct gx_clock *clock = gx_clock_family[i];
      int steps = clock->order > 4 ? 8 : clock->order > 2 ? 16 : 128;
      double coarse = error_after(clock, kind, steps), fine = error_after(clock, kind, 2 * steps), order = log2(coarse / fine);
      CHECK(fabs(order - clock->order) < 0.25, "%s: order %.3f, claims %d", clock->name, order, clock->order);
      CHECK(fine < 1e-2, "%s: error %g", clock->name, fine);
    }
}

/* Work of the whole acceleration is the change of kinetic energy: exactly for kicks, to its order for a tableau. */
struct work {
  double power, weight;
  int calls;
};

static void power(void *context, struct gx_space *space, double weight)
{
  struct work *work = context;
  work->power += weight * of(space)->a * of(space)->v;
  work->weight += weight;
  work->calls++;
}

static double work_error(const struct gx_clock *clock, int kind, int steps)
{
  double dt = 1.0 / steps;
  struct gx_outcome outcome;
  struct oscillator one = start(clock, kind, dt, &outcome);
  struct work work = {0};
  struct gx_work_observer observer = {&work, power};
  struct gx_stepper *stepper = gx_stepper_create(clock, &one.space, &observer);
  double before = 0.5 * one.v * one.v;
  for (int i = 0; i < steps; i++) gx_stepper_step(stepper, i * dt, dt);
  gx_stepper_free(stepper);
  NEAR(work.weight, 1, 1e-12);
  assert_true(work.calls >= steps);
  return fabs(0.5 * one.v * one.v - before - work.power);
}

static void work_is_the_change_of_kinetic_energy(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++)
    for (int kind = 0; kind < KINDS; kind++) {
      const struct gx_clock *clock = gx_clock_family[i];
      double coarse = work_error(clock, kind, 16), fine = work_error(clock, kind, 32);
      if (clock->tableau)
        CHECK(log2(coarse / fine) > clock->order - 0.25, "%s: order %.3f", clock->name, log2(coarse / fine));
      else
        NEAR(fine, 0, 1e-13);
    }
}

static double watch_step(const struct gx_clock *clock, double t, double dt, struct oscillator *one)
{
  struct gx_outcome outcome;
  *one = start(clock, 0, dt, &outcome);
  struct gx_stepper *stepper = gx_stepper_create(clock, &one->space, NULL);
  assert_int_equal(gx_stepper_step(stepper, t, dt), GX_OK);
  int first = one->accelerated;
  for (int i = 1; i <= 4; i++) assert_int_equal(gx_stepper_step(stepper, t + i * dt, dt), GX_OK);
  gx_stepper_free(stepper);
  double steady = (one->accelerated - first) / 4.0;
  one->accelerated = first;
  return steady;
}

/* Rows and splittings: each acceleration at the time that the drifts so far have reached. Tableaux: at the c of the stage. */
static void forces_are_taken_at_the_time_of_their_stage(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++) {
    const struct gx_clock *clock = gx_clock_family[i];
    const double t = 3, dt = 0.125;
    struct oscillator one;
    NEAR(watch_step(clock, t, dt, &one), clock->stages, 0);
    int stage = 0;
    double drifted = 0;
    const struct gx_row *row = clock->plain_rows ? clock->plain_rows : clock->rows;
    for (; row && row->primitive != GX_END; row++) {
      if (row->primitive == GX_DRIFT) drifted += row->coefficient;
      if (row->primitive == GX_ACCELERATE) NEAR(one.when[stage++], t + drifted * dt, 1e-15);
    }
    for (int j = 0; clock->splitting && j <= clock->splitting->stages; j++) {
      drifted += clock->splitting->drift[j];
      if (j < clock->splitting->stages) NEAR(one.when[stage++], t + drifted * dt, 2e-15);
    }
    if (!clock->tableau) NEAR(drifted, 1, 1e-15);
    for (; clock->tableau && stage < clock->tableau->stages; stage++)
      NEAR(one.when[stage], t + clock->tableau->c[stage] * dt, 1e-15);
    assert_int_equal(one.accelerated, stage);
  }
}

/* Observing the acceleration between steps changes no bit of the run. */
static void observed_accelerations_are_reused(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++) {
    const struct gx_clock *clock = gx_clock_family[i];
    struct oscillator run[2];
    struct gx_outcome outcome;
    for (int watched = 0; watched < 2; watched++) {
      run[watched] = start(clock, 0, 0.1, &outcome);
      struct gx_stepper *stepper = gx_stepper_create(clock, &run[watched].space, NULL);
      for (int step = 0; step < 10; step++) {
        if (watched) assert_int_equal(gx_stepper_accelerate(stepper, step * 0.1), GX_OK);
        if (watched) assert_int_equal(gx_stepper_accelerate(stepper, step * 0.1), GX_OK);
        assert_int_equal(gx_stepper_step(stepper, step * 0.1, 0.1), GX_OK);
      }
      gx_stepper_free(stepper);
    }
    NEAR(run[1].x, run[0].x, 0);
    NEAR(run[1].v, run[0].v, 0);
    NEAR(run[1].s, run[0].s, 0);
    bool accelerates_first =
        clock->tableau || (clock->rows ? clock->rows[2].primitive == GX_ACCELERATE : clock->splitting->drift[0] == 0);
    if (accelerates_first) {
      assert_int_equal(run[1].accelerated, run[0].accelerated);
      assert_int_equal(run[1].weighed, run[0].weighed);
      assert_int_equal(run[1].projected, run[0].projected);
    }
  }
}

/* A step ends with a new velocity of particles or new positions: nodal velocity must be projected again, the force only if
 * positions are new. */
static void a_step_leaves_nodal_velocity_to_be_projected(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++) {
    struct gx_outcome outcome;
    struct oscillator one = start(gx_clock_family[i], 0, 0.1, &outcome);
    struct gx_stepper *stepper = gx_stepper_create(gx_clock_family[i], &one.space, NULL);
    for (int step = 0; step < 3; step++) {
      assert_int_equal(gx_stepper_step(stepper, step * 0.1, 0.1), GX_OK);
      int projected = one.projected;
      assert_int_equal(gx_stepper_accelerate(stepper, (step + 1) * 0.1), GX_OK);
      CHECK(one.projected == projected + 1, "%s", gx_clock_family[i]->name);
    }
    gx_stepper_free(stepper);
  }
}

static void failures_are_passed_on(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++) {
    struct gx_outcome outcome;
    struct oscillator one = start(gx_clock_family[i], 0, 0.1, &outcome);
    struct gx_stepper *stepper = gx_stepper_create(gx_clock_family[i], &one.space, NULL);
    one.x = NAN;
    assert_int_equal(gx_stepper_step(stepper, 0, 0.1), GX_UNSTABLE);
    assert_int_equal(outcome.status, GX_UNSTABLE);
    assert_string_equal(outcome.reason, "too far");
    gx_stepper_free(stepper);
  }
}

/* Rooted trees to order 4, by their elementary weights sum_i b_i phi_i = 1/gamma. phi of a node multiplies (a phi) of its sons. */
struct tree {
  int order;
  long double gamma;
  int sons[3]; /* index + 1 of earlier trees, 0 after the last */
};

static const struct tree trees[] = {
    {1, 1, {0}},       /* . */
    {2, 2, {1}},       /* [.] */
    {3, 3, {1, 1}},    /* [. .] */
    {3, 6, {2}},       /* [[.]] */
    {4, 4, {1, 1, 1}}, /* [. . .] */
    {4, 8, {1, 2}},    /* [. [.]] */
    {4, 12, {3}},      /* [[. .]] */
    {4, 24, {4}},      /* [[[.]]] */
};
enum { TREES = sizeof trees / sizeof *trees };

static int order_by_trees(const struct gx_tableau *tableau)
{
  long double phi[TREES][GX_MAX_STAGES];
  int order = 4;
  for (int k = 0; k < TREES; k++) {
    long double weight = 0;
    for (int i = 0; i < tableau->stages; i++) {
      phi[k][i] = 1;
      for (int s = 0; s < 3 && trees[k].sons[s]; s++) {
        long double sum = 0;
        for (int j = 0; j < i; j++) sum += (long double)tableau->a[i][j] * phi[trees[k].sons[s] - 1][j];
        phi[k][i] *= sum;
      }
      weight += tableau->b[i] * phi[k][i];
    }
    if (fabsl(weight - 1 / trees[k].gamma) > 4 * DBL_EPSILON && order >= trees[k].order) order = trees[k].order - 1;
  }
  return order;
}

static void tableaux_meet_the_order_conditions(void **state)
{
  (void)state;
  int seen = 0;
  for (size_t i = 0; gx_clock_family[i]; i++) {
    const struct gx_clock *clock = gx_clock_family[i];
    const struct gx_tableau *tableau = clock->tableau;
    if (!tableau) continue;
    seen++;
    assert_int_equal(order_by_trees(tableau), clock->order < 4 ? clock->order : 4);
    for (int s = 0; s < tableau->stages; s++) {
      long double sum = 0;
      for (int j = 0; j < GX_MAX_STAGES; j++) {
        sum += tableau->a[s][j];
        if (j >= s) NEAR(tableau->a[s][j], 0, 0);
      }
      NEAR((double)sum, tableau->c[s], 2 * DBL_EPSILON);
    }
  }
  assert_true(seen > 0);
}

static void each_clock_is_of_one_form(void **state)
{
  (void)state;
  for (size_t i = 0; gx_clock_family[i]; i++) {
    const struct gx_clock *clock = gx_clock_family[i];
    assert_int_equal(!!clock->rows + !!clock->splitting + !!clock->tableau, 1);
    assert_ptr_equal(gx_clock_find(clock->name), clock);
    assert_true(clock->order > 0 && clock->stability > 0 && *clock->help && *clock->source);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(clocks_have_the_order_they_claim),
      cmocka_unit_test(work_is_the_change_of_kinetic_energy),
      cmocka_unit_test(forces_are_taken_at_the_time_of_their_stage),
      cmocka_unit_test(observed_accelerations_are_reused),
      cmocka_unit_test(a_step_leaves_nodal_velocity_to_be_projected),
      cmocka_unit_test(failures_are_passed_on),
      cmocka_unit_test(tableaux_meet_the_order_conditions),
      cmocka_unit_test(each_clock_is_of_one_form),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
