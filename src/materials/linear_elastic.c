/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear bar: P = sigma = E (F - 1) in 1-D (berzins2021 eq. 32). */
#include <gridcross/material.h>

#include <math.h>
#include <stdbool.h>

#include "../core/kernel.h"

GX_CLONES static bool piola_points(double young, size_t n, const double *restrict F, double *restrict P)
{
  long bad = 0; /* as wide as a double, of which as many fit in a vector */
  for (size_t p = 0; p < n; p++) {
    bad |= !(F[p] > 0 && F[p] < 1e100);
    P[p] = young * (F[p] - 1);
  }
  return bad;
}

static long piola(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *const *P)
{
  (void)dim;
  if (piola_points(moduli->young, n, F[0], P[0]))
    for (size_t p = 0; p < n; p++)
      if (!(F[0][p] > 0 && F[0][p] < 1e100)) return (long)p;
  return -1;
}

static void piola_rate(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *const *rate_F,
                       double *const *rate_P)
{
  (void)dim;
  (void)F;
  for (size_t p = 0; p < n; p++) rate_P[0][p] = moduli->young * rate_F[0][p];
}

static void energy(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *W)
{
  (void)dim;
  for (size_t p = 0; p < n; p++) W[p] = 0.5 * moduli->young * (F[0][p] - 1) * (F[0][p] - 1);
}

static double wave_speed(const struct gx_moduli *moduli)
{
  return sqrt(moduli->young / moduli->density);
}

const struct gx_material gx_linear_elastic = {
    .name = "linear-elastic",
    .help = "sigma = E (F - 1), 1-D",
    .source = "berzins2021 eq. 32",
    .piola = piola,
    .piola_rate = piola_rate,
    .energy = energy,
    .wave_speed = wave_speed,
};
