/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that a run file describes: box, disk, ring. */
#ifndef GRIDCROSS_PROBLEMS_BODY_H
#define GRIDCROSS_PROBLEMS_BODY_H

#include <gridcross/problem.h>

/* gx_problem.inside and .check of problems that leave the body open. A point on the edge is inside. */
bool gx_body_inside(const struct gx_problem_options *options, const double *X);
enum gx_status gx_body_check(const struct gx_problem_options *options, struct gx_outcome *outcome);

#endif
