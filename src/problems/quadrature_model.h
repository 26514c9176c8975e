/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The external acceleration of steffen2010 §5.3. */
#ifndef GRIDCROSS_PROBLEMS_QUADRATURE_MODEL_H
#define GRIDCROSS_PROBLEMS_QUADRATURE_MODEL_H

#include <gridcross/problem.h>

/* Eq. 88 for a particle at x, m/s^2; zero where options->jump is. */
double gx_quadrature_model_acceleration(const struct gx_problem_options *options, double x);

#endif
