/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Total linear and angular momentum and kinetic energy of particles, and the sizes that their changes are compared with. */
#ifndef GRIDCROSS_MEASURES_MOMENTUM_H
#define GRIDCROSS_MEASURES_MOMENTUM_H

#include <gridcross/space.h>

struct gx_momentum {
  double linear[GX_MAX_DIM];  /* sum m v, kg m/s */
  double angular[GX_MAX_DIM]; /* sum m x cross v, about the origin, kg m^2/s; in 2-D only that along z, the last */
  double kinetic;             /* sum m v^2 / 2, J */
  /* bounds of sum m |v| and sum m |x - xc| |v|, by Cauchy and Schwarz, which a body keeps while it moves in any way; xc: its
   * centre of mass */
  double linear_size, angular_size;
};

/* v: [dim][n], m/s */
struct gx_momentum gx_momentum_of(const struct gx_particles *particles, double *const *v);
/* |a - b| of vectors in 3-D. */
double gx_momentum_distance(const double *a, const double *b);

#endif
