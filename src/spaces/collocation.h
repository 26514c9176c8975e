/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the two spline spaces share: strong-form acceleration a = Div P / rho0 + b by splines through particle values, in 1-D.
 *
 *   frame reference: sites X, a = (1/rho0) dP/dX + b, F = 1 + du/dX
 *   frame current:   sites x, a = (F/rho0) dsigma/dx + b, dF/dt = (dv/dx) F; berzins2021 §8 omits the factor F (divergence papers)
 *
 * Ends: closure papers splines u and v through the particles and a zero at either end, the stress through the particles (in the
 * reference frame also through both ends); closure symmetric mirrors u and v oddly and the stress evenly at the ends; periodic
 * problems need neither. */
#ifndef GRIDCROSS_SPACES_COLLOCATION_H
#define GRIDCROSS_SPACES_COLLOCATION_H

#include <gridcross/space.h>
#include <gridcross_splines.h>

struct gx_collocation {
  struct gx_space space;
  struct gx_space_options options;
  size_t n;    /* particles */
  bool nodal;  /* by way of the grid's nodes */
  bool closed; /* closure papers between fixed ends: zeros at the ends are sites of motion */
  bool stress_at_ends;
  size_t nodes;
  /* splines through the motion (u or v) and the stress at their sites */
  struct gx_spline_interpolant *motion, *stress, *node;
  struct gx_spline_points *motion_points; /* particles and ends: derivative; nodal: nodes: value */
  struct gx_spline_points *stress_points; /* particles: derivative; nodal: nodes: derivative */
  struct gx_spline_points *node_points;   /* nodal: particles and ends: value, derivative */
  double *x;                              /* [n + 2] sites with both ends around them */
  double *ends_last;   /* [n + 2] the particles, then both ends: points where the motion's derivative is taken */
  double *at_node;     /* [nodes] positions */
  double *value;       /* [n + 2] values at sites */
  double *coefficient; /* [most functions] */
  double *nodal_value; /* [nodes] */
  double *slope;       /* [n + 2] derivative of motion at particles, then ends */
  double *F, *P;       /* [n + 2] at particles, then ends: reference frame */
  double *a;           /* [n] acceleration of particles */
  double *opened;      /* [n] y of GX_OPEN */
  double *rate;        /* [n] */
  double *block;
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
