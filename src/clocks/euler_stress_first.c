/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symplectic Euler, stress updated first (USF) from the velocity before the kick. */
#include <gridcross/clock.h>

static const struct gx_row rows[] = {
    {GX_WEIGHTS, 0}, {GX_PROJECT, 0}, {GX_STRAIN, 1}, {GX_ACCELERATE, 0}, {GX_KICK, 1}, {GX_DRIFT, 1}, {GX_END, 0},
};

const struct gx_clock gx_euler_stress_first = {
    .name = "euler-stress-first",
    .help = "symplectic Euler, stress updated before the velocity",
    .source = "berzins2021 §4, eqs 16-22; Bardenhagen 2002",
    .order = 1,
    .stages = 1,
    .symplectic = true,
    .first_order_defect = true,
    .stability = 2,
    .rows = rows,
};
