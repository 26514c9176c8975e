/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stormer-Verlet for MPM, berzins2022 §5. With w = v_i + dt/2 a_i and weights S, S* at x and x* = x + dt S w:
 *   F' = F (1 + dt/2 D w) / (1 - dt/2 D* w), D* with the particle domains of the step's start, a* at (x*, F'),
 *   v_p += dt/2 (S a + S* a*),  x <- x + dt/2 (S v_i + S* (v_i + dt/2 (a_i + a_i*))).
 * Where weights never change this is the velocity Verlet method. */
#include <gridcross/clock.h>

static const struct gx_row rows[] = {
    {GX_WEIGHTS, 0},  {GX_PROJECT, 0},    {GX_ACCELERATE, 0},     {GX_OPEN, 0.5},        {GX_KICK, 0.5},
    {GX_STRAIN, 0.5}, {GX_DRIFT, 1},      {GX_WEIGHTS_FROZEN, 0}, {GX_STRAIN_BACK, 0.5}, {GX_STRETCH, 0},
    {GX_MASS, 0},     {GX_ACCELERATE, 0}, {GX_KICK, 0.5},         {GX_CLOSE, 0.5},       {GX_END, 0},
};

static const struct gx_row plain_rows[] = {
    {GX_WEIGHTS, 0}, {GX_PROJECT, 0}, {GX_ACCELERATE, 0}, {GX_KICK, 0.5}, {GX_STRAIN, 1}, {GX_DRIFT, 1},
    {GX_WEIGHTS, 0}, {GX_PROJECT, 0}, {GX_ACCELERATE, 0}, {GX_KICK, 0.5}, {GX_END, 0},
};

const struct gx_clock gx_stormer_verlet = {
    .name = "stormer-verlet",
    .help = "velocity Verlet; on a fixed grid with the weights of both ends of the step, in two stages",
    .source = "berzins2022 §5; Hairer, Lubich & Wanner 2003",
    .order = 2,
    .stages = 1,
    .symplectic = true,
    .stability = 2,
    .rows = rows,
    .plain_rows = plain_rows,
};
