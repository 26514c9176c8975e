/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Manufactured standing waves along each active direction, u_d = A sin(2 pi X_d) cos(c pi t + phi_d), on the compressible
 * neo-Hookean solid. F is diagonal, so with J = prod F_e the body force b = d2u/dt2 - Div P / rho0 is
 * b_d = u_d pi^2 (4 (mu + (mu + lambda (1 - ln J)) / F_d^2) / rho0 - c^2). */
#include "axis_aligned.h"

#include <stdbool.h>

#include "../core/kernel.h"
#include "../core/logarithm.h"
#include "standing_wave.h"

static double angle(const struct gx_posed *posed, int d, double t)
{
  return M_PI * posed->speed * t + posed->options.phase[d];
}

void gx_axis_aligned_exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F,
                           double *const *a)
{
  double factor[GX_MAX_DIM], rate[GX_MAX_DIM];
  for (int d = 0; d < posed->options.dim; d++) {
    factor[d] = cos(angle(posed, d, t));
    rate[d] = -M_PI * posed->speed * sin(angle(posed, d, t));
  }
  gx_standing_wave_exact(posed, M_PI * posed->speed, factor, rate, u, v, F, a);
}

/* Without a bulk term each direction depends on its own F_d alone. */
GX_CLONES static void body_without_bulk(size_t n, double A, double mu, double stiff, double inertia, const double *restrict sine,
                                        const double *restrict cosine, double *restrict out)
{
  const double slope = 2 * M_PI * A;
  for (size_t p = 0; p < n; p++) {
    double F = 1 + slope * cosine[p];
    out[p] = A * sine[p] * (stiff * (mu + mu / (F * F)) - inertia);
  }
}

GX_CORE void body_points(const int dim, const struct gx_posed *posed, const double *A, double stiff, double inertia,
                         double *const *b)
{
  const double mu = posed->options.moduli.mu, lambda = posed->options.moduli.lambda;
  double *sine[GX_MAX_DIM], *cosine[GX_MAX_DIM], *out[GX_MAX_DIM], slope[GX_MAX_DIM];
  for (int d = 0; d < dim; d++) {
    sine[d] = posed->sine[d];
    cosine[d] = posed->cosine[d];
    out[d] = b[d];
    slope[d] = 2 * M_PI * A[d];
  }
  GX_APART
  for (size_t p = 0; p < posed->n; p++) {
    double F[GX_MAX_DIM], J = 1;
    for (int d = 0; d < dim; d++) J *= F[d] = 1 + slope[d] * cosine[d][p];
    const double bulk = lambda * (1 - gx_logarithm(J));
    for (int d = 0; d < dim; d++) out[d][p] = A[d] * sine[d][p] * (stiff * (mu + (mu + bulk) / (F[d] * F[d])) - inertia);
  }
}

GX_CLONES static void body_with_bulk(const struct gx_posed *posed, const double *A, double stiff, double inertia,
                                     double *const *b)
{
  GX_FOR_DIM(posed->options.dim, body_points(dim, posed, A, stiff, inertia, b))
}

void gx_axis_aligned_body(const struct gx_posed *posed, double t, double *const *b)
{
  const struct gx_problem_options *options = &posed->options;
  double A[GX_MAX_DIM];
  for (int d = 0; d < options->dim; d++) A[d] = options->active[d] ? options->amplitude * cos(angle(posed, d, t)) : 0;
  const double stiff = 4 * M_PI * M_PI / options->moduli.density, inertia = M_PI * M_PI * posed->speed * posed->speed;
  if (options->moduli.lambda != 0)
    body_with_bulk(posed, A, stiff, inertia, b);
  else
    for (int d = 0; d < options->dim; d++)
      body_without_bulk(posed->n, A[d], options->moduli.mu, stiff, inertia, posed->sine[d], posed->cosine[d], b[d]);
}

double gx_axis_aligned_body_angle(const struct gx_posed *posed, double t)
{
  return angle(posed, 0, t);
}

const struct gx_problem gx_axis_aligned = {
    .name = "axis-aligned",
    .help = "standing waves along each active direction, neo-Hookean solid, 1-D to 3-D",
    .source = "steffen2010 §6.1, extended to dim directions and a bulk modulus",
    .material = &gx_neo_hookean,
    .max_dim = 3,
    .has_directions = true,
    .has_poisson = true,
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
