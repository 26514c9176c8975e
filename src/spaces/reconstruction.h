/* SPDX-License-Identifier: GPL-3.0-or-later */
/* method.quadrature reconstructed: the integrals of mass, momentum and force are taken at p + 1 Gauss points a cell and direction,
 * where density, velocity, stress and body force are reconstructed from the particles:
 *   M_ij = int rho phi_i phi_j,  p_i = int rho v phi_i,  f_i = int (-sigma : grad phi_i + rho b phi_i).
 * Particles then only carry the fields and are no quadrature rule, whose error grows where they cross cells (steffen2010 §5.3).
 * Velocity is shifted by what the reconstruction leaves out of the particles' momentum, so that the total is exact. The splines of a
 * line leave the density alone: its total is right to the order of the quadrature, and to scale it would detune every vibration by
 * that error, which adds up over periods while the local errors do not.
 * Sources: Tielen, Wobbes, Moeller & Beuth, A high order material point method, Procedia Eng. 175 (2017); Wobbes, Moeller, Galavi &
 * Vuik, Conservative Taylor least squares reconstruction with application to material point methods, Int. J. Numer. Meth. Engng
 * 117 (2019). */
#ifndef GRIDCROSS_SPACES_RECONSTRUCTION_H
#define GRIDCROSS_SPACES_RECONSTRUCTION_H

#include <gridcross/space.h>

#include "blocks.h"

/* Fields through particles: values at the particles to values at fixed points. */
struct gx_fit;

struct gx_fit_kind {
  bool scales; /* density is scaled to the particles' total mass; else it is accurate enough to be left alone */
  void (*free)(struct gx_fit *fit);
  /* Particles are at x: [dim][n]. */
  enum gx_status (*place)(struct gx_fit *fit, const double *const *x);
  /* value: [count][n] at the particles to out: [count][points]; odd: zero where the ends are held and mirrored with a change of
   * sign, else evenly. */
  void (*take)(struct gx_fit *fit, int count, bool odd, double *const *value, double *const *out);
};

struct gx_fit {
  const struct gx_fit_kind *kind;
  /* Of the last placement: particles in cells whose integrals are left to sums over them, where fields are 0 at the points; NULL:
   * none. How many such cells there are. */
  const bool *left; /* [n] */
  size_t left_cells;
};

struct gx_reconstruction {
  const struct gx_grid *grid;           /* borrowed */
  const struct gx_particles *particles; /* borrowed */
  bool current;                         /* fields of x and of present volumes, else of X and of reference ones */
  struct gx_fit *fit;
  /* Gauss points of the cells, p + 1 a direction, which never move: V0 their weights, m the mass they stand for, v what is projected, b
   * and P what the force scatters by weights, N, and by gradients, N m. Owned */
  struct gx_particles *points;
  struct gx_blocks blocks;      /* of the points */
  double *field[GX_MAX_TENSOR]; /* [n] T of the particles, then per volume */
  double *inverse_volume;       /* [n] of the particles, 1/m^dim */
  void *block;
};

/* On a grid laid out for the basis; current: the grid is fixed. Refuses particles that no field passes through. */
enum gx_status gx_reconstruction_create(struct gx_reconstruction **out, const struct gx_grid *grid,
                                        const struct gx_space_options *options, const struct gx_particles *particles,
                                        bool current, struct gx_outcome *outcome);
void gx_reconstruction_free(struct gx_reconstruction *reconstruction);
/* Particles are at x: [dim][n]. */
enum gx_status gx_reconstruction_place(struct gx_reconstruction *reconstruction, const double *const *x);
/* m of the points from the particles' m and F. */
void gx_reconstruction_mass(struct gx_reconstruction *reconstruction);
/* value of the points from the particles' [dim][n], with the sum of m value of the particles unless an end holds the component. */
void gx_reconstruction_value(struct gx_reconstruction *reconstruction, double *const *value);
/* T of the points from that in field, integrated over the particles' volumes; body from b: [dim][n], m/s^2, or NULL. */
void gx_reconstruction_force(struct gx_reconstruction *reconstruction, double *const *b);
/* Adds one constant a component to values of the particles, [dim][n], so that the sum of m value is moment, unless an end holds the
 * component: what the particles do not take of the nodes' momentum. */
void gx_reconstruction_keep(const struct gx_reconstruction *reconstruction, const double *moment, double *const *value);

#endif
