/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The velocity field of steffen2010 §5.2.1, which both model problems of §5 have. */
#ifndef GRIDCROSS_PROBLEMS_JUMP_MODEL_H
#define GRIDCROSS_PROBLEMS_JUMP_MODEL_H

#include <stddef.h>

#include <gridcross/problem.h>

enum { GX_JUMP_MODEL_KNOTS = 3 };

/* Where the slope of the velocity changes, m. */
extern const double gx_jump_model_knots[GX_JUMP_MODEL_KNOTS];
/* Piece that x is in, from 0; a knot belongs to the piece on its right. */
int gx_jump_model_piece(double x);
/* Eq. 70, the first and the last piece continued beyond the domain, m/s. */
double gx_jump_model_velocity(double x);
/* Position at the start, m. */
double gx_jump_model_start(const struct gx_posed *posed);
/* gx_problem.exact: eqs 72 and 74. */
void gx_jump_model_exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F,
                         double *const *a);

extern const struct gx_material gx_jump_model_material;

#endif
