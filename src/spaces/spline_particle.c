/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spline collocation at the particles, no grid (berzins2021 §8): the derivative of the spline through the particles' stress gives
 * their acceleration, that of the spline through their velocity the velocity gradient. */
#include "collocation.h"

const struct gx_space_kind gx_spline_particle = {
    .name = "spline-particle",
    .help = "strong form, splines through the particles, no grid",
    .source = "berzins2021 §8",
    .collocation = true,
    .create = gx_collocation_create,
    .free = gx_collocation_free,
    .weights = gx_collocation_weights,
    .project = gx_collocation_project,
    .accelerate = gx_collocation_accelerate,
    .advance = gx_collocation_advance,
    .twofold = gx_collocation_twofold,
    .state = gx_collocation_state,
    .rates = gx_collocation_rates,
    .kinetic = gx_collocation_kinetic,
    .settle = gx_collocation_settle,
    .particle_acceleration = gx_collocation_particle_acceleration,
};
