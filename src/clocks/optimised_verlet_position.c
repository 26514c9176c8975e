/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Position form of the Verlet method with the least leading error (Omelyan, Mryglod & Folk 2002). */
#include <gridcross/clock.h>

#define XI 0.1931833275037836

static const struct gx_splitting splitting = {
    .stages = 2,
    .drift = {XI, 1 - 2 * XI, XI},
    .kick = {0.5, 0.5},
};

const struct gx_clock gx_optimised_verlet_position = {
    .name = "optimised-verlet-position",
    .help = "drifts xi, 1 - 2 xi, xi about half kicks: Verlet with the least leading error",
    .source = "Omelyan, Mryglod & Folk 2002; berzins2021 [13]",
    .order = 2,
    .stages = 2,
    .symplectic = true,
    .stability = 2.553145,
    .splitting = &splitting,
};
