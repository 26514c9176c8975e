/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The classic fourth-order Runge-Kutta method (Kutta 1901) on the whole state. */
#include <gridcross/clock.h>

static const struct gx_tableau tableau = {
    .stages = 4,
    .a = {{0}, {0.5}, {0, 0.5}, {0, 0, 1}},
    .b = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6},
    .c = {0, 0.5, 0.5, 1},
};

const struct gx_clock gx_rk4 = {
    .name = "rk4",
    .help = "classic Runge-Kutta",
    .source = "Kutta 1901; Hairer, Norsett & Wanner 1993 II.1",
    .order = 4,
    .stages = 4,
    .stability = 2.8284271247461903, /* 2 sqrt 2, on the imaginary axis */
    .tableau = &tableau,
};
