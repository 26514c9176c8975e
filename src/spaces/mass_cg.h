/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Consistent mass of any particles in any dimension: conjugate gradients, with M applied as scatter(m gather(x)) by the transfer
 * kernels, preconditioned by the mass of a full box, scaled to the diagonal of M. */
#ifndef GRIDCROSS_SPACES_MASS_CG_H
#define GRIDCROSS_SPACES_MASS_CG_H

#include <gridcross/basis.h>

#include "transfer.h"

/* The residual that ends the iteration, relative to the right side, both in the norm of the preconditioner's inverse: since that is
 * near M^-1, it bounds the error of the solution in the norm of M (kinetic energy). */
#define GX_MASS_CG_TOLERANCE 1e-14
enum { GX_MASS_CG_MOST = 1000 }; /* iterations */

struct gx_mass_cg;

/* For n particles. NULL when memory runs out. grid is borrowed. */
struct gx_mass_cg *gx_mass_cg_create(const struct gx_grid *grid, const struct gx_basis *basis, size_t n);
void gx_mass_cg_free(struct gx_mass_cg *cg);
/* Takes M to be that of weights and m, both borrowed until the next call. Returns 0, or -1 when M(i, i) of a function is negative. */
int gx_mass_cg_prepare(struct gx_mass_cg *cg, const struct gx_weights *weights, const double *m);
/* Solves M x = field in place for every vector component at once; functions that are held or that no particle sees get 0.
 * field: [dim][stored], folded; spread on return. Returns the iterations taken, or -1 when M is not positive definite or the
 * iteration does not end. A field that is not finite is left as it is. */
int gx_mass_cg_solve(struct gx_mass_cg *cg, double *const *field);

#endif
