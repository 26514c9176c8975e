/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Determinant and cofactors of a dim x dim row-major tensor: the one place where the dimension is told apart. */
#ifndef GRIDCROSS_CORE_TENSOR_H
#define GRIDCROSS_CORE_TENSOR_H

#include "kernel.h"

/* C = det(F) F^-T; returns det F. */
GX_CORE double gx_tensor_cofactor(const int dim, const double *F, double *C)
{
  if (dim == 1) {
    C[0] = 1;
    return F[0];
  }
  if (dim == 2) {
    C[0] = F[3];
    C[1] = -F[2];
    C[2] = -F[1];
    C[3] = F[0];
    return F[0] * F[3] - F[1] * F[2];
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      C[3 * i + j] = F[3 * i1 + j1] * F[3 * i2 + j2] - F[3 * i1 + j2] * F[3 * i2 + j1];
    }
  return F[0] * C[0] + F[1] * C[1] + F[2] * C[2];
}

/* Loads component arrays of particle p. */
GX_CORE void gx_tensor_load(const int dim, double *const *array, size_t p, double *T)
{
  for (int k = 0; k < dim * dim; k++) T[k] = array[k][p];
}

GX_CORE void gx_tensor_store(const int dim, double *const *array, size_t p, const double *T)
{
  for (int k = 0; k < dim * dim; k++) array[k][p] = T[k];
}

#endif
