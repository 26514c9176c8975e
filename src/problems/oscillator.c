/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Model problem 2 of berzins2021 §7, three equations that mimic MPM: x' = v, sigma' = 3 E pi v, v' = -(pi sigma - 2 pi^2 E x),
 * with x = sin(C pi t), v = C pi cos(C pi t), sigma = 3 E pi x, C = sqrt(E), H = v^2 + sigma^2/(3E) - 2 E pi^2 x^2 = E pi^2.
 * The printed equations (35)-(44) are garbled; these are consistent with the printed solution and tables. */
#include <math.h>

#include <gridcross/problem.h>

/* x is kept as a displacement, sigma as a stress; F = 2 + x ties the exact stress to the exact x. */
static long piola(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *const *P)
{
  for (size_t p = 0; p < n; p++) P[dim - 1][p] = 3 * moduli->young * M_PI * (F[dim - 1][p] - 2);
  return -1;
}

static double speed(const struct gx_moduli *moduli)
{
  return sqrt(moduli->young);
}

static const struct gx_material spring = {.name = "spring", .piola = piola, .wave_speed = speed};

static void exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F, double *const *a)
{
  double omega = M_PI * posed->speed;
  if (u) u[0][0] = sin(omega * t);
  if (v) v[0][0] = omega * cos(omega * t);
  if (F) F[0][0] = 2 + sin(omega * t);
  if (a) a[0][0] = -omega * omega * sin(omega * t);
}

const struct gx_problem gx_oscillator = {
    .name = "oscillator",
    .help = "three ordinary differential equations with the structure of MPM: clocks alone, no space error",
    .source = "berzins2021 §7, model problem 2",
    .material = &spring,
    .space = "oscillator-equations",
    .max_dim = 1,
    .has_interpolation_error = true,
    .cycles = 2,
    .exact = exact,
};
