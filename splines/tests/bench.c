/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Costs per point, beside GSL's own evaluation. usage: bench [SITES] */
#include <gridcross_splines.h>

#include <gsl/gsl_bspline.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "sites.h"

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

/* The best of forty runs of `repeats` each, in ns per point. */
#define TIME(result, statement)                                                                                                  \
  do {                                                                                                                           \
    result = HUGE_VAL;                                                                                                           \
    for (int time_i = 0; time_i < 40; time_i++) {                                                                                \
      double time_start = now();                                                                                                 \
      for (size_t time_r = 0; time_r < repeats; time_r++) statement;                                                             \
      result = fmin(result, (now() - time_start) / (double)(repeats * n));                                                       \
    }                                                                                                                            \
  } while (0)

static void gsl_points(const struct gx_spline_knots *knots, size_t n, const double *x, double *out)
{
  const size_t p = (size_t)knots->degree;
  gsl_bspline_workspace *w = gsl_bspline_alloc(p + 1, knots->sites - p + 1);
  for (size_t i = 0; i < w->knots->size; i++) gsl_vector_set(w->knots, i, knots->knot[i]);
  gsl_vector *B = gsl_vector_alloc(p + 1);
  gsl_matrix *dB = gsl_matrix_alloc(p + 1, 2);
  const size_t repeats = 1 + 10000 / n;
  size_t first, last;
  TIME(out[0], for (size_t i = 0; i < n; i++) gsl_bspline_eval_nonzero(x[i], B, &first, &last, w));
  TIME(out[1], for (size_t i = 0; i < n; i++) gsl_bspline_deriv_eval_nonzero(x[i], 1, dB, &first, &last, w));
  gsl_matrix_free(dB);
  gsl_vector_free(B);
  gsl_bspline_free(w);
}

static void line(enum gx_spline_ends ends, int degree, size_t n)
{
  static const char *const name[] = {"open", "periodic", "even", "odd"};
  double *x = calloc(3 * n, sizeof *x), *value = x + n, *out = x + 2 * n;
  struct gx_spline_interpolant *s;
  struct gx_spline_points *values, *slopes;
  struct gx_spline_error error;
  uint64_t state = 1;
  jittered_sites(n, 0, 1, 0.4, &state, x);
  for (size_t i = 0; i < n; i++) value[i] = sin(6 * x[i]);
  if (gx_spline_interpolant_create(&s, ends, degree, n, &error) || gx_spline_interpolant_set_sites(s, x, 0, 1, &error) ||
      gx_spline_points_create(&values, degree, 1, n, &error) || gx_spline_points_create(&slopes, degree, 2, n, &error)) {
    fprintf(stderr, "%s\n", error.message);
    exit(1);
  }
  double *c = calloc(s->knots->functions, sizeof *c);
  const size_t repeats = 1 + 20000 / n;
  double knots, sites, solve, set_values, set_slopes, product, gsl[2] = {NAN, NAN};
  TIME(knots, gx_spline_knots_average(s->knots, x, 0, 1, NULL));
  TIME(sites, gx_spline_interpolant_set_sites(s, x, 0, 1, NULL));
  TIME(solve, gx_spline_interpolant_solve(s, value, c));
  TIME(set_values, gx_spline_points_set(values, s->knots, x));
  TIME(set_slopes, gx_spline_points_set(slopes, s->knots, x));
  TIME(product, gx_spline_points_evaluate(slopes, 1, c, out));
  if (ends == GX_SPLINE_OPEN) gsl_points(s->knots, n, x, gsl);
  printf("%-9s %d %6zu  %d+%d  %7.1f %7.1f %7.1f %7.1f %7.1f %7.1f  %7.1f %7.1f\n", name[ends], degree, n, s->lower, s->upper,
         knots, sites, solve, set_values, set_slopes, product, gsl[0], gsl[1]);
  gx_spline_points_free(values);
  gx_spline_points_free(slopes);
  gx_spline_interpolant_free(s);
  free(c);
  free(x);
}

static void circulant(int degree, size_t n)
{
  struct gx_spline_circulant *c;
  if (gx_spline_circulant_create(&c, degree, n, 1, NULL)) exit(1);
  double *value = calloc(n, sizeof *value), *out = calloc(n + 2 * (size_t)degree, sizeof *out), solve, slope;
  for (size_t i = 0; i < n; i++) value[i] = sin(6.28 * (double)i / (double)n);
  const size_t repeats = 1 + 20000 / n;
  TIME(solve, gx_spline_circulant_solve(c, value, out));
  TIME(slope, gx_spline_circulant_derivative(c, 1, value, out));
  printf("circulant %d %6zu  solve %.1f, derivative at the sites from values %.1f\n", degree, n, solve, slope);
  gx_spline_circulant_free(c);
  free(value);
  free(out);
}

int main(int count, char **argument)
{
  const size_t sites[] = {40, 160, 10000};
  printf("ns per point                 ----------------- own -----------------------------------  ----- gsl -----\n"
         "ends  degree  sites band   knots  +matrix   solve  values  slopes product   values  slopes\n");
  for (int i = 0; i < (count > 1 ? 1 : 3); i++) {
    size_t n = count > 1 ? strtoul(argument[1], NULL, 10) : sites[i];
    for (int degree = 3; degree <= 9; degree += 2)
      for (int ends = GX_SPLINE_OPEN; ends <= GX_SPLINE_EVEN; ends++) line((enum gx_spline_ends)ends, degree, n);
    for (int degree = 3; degree <= 9; degree += 2) circulant(degree, n);
  }
}
