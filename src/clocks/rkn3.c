/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Third-order symplectic Runge-Kutta-Nystrom method of Ruth: kicks 7/24, 3/4, -1/24; drifts 2/3, -2/3, 1. */
#include <gridcross/clock.h>

static const struct gx_splitting splitting = {
    .stages = 3,
    .drift = {0, 2.0 / 3, -2.0 / 3, 1},
    .kick = {7.0 / 24, 3.0 / 4, -1.0 / 24},
};

const struct gx_clock gx_rkn3 = {
    .name = "rkn3",
    .help = "three stages, one drift backwards; grows at any step with projection each-step",
    .source = "Ruth 1983",
    .order = 3,
    .stages = 3,
    .symplectic = true,
    .stability = 2.507481,
    .splitting = &splitting,
};
