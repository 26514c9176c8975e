/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems: exact v and F are derivatives of exact u, and the body force closes the balance of momentum,
 * rho0 d2u/dt2 = Div P + rho0 b, by numerical derivatives of P. The model problems of steffen2010 §5 by hand. */
#include <gridcross/problem.h>

#include <string.h>

#include "check.h"
#include "problems/jump_model.h"
#include "problems/quadrature_model.h"

enum { N = 30 };

struct field {
  double store[GX_MAX_TENSOR][N];
  double *component[GX_MAX_TENSOR];
};

static double *const *of(struct field *field)
{
  for (int k = 0; k < GX_MAX_TENSOR; k++) field->component[k] = field->store[k];
  return field->component;
}

static struct gx_problem_options options_of(const struct gx_problem *problem, int dim, unsigned active)
{
  struct gx_problem_options options = {
      .dim = dim,
      .amplitude = 0.05,
      .mode = problem->has_mode ? 2 : 1,
      .moduli = gx_material_moduli(30, problem->has_poisson ? 0.3 : 0, 2.3),
  };
  for (int d = 0; d < dim; d++) {
    options.active[d] = active >> d & 1;
    options.phase[d] = problem->has_directions ? 0.4 + 0.9 * d : 0;
    options.velocity[d] = 0.3 - 0.1 * d;
    options.body.centre[d] = 0.4 + 0.1 * d;
    options.body.size[d] = 0.7;
  }
  options.spin = dim > 1 ? 2.3 : 0;
  options.rotation = 0.6;
  return options;
}

/* Of the difference quotients, m and s: what moves on a part of the domain varies faster over it. */
static double step_of(const struct gx_problem *problem)
{
  return problem->inside ? 1e-4 : 1e-3;
}

/* Random points of the body shifted by `shift` along direction e. */
static struct gx_posed *pose(const struct gx_problem *problem, const struct gx_problem_options *options, int e, double shift)
{
  struct field X;
  double at[GX_MAX_DIM];
  uint64_t seed = 23;
  of(&X);
  for (int p = 0; p < N; p++) {
    do {
      for (int d = 0; d < options->dim; d++) at[d] = check_random(&seed, 0, 1);
    } while (problem->inside && !problem->inside(options, at));
    for (int d = 0; d < options->dim; d++) X.store[d][p] = at[d] + (d == e ? shift : 0);
  }
  return gx_problem_pose(problem, options, N, X.component);
}

static void each_problem(void (*check)(const struct gx_problem *problem, const struct gx_problem_options *options, double t))
{
  for (size_t i = 0; gx_problem_family[i]; i++) {
    const struct gx_problem *problem = gx_problem_family[i];
    if (problem->space || !problem->exact) continue; /* not a continuum, or without solution */
    for (int dim = problem->min_dim > 1 ? problem->min_dim : 1; dim <= problem->max_dim; dim++)
      for (unsigned active = problem->has_directions ? 1 : (1u << dim) - 1; active < 1u << dim; active++)
        for (double t = 0; t < 0.6; t += 0.17) {
          struct gx_problem_options options = options_of(problem, dim, active);
          check(problem, &options, t);
        }
  }
}

static const double shift[] = {-2, -1, 1, 2};

/* fourth-order central difference of component k at point p */
static double slope(const struct field *four, int k, int p, double step)
{
  return (four[0].store[k][p] - 8 * four[1].store[k][p] + 8 * four[2].store[k][p] - four[3].store[k][p]) / (12 * step);
}

static void check_exact(const struct gx_problem *problem, const struct gx_problem_options *options, double t)
{
  const double step = step_of(problem);
  int dim = options->dim;
  struct gx_posed *posed = pose(problem, options, 0, 0);
  struct field u, v, F, a, u_at[4], v_at[4];
  problem->exact(posed, t, of(&u), of(&v), of(&F), of(&a));
  for (int i = 0; i < 4; i++) problem->exact(posed, t + step * shift[i], of(&u_at[i]), of(&v_at[i]), NULL, NULL);
  double speed = posed->speed * 2 * M_PI * options->mode * options->amplitude;
  for (int d = 0; d < dim; d++)
    for (int p = 0; p < N; p++) {
      NEAR(slope(u_at, d, p, step), v.store[d][p], 1e-5 * speed);
      NEAR(slope(v_at, d, p, step), a.store[d][p], 1e-5 * speed * posed->speed * 2 * M_PI * options->mode);
    }
  for (int e = 0; e < dim; e++) {
    for (int i = 0; i < 4; i++) {
      struct gx_posed *moved = pose(problem, options, e, step * shift[i]);
      problem->exact(moved, t, of(&u_at[i]), NULL, NULL, NULL);
      gx_problem_free(moved);
    }
    for (int d = 0; d < dim; d++)
      for (int p = 0; p < N; p++) NEAR((d == e) + slope(u_at, d, p, step), F.store[d * dim + e][p], 1e-8);
  }
  for (int d = 0; d < dim; d++)
    for (int p = 0; p < N && !options->active[d]; p++) NEAR(u.store[d][p], 0, 0);
  gx_problem_free(posed);
}

static void velocity_gradient_and_acceleration_are_derivatives(void **state)
{
  (void)state;
  each_problem(check_exact);
}

static void check_balance(const struct gx_problem *problem, const struct gx_problem_options *options, double t)
{
  const double step = step_of(problem);
  int dim = options->dim;
  double divergence[GX_MAX_DIM][N] = {{0}};
  for (int e = 0; e < dim; e++) {
    struct field F, P[4];
    for (int i = 0; i < 4; i++) {
      struct gx_posed *moved = pose(problem, options, e, step * shift[i]);
      problem->exact(moved, t, NULL, NULL, of(&F), NULL);
      assert_int_equal(problem->material->piola(&options->moduli, dim, N, F.component, of(&P[i])), -1);
      gx_problem_free(moved);
    }
    for (int d = 0; d < dim; d++)
      for (int p = 0; p < N; p++) divergence[d][p] += slope(P, d * dim + e, p, step);
  }
  struct gx_posed *posed = pose(problem, options, 0, 0);
  struct field v[4], b = {0};
  for (int i = 0; i < 4; i++) problem->exact(posed, t + 0.1 * step * shift[i], NULL, of(&v[i]), NULL, NULL);
  of(&b);
  if (problem->body) problem->body(posed, t, b.component);
  double wave = 2 * M_PI * options->mode, scale = options->moduli.young * options->amplitude * wave * wave;
  for (int d = 0; d < dim; d++)
    for (int p = 0; p < N; p++)
      NEAR(options->moduli.density * (slope(v, d, p, 0.1 * step) - b.store[d][p]), divergence[d][p], 3e-8 * scale);
  gx_problem_free(posed);
}

static void body_force_balances_momentum(void **state)
{
  (void)state;
  each_problem(check_balance);
}

/* steffen2010 eq. 131: b = C^2 pi^2 u (2 F^-2 + 1), also for the axis-aligned wave along one direction. */
static void neo_hookean_body_by_hand(void **state)
{
  (void)state;
  const char *const names[] = {"bar-neo-hookean", "axis-aligned"};
  for (int i = 0; i < 2; i++) {
    const struct gx_problem *problem = gx_problem_find(names[i]);
    struct gx_problem_options options = {
        .dim = 1, .amplitude = 0.05, .mode = 1, .moduli = gx_material_moduli(1e4, 0, 1), .active = {true}};
    double X[] = {0.1, 0.3, 0.55}, b[3], u[3], F[3];
    struct gx_posed *posed = gx_problem_pose(problem, &options, 3, (double *[]){X});
    problem->exact(posed, 0.003, (double *[]){u}, NULL, (double *[]){F}, NULL);
    problem->body(posed, 0.003, (double *[]){b});
    for (int p = 0; p < 3; p++) {
      NEAR(u[p], 0.05 * sin(2 * M_PI * X[p]) * cos(0.3 * M_PI), 1e-16);
      NEAR(F[p], 1 + 0.1 * M_PI * cos(2 * M_PI * X[p]) * cos(0.3 * M_PI), 1e-15);
      CLOSE(b[p], 1e4 * M_PI * M_PI * u[p] * (2 / (F[p] * F[p]) + 1), 1e-13);
    }
    gx_problem_free(posed);
  }
}

static void linear_bar_by_hand(void **state)
{
  (void)state;
  const struct gx_problem *problem = gx_problem_find("bar-linear");
  struct gx_problem_options options = {
      .dim = 1, .amplitude = 0.05, .mode = 1, .moduli = gx_material_moduli(16, 0, 1), .active = {true}};
  double X = 0.2, u, v;
  struct gx_posed *posed = gx_problem_pose(problem, &options, 1, (double *[]){&X});
  problem->exact(posed, 0.01, (double *[]){&u}, (double *[]){&v}, NULL, NULL);
  NEAR(u, 0.05 * sin(0.4 * M_PI) * sin(0.08 * M_PI), 1e-16);
  NEAR(v, 0.05 * sin(0.4 * M_PI) * 8 * M_PI * cos(0.08 * M_PI), 1e-14);
  assert_null(problem->body);
  gx_problem_free(posed);
}

/* After `cycles`/c the motion repeats, and not after half of it. */
static void check_period(const struct gx_problem *problem, const struct gx_problem_options *options, double t)
{
  if (problem->cycles == 0) return;
  struct gx_posed *posed = pose(problem, options, 0, 0);
  struct field u, later, half;
  double period = problem->cycles / (posed->speed * options->mode), difference = 0;
  problem->exact(posed, t, of(&u), NULL, NULL, NULL);
  problem->exact(posed, t + period, of(&later), NULL, NULL, NULL);
  problem->exact(posed, t + period / 2, of(&half), NULL, NULL, NULL);
  for (int d = 0; d < options->dim; d++)
    for (int p = 0; p < N; p++) {
      NEAR(later.store[d][p], u.store[d][p], 1e-15);
      difference = fmax(difference, fabs(u.store[d][p] - half.store[d][p]));
    }
  assert_true(t == 0 || difference > 1e-3);
  gx_problem_free(posed);
}

static void motion_is_periodic(void **state)
{
  (void)state;
  each_problem(check_period);
}

/* steffen2010 eq. 70 */
static double carrying_velocity(double x)
{
  return x < 1.0 / 3 ? 3 * x + 1 : x < 2.0 / 3 ? 6 * x : x < 5.0 / 6 ? 12 * x - 4 : 18 * x - 9;
}

/* x(t) of the model problems by hand, posed with the given knot and step. */
static double carried_to(const char *name, int knot, double t, double *v, double *a)
{
  struct gx_problem_options options = {.dim = 1, .mode = 1, .knot = knot, .dt = 0.01, .jump = 1, .particle_width = 0.1};
  double X = 0.5, u;
  struct gx_posed *posed = gx_problem_pose(gx_problem_find(name), &options, 1, (double *[]){&X});
  posed->problem->exact(posed, t, (double *[]){&u}, (double *[]){v}, NULL, (double *[]){a});
  double x = gx_jump_model_start(posed) + u;
  gx_problem_free(posed);
  return x;
}

static void a_carried_particle_has_the_velocity_of_its_place(void **state)
{
  (void)state;
  const char *const names[] = {"jump-model", "quadrature-model"};
  const double first = log(2) / 3, second = first + log(2) / 6, third = second + log(1.5) / 12; /* 1/v from knot to knot */
  double v, a;
  for (int i = 0; i < 2; i++) {
    NEAR(carried_to(names[i], 0, 0, &v, &a), 0, 0);
    NEAR(carried_to(names[i], 0, first, &v, &a), 1.0 / 3, 1e-15);
    NEAR(carried_to(names[i], 0, second, &v, &a), 2.0 / 3, 1e-15);
    NEAR(carried_to(names[i], 0, third, &v, &a), 5.0 / 6, 1e-15);
    NEAR(carried_to(names[i], 0, third + log(1.5) / 18, &v, &a), 1, 1e-14); /* 6 to 9 at slope 18 */
    NEAR(v, 9, 1e-13);
    for (double t = 0.01; t < 0.42; t += 0.0137) {
      const double step = 1e-5;
      double before = carried_to(names[i], 0, t - step, &v, &a), after = carried_to(names[i], 0, t + step, &v, &a);
      double x = carried_to(names[i], 0, t, &v, &a);
      NEAR((after - before) / (2 * step), v, 1e-4); /* a knot between the two costs 6 * 6 * step / 4 */
      NEAR(v, carrying_velocity(x), 1e-14);
      NEAR(a, (carrying_velocity(x) - carrying_velocity(x - 1e-6)) / 1e-6 * v, 1e-6);
    }
  }
}

/* Eq. 83: half a step of 0.01 leads to the knot. */
static void a_knot_is_met_half_way(void **state)
{
  (void)state;
  const double knots[] = {1.0 / 3, 2.0 / 3, 5.0 / 6};
  for (int k = 0; k < 3; k++) {
    double v, a, x = carried_to("jump-model", k + 1, 0, &v, &a);
    NEAR(x + 0.005 * carrying_velocity(x), knots[k], 1e-15);
    NEAR(gx_jump_model_velocity(knots[k]), gx_jump_model_velocity(knots[k] - 1e-14), 1e-12);
    NEAR(v, carrying_velocity(x), 1e-14);
  }
}

/* J (-1/3 + 1/6 + 3/2 1/6) as printed, half of the second term as corrected; the midpoint rule on [x - 1/8, x + 1/8] by hand. */
static void the_external_acceleration_is_a_quadrature_error(void **state)
{
  (void)state;
  struct gx_problem_options printed = {.jump = 2}, corrected = {.jump = 2, .corrected = true};
  for (double x = 0.04; x < 1; x += 0.1) { /* a particle without width errs nowhere */
    NEAR(gx_quadrature_model_acceleration(&printed, x), 2.0 / 12, 1e-15);
    NEAR(gx_quadrature_model_acceleration(&corrected, x), 0, 1e-15);
  }
  printed.particle_width = corrected.particle_width = 0.25;
  NEAR(gx_quadrature_model_acceleration(&corrected, 0.2), 0, 1e-15);                              /* within a piece */
  NEAR(gx_quadrature_model_acceleration(&corrected, 0.3), -2 * (0.425 - 1.0 / 3), 1e-15);         /* takes -J beyond 1/3 */
  NEAR(gx_quadrature_model_acceleration(&corrected, 0.4), 2 * (1.0 / 3 - 0.275), 1e-15);          /* takes 0 before it */
  NEAR(gx_quadrature_model_acceleration(&printed, 0.7), 2 * (1.0 / 12 + 2.0 / 3 - 0.575), 1e-15); /* J before 2/3 */
  NEAR(gx_quadrature_model_acceleration(&corrected, 0), -2 * 0.125, 1e-15);                       /* half of it outside */
  NEAR(gx_quadrature_model_acceleration(&corrected, 0.95), 2 * 1.5 * 0.075 + 2 * (5.0 / 6 - 0.825), 1e-15);
}

/* The start of a problem without exact solution: F belongs to u, and spin to x. */
static void a_spinning_block_starts_as_it_says(void **state)
{
  (void)state;
  const struct gx_problem *problem = gx_problem_find("spinning-block");
  const double step = 1e-5;
  for (int dim = 2; dim <= 3; dim++) {
    struct gx_problem_options options = options_of(problem, dim, 7);
    for (int d = 0; d < dim; d++) options.body.size[d] = 0.5 + 0.1 * d;
    struct gx_posed *posed = pose(problem, &options, 0, 0);
    struct field u, v, F, low, high, unused, other;
    problem->initial(posed, of(&u), of(&v), of(&F));
    for (int e = 0; e < dim; e++) {
      struct gx_posed *below = pose(problem, &options, e, -step), *above = pose(problem, &options, e, step);
      problem->initial(below, of(&low), of(&unused), of(&other));
      problem->initial(above, of(&high), of(&unused), of(&other));
      for (int d = 0; d < dim; d++)
        for (int p = 0; p < N; p++)
          NEAR(F.store[d * dim + e][p], (d == e) + (high.store[d][p] - low.store[d][p]) / (2 * step), 1e-8);
      gx_problem_free(below);
      gx_problem_free(above);
    }
    for (int p = 0; p < N; p++) {
      NEAR(v.store[0][p], -2.3 * (posed->X[1][p] + u.store[1][p] - 0.5), 1e-14);
      NEAR(v.store[1][p], 2.3 * (posed->X[0][p] + u.store[0][p] - 0.4), 1e-14);
      if (dim == 3) NEAR(v.store[2][p], 0, 0);
    }
    gx_problem_free(posed);
  }
}

/* Of radius 0.2 about (0.2, 0.2) and (0.8, 0.8), flying at each other. */
static void disks_are_where_they_should_be(void **state)
{
  (void)state;
  static const struct {
    double X[2];
    int disk; /* 0: none */
  } points[] = {{{0.2, 0.2}, 1}, {{0.01, 0.2}, 1}, {{0.2, 0.39}, 1}, {{0.34, 0.34}, 1}, {{0.35, 0.35}, 0}, {{0.5, 0.5}, 0},
                {{0.8, 0.8}, 2}, {{0.8, 0.61}, 2}, {{0.99, 0.8}, 2}, {{0.66, 0.66}, 2}, {{0.65, 0.65}, 0}, {{0.2, 0.8}, 0}};
  const struct gx_problem *problem = gx_problem_find("colliding-disks");
  const struct gx_problem_options options = {.dim = 2};
  for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
    const double *X = points[i].X;
    const int disk = problem->inside(&options, X) ? 1 + problem->second(&options, X) : 0;
    if (disk != points[i].disk) fail_msg("(%g, %g) is of disk %d, not %d", X[0], X[1], disk, points[i].disk);
  }
}

/* What run files may say of the ends, the first being the default, and how long a run is that says nothing: the disks meet after 1.6 s
 * and are as far apart again after 3.2, the block has turned once, of the model problems as in steffen2010. */
static void ends_are_those_of_the_problem(void **state)
{
  (void)state;
  static const struct {
    const char *problem, *boundary[4];
    double end;
  } expected[] = {
      {"bar-linear", {"fixed", "periodic"}, 0},
      {"bar-neo-hookean", {"periodic", "fixed"}, 0},
      {"axis-aligned", {"periodic", "fixed"}, 0},
      {"generalized-vortex", {"free", "periodic", "fixed"}, 0},
      {"free-flight", {"periodic", "free"}, 1},
      {"spinning-block", {"free", "periodic"}, 0.125},
      {"cantilever", {"clamped"}, 1},
      {"colliding-disks", {"free", "fixed"}, 3.6},
      {"jump-model", {NULL}, 0.4},
      {"quadrature-model", {NULL}, 0.4},
      {"oscillator", {NULL}, 0},
  };
  enum { COUNT = sizeof expected / sizeof *expected };
  int problems = 0;
  while (gx_problem_family[problems]) problems++;
  assert_int_equal(problems, COUNT);
  for (int i = 0; i < COUNT; i++) {
    const struct gx_problem *problem = gx_problem_find(expected[i].problem);
    unsigned boundaries = 0;
    for (int k = 0; expected[i].boundary[k]; k++)
      for (int b = 0; b < GX_BOUNDARIES; b++)
        if (!strcmp(gx_problem_boundary[b], expected[i].boundary[k])) boundaries |= 1u << b;
    CHECK(problem->boundaries == boundaries, "%s admits others", problem->name);
    if (boundaries) assert_string_equal(gx_problem_boundary[problem->boundary], expected[i].boundary[0]);
    CHECK(problem->end == expected[i].end, "%s ends at %g", problem->name, problem->end);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(velocity_gradient_and_acceleration_are_derivatives),
      cmocka_unit_test(body_force_balances_momentum),
      cmocka_unit_test(neo_hookean_body_by_hand),
      cmocka_unit_test(linear_bar_by_hand),
      cmocka_unit_test(motion_is_periodic),
      cmocka_unit_test(a_carried_particle_has_the_velocity_of_its_place),
      cmocka_unit_test(a_knot_is_met_half_way),
      cmocka_unit_test(the_external_acceleration_is_a_quadrature_error),
      cmocka_unit_test(a_spinning_block_starts_as_it_says),
      cmocka_unit_test(disks_are_where_they_should_be),
      cmocka_unit_test(ends_are_those_of_the_problem),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
