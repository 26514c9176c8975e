/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of splines in terms of particles: left the domain, tangled, at no finite place. */
#include "sites.h"

#include <math.h>

static enum gx_status misplaced(struct gx_outcome *outcome, const struct gx_spline_error *error, size_t n, const double *x,
                                bool periodic, bool within)
{
  for (size_t p = 0; p < n; p++)
    if (!isfinite(x[p])) return gx_status_set(outcome, GX_UNSTABLE, (long)p, "a particle is at %g", x[p]);
  for (size_t p = 0; p < n && !periodic; p++)
    if (within ? !(x[p] > 0 && x[p] < 1) : !(x[p] >= 0 && x[p] <= 1))
      return gx_status_set(outcome, GX_LEFT_DOMAIN, (long)p, "a particle is at %.6g, past the fixed end at %d", x[p], x[p] > 0.5);
  for (size_t p = 1; p < n; p++)
    if (!(x[p] > x[p - 1]))
      return gx_status_set(outcome, GX_TANGLED, (long)p, "a particle at %.17g has met or passed its neighbour at %.17g", x[p],
                           x[p - 1]);
  if (periodic && error->status == GX_SPLINE_OUTSIDE)
    return gx_status_set(outcome, GX_TANGLED, (long)n - 1, "a particle at %.17g has met or passed the first one's image at %.17g",
                         x[n - 1], x[0] + 1);
  return gx_status_set(outcome, GX_REFUSED, -1, "%s", error->message);
}

enum gx_status gx_sites_report(struct gx_outcome *outcome, const struct gx_spline_error *error, size_t n, const double *x,
                               bool periodic, bool within)
{
  if (error->status == GX_SPLINE_NOT_INCREASING || error->status == GX_SPLINE_OUTSIDE)
    return misplaced(outcome, error, n, x, periodic, within);
  enum gx_status status = error->status == GX_SPLINE_MEMORY     ? GX_FAILED
                          : error->status == GX_SPLINE_SINGULAR ? GX_SINGULAR
                                                                : GX_REFUSED;
  return gx_status_set(outcome, status, -1, "%s", error->message);
}
