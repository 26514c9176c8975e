/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the two spline spaces share: strong-form acceleration a = Div P / rho0 + b by splines through particle values.
 *
 *   frame reference: sites X, a_d = (1/rho0) sum_e dP_de/dX_e + b_d, F_de = delta_de + du_d/dX_e; on a complete lattice in 2-D and 3-D
 *   frame current:   sites x, a = (F/rho0) dsigma/dx + b, dF/dt = (dv/dx) F, 1-D; berzins2021 §8 omits the factor F (divergence papers)
 *
 * Ends: closure papers (1-D) splines u and v through the particles and a zero at either end, the stress through the particles (in
 * the reference frame also through both ends); closure symmetric mirrors motion and stress at ends that hold the normal component,
 * see spline_lattice.h; periodic problems need neither. */
#ifndef GRIDCROSS_SPACES_COLLOCATION_H
#define GRIDCROSS_SPACES_COLLOCATION_H

#include <gridcross/space.h>

#include "spline_lattice.h"

struct gx_collocation {
  struct gx_space space;
  struct gx_space_options options;
  size_t n; /* particles */
  struct gx_spline_lattice lattice;
  bool strained;                 /* F is that of u, and the stress that of F: neither is integrated */
  double *F[GX_MAX_TENSOR];      /* [n] the particles', or, stress at ends, [n + 2] with both ends behind them, owned */
  double *P[GX_MAX_TENSOR];      /* likewise */
  double *a[GX_MAX_DIM];         /* [n + 2] acceleration of particles, owned */
  double *opened[GX_MAX_DIM];    /* [n] y of GX_OPEN, owned */
  double *rate[GX_MAX_TENSOR];   /* [n] dF/dt where F or the stress is integrated, else NULL, owned */
  double *rate_P[GX_MAX_TENSOR]; /* [n] dP/dt where the stress is, else NULL, owned */
  void *block;
};

enum gx_status gx_collocation_create(const struct gx_space_kind *kind, struct gx_space **space,
                                     const struct gx_space_options *options, struct gx_particles *particles,
                                     const struct gx_posed *posed, struct gx_outcome *outcome);
void gx_collocation_free(struct gx_space *space);

/* The primitives, which differ by `nodal` alone. */
enum gx_status gx_collocation_weights(struct gx_space *space);
enum gx_status gx_collocation_project(struct gx_space *space);
enum gx_status gx_collocation_accelerate(struct gx_space *space, double t);
void gx_collocation_advance(struct gx_space *space, double kick, double strain, double drift);
enum gx_status gx_collocation_twofold(struct gx_space *space, enum gx_primitive primitive, double span);
void gx_collocation_state(struct gx_space *space, struct gx_state *state);
void gx_collocation_rates(struct gx_space *space, double *const *rate);
double gx_collocation_kinetic(const struct gx_space *space);
void gx_collocation_settle(struct gx_space *space);
void gx_collocation_particle_acceleration(struct gx_space *space, double *const *a);

#endif
