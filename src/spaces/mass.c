/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The choice among the solvers of consistent mass. */
#include "mass.h"

#include <stdlib.h>

#include "mass_band.h"
#include "mass_cg.h"
#include "mass_kronecker.h"

struct gx_mass {
  const struct gx_grid *grid;
  bool is_product;                     /* M of the last gx_mass_factor */
  struct gx_mass_band *band;           /* 1-D, else NULL */
  struct gx_mass_kronecker *kronecker; /* 2-D and 3-D */
  struct gx_mass_cg *cg;
};

struct gx_mass *gx_mass_create(const struct gx_grid *grid, const struct gx_basis *basis, const struct gx_particles *particles)
{
  struct gx_mass *mass = calloc(1, sizeof *mass);
  if (!mass) return NULL;
  mass->grid = grid;
  if (grid->dim == 1) {
    mass->band = gx_mass_band_create(&grid->axis[0], 1);
  } else {
    mass->kronecker = gx_mass_kronecker_create(grid, particles->lattice);
    mass->cg = gx_mass_cg_create(grid, basis, particles->n);
  }
  if (mass->band || (mass->kronecker && mass->cg)) return mass;
  gx_mass_free(mass);
  return NULL;
}

void gx_mass_free(struct gx_mass *mass)
{
  if (!mass) return;
  gx_mass_band_free(mass->band);
  gx_mass_kronecker_free(mass->kronecker);
  gx_mass_cg_free(mass->cg);
  free(mass);
}

enum gx_status gx_mass_factor(struct gx_mass *mass, const struct gx_weights *weights, const double *m, struct gx_outcome *outcome)
{
  int failed = 0;
  mass->is_product = !mass->band && gx_mass_kronecker_fits(mass->kronecker, weights, m);
  if (mass->band)
    failed = gx_mass_band_factor(mass->band, weights->n, weights->first[0], weights->S[0], m);
  else if (mass->is_product)
    failed = gx_mass_kronecker_factor(mass->kronecker, weights, m);
  else
    failed = gx_mass_cg_prepare(mass->cg, weights, m);
  if (!failed) return GX_OK;
  return gx_status_set(outcome, GX_SINGULAR, -1,
                       "the consistent mass matrix is not positive definite: too few particles under a basis function");
}

enum gx_status gx_mass_solve(struct gx_mass *mass, double *const *field, struct gx_outcome *outcome)
{
  if (mass->band) {
    gx_mass_band_solve(mass->band, 0, field[0]);
  } else if (mass->is_product) {
    for (int d = 0; d < mass->grid->dim; d++) {
      gx_mass_kronecker_solve(mass->kronecker, d, field[d]);
      gx_grid_spread(mass->grid, field[d]);
    }
  } else if (gx_mass_cg_solve(mass->cg, field) < 0) {
    return gx_status_set(outcome, GX_SINGULAR, -1,
                         "the consistent mass matrix is too near to singular for conjugate gradients (%d iterations): too few "
                         "particles under a basis function",
                         GX_MASS_CG_MOST);
  }
  return GX_OK;
}
