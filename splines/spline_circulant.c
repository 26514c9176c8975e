/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uniform periodic sites: collocation and differentiation commute with shifts, so that a transform makes them products. */
#include <gridcross_splines.h>

#include <fftw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct gx_spline_circulant {
  size_t sites;
  struct gx_spline_knots *knots;
  fftw_plan forward, backward;
  double *line;            /* [sites] */
  fftw_complex *transform; /* [sites / 2 + 1] */
  double *solve;           /* [sites / 2 + 1], 1 / (sites * symbol of the values) */
  double *symbol;          /* [degree][sites / 2 + 1], over the symbol of the values; imaginary for odd orders */
};

static bool plan(struct gx_spline_circulant *c)
{
  const int n = (int)c->sites;
  fftw_make_planner_thread_safe();
  c->forward = fftw_plan_dft_r2c_1d(n, c->line, c->transform, FFTW_ESTIMATE);
  c->backward = fftw_plan_dft_c2r_1d(n, c->transform, c->line, FFTW_ESTIMATE);
  return c->forward && c->backward;
}

/* Derivatives at site 0 of the functions that do not vanish there; the first one's number, ghosts counted. */
static enum gx_spline_status stencil(const struct gx_spline_circulant *c, int order, double *weight, size_t *first,
                                     struct gx_spline_error *error)
{
  struct gx_spline_points *point;
  const double origin = 0;
  enum gx_spline_status status = gx_spline_points_create(&point, c->knots->degree, 1U << order, 1, error);
  if (status != GX_SPLINE_OK) return status;
  gx_spline_points_set(point, c->knots, &origin);
  memcpy(weight, point->weight[order], ((size_t)c->knots->degree + 1) * sizeof *weight);
  *first = point->first[0];
  gx_spline_points_free(point);
  return GX_SPLINE_OK;
}

/* Functions at equal distances have equal values, or opposite ones for odd orders: the symbol is a sum of cosines or sines. */
static enum gx_spline_status find_symbols(struct gx_spline_circulant *c, struct gx_spline_error *error)
{
  const int p = c->knots->degree, g = (int)c->knots->ghosts;
  const size_t n = c->sites, half = n / 2 + 1;
  for (int order = 0; order < p; order++) {
    double weight[GX_SPLINE_MAX_DEGREE + 1], *symbol = c->symbol + (size_t)order * half;
    size_t first;
    enum gx_spline_status status = stencil(c, order, weight, &first, error);
    if (status != GX_SPLINE_OK) return status;
    for (size_t m = 0; m < half; m++) {
      double sum = 0;
      for (int j = 0; j <= p; j++) {
        long turn = (long)m * (long)((int)first + j - g) % (long)n;
        double angle = 2 * M_PI * (double)turn / (double)n;
        sum += weight[j] * (order % 2 ? sin(angle) : cos(angle));
      }
      symbol[m] = sum;
    }
  }
  for (size_t m = 0; m < half; m++) {
    c->solve[m] = 1 / (c->symbol[m] * (double)n);
    for (int order = p - 1; order >= 0; order--) c->symbol[(size_t)order * half + m] *= c->solve[m];
  }
  return GX_SPLINE_OK;
}

static enum gx_spline_status uniform_knots(struct gx_spline_circulant *c, int degree, double period,
                                           struct gx_spline_error *error)
{
  enum gx_spline_status status = gx_spline_knots_create(&c->knots, GX_SPLINE_PERIODIC, degree, c->sites, error);
  if (status != GX_SPLINE_OK) return status;
  for (size_t j = 0; j < c->sites; j++) c->line[j] = period * ((double)j / (double)c->sites);
  return gx_spline_knots_average(c->knots, c->line, 0, period, error);
}

enum gx_spline_status gx_spline_circulant_create(struct gx_spline_circulant **circulant, int degree, size_t sites, double period,
                                                 struct gx_spline_error *error)
{
  *circulant = NULL;
  if (degree < 1 || degree > GX_SPLINE_MAX_DEGREE)
    return gx_spline_error_set(error, GX_SPLINE_DEGREE, -1, "degree %d is not one of 1 to %d", degree, GX_SPLINE_MAX_DEGREE);
  struct gx_spline_circulant *c = calloc(1, sizeof *c);
  if (!c) return gx_spline_error_set(error, GX_SPLINE_MEMORY, -1, "out of memory for a spline of %zu sites", sites);
  const size_t half = sites / 2 + 1;
  c->sites = sites;
  c->line = fftw_malloc((sites + 1) * sizeof *c->line);
  c->transform = fftw_malloc(half * sizeof *c->transform);
  c->solve = calloc(half * (size_t)(degree + 1), sizeof *c->solve);
  enum gx_spline_status status = GX_SPLINE_MEMORY;
  if (!c->line || !c->transform || !c->solve)
    gx_spline_error_set(error, status, -1, "out of memory for a spline of %zu sites", sites);
  else {
    c->symbol = c->solve + half;
    status = uniform_knots(c, degree, period, error);
    if (status == GX_SPLINE_OK) status = find_symbols(c, error);
    if (status == GX_SPLINE_OK && !plan(c))
      status = gx_spline_error_set(error, GX_SPLINE_MEMORY, -1, "no transform of %zu sites", sites);
  }
  if (status == GX_SPLINE_OK)
    *circulant = c;
  else
    gx_spline_circulant_free(c);
  return status;
}

void gx_spline_circulant_free(struct gx_spline_circulant *circulant)
{
  if (!circulant) return;
  if (circulant->forward) fftw_destroy_plan(circulant->forward);
  if (circulant->backward) fftw_destroy_plan(circulant->backward);
  fftw_free(circulant->line);
  fftw_free(circulant->transform);
  free(circulant->solve);
  gx_spline_knots_free(circulant->knots);
  free(circulant);
}

const struct gx_spline_knots *gx_spline_circulant_knots(const struct gx_spline_circulant *circulant)
{
  return circulant->knots;
}

static void apply(struct gx_spline_circulant *c, bool imaginary, const double *symbol, const double *value, double *out)
{
  const size_t half = c->sites / 2 + 1;
  memcpy(c->line, value, c->sites * sizeof *value);
  fftw_execute(c->forward);
  for (size_t m = 0; m < half; m++) {
    double real = c->transform[m][0] * symbol[m], rest = c->transform[m][1] * symbol[m];
    c->transform[m][0] = imaginary ? -rest : real;
    c->transform[m][1] = imaginary ? real : rest;
  }
  fftw_execute(c->backward);
  memcpy(out, c->line, c->sites * sizeof *out);
}

void gx_spline_circulant_solve(struct gx_spline_circulant *circulant, const double *value, double *coefficient)
{
  apply(circulant, false, circulant->solve, value, coefficient + circulant->knots->ghosts);
  gx_spline_knots_close(circulant->knots, 1, coefficient);
}

void gx_spline_circulant_derivative(struct gx_spline_circulant *circulant, int order, const double *value, double *out)
{
  apply(circulant, order % 2, circulant->symbol + (size_t)order * (circulant->sites / 2 + 1), value, out);
}
