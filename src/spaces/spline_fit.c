/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two interpolants between fixed ends, of fields that are odd and even there; on a ring one. */
#include "spline_fit.h"

#include <stdlib.h>

#include <gsl/gsl_heapsort.h>

#include <gridcross_splines.h>

#include "sites.h"

struct spline_fit {
  struct gx_fit fit;
  bool periodic;
  size_t n;
  const double *point;                      /* borrowed */
  struct gx_outcome *outcome;               /* borrowed */
  struct gx_spline_interpolant *even, *odd; /* odd NULL: periodic */
  struct gx_spline_points *points;
  size_t *order;       /* [n] particles from left to right */
  double *value;       /* [n] a field in that order */
  double *site;        /* [n] positions in that order, held to the ends, past which round-off may carry them */
  double *coefficient; /* [functions] */
};

static void release(struct gx_fit *fit)
{
  struct spline_fit *s = (struct spline_fit *)fit;
  if (!s) return;
  gx_spline_interpolant_free(s->even);
  gx_spline_interpolant_free(s->odd);
  gx_spline_points_free(s->points);
  free(s->order);
  free(s->value);
  free(s->site);
  free(s->coefficient);
  free(s);
}

static enum gx_status report(const struct spline_fit *s, const struct gx_spline_error *error)
{
  enum gx_status status = gx_sites_report(s->outcome, error, s->n, s->site, s->periodic, false);
  if (s->outcome->particle >= 0) s->outcome->particle = (long)s->order[s->outcome->particle];
  return status;
}

static enum gx_status place(struct gx_fit *fit, const double *const *x)
{
  struct spline_fit *s = (struct spline_fit *)fit;
  struct gx_spline_error error;
  for (size_t p = 0; p < s->n; p++) {
    double at = x[0][s->order[p]];
    s->site[p] = s->periodic ? at : at < 0 ? 0 : at > 1 ? 1 : at;
  }
  if (gx_spline_interpolant_set_sites(s->even, s->site, 0, 1, &error)) return report(s, &error);
  if (s->odd && gx_spline_interpolant_set_sites(s->odd, s->site, 0, 1, &error)) return report(s, &error);
  gx_spline_points_set(s->points, s->even->knots, s->point); /* both have the same knots */
  return GX_OK;
}

static void take(struct gx_fit *fit, int count, bool odd, double *const *value, double *const *out)
{
  struct spline_fit *s = (struct spline_fit *)fit;
  for (int i = 0; i < count; i++) {
    for (size_t p = 0; p < s->n; p++) s->value[p] = value[i][s->order[p]];
    gx_spline_interpolant_solve(odd && s->odd ? s->odd : s->even, s->value, s->coefficient);
    gx_spline_points_evaluate(s->points, 0, s->coefficient, out[i]);
  }
}

static int compare(const void *a, const void *b)
{
  const double left = *(const double *)a, right = *(const double *)b;
  return (left > right) - (left < right);
}

static const struct gx_fit_kind kind = {.free = release, .place = place, .take = take};

enum gx_status gx_spline_fit_create(struct gx_fit **fit, int p, bool periodic, size_t n, const double *X, size_t points,
                                    const double *point, struct gx_outcome *outcome)
{
  int degree = p + 2 < GX_SPLINE_MAX_DEGREE ? p + 2 : GX_SPLINE_MAX_DEGREE;
  if (n < (size_t)degree + 1)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "quadrature reconstructed at degree %d takes splines of degree %d, which need %d particles or more, and "
                         "there are %zu",
                         p, degree, degree + 1, n);
  struct spline_fit *s = calloc(1, sizeof *s);
  if (!s) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  *s = (struct spline_fit){.fit = {.kind = &kind}, .periodic = periodic, .n = n, .point = point, .outcome = outcome};
  struct gx_spline_error error = {.status = GX_SPLINE_OK};
  if (!gx_spline_interpolant_create(&s->even, periodic ? GX_SPLINE_PERIODIC : GX_SPLINE_EVEN, degree, n, &error) && !periodic)
    gx_spline_interpolant_create(&s->odd, GX_SPLINE_ODD, degree, n, &error);
  if (!error.status) gx_spline_points_create(&s->points, degree, 1, points, &error);
  if (!error.status) {
    s->order = malloc(n * sizeof *s->order);
    s->value = malloc(n * sizeof(double));
    s->site = malloc(n * sizeof(double));
    s->coefficient = malloc(s->even->knots->functions * sizeof(double));
  }
  if (error.status || !s->order || !s->value || !s->site || !s->coefficient) {
    release(&s->fit);
    return gx_status_set(outcome, GX_FAILED, -1, "out of memory for splines through %zu particles", n);
  }
  gsl_heapsort_index(s->order, X, n, sizeof *X, compare);
  *fit = &s->fit;
  return GX_OK;
}
