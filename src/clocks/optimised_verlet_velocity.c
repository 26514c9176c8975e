/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Velocity form of the Verlet method with the least leading error (Omelyan, Mryglod & Folk 2002). */
#include <gridcross/clock.h>

#define XI 0.1931833275037836

static const struct gx_splitting splitting = {
    .stages = 3,
    .drift = {0, 0.5, 0.5, 0},
    .kick = {XI, 1 - 2 * XI, XI},
};

const struct gx_clock gx_optimised_verlet_velocity = {
    .name = "optimised-verlet-velocity",
    .help = "kicks xi, 1 - 2 xi, xi about half drifts: Verlet with the least leading error",
    .source = "Omelyan, Mryglod & Folk 2002; berzins2021 [13]",
    .order = 2,
    .stages = 2,
    .symplectic = true,
    .stability = 2.553145,
    .splitting = &splitting,
};
