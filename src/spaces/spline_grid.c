/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spline collocation by way of the grid (berzins2021 §8): the derivative of the stress spline is taken at the nodes, held at zero
 * at fixed ends, and splined from there to the particles; the velocity goes to the nodes and its gradient back likewise. */
#include "collocation.h"

const struct gx_space_kind gx_spline_grid = {
    .name = "spline-grid",
    .help = "strong form, splines through the particles and through the nodes",
    .source = "berzins2021 §8",
    .collocation = true,
    .nodal = true,
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
