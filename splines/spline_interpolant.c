/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interpolation by collocation: the spline that takes given values at given sites. */
#include <gridcross_splines.h>

#include "spline_band.h"
#include "spline_basis.h"
#include "spline_border.h"

#include <stdlib.h>
#include <string.h>

/* Rows sum to one: less than this adds nothing to any digit, and arises where a site meets a knot but for rounding. */
static const double NOTHING = 1e-30;

enum gx_spline_status gx_spline_interpolant_create(struct gx_spline_interpolant **interpolant, enum gx_spline_ends ends,
                                                   int degree, size_t sites, struct gx_spline_error *error)
{
  *interpolant = NULL;
  struct gx_spline_knots *knots;
  enum gx_spline_status status = gx_spline_knots_create(&knots, ends, degree, sites, error);
  if (status != GX_SPLINE_OK) return status;
  struct gx_spline_interpolant *s = calloc(1, sizeof *s);
  double *band = calloc(sites * (2 * (size_t)degree + 1), sizeof *band);
  double *scratch = calloc(sites + knots->functions, sizeof *scratch);
  struct gx_spline_border *border = ends == GX_SPLINE_PERIODIC ? gx_spline_border_create(degree, sites) : NULL;
  if (!s || !band || !scratch || (ends == GX_SPLINE_PERIODIC && !border)) {
    free(s);
    free(band);
    free(scratch);
    gx_spline_border_free(border);
    gx_spline_knots_free(knots);
    return gx_spline_error_set(error, GX_SPLINE_MEMORY, -1, "out of memory for a spline of %zu sites", sites);
  }
  *s = (struct gx_spline_interpolant){.knots = knots, .band = band, .border = border, .scratch = scratch};
  *interpolant = s;
  return GX_SPLINE_OK;
}

void gx_spline_interpolant_free(struct gx_spline_interpolant *interpolant)
{
  if (!interpolant) return;
  gx_spline_knots_free(interpolant->knots);
  gx_spline_border_free(interpolant->border);
  free(interpolant->band);
  free(interpolant->scratch);
  free(interpolant);
}

static struct gx_spline_band band_of(const struct gx_spline_interpolant *s)
{
  return (struct gx_spline_band){s->knots->degree, s->lower, s->upper, s->knots->sites, s->band};
}

/* Offset from row i of the coefficient that stands for function j of the endless sequence, with the sign it enters with. */
static ptrdiff_t fold(const struct gx_spline_knots *knots, ptrdiff_t i, ptrdiff_t j, double *sign)
{
  const ptrdiff_t n = (ptrdiff_t)knots->sites;
  *sign = 1;
  if (knots->ends == GX_SPLINE_PERIODIC || (j >= 0 && j < n)) return j - i; /* the border wraps */
  if (knots->ends == GX_SPLINE_ODD) *sign = -1;
  return (j < 0 ? knots->at_end[0] - 1 - j : 2 * n - 1 - knots->at_end[1] - j) - i;
}

GX_SPLINE_CORE long assemble(const int degree, struct gx_spline_interpolant *s, const double *site)
{
  const struct gx_spline_knots *knots = s->knots;
  const ptrdiff_t n = (ptrdiff_t)knots->sites, g = (ptrdiff_t)knots->ghosts;
  const bool periodic = knots->ends == GX_SPLINE_PERIODIC;
  int lower = 0, upper = 0;
  size_t piece = (size_t)degree;
  double *diagonal = s->band + degree;
  for (ptrdiff_t i = 0; i < n; i++, diagonal += 2 * degree + 1) {
    double S[GX_SPLINE_MAX_DEGREE + 1] = {0};
    piece = gx_spline_basis_locate(knots, site[i], piece);
    gx_spline_basis_values(degree, knots, piece, site[i], S);
    const ptrdiff_t offset = (ptrdiff_t)piece - degree - g - i; /* of the first function from the diagonal */
    if (offset > 0 || offset < -degree || !(S[-offset] > 0)) return (long)i;
    for (int d = -degree; d <= degree; d++) diagonal[d] = 0;
    int begin = 0, end = degree;
    while (begin < -offset && S[begin] < NOTHING) begin++;
    while (end > -offset && S[end] < NOTHING) end--;
    if (periodic || (i + offset >= 0 && i + offset + degree < n)) {
      for (int j = 0; j <= degree; j++) diagonal[offset + j] = S[j];
      if (-(offset + begin) > lower) lower = (int)-(offset + begin);
      if (offset + end > upper) upper = (int)(offset + end);
      continue;
    }
    for (int j = begin; j <= end; j++) {
      double sign;
      ptrdiff_t d = fold(knots, i, i + offset + j, &sign);
      diagonal[d] += sign * S[j];
      if (-d > lower) lower = (int)-d;
      if (d > upper) upper = (int)d;
    }
  }
  s->lower = lower;
  s->upper = upper;
  return -1;
}

static long assemble_any(struct gx_spline_interpolant *s, const double *site)
{
  GX_SPLINE_FOR_DEGREE(s->knots->degree, return assemble(degree, s, site))
  return 0;
}

enum gx_spline_status gx_spline_interpolant_collocate(struct gx_spline_interpolant *interpolant, const double *site,
                                                      struct gx_spline_error *error)
{
  const struct gx_spline_knots *knots = interpolant->knots;
  for (size_t i = 1; i < knots->sites; i++)
    if (!(site[i] > site[i - 1]))
      return gx_spline_error_set(error, GX_SPLINE_NOT_INCREASING, (long)i,
                                 "sites must increase, but site %zu at %.17g follows one at %.17g", i, site[i], site[i - 1]);
  if (knots->ends == GX_SPLINE_OPEN && !(site[0] >= knots->low && site[knots->sites - 1] <= knots->high))
    return gx_spline_error_set(error, GX_SPLINE_OUTSIDE, site[0] >= knots->low ? (long)knots->sites - 1 : 0,
                               "sites from %.17g to %.17g reach beyond the knots from %.17g to %.17g", site[0],
                               site[knots->sites - 1], knots->low, knots->high);
  long fault = assemble_any(interpolant, site);
  if (fault >= 0)
    return gx_spline_error_set(error, GX_SPLINE_SCHOENBERG_WHITNEY, fault,
                               "site %ld at %.17g lies outside the support of function %ld, between knots %.17g and %.17g "
                               "(Schoenberg-Whitney)",
                               fault, site[fault], fault, knots->knot[(size_t)fault + knots->ghosts],
                               knots->knot[(size_t)fault + knots->ghosts + (size_t)knots->degree + 1]);
  struct gx_spline_band band = band_of(interpolant);
  fault = interpolant->border ? gx_spline_border_factor(interpolant->border, &band) : gx_spline_band_factor(&band);
  if (fault < 0) return GX_SPLINE_OK;
  return gx_spline_error_set(error, GX_SPLINE_SINGULAR, fault,
                             "the collocation matrix is singular to rounding at site %ld of %zu, at %.17g", fault, knots->sites,
                             site[fault]);
}

enum gx_spline_status gx_spline_interpolant_set_sites(struct gx_spline_interpolant *interpolant, const double *site, double low,
                                                      double high, struct gx_spline_error *error)
{
  enum gx_spline_status status = gx_spline_knots_average(interpolant->knots, site, low, high, error);
  return status == GX_SPLINE_OK ? gx_spline_interpolant_collocate(interpolant, site, error) : status;
}

void gx_spline_interpolant_solve(const struct gx_spline_interpolant *interpolant, const double *value, double *coefficient)
{
  struct gx_spline_band band = band_of(interpolant);
  double *x = coefficient + interpolant->knots->ghosts;
  if (interpolant->border)
    gx_spline_border_solve(interpolant->border, &band, 1, value, x);
  else
    gx_spline_band_solve(&band, value, x);
  gx_spline_knots_close(interpolant->knots, 1, coefficient);
}

void gx_spline_interpolant_solve_many(const struct gx_spline_interpolant *interpolant, size_t count, const double *value,
                                      double *coefficient)
{
  struct gx_spline_band band = band_of(interpolant);
  double *x = coefficient + interpolant->knots->ghosts * count;
  if (interpolant->border)
    gx_spline_border_solve(interpolant->border, &band, count, value, x);
  else
    gx_spline_band_solve_many(&band, count, value, x);
  gx_spline_knots_close(interpolant->knots, count, coefficient);
}

double gx_spline_interpolant_condition(struct gx_spline_interpolant *interpolant)
{
  const struct gx_spline_knots *knots = interpolant->knots;
  double *sign = interpolant->scratch, *coefficient = sign + knots->sites, largest = 0;
  for (size_t i = 0; i < knots->sites; i++) sign[i] = i % 2 ? -1 : 1;
  gx_spline_interpolant_solve(interpolant, sign, coefficient);
  for (size_t i = 0; i < knots->sites; i++) largest = fmax(largest, fabs(coefficient[knots->ghosts + i]));
  return largest; /* the norm of the matrix itself is 1: its rows sum to one */
}
