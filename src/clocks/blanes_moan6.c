/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sixth-order method SRKN 11b of Blanes & Moan 2002: eleven drifts between twelve kicks. */
#include <gridcross/clock.h>

#define B1 0.0414649985182624
#define B2 0.198128671918067
#define B3 -0.0400061921041533
#define B4 0.0752539843015807
#define B5 -0.0115113874206879
#define B6 (0.5 - (B1 + B2 + B3 + B4 + B5))
#define A1 0.123229775946271
#define A2 0.290553797799558
#define A3 -0.127049212625417
#define A4 -0.246331761062075
#define A5 0.357208872795928
#define A6 (1 - 2 * (A1 + A2 + A3 + A4 + A5))

static const struct gx_splitting splitting = {
    .stages = 12,
    .drift = {0, A1, A2, A3, A4, A5, A6, A5, A4, A3, A2, A1, 0},
    .kick = {B1, B2, B3, B4, B5, B6, B6, B5, B4, B3, B2, B1},
};

const struct gx_clock gx_blanes_moan6 = {
    .name = "blanes-moan6",
    .help = "eleven stages for second-order equations, small error constants",
    .source = "Blanes & Moan 2002, SRKN 11b",
    .order = 6,
    .stages = 11,
    .symplectic = true,
    .stability = 3.141431,
    .splitting = &splitting,
};
