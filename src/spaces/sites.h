/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What it means for particles on a line that no spline passes through them. */
#ifndef GRIDCROSS_SPACES_SITES_H
#define GRIDCROSS_SPACES_SITES_H

#include <gridcross/status.h>
#include <gridcross_splines.h>

/* Fills the outcome from a spline's error, in terms of the n particles at x, on a ring of length 1 or between fixed ends at 0 and
 * 1, which they may lie on unless within. Returns its status. */
enum gx_status gx_sites_report(struct gx_outcome *outcome, const struct gx_spline_error *error, size_t n, const double *x,
                               bool periodic, bool within);

#endif
