/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A particle carried by a fixed piecewise-linear velocity, steffen2010 §5.2: dx/dt = v(x), v(x) = slope x + offset by eq. 70. With
 * x(t0) = x0 in a piece, x(t) = (x0 + offset/slope) exp(slope (t - t0)) - offset/slope there (eq. 72), and it leaves at
 * t0 + ln((knot + offset/slope) / (x0 + offset/slope)) / slope (eq. 74). */
#include "jump_model.h"

#include <math.h>

enum { PIECES = GX_JUMP_MODEL_KNOTS + 1 };

const double gx_jump_model_knots[GX_JUMP_MODEL_KNOTS] = {1.0 / 3, 2.0 / 3, 5.0 / 6};
static const double slope[PIECES] = {3, 6, 12, 18}, offset[PIECES] = {1, 0, -4, -9};

int gx_jump_model_piece(double x)
{
  int piece = 0;
  while (piece < GX_JUMP_MODEL_KNOTS && x >= gx_jump_model_knots[piece]) piece++;
  return piece;
}

double gx_jump_model_velocity(double x)
{
  int piece = gx_jump_model_piece(x);
  return slope[piece] * x + offset[piece];
}

/* Eq. 83: knot = x + dt/2 v(x). */
double gx_jump_model_start(const struct gx_posed *posed)
{
  int knot = posed->options.knot;
  double half = 0.5 * posed->options.dt;
  return knot ? (gx_jump_model_knots[knot - 1] - half * offset[knot - 1]) / (1 + half * slope[knot - 1]) : 0;
}

void gx_jump_model_exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F,
                         double *const *a)
{
  double start = gx_jump_model_start(posed), x = start, left = t;
  int piece = gx_jump_model_piece(x);
  for (; piece < GX_JUMP_MODEL_KNOTS; piece++) {
    double zero = offset[piece] / slope[piece], knot = gx_jump_model_knots[piece];
    double leaves = log((knot + zero) / (x + zero)) / slope[piece];
    if (left < leaves) break;
    x = knot;
    left -= leaves;
  }
  double zero = offset[piece] / slope[piece];
  x = (x + zero) * exp(slope[piece] * left) - zero;
  if (u) u[0][0] = x - start;
  if (v) v[0][0] = slope[piece] * x + offset[piece];
  if (F) F[0][0] = 1;
  if (a) a[0][0] = slope[piece] * (slope[piece] * x + offset[piece]);
}

static double unit_speed(const struct gx_moduli *moduli)
{
  (void)moduli;
  return 1;
}

const struct gx_material gx_jump_model_material = {.name = "none", .wave_speed = unit_speed};

const struct gx_problem gx_jump_model = {
    .name = "jump-model",
    .help = "a particle carried through knots of a fixed velocity: errors of steps across cell edges alone",
    .source = "steffen2010 §5.2, eqs 70-75",
    .material = &gx_jump_model_material,
    .space = "velocity-field",
    .max_dim = 1,
    .has_knots = true,
    .end = 0.4,
    .exact = gx_jump_model_exact,
};
