/* SPDX-License-Identifier: GPL-3.0-or-later */
/* jump-model with an external acceleration, steffen2010 §5.3: the integral over [0, 1] of the piecewise constant g of eq. 87, the
 * particle's own part [x - width/2, x + width/2] by the midpoint rule (eq. 88). g as printed integrates to J/12; with J/2 in place of
 * J on [2/3, 5/6] it integrates to 0, as the paper says of it, and the exact solution is that without acceleration. There is no g
 * outside the domain: a particle that reaches over an end has a quadrature error too. */
#include "quadrature_model.h"

#include <math.h>

#include "jump_model.h"

enum { PIECES = GX_JUMP_MODEL_KNOTS + 1 };

/* g/J */
static const double printed[PIECES] = {-1, 0, 1, 1.5}, corrected[PIECES] = {-1, 0, 0.5, 1.5};

/* Integral of g from 0 to x. */
static double integral(const double *g, double x)
{
  double sum = 0, from = 0;
  for (int piece = 0; piece < PIECES && x > from; piece++) {
    double to = piece < GX_JUMP_MODEL_KNOTS ? gx_jump_model_knots[piece] : 1;
    sum += g[piece] * (fmin(x, to) - from);
    from = to;
  }
  return sum;
}

double gx_quadrature_model_acceleration(const struct gx_problem_options *options, double x)
{
  const double *g = options->corrected ? corrected : printed;
  double half = 0.5 * options->particle_width, at = x >= 0 && x <= 1 ? g[gx_jump_model_piece(x)] : 0;
  double own = integral(g, x + half) - integral(g, x - half);
  return options->jump * (integral(g, 1) - own + at * options->particle_width);
}

const struct gx_problem gx_quadrature_model = {
    .name = "quadrature-model",
    .help = "jump-model with an acceleration that errs as the midpoint rule does across cell edges",
    .source = "steffen2010 §5.3, eqs 87-92",
    .material = &gx_jump_model_material,
    .space = "velocity-field",
    .max_dim = 1,
    .has_knots = true,
    .has_jump = true,
    .end = 0.4,
    .exact = gx_jump_model_exact,
};
