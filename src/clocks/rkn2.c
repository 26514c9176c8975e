/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Second-order Runge-Kutta-Nystrom method c = (0, 1), b = (1/2, 1/2). berzins2021 §5 prints b_1 = 1/2 alone, which is not consistent. */
#include <gridcross/clock.h>

static const struct gx_splitting splitting = {
    .stages = 2,
    .drift = {0, 1, 0},
    .kick = {0.5, 0.5},
};

const struct gx_clock gx_rkn2 = {
    .name = "rkn2",
    .help = "two stages, c = (0, 1), b = (1/2, 1/2)",
    .source = "berzins2021 §5",
    .order = 2,
    .stages = 1,
    .symplectic = true,
    .stability = 2,
    .splitting = &splitting,
};
