/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Consistent mass of a product of directions, M = M_x (x) M_y (x) M_z: solved line by line with the factors of each direction. */
#ifndef GRIDCROSS_SPACES_MASS_KRONECKER_H
#define GRIDCROSS_SPACES_MASS_KRONECKER_H

#include <gridcross/basis.h>

#include "transfer.h"

struct gx_mass_kronecker;

/* NULL when memory runs out. grid is borrowed. lattice: of the particles, as in gx_particles; zeros where only boxes are factored. */
struct gx_mass_kronecker *gx_mass_kronecker_create(const struct gx_grid *grid, const int *lattice);
void gx_mass_kronecker_free(struct gx_mass_kronecker *kronecker);
/* Whether weights and masses are products: particle (k0, k1, k2) of the lattice has the weights of k_d along d, and a mass that is a
 * product over d but for round-off. */
bool gx_mass_kronecker_fits(const struct gx_mass_kronecker *kronecker, const struct gx_weights *weights, const double *m);
/* Factors the mass of particles that fit. Returns 0, or -1 when it is not positive definite. */
int gx_mass_kronecker_factor(struct gx_mass_kronecker *kronecker, const struct gx_weights *weights, const double *m);
/* Factors the mass of a full box of density 1, by as many Gauss points in each cell as functions meet there, with domains of half
 * a cell. Returns 0, -1 when it is not positive definite, -2 when memory runs out. */
int gx_mass_kronecker_factor_box(struct gx_mass_kronecker *kronecker, const struct gx_basis *basis);
/* diagonal[i] = M(i, i), at periodic images too. [stored] */
void gx_mass_kronecker_diagonal(const struct gx_mass_kronecker *kronecker, double *diagonal);
/* Solves M x = field in place for a vector component, zero where an end holds it. field: [stored], folded, and
 * folded on return. */
void gx_mass_kronecker_solve(struct gx_mass_kronecker *kronecker, int component, double *field);

#endif
