/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Neo-Hookean bar, steffen2010 §6.1: u = A sin(2 pi X) cos(C pi t), C = sqrt(E/rho0), kept exact by the body force of eq. 131,
 * b = C^2 pi^2 u (2 F^-2 + 1). At t = 0 the bar is already deformed. The 1-D case of axis-aligned. */
#include "axis_aligned.h"
#include "standing_wave.h"

const struct gx_problem gx_bar_neo_hookean = {
    .name = "bar-neo-hookean",
    .help = "manufactured standing wave in a neo-Hookean bar with body force",
    .source = "steffen2010 §6.1, eqs 129-132",
    .material = &gx_neo_hookean,
    .max_dim = 1,
    .boundaries = 1u << GX_BOUNDARY_PERIODIC | 1u << GX_BOUNDARY_FIXED,
    .boundary = GX_BOUNDARY_PERIODIC,
    .has_amplitude = true,
    .waves = true,
    .cycles = 2,
    .check = gx_standing_wave_check,
    .exact = gx_axis_aligned_exact,
    .body = gx_axis_aligned_body,
    .body_angle = gx_axis_aligned_body_angle,
};
