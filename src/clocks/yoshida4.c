/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fourth-order triple jump of the Verlet method (Yoshida 1990; Forest & Ruth 1990). */
#include <gridcross/clock.h>

/* 1/(2 - 2^(1/3)) and -2^(1/3)/(2 - 2^(1/3)) */
#define OUTER 1.3512071919596578
#define INNER -1.7024143839193153

static const struct gx_splitting splitting = {
    .stages = 3,
    .drift = {0.5 * OUTER, 0.5 * (OUTER + INNER), 0.5 * (INNER + OUTER), 0.5 * OUTER},
    .kick = {OUTER, INNER, OUTER},
};

const struct gx_clock gx_yoshida4 = {
    .name = "yoshida4",
    .help = "triple jump of the Verlet method",
    .source = "Yoshida 1990; Forest & Ruth 1990",
    .order = 4,
    .stages = 3,
    .symplectic = true,
    .stability = 1.573401,
    .splitting = &splitting,
};
