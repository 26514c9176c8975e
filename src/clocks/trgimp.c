/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trapezoidal GIMP, berzins2022 §6: a stress-last Euler step predicts x* and F'; with a* there, velocity and position are
 * corrected by the trapezoidal rule, F' is kept. Its energy defect per step is of third order, but F' is of first order, so
 * that a free vibration loses the share 1 - exp(-omega^2 dt T/2) of its energy: order 1 wherever strain is integrated. On the
 * moving mesh, where F comes from the corrected displacement, it is of order 2. */
#include <gridcross/clock.h>

static const struct gx_row rows[] = {
    {GX_WEIGHTS, 0},      {GX_PROJECT, 0},    {GX_ACCELERATE, 0}, {GX_OPEN, 0.5},        {GX_KICK, 0.5},
    {GX_KICK_NODES, 0.5}, {GX_STRAIN, 1},     {GX_DRIFT, 1},      {GX_KICK_NODES, -0.5}, {GX_WEIGHTS, 0},
    {GX_MASS, 0},         {GX_ACCELERATE, 0}, {GX_KICK, 0.5},     {GX_CLOSE, 0.5},       {GX_END, 0},
};

const struct gx_clock gx_trgimp = {
    .name = "trgimp",
    .help = "Euler predictor, trapezoidal corrector of velocity and position",
    .source = "berzins2022 §6",
    .order = 1,
    .stages = 2,
    .stability = 1, /* on the oscillator, whose force takes stress and position; sqrt 2 where it takes one of them */
    .rows = rows,
};
