/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sixth-order composition of seven Verlet steps, solution A of Yoshida 1990. */
#include <gridcross/clock.h>

/* lengths of the seven Verlet steps, outermost first */
#define W3 0.784513610477560
#define W2 0.235573213359357
#define W1 -1.17767998417887
#define W0 (1 - 2 * (W1 + W2 + W3))

static const struct gx_splitting splitting = {
    .stages = 7,
    .drift = {0.5 * W3, 0.5 * (W3 + W2), 0.5 * (W2 + W1), 0.5 * (W1 + W0), 0.5 * (W0 + W1), 0.5 * (W1 + W2), 0.5 * (W2 + W3),
              0.5 * W3},
    .kick = {W3, W2, W1, W0, W1, W2, W3},
};

const struct gx_clock gx_yoshida6 = {
    .name = "yoshida6",
    .help = "seven Verlet steps, solution A",
    .source = "Yoshida 1990",
    .order = 6,
    .stages = 7,
    .symplectic = true,
    .stability = 2.269057,
    .splitting = &splitting,
};
