/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Central differences (leapfrog): the rows of euler-stress-last with velocity at half steps, steffen2010 eqs 23-27. */
#include <gridcross/clock.h>

static const struct gx_row rows[] = {
    {GX_WEIGHTS, 0}, {GX_PROJECT, 0}, {GX_ACCELERATE, 0}, {GX_KICK, 1}, {GX_STRAIN, 1}, {GX_DRIFT, 1}, {GX_END, 0},
};

const struct gx_clock gx_central_difference = {
    .name = "central-difference",
    .help = "leapfrog: velocity at half steps, started at -dt/2",
    .source = "steffen2010 eqs 23-27",
    .order = 2,
    .stages = 1,
    .symplectic = true,
    .staggered = true,
    .stability = 2,
    .rows = rows,
};
