/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compressible neo-Hookean solid: W = mu/2 (F:F - dim) - mu ln J + lambda/2 (ln J)^2, P = mu (F - F^-T) + lambda ln J F^-T.
 * In 1-D with nu = 0: P = sigma = (E/2)(F - 1/F), steffen2010 eq. 132. In 2-D: plane strain. */
#include <gridcross/material.h>

#include <math.h>
#include <stdbool.h>

#include "../core/logarithm.h"
#include "../core/tensor.h"
#include "../core/vector.h"

static const double huge = 1e100;

/* Returns whether some det F is not a positive number. ln J is paid for only when there is a bulk term. */
GX_CORE bool piola_points(const int dim, const bool bulk, const struct gx_moduli *moduli, size_t n, double *const *F,
                          double *const *P)
{
  const double mu = moduli->mu, lambda = moduli->lambda;
  double *in[GX_MAX_TENSOR], *restrict out[GX_MAX_TENSOR];
  for (int k = 0; k < dim * dim; k++) {
    in[k] = F[k];
    out[k] = P[k];
  }
  long bad = 0; /* as wide as a double, of which as many fit in a vector */
  GX_APART
  for (size_t p = 0; p < n; p++) {
    double f[GX_MAX_TENSOR], c[GX_MAX_TENSOR];
    for (int k = 0; k < dim * dim; k++) f[k] = in[k][p];
    double J = gx_tensor_cofactor(dim, f, c);
    bad |= !(J > 0 && J < huge);
    double share = ((bulk ? lambda * gx_logarithm(J) : 0) - mu) / J;
    for (int k = 0; k < dim * dim; k++) out[k][p] = mu * f[k] + share * c[k];
  }
  return bad;
}

GX_CLONES static bool piola_any(const struct gx_moduli *moduli, int dimension, size_t n, double *const *F, double *const *P)
{
  bool bad;
  if (moduli->lambda != 0) {
    GX_FOR_DIM(dimension, bad = piola_points(dim, true, moduli, n, F, P))
  } else {
    GX_FOR_DIM(dimension, bad = piola_points(dim, false, moduli, n, F, P))
  }
  return bad;
}

static long piola(const struct gx_moduli *moduli, int dimension, size_t n, double *const *F, double *const *P)
{
  if (!piola_any(moduli, dimension, n, F, P)) return -1;
  for (size_t p = 0; p < n; p++) {
    double f[GX_MAX_TENSOR], c[GX_MAX_TENSOR], J;
    GX_FOR_DIM(dimension, gx_tensor_load(dim, F, p, f); J = gx_tensor_cofactor(dim, f, c))
    if (!(J > 0 && J < huge)) return (long)p;
  }
  return -1;
}

/* dP = mu dF + (mu - lambda ln J) F^-T dF^T F^-T + lambda tr(F^-1 dF) F^-T */
GX_CORE void piola_rate_points(const int dim, const struct gx_moduli *moduli, size_t n, double *const *F, double *const *rate_F,
                               double *const *rate_P)
{
  const double mu = moduli->mu, lambda = moduli->lambda;
  for (size_t p = 0; p < n; p++) {
    double f[GX_MAX_TENSOR], g[GX_MAX_TENSOR], c[GX_MAX_TENSOR], dP[GX_MAX_TENSOR];
    gx_tensor_load(dim, F, p, f);
    gx_tensor_load(dim, rate_F, p, g);
    double J = gx_tensor_cofactor(dim, f, c), trace = 0;
    for (int k = 0; k < dim * dim; k++) {
      c[k] /= J;
      trace += c[k] * g[k];
    }
    double bulk = lambda != 0 ? lambda * gx_logarithm(J) : 0;
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++) {
        double twisted = 0;
        for (int k = 0; k < dim; k++)
          for (int l = 0; l < dim; l++) twisted += c[i * dim + k] * g[l * dim + k] * c[l * dim + j];
        int ij = i * dim + j;
        dP[ij] = mu * g[ij] + (mu - bulk) * twisted + lambda * trace * c[ij];
      }
    gx_tensor_store(dim, rate_P, p, dP);
  }
}

static void piola_rate(const struct gx_moduli *moduli, int dimension, size_t n, double *const *F, double *const *rate_F,
                       double *const *rate_P)
{
  GX_FOR_DIM(dimension, piola_rate_points(dim, moduli, n, F, rate_F, rate_P))
}

GX_CORE void energy_points(const int dim, const struct gx_moduli *moduli, size_t n, double *const *F, double *restrict W)
{
  const double mu = moduli->mu, lambda = moduli->lambda;
  double *in[GX_MAX_TENSOR];
  for (int k = 0; k < dim * dim; k++) in[k] = F[k];
  GX_APART
  for (size_t p = 0; p < n; p++) {
    double f[GX_MAX_TENSOR], c[GX_MAX_TENSOR], square = 0;
    for (int k = 0; k < dim * dim; k++) f[k] = in[k][p];
    const double log_J = gx_logarithm(gx_tensor_cofactor(dim, f, c));
    for (int k = 0; k < dim * dim; k++) square += f[k] * f[k];
    W[p] = 0.5 * mu * (square - dim) - mu * log_J + 0.5 * lambda * log_J * log_J;
  }
}

GX_CLONES static void energy(const struct gx_moduli *moduli, int dimension, size_t n, double *const *F, double *W)
{
  GX_FOR_DIM(dimension, energy_points(dim, moduli, n, F, W))
}

enum { FOLD = 4 };

/* W of points p, p + n, ... together, n of them, without a bulk term: ln J1 + ln J2 + ... is one logarithm. */
GX_CORE void energy_folded(const int dim, double mu, size_t n, double *const *F, double *restrict W)
{
  const double *in[FOLD][GX_MAX_TENSOR];
  for (size_t q = 0; q < FOLD; q++)
    for (int k = 0; k < dim * dim; k++) in[q][k] = F[k] + q * n;
  GX_APART
  for (size_t p = 0; p < n; p++) {
    double square = 0, product = 1;
    for (int q = 0; q < FOLD; q++) {
      double f[GX_MAX_TENSOR], c[GX_MAX_TENSOR];
      for (int k = 0; k < dim * dim; k++) {
        f[k] = in[q][k][p];
        square += f[k] * f[k];
      }
      product *= gx_tensor_cofactor(dim, f, c);
    }
    W[p] = mu * (0.5 * (square - FOLD * dim) - gx_logarithm(product));
  }
}

GX_CLONES static void fold_energy(double mu, int dimension, size_t n, double *const *F, double *W)
{
  GX_FOR_DIM(dimension, energy_folded(dim, mu, n, F, W))
}

/* Of a piece whose length is a multiple of FOLD; the product of J may overflow where J does not. */
static double total_of_piece(const struct gx_moduli *moduli, int dim, size_t n, double *const *F)
{
  double W[FOLD * GX_VECTOR_PIECE], sum = NAN;
  if (moduli->lambda == 0) {
    fold_energy(moduli->mu, dim, n / FOLD, F, W);
    sum = gx_vector_sum(n / FOLD, W);
  }
  if (isfinite(sum)) return sum;
  energy(moduli, dim, n, F, W);
  return gx_vector_sum(n, W);
}

static double total(const struct gx_moduli *moduli, int dim, size_t n, double *const *F)
{
  double sum = 0, W[FOLD], *piece[GX_MAX_TENSOR];
  const size_t rest = n % FOLD;
  for (size_t from = 0; from < n; from += FOLD * GX_VECTOR_PIECE) {
    const size_t left = n - rest - from, length = left < FOLD * GX_VECTOR_PIECE ? left : FOLD * GX_VECTOR_PIECE;
    for (int k = 0; k < dim * dim; k++) piece[k] = F[k] + from;
    if (from + rest < n) sum += total_of_piece(moduli, dim, length, piece);
  }
  for (int k = 0; k < dim * dim; k++) piece[k] = F[k] + n - rest;
  if (rest > 0) energy(moduli, dim, rest, piece, W);
  for (size_t p = 0; p < rest; p++) sum += W[p];
  return sum;
}

static double wave_speed(const struct gx_moduli *moduli)
{
  return sqrt((moduli->lambda + 2 * moduli->mu) / moduli->density);
}

const struct gx_material gx_neo_hookean = {
    .name = "neo-hookean",
    .help = "compressible neo-Hookean solid; 1-D: sigma = (E/2)(F - 1/F)",
    .source = "steffen2010 eq. 132",
    .piola = piola,
    .piola_rate = piola_rate,
    .energy = energy,
    .total = total,
    .wave_speed = wave_speed,
};
