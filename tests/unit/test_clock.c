/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every clock against its own claims: order from the order conditions in long double, order and stability limit measured on the
 * oscillator, and the symplectic ones on the area of phase space. */
#include <stdlib.h>

#include <gridcross/clock.h>

#include "check.h"

/* A tree of the Nystrom series of x'' = f(x): the stage values it gives and its exact value kappa s^power, s = t/dt. */
struct tree {
  long double stage[GX_MAX_STAGES], kappa;
  int power;
};

enum { MOST_ORDER = 7, MOST_TREES = 64 };

/* Coefficients of a splitting as a Runge-Kutta-Nystrom method. */
struct nystrom {
  int stages;
  long double c[GX_MAX_STAGES], b[GX_MAX_STAGES], a[GX_MAX_STAGES][GX_MAX_STAGES];
};

static struct nystrom nystrom_of(const struct gx_splitting *splitting)
{
  struct nystrom method = {.stages = splitting->stages};
  long double c = 0;
  for (int i = 0; i < method.stages; i++) {
    method.c[i] = c += splitting->drift[i];
    method.b[i] = splitting->kick[i];
    for (int j = 0; j < i; j++) method.a[i][j] = method.b[j] * (method.c[i] - method.c[j]);
  }
  return method;
}

struct forest {
  struct nystrom method;
  int count[MOST_ORDER + 1];
  struct tree tree[MOST_ORDER + 1][MOST_TREES];
  int children, order_of[4 * MOST_TREES];
  struct tree child[4 * MOST_TREES];
};

/* Adds to trees of `order` all products of `tree` with children from `first` on that fill up `left`. */
static void grow(struct forest *forest, int order, int first, int left, struct tree tree)
{
  if (left == 0) {
    assert_true(forest->count[order] < MOST_TREES);
    forest->tree[order][forest->count[order]++] = tree;
    return;
  }
  for (int k = first; k < forest->children; k++) {
    if (forest->order_of[k] > left) continue;
    struct tree longer = tree;
    for (int i = 0; i < forest->method.stages; i++) longer.stage[i] *= forest->child[k].stage[i];
    longer.kappa *= forest->child[k].kappa;
    longer.power += forest->child[k].power;
    grow(forest, order, k, left - forest->order_of[k], longer);
  }
}

/* What f's argument sees of a subtree: its double integral. */
static void add_child(struct forest *forest, int order, const struct tree *subtree)
{
  struct tree *child = &forest->child[forest->children];
  forest->order_of[forest->children++] = order + 1;
  child->kappa = subtree->kappa / ((subtree->power + 1) * (subtree->power + 2));
  child->power = subtree->power + 2;
  for (int i = 0; i < forest->method.stages; i++) {
    child->stage[i] = 0;
    for (int j = 0; j < i; j++) child->stage[i] += forest->method.a[i][j] * subtree->stage[j];
  }
}

/* Largest residual of the conditions of each order, velocity and position. */
static void residuals(const struct gx_splitting *splitting, long double residual[MOST_ORDER + 1])
{
  struct forest *forest = calloc(1, sizeof *forest);
  assert_non_null(forest);
  const struct nystrom *method = &forest->method;
  forest->method = nystrom_of(splitting);
  struct tree one = {.kappa = 1}, time = {.kappa = 1, .power = 1};
  for (int i = 0; i < method->stages; i++) {
    one.stage[i] = 1;
    time.stage[i] = method->c[i];
  }
  forest->children = 1;
  forest->order_of[0] = 1;
  forest->child[0] = time;
  for (int order = 1; order <= MOST_ORDER; order++) {
    residual[order] = 0;
    grow(forest, order, 0, order - 1, one);
    for (int k = 0; k < forest->count[order]; k++) {
      long double sum = 0, exact = forest->tree[order][k].kappa / (forest->tree[order][k].power + 1);
      for (int i = 0; i < method->stages; i++) sum += method->b[i] * forest->tree[order][k].stage[i];
      residual[order] = fmaxl(residual[order], fabsl(sum - exact));
      add_child(forest, order, &forest->tree[order][k]);
    }
    for (int k = 0; order > 1 && k < forest->count[order - 1]; k++) {
      const struct tree *tree = &forest->tree[order - 1][k];
      long double sum = 0, exact = tree->kappa / ((tree->power + 1) * (tree->power + 2));
      for (int i = 0; i < method->stages; i++) sum += method->b[i] * (1 - method->c[i]) * tree->stage[i];
      residual[order] = fmaxl(residual[order], fabsl(sum - exact));
    }
  }
  /* Hairer, Norsett & Wanner 1993, II.14: numbers of Nystrom trees of f(x) */
  static const int known[MOST_ORDER + 1] = {0, 1, 1, 2, 3, 6, 10, 20};
  for (int order = 1; order <= MOST_ORDER; order++) assert_int_equal(forest->count[order], known[order]);
  free(forest);
}

static void splittings_have_their_order(void **state)
{
  (void)state;
  for (const struct gx_clock *const *clock = gx_clock_family; *clock; clock++) {
    if (!(*clock)->splitting) continue;
    long double residual[MOST_ORDER + 1];
    residuals((*clock)->splitting, residual);
    int order = 0;
    while (order < MOST_ORDER && residual[order + 1] < 3e-15L) order++;
    if (order != (*clock)->order || residual[order + 1] < 1e-7L)
      fail_msg("%s claims order %d, its conditions hold through %d; residuals %.2Lg, %.2Lg", (*clock)->name, (*clock)->order,
               order, residual[order], residual[order + 1]);
  }
}

/* The oscillator with C = 1/pi, so that omega = 1. */
struct oscillator {
  struct gx_particles *particles;
  struct gx_posed *posed;
  struct gx_space *space;
  struct gx_stepper *stepper;
  struct gx_outcome outcome;
};

static void set_up(struct oscillator *oscillator, const struct gx_clock *clock)
{
  const struct gx_problem *problem = gx_problem_find("oscillator");
  struct gx_problem_options options = {.dim = 1, .mode = 1, .moduli = {.young = 1 / (M_PI * M_PI), .density = 1}};
  struct gx_space_options none = {0};
  int cells = 1;
  oscillator->particles = gx_particles_create(1, &cells, 1, GX_LAYOUT_UNIFORM, 1);
  oscillator->posed = gx_problem_pose(problem, &options, 1, oscillator->particles->X);
  oscillator->posed->problem->exact(oscillator->posed, 0, oscillator->particles->u, oscillator->particles->v,
                                    oscillator->particles->F, NULL);
  const struct gx_space_kind *kind = gx_space_find(problem->space);
  assert_int_equal(kind->create(kind, &oscillator->space, &none, oscillator->particles, oscillator->posed, &oscillator->outcome),
                   GX_OK);
  oscillator->stepper = gx_stepper_create(clock, oscillator->space, NULL);
  assert_non_null(oscillator->stepper);
}

static void tear_down(struct oscillator *oscillator)
{
  gx_stepper_free(oscillator->stepper);
  oscillator->space->kind->free(oscillator->space);
  gx_problem_free(oscillator->posed);
  gx_particles_free(oscillator->particles);
}

/* Largest of |x| and |v| over the last tenth of the steps. */
static double size_after(const struct gx_clock *clock, double dt, int steps)
{
  struct oscillator oscillator;
  set_up(&oscillator, clock);
  double largest = 0;
  for (int k = 0; k < steps && isfinite(largest); k++) {
    assert_int_equal(gx_stepper_step(oscillator.stepper, k * dt, dt), GX_OK);
    double size = fmax(fabs(oscillator.particles->u[0][0]), fabs(oscillator.particles->v[0][0]));
    if (!(size < 1e100)) largest = INFINITY;
    if (k > 0.9 * steps) largest = fmax(largest, size);
  }
  tear_down(&oscillator);
  return largest;
}

static void limits_of_stability(void **state)
{
  (void)state;
  for (const struct gx_clock *const *clock = gx_clock_family; *clock; clock++) {
    double below = size_after(*clock, 0.9999 * (*clock)->stability, 100000);
    double above = size_after(*clock, 1.0001 * (*clock)->stability, 100000);
    if (!(below < 1e4) || above < 1e8)
      fail_msg("%s: omega dt %.9g is not its limit: the solution grows to %g below and %g above", (*clock)->name,
               (*clock)->stability, below, above);
  }
}

/* Error at t = 1 of a clock started as it demands. */
static double error_at_one(const struct gx_clock *clock, int steps)
{
  struct oscillator oscillator;
  double dt = 1.0 / steps;
  set_up(&oscillator, clock);
  if (clock->staggered) oscillator.particles->v[0][0] = cos(-0.5 * dt);
  for (int k = 0; k < steps; k++) assert_int_equal(gx_stepper_step(oscillator.stepper, k * dt, dt), GX_OK);
  double error = fabs(oscillator.particles->u[0][0] - sin(1));
  if (!clock->staggered) error = fmax(error, fabs(oscillator.particles->v[0][0] - cos(1)));
  tear_down(&oscillator);
  return error;
}

static void orders_on_the_oscillator(void **state)
{
  (void)state;
  for (const struct gx_clock *const *clock = gx_clock_family; *clock; clock++) {
    int steps = (*clock)->order > 4 ? 4 : 16;
    double order = log2(error_at_one(*clock, steps) / error_at_one(*clock, 2 * steps));
    if (order < (*clock)->order - 0.25 || order > (*clock)->order + 0.75)
      fail_msg("%s claims order %d and shows %.3f on the oscillator", (*clock)->name, (*clock)->order, order);
  }
}

/* A clock that strains before it accelerates uses the velocity that the last step's drift has used: between steps its stress lags
 * by dt v behind the position. */
static double lag(const struct gx_clock *clock)
{
  for (const struct gx_row *row = clock->rows; row && row->primitive != GX_END && row->primitive != GX_ACCELERATE; row++)
    if (row->primitive == GX_STRAIN) return row->coefficient;
  return 0;
}

static void symplectic_steps_keep_area(void **state)
{
  (void)state;
  for (const struct gx_clock *const *clock = gx_clock_family; *clock; clock++) {
    double image[2][2], dt = 0.3;
    for (int i = 0; i < 2; i++) {
      struct oscillator oscillator;
      set_up(&oscillator, *clock);
      struct gx_particles *particles = oscillator.particles;
      particles->u[0][0] = i == 0;
      particles->v[0][0] = i == 1;
      particles->P[0][0] =
          3 * oscillator.posed->options.moduli.young * M_PI * (particles->u[0][0] - lag(*clock) * dt * particles->v[0][0]);
      gx_stepper_step(oscillator.stepper, 0, dt);
      image[i][0] = particles->u[0][0];
      image[i][1] = particles->v[0][0];
      tear_down(&oscillator);
    }
    double area = image[0][0] * image[1][1] - image[0][1] * image[1][0];
    bool kept = fabs(area - 1) < 1e-13;
    if ((*clock)->symplectic != kept) fail_msg("%s: a step maps unit area to %.17g", (*clock)->name, area);
  }
}

/* Kicks and drifts of a step each make up dt; the trapezoidal ones stand at its two ends. */
static void stages_make_up_a_step(void **state)
{
  (void)state;
  for (int k = 0; gx_clock_family[k]; k++)
    for (int plain = 0; plain < 2; plain++) {
      struct gx_clock_stage stage[GX_MAX_STAGES + 1];
      int count = gx_clock_stages(gx_clock_family[k], plain, stage);
      double kick = 0, drift = 0;
      assert_in_range(count, 1, GX_MAX_STAGES + 1);
      NEAR(stage[0].time, 0, 0);
      for (int j = 0; j < count; j++) {
        kick += stage[j].kick;
        drift += stage[j].drift;
      }
      NEAR(kick, 1, 1e-14);
      NEAR(drift, 1, 1e-14);
    }
  struct gx_clock_stage stage[GX_MAX_STAGES + 1];
  static const struct {
    const char *name;
    bool plain;
    int count;
    struct gx_clock_stage stage[3];
  } rows[] = {{"central-difference", false, 1, {{0, 1, 1, 1}}},
              {"stormer-verlet", false, 2, {{0, 0.5, 0.5, 0}, {1, 0.5, 0.5, 1}}},
              {"stormer-verlet", true, 2, {{0, 0.5, 1, 0.5}, {1, 0.5, 0, 0}}},
              {"trgimp", false, 2, {{0, 0.5, 0.5, 0}, {1, 0.5, 0.5, 1}}},
              {"rk4", false, 3, {{0, 1.0 / 6, 1.0 / 6, 0}, {0.5, 2.0 / 3, 2.0 / 3, 0.5}, {1, 1.0 / 6, 1.0 / 6, 1}}}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    assert_int_equal(gx_clock_stages(gx_clock_find(rows[i].name), rows[i].plain, stage), rows[i].count);
    for (int j = 0; j < rows[i].count; j++) {
      NEAR(stage[j].time, rows[i].stage[j].time, 0);
      NEAR(stage[j].kick, rows[i].stage[j].kick, 1e-15);
      NEAR(stage[j].drift, rows[i].stage[j].drift, 1e-15);
      if (stage[j].drift != 0) NEAR(stage[j].velocity_time, rows[i].stage[j].velocity_time, 1e-15);
    }
  }
}

/* What only fixed grids know is in the rows of these alone. */
static void rows_ask_of_a_space_what_it_knows(void **state)
{
  (void)state;
  for (const struct gx_clock *const *clock = gx_clock_family; *clock; clock++)
    for (const struct gx_row *row = (*clock)->plain_rows ? (*clock)->plain_rows : (*clock)->rows; row && row->primitive; row++)
      if (row->primitive == GX_WEIGHTS_FROZEN || row->primitive == GX_STRETCH || row->primitive == GX_STRAIN_BACK)
        fail_msg("%s needs plain_rows without what is for fixed grids alone", (*clock)->name);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(splittings_have_their_order), cmocka_unit_test(limits_of_stability),
      cmocka_unit_test(orders_on_the_oscillator),    cmocka_unit_test(symplectic_steps_keep_area),
      cmocka_unit_test(stages_make_up_a_step),       cmocka_unit_test(rows_ask_of_a_space_what_it_knows),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
