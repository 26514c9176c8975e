/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of materials, Lamé parameters, and Cauchy stress. */
#include <gridcross/material.h>

#include "../core/family.h"
#include "../core/tensor.h"
#include "material_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_material gx_##member;
GX_FAMILY(gx_material, gx_material, GX_MATERIAL_FAMILY)

struct gx_moduli gx_material_moduli(double young, double poisson, double density)
{
  return (struct gx_moduli){
      .young = young,
      .lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)),
      .mu = young / (2 * (1 + poisson)),
      .density = density,
  };
}

GX_CORE void cauchy_points(const int dim, size_t n, double *const *F, double *const *P, double *const *sigma)
{
  double *in[GX_MAX_TENSOR], *stress[GX_MAX_TENSOR];
  double *restrict out[GX_MAX_TENSOR];
  for (int k = 0; k < dim * dim; k++) {
    in[k] = F[k];
    stress[k] = P[k];
    out[k] = sigma[k];
  }
  GX_APART
  for (size_t p = 0; p < n; p++) {
    double f[GX_MAX_TENSOR], c[GX_MAX_TENSOR];
    for (int k = 0; k < dim * dim; k++) f[k] = in[k][p];
    double J = gx_tensor_cofactor(dim, f, c);
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++) {
        double sum = 0;
        for (int k = 0; k < dim; k++) sum += stress[i * dim + k][p] * f[j * dim + k];
        out[i * dim + j][p] = dim == 1 ? stress[0][p] : sum / J;
      }
  }
}

GX_CLONES void gx_material_cauchy(int dimension, size_t n, double *const *F, double *const *P, double *const *sigma)
{
  GX_FOR_DIM(dimension, cauchy_points(dim, n, F, P, sigma))
}
