/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Consistent mass M_ij = sum_p m_p S_ip S_jp: assembled as a band matrix, factored and solved by GSL's band Cholesky. */
#ifndef GRIDCROSS_SPACES_MASS_H
#define GRIDCROSS_SPACES_MASS_H

#include <gridcross/basis.h>

#include "transfer.h"

struct gx_mass;

/* Memory that the band matrices of a grid take. */
double gx_mass_bytes(const struct gx_grid *grid);
/* NULL when memory runs out. grid is borrowed. */
struct gx_mass *gx_mass_create(const struct gx_grid *grid);
void gx_mass_free(struct gx_mass *mass);
/* Assembles and factors M for the current weights. Returns 0, or -1 when M is not positive definite. */
int gx_mass_factor(struct gx_mass *mass, const struct gx_weights *weights, const double *m);
/* Solves M x = field in place for component d, whose ends are held at zero in bounded direction d. field: [stored], folded. */
void gx_mass_solve(struct gx_mass *mass, int d, double *field);

#endif
