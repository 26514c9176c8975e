/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fourth-order symplectic Runge-Kutta-Nystrom method of Calvo & Sanz-Serna, berzins2021 Table 1. */
#include <gridcross/clock.h>

/* c_j of Table 1; c_5 = 1, so no drift follows the last kick, and c_4 < c_3: one drift runs backwards */
#define C2 0.205177661542286386
#define C3 0.608198943146500973
#define C4 0.487278066807586965

static const struct gx_splitting splitting = {
    .stages = 5,
    .drift = {0, C2, C3 - C2, C4 - C3, 1 - C4, 0},
    .kick = {0.061758858135626325, 0.338978026553643355, 0.614791307175577566, -0.140548014659373380, 0.125019822794526133},
};

const struct gx_clock gx_rkn4 = {
    .name = "rkn4",
    .help = "five stages, one drift backwards",
    .source = "Calvo & Sanz-Serna 1993; berzins2021 Table 1",
    .order = 4,
    .stages = 4,
    .symplectic = true,
    .stability = 3.055857,
    .splitting = &splitting,
};
