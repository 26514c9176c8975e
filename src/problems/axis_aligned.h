/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The axis-aligned standing wave; bar-neo-hookean is its 1-D case. */
#ifndef GRIDCROSS_PROBLEMS_AXIS_ALIGNED_H
#define GRIDCROSS_PROBLEMS_AXIS_ALIGNED_H

#include <gridcross/problem.h>

extern const struct gx_material gx_neo_hookean;
void gx_axis_aligned_exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F,
                           double *const *a);
void gx_axis_aligned_body(const struct gx_posed *posed, double t, double *const *b);
double gx_axis_aligned_body_angle(const struct gx_posed *posed, double t);

#endif
