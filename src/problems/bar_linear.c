/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear bar: u = A sin(2 pi m X) sin(2 pi m c t), c = sqrt(E/rho0), no body force (berzins2021 §6, berzins2022 §12.1).
 * The papers' E is 4 times the modulus here. */
#include "standing_wave.h"

extern const struct gx_material gx_linear_elastic;

static void exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F, double *const *a)
{
  double omega = 2 * M_PI * posed->options.mode * posed->speed;
  gx_standing_wave_exact(posed, omega, (double[]){sin(omega * t)}, (double[]){omega * cos(omega * t)}, u, v, F, a);
}

const struct gx_problem gx_bar_linear = {
    .name = "bar-linear",
    .help = "free vibration of a linear bar from its straight state",
    .source = "berzins2021 §6, eqs 32, 33; berzins2022 §12.1",
    .material = &gx_linear_elastic,
    .max_dim = 1,
    .has_mode = true,
    .boundaries = 1u << GX_BOUNDARY_PERIODIC | 1u << GX_BOUNDARY_FIXED,
    .boundary = GX_BOUNDARY_FIXED,
    .has_amplitude = true,
    .waves = true,
    .cycles = 1,
    .check = gx_standing_wave_check,
    .exact = exact,
};
