/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Consistent mass M_ij = sum_p m_p S_ip S_jp, by the cheapest solver that the particles allow:
 * - 1-D: a band matrix and GSL's band Cholesky (mass_band.h);
 * - 2-D and 3-D, weights and masses that are products over the directions (particles on a complete lattice at their reference
 *   positions: the moving mesh, or a fixed grid before anything moves): factors of one direction each (mass_kronecker.h);
 * - else conjugate gradients (mass_cg.h).
 * Functions that no particle sees and those that an end holds are taken out: they get 0. */
#ifndef GRIDCROSS_SPACES_MASS_H
#define GRIDCROSS_SPACES_MASS_H

#include <gridcross/basis.h>

#include "transfer.h"

struct gx_mass;

/* For the given particles. NULL when memory runs out. grid is borrowed. */
struct gx_mass *gx_mass_create(const struct gx_grid *grid, const struct gx_basis *basis, const struct gx_particles *particles);
void gx_mass_free(struct gx_mass *mass);
/* Takes M to be that of weights and m, both borrowed until the next call. GX_SINGULAR when it is seen not to be positive definite. */
enum gx_status gx_mass_factor(struct gx_mass *mass, const struct gx_weights *weights, const double *m,
                              struct gx_outcome *outcome);
/* Solves M x = field in place for every vector component. field: [dim][stored], folded; spread on return. GX_SINGULAR when
 * conjugate gradients do not get to GX_MASS_CG_TOLERANCE. Nothing is allocated, and equal calls give equal bits. */
enum gx_status gx_mass_solve(struct gx_mass *mass, double *const *field, struct gx_outcome *outcome);

#endif
