/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fourth-order position-extended Forest-Ruth-like method (Omelyan, Mryglod & Folk 2002). */
#include <gridcross/clock.h>

#define XI     0.1786178958448091
#define LAMBDA -0.2123418310626054
#define CHI    -0.06626458266981849

static const struct gx_splitting splitting = {
    .stages = 4,
    .drift = {XI, CHI, 1 - 2 * (CHI + XI), CHI, XI},
    .kick = {0.5 * (1 - 2 * LAMBDA), LAMBDA, LAMBDA, 0.5 * (1 - 2 * LAMBDA)},
};

const struct gx_clock gx_pefrl = {
    .name = "pefrl",
    .help = "four stages, position-extended Forest-Ruth-like; grows slowly at any step with projection each-step",
    .source = "Omelyan, Mryglod & Folk 2002, Comput. Phys. Commun. 146",
    .order = 4,
    .stages = 4,
    .symplectic = true,
    .stability = 2.989449,
    .splitting = &splitting,
};
