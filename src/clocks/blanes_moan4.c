/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fourth-order method SRKN 6b of Blanes & Moan 2002: six drifts between seven kicks. */
#include <gridcross/clock.h>

#define B1 0.0829844064174052
#define B2 0.396309801498368
#define B3 -0.0390563049223486
#define B4 (1 - 2 * (B1 + B2 + B3))
#define A1 0.245298957184271
#define A2 0.604872665711080
#define A3 (0.5 - (A1 + A2))

static const struct gx_splitting splitting = {
    .stages = 7,
    .drift = {0, A1, A2, A3, A3, A2, A1, 0},
    .kick = {B1, B2, B3, B4, B3, B2, B1},
};

const struct gx_clock gx_blanes_moan4 = {
    .name = "blanes-moan4",
    .help = "six stages for second-order equations, small error constants",
    .source = "Blanes & Moan 2002, SRKN 6b",
    .order = 4,
    .stages = 6,
    .symplectic = true,
    .stability = 3.163465,
    .splitting = &splitting,
};
