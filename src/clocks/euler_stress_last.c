/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symplectic Euler, stress updated last (USL): berzins2022 §3. */
#include <gridcross/clock.h>

static const struct gx_row rows[] = {
    {GX_WEIGHTS, 0}, {GX_PROJECT, 0}, {GX_ACCELERATE, 0}, {GX_KICK, 1}, {GX_STRAIN, 1}, {GX_DRIFT, 1}, {GX_END, 0},
};

const struct gx_clock gx_euler_stress_last = {
    .name = "euler-stress-last",
    .help = "symplectic Euler, stress updated after the velocity",
    .source = "berzins2022 §3, eqs 17-29",
    .order = 1,
    .stages = 1,
    .symplectic = true,
    .first_order_defect = true,
    .stability = 2,
    .rows = rows,
};
