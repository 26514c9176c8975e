/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which reference points belong to a box, a disk or a ring, and which of these make sense. */
#include "body.h"

#include <math.h>

static const double edge = 1e-12; /* m: round-off of points and edges that are given in decimals */

bool gx_body_inside(const struct gx_problem_options *options, const double *X)
{
  const struct gx_body *body = &options->body;
  bool in_box = true;
  double square = 0;
  for (int d = 0; d < options->dim; d++) {
    double apart = X[d] - body->centre[d];
    in_box = in_box && fabs(apart) <= 0.5 * body->size[d] + edge;
    square += apart * apart;
  }
  if (body->shape == GX_SHAPE_BOX) return in_box;
  double from = sqrt(square);
  return from <= body->radius + edge && (body->shape == GX_SHAPE_DISK || from >= body->inner_radius - edge);
}

enum gx_status gx_body_check(const struct gx_problem_options *options, struct gx_outcome *outcome)
{
  const struct gx_body *body = &options->body;
  if (body->shape == GX_SHAPE_POINTS) return GX_OK;
  if (body->shape == GX_SHAPE_RING && body->inner_radius >= body->radius)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "a ring of inner radius %g m and radius %g m is empty: give a smaller inner one", body->inner_radius,
                         body->radius);
  for (int d = 0; d < options->dim; d++) {
    double half = body->shape == GX_SHAPE_BOX ? 0.5 * body->size[d] : body->radius;
    double low = body->centre[d] - half, high = body->centre[d] + half;
    if (low < -edge || high > 1 + edge)
      return gx_status_set(
          outcome, GX_REFUSED, -1,
          "the body reaches from %g to %g along %c, out of the domain [0, 1]: move its centre or make it smaller", low, high,
          "xyz"[d]);
  }
  return GX_OK;
}
