/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Product grids: products of polynomials, and every mix of derivatives, in one to three dimensions. */
#include <gridcross_splines.h>

#include <string.h>

#include "near.h"
#include "sites.h"

static struct gx_spline_error error;

/* One direction: x^3 - x / 2, even: cos(pi x), odd: sin(pi x), periodic: 2 + sin(2 pi x). */
static double function(enum gx_spline_ends ends, int order, double x)
{
  switch (ends) {
  case GX_SPLINE_OPEN:
    return order ? 3 * x * x - 0.5 : x * x * x - x / 2;
  case GX_SPLINE_PERIODIC:
    return order ? 2 * M_PI * cos(2 * M_PI * x) : 2 + sin(2 * M_PI * x);
  case GX_SPLINE_EVEN:
    return order ? -M_PI * sin(M_PI * x) : cos(M_PI * x);
  default:
    return order ? M_PI * cos(M_PI * x) : sin(M_PI * x);
  }
}

enum { ROOM = 24 };

static const size_t SITES[] = {20, 16, 18}, POINTS[] = {5, 19, 4}, most[] = {20, 19, 18};

/* Product of the three one-dimensional functions at index i of a grid. */
static double product(int dim, const enum gx_spline_ends *ends, const int *order, const size_t *shape, double (*x)[ROOM],
                      size_t i)
{
  double value = 1;
  for (int d = dim - 1; d >= 0; d--) {
    value *= function(ends[d], order ? order[d] : 0, x[d][i % shape[d]]);
    i /= shape[d];
  }
  return value;
}

static size_t total(int dim, const size_t *shape)
{
  size_t count = 1;
  for (int d = 0; d < dim; d++) count *= shape[d];
  return count;
}

static void grid(int dim, const enum gx_spline_ends *ends, const int *degree, const double *tolerance)
{
  uint64_t state = 17;
  struct gx_spline_interpolant *s[3] = {0};
  struct gx_spline_points *points[3] = {0};
  struct gx_spline_lines *line[3] = {0};
  double site[3][ROOM], x[3][ROOM];
  for (int d = 0; d < dim; d++) {
    jittered_sites(SITES[d], 0, 1, 0.2, &state, site[d]);
    for (size_t i = 0; i < POINTS[d]; i++) x[d][i] = 0.05 + 0.9 * random_number(&state);
    DONE(gx_spline_interpolant_create(&s[d], ends[d], degree[d], SITES[d], &error));
    DONE(gx_spline_interpolant_set_sites(s[d], site[d], 0, 1, &error));
    DONE(gx_spline_points_create(&points[d], degree[d], 3, POINTS[d], &error));
    gx_spline_points_set(points[d], s[d]->knots, x[d]);
    DONE(gx_spline_lines_create(&line[d], s[d], points[d], &error));
  }
  const struct gx_spline_lines *const lines[] = {line[0], line[1], line[2]};
  double *value = calloc(total(dim, SITES), sizeof *value), *out = calloc(total(dim, most), sizeof *out);
  double *work[] = {calloc(gx_spline_tensor_room(dim, lines), sizeof *out),
                    calloc(gx_spline_tensor_room(dim, lines), sizeof *out)};
  for (size_t i = 0; i < total(dim, SITES); i++) value[i] = product(dim, ends, NULL, SITES, site, i);
  for (int mix = 0; mix < 1 << dim; mix++)
    for (int sites = 0; sites < (1 << dim) - 1; sites++) { /* directions that stay at their sites */
      int order[] = {mix & 1, mix >> 1 & 1, mix >> 2}, total_order = 0;
      double place[3][ROOM];
      size_t shape[3];
      for (int d = 0; d < dim; d++) {
        bool stays = sites >> d & 1;
        shape[d] = stays ? SITES[d] : POINTS[d];
        memcpy(place[d], stays ? site[d] : x[d], sizeof place[d]);
        if (stays) order[d] = -1;
        total_order += order[d] > 0;
      }
      const int derivative[] = {order[0] > 0, order[1] > 0, order[2] > 0};
      for (int again = 0; again < 2; again++) {
        gx_spline_tensor_apply(dim, lines, order, value, again, out, work);
        for (size_t i = 0; i < total(dim, shape); i++)
          NEAR(out[i], (1 + again) * product(dim, ends, derivative, shape, place, i), (1 + again) * tolerance[total_order]);
      }
    }
  for (int d = 0; d < dim; d++) {
    gx_spline_lines_free(line[d]);
    gx_spline_interpolant_free(s[d]);
    gx_spline_points_free(points[d]);
  }
  free(work[0]);
  free(work[1]);
  free(value);
  free(out);
}

static void grids(void **unused)
{
  (void)unused;
  const enum gx_spline_ends open[] = {GX_SPLINE_OPEN, GX_SPLINE_OPEN, GX_SPLINE_OPEN};
  const enum gx_spline_ends mixed[] = {GX_SPLINE_EVEN, GX_SPLINE_PERIODIC, GX_SPLINE_ODD};
  for (int dim = 1; dim <= 3; dim++) {
    grid(dim, open, (const int[]){3, 5, 4}, (const double[]){1e-13, 1e-11, 1e-10, 1e-9});
    grid(dim, mixed, (const int[]){9, 9, 9}, (const double[]){2e-7, 2e-5, 2e-4, 1e-3});
  }
}

/* Neighbours do not count: spline j of many has the bits of itself alone, in the sixteens and in the rest. */
static void check_many(const struct gx_spline_interpolant *s, const struct gx_spline_points *points, uint64_t *state)
{
  enum { MANY = 37 };
  const size_t n = s->knots->sites, functions = s->knots->functions;
  double *in = calloc(n * MANY, sizeof *in), *coefficient = calloc(functions * MANY, sizeof *in);
  double *out = calloc(points->count * MANY, sizeof *in), *one = calloc(n + functions + points->count, sizeof *in);
  for (size_t i = 0; i < n * MANY; i++) in[i] = random_number(state) - 0.5;
  gx_spline_interpolant_solve_many(s, MANY, in, coefficient);
  gx_spline_points_evaluate_many(points, 1, MANY, coefficient, out);
  for (size_t j = 0; j < MANY; j++) {
    for (size_t i = 0; i < n; i++) one[i] = in[i * MANY + j];
    gx_spline_interpolant_solve(s, one, one + n);
    gx_spline_points_evaluate(points, 1, one + n, one + n + functions);
    for (size_t i = 0; i < points->count; i++) NEAR(out[i * MANY + j], one[n + functions + i], 0);
  }
  free(in);
  free(coefficient);
  free(out);
  free(one);
}

/* Every line has the bits it would have alone, wherever it lies and however many there are. */
static void lines_are_independent(void **unused)
{
  (void)unused;
  enum { N = 21, COUNT = 13 };
  static const size_t shapes[][2] = {{1, 1}, {1, 7}, {5, 1}, {40, 1}, {3, 5}, {2, 16}, {2, 31}, {2, 37}, {1, 64}};
  static const enum gx_spline_ends kinds[] = {GX_SPLINE_OPEN, GX_SPLINE_PERIODIC, GX_SPLINE_EVEN, GX_SPLINE_ODD};
  for (int k = 0; k < 4; k++)
    for (int degree = 1; degree <= GX_SPLINE_MAX_DEGREE; degree++) {
      uint64_t state = 5;
      double site[N], x[COUNT], value[N], coefficient[N + 2 * GX_SPLINE_MAX_DEGREE], alone[COUNT];
      struct gx_spline_interpolant *s;
      struct gx_spline_points *points;
      struct gx_spline_lines *lines;
      jittered_sites(N, 0, 1, 0.3, &state, site);
      for (int i = 0; i < COUNT; i++) x[i] = random_number(&state);
      DONE(gx_spline_interpolant_create(&s, kinds[k], degree, N, &error));
      DONE(gx_spline_interpolant_set_sites(s, site, 0, 1, &error));
      DONE(gx_spline_points_create(&points, degree, 3, COUNT, &error));
      gx_spline_points_set(points, s->knots, x);
      DONE(gx_spline_lines_create(&lines, s, points, &error));
      for (size_t h = 0; h < sizeof shapes / sizeof *shapes; h++) {
        const size_t before = shapes[h][0], after = shapes[h][1];
        double *in = calloc(before * N * after, sizeof *in), *out = calloc(before * COUNT * after, sizeof *out);
        for (size_t i = 0; i < before * N * after; i++) in[i] = random_number(&state) - 0.5;
        gx_spline_lines_apply(lines, 1, before, after, in, false, out);
        for (size_t line = 0; line < before * after; line++) {
          const size_t block = line / after, at = line % after;
          for (size_t i = 0; i < N; i++) value[i] = in[(block * N + i) * after + at];
          gx_spline_interpolant_solve(s, value, coefficient);
          gx_spline_points_evaluate(points, 1, coefficient, alone);
          for (size_t i = 0; i < COUNT; i++) NEAR(out[(block * COUNT + i) * after + at], alone[i], 0);
        }
        free(in);
        free(out);
      }
      check_many(s, points, &state);
      gx_spline_lines_free(lines);
      gx_spline_points_free(points);
      gx_spline_interpolant_free(s);
    }
}

static void refusals(void **unused)
{
  (void)unused;
  struct gx_spline_interpolant *s;
  struct gx_spline_points *points;
  struct gx_spline_lines *lines;
  DONE(gx_spline_interpolant_create(&s, GX_SPLINE_OPEN, 3, 10, &error));
  DONE(gx_spline_points_create(&points, 5, 1, 4, &error));
  assert_int_equal(gx_spline_lines_create(&lines, s, points, &error), GX_SPLINE_DEGREE);
  assert_null(lines);
  gx_spline_interpolant_free(s);
  gx_spline_points_free(points);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(grids), cmocka_unit_test(lines_are_independent),
                                     cmocka_unit_test(refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
