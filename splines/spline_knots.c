/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Knot sequences: averages of sites (aptknt; de Boor, Practical Guide, ch. XIII), open uniform, given. */
#include <gridcross_splines.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum gx_spline_status gx_spline_knots_create(struct gx_spline_knots **knots, enum gx_spline_ends ends, int degree, size_t sites,
                                             struct gx_spline_error *error)
{
  *knots = NULL;
  if (degree < 1 || degree > GX_SPLINE_MAX_DEGREE)
    return gx_spline_error_set(error, GX_SPLINE_DEGREE, -1, "degree %d is not one of 1 to %d", degree, GX_SPLINE_MAX_DEGREE);
  if (sites < (size_t)degree + 1)
    return gx_spline_error_set(error, GX_SPLINE_TOO_FEW, -1, "a spline of degree %d needs %d sites or more, and has %zu", degree,
                               degree + 1, sites);
  const size_t p = (size_t)degree;
  /* Functions that reach into the domain from beyond an end: half of the knots of one that straddles a mirror; all but one of a
   * periodic one. */
  const size_t ghosts = ends == GX_SPLINE_OPEN ? 0 : ends == GX_SPLINE_PERIODIC ? p : p / 2 + 1;
  const size_t functions = sites + 2 * ghosts, length = functions + p + 1, beyond = ends == GX_SPLINE_OPEN ? 0 : ghosts + p;
  struct gx_spline_knots *k = malloc(sizeof *k);
  double *memory = calloc(length * (p + 1) + sites + 2 * beyond, sizeof *memory);
  if (!k || !memory) {
    free(k);
    free(memory);
    return gx_spline_error_set(error, GX_SPLINE_MEMORY, -1, "out of memory for a spline of %zu sites", sites);
  }
  *k = (struct gx_spline_knots){.ends = ends,
                                .degree = degree,
                                .sites = sites,
                                .ghosts = ghosts,
                                .functions = functions,
                                .knot = memory,
                                .inverse = memory + length,
                                .extended = memory + length * (p + 1),
                                .beyond = beyond};
  *knots = k;
  return GX_SPLINE_OK;
}

void gx_spline_knots_free(struct gx_spline_knots *knots)
{
  if (!knots) return;
  free(knots->knot);
  free(knots);
}

static void invert_widths(struct gx_spline_knots *knots)
{
  const size_t length = knots->functions + (size_t)knots->degree + 1;
  const double *t = knots->knot;
  for (int q = 1; q <= knots->degree; q++) {
    double *restrict inverse = knots->inverse + (size_t)(q - 1) * length;
    for (size_t i = 0; i < length - (size_t)q; i++) {
      double width = t[i + (size_t)q] - t[i];
      inverse[i] = width > 0 ? 1 / width : 0;
    }
  }
}

static enum gx_spline_status check_sites(const struct gx_spline_knots *knots, const double *site, double low, double high,
                                         struct gx_spline_error *error)
{
  const size_t n = knots->sites;
  bool increasing = isfinite(site[0]) && isfinite(site[n - 1]);
  for (size_t i = 1; i < n; i++) increasing &= site[i] > site[i - 1];
  if (!increasing) {
    size_t i = isfinite(site[0]) ? 1 : 0;
    while (i && i < n - 1 && site[i] > site[i - 1]) i++;
    return gx_spline_error_set(error, GX_SPLINE_NOT_INCREASING, (long)i,
                               "sites must be finite and increase, but site %zu at %.17g follows one at %.17g", i, site[i],
                               i ? site[i - 1] : site[0]);
  }
  if (knots->ends == GX_SPLINE_OPEN) return GX_SPLINE_OK;
  if (!(low < high) || !isfinite(high - low))
    return gx_spline_error_set(error, GX_SPLINE_OUTSIDE, -1, "the ends %.17g and %.17g do not enclose a domain", low, high);
  if (knots->ends == GX_SPLINE_PERIODIC) {
    if (site[n - 1] - site[0] < high - low) return GX_SPLINE_OK;
    return gx_spline_error_set(error, GX_SPLINE_OUTSIDE, (long)(n - 1),
                               "sites from %.17g to %.17g do not fit into a period of %.17g", site[0], site[n - 1], high - low);
  }
  if (site[0] >= low && site[n - 1] <= high) return GX_SPLINE_OK;
  size_t i = site[0] >= low ? n - 1 : 0;
  return gx_spline_error_set(error, GX_SPLINE_OUTSIDE, (long)i, "site %zu at %.17g lies outside the ends %.17g and %.17g", i,
                             site[i], low, high);
}

static void average_open(struct gx_spline_knots *knots, const double *site)
{
  const size_t n = knots->sites, p = (size_t)knots->degree;
  double *t = knots->knot;
  for (size_t i = 0; i <= p; i++) {
    t[i] = site[0];
    t[n + i] = site[n - 1];
  }
  const double share = 1.0 / (double)p;
  for (size_t j = 0; j + p + 1 < n; j++) {
    double sum = 0;
    for (size_t i = 1; i <= p; i++) sum += site[j + i];
    t[j + p + 1] = p == 1 ? sum : sum * share;
  }
}

/* Sites continued by the period or by mirrors; a site on a mirror is its own image. */
static const double *extend(struct gx_spline_knots *knots, const double *site, double low, double high)
{
  const ptrdiff_t n = (ptrdiff_t)knots->sites, beyond = (ptrdiff_t)knots->beyond;
  double *x = knots->extended + beyond;
  memcpy(x, site, knots->sites * sizeof *x);
  if (knots->ends == GX_SPLINE_PERIODIC) {
    for (ptrdiff_t i = 0; i < beyond; i++) {
      x[-1 - i] = x[n - 1 - i] - (high - low);
      x[n + i] = x[i] + (high - low);
    }
  } else {
    const int skip_low = knots->at_end[0], skip_high = knots->at_end[1];
    for (ptrdiff_t i = 0; i < beyond; i++) {
      x[-1 - i] = 2 * low - x[i + skip_low];
      x[n + i] = 2 * high - x[n - 1 - i - skip_high];
    }
  }
  return x;
}

/* Knot i is the mean of sites i - degree ... i - 1, about their own middle so that uniform sites keep every digit. */
static void average_closed(struct gx_spline_knots *knots, const double *x)
{
  const ptrdiff_t p = knots->degree, g = (ptrdiff_t)knots->ghosts, last = (ptrdiff_t)(knots->functions) - g + p;
  const double share = 1.0 / (double)p;
  for (ptrdiff_t i = -g; i <= last; i++) {
    const double *window = x + i - p, middle = window[p / 2];
    double sum = 0;
    for (ptrdiff_t j = 0; j < p; j++) sum += window[j] - middle;
    knots->knot[i + g] = middle + sum * share;
  }
}

enum gx_spline_status gx_spline_knots_average(struct gx_spline_knots *knots, const double *site, double low, double high,
                                              struct gx_spline_error *error)
{
  enum gx_spline_status status = check_sites(knots, site, low, high, error);
  if (status != GX_SPLINE_OK) return status;
  if (knots->ends == GX_SPLINE_OPEN) {
    knots->low = site[0];
    knots->high = site[knots->sites - 1];
    average_open(knots, site);
  } else {
    bool mirrored = knots->ends != GX_SPLINE_PERIODIC;
    knots->at_end[0] = mirrored && site[0] == low;
    knots->at_end[1] = mirrored && site[knots->sites - 1] == high;
    knots->low = mirrored ? low : site[0];
    knots->high = mirrored ? high : site[0] + (high - low);
    average_closed(knots, extend(knots, site, low, high));
  }
  invert_widths(knots);
  return GX_SPLINE_OK;
}

enum gx_spline_status gx_spline_knots_given(struct gx_spline_knots *knots, const double *knot, struct gx_spline_error *error)
{
  const size_t n = knots->sites, p = (size_t)knots->degree;
  if (knots->ends != GX_SPLINE_OPEN)
    return gx_spline_error_set(error, GX_SPLINE_OUTSIDE, -1, "knots can be given for open splines only");
  bool ordered = isfinite(knot[0]) && isfinite(knot[n + p]) && knot[p] < knot[n];
  for (size_t i = 1; i <= n + p; i++) ordered &= knot[i] >= knot[i - 1];
  for (size_t i = 0; i < n; i++) ordered &= knot[i + p + 1] > knot[i];
  if (!ordered)
    return gx_spline_error_set(error, GX_SPLINE_NOT_INCREASING, -1,
                               "knots must be finite, must not decrease, and none may stand more than degree + 1 times");
  memcpy(knots->knot, knot, (n + p + 1) * sizeof *knot);
  knots->low = knot[p];
  knots->high = knot[n];
  invert_widths(knots);
  return GX_SPLINE_OK;
}

enum gx_spline_status gx_spline_knots_uniform(struct gx_spline_knots *knots, double low, double high,
                                              struct gx_spline_error *error)
{
  const size_t n = knots->sites, p = (size_t)knots->degree, pieces = n - p;
  if (knots->ends != GX_SPLINE_OPEN || !(low < high) || !isfinite(high - low))
    return gx_spline_error_set(error, GX_SPLINE_OUTSIDE, -1, "open uniform knots need open ends, low < high (%.17g, %.17g)", low,
                               high);
  double *t = knots->knot;
  for (size_t i = 0; i <= p; i++) {
    t[i] = low;
    t[n + i] = high;
  }
  for (size_t i = 1; i < pieces; i++) t[p + i] = low + (high - low) * ((double)i / (double)pieces);
  knots->low = low;
  knots->high = high;
  invert_widths(knots);
  return GX_SPLINE_OK;
}

void gx_spline_knots_close(const struct gx_spline_knots *knots, size_t count, double *coefficient)
{
  const ptrdiff_t n = (ptrdiff_t)knots->sites, g = (ptrdiff_t)knots->ghosts;
  const double sign = knots->ends == GX_SPLINE_ODD ? -1 : 1;
  const bool periodic = knots->ends == GX_SPLINE_PERIODIC;
  for (ptrdiff_t i = 0; i < g; i++) {
    ptrdiff_t left = periodic ? n - 1 - i : i + knots->at_end[0], right = periodic ? i : n - 1 - i - knots->at_end[1];
    for (size_t s = 0; s < count; s++) {
      coefficient[(size_t)(g - 1 - i) * count + s] = sign * coefficient[(size_t)(g + left) * count + s];
      coefficient[(size_t)(g + n + i) * count + s] = sign * coefficient[(size_t)(g + right) * count + s];
    }
  }
}
