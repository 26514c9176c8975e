/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splines through values at the particles of a complete lattice, and their derivatives, as products of one-dimensional operators
 * applied line by line. Of a tensor-product interpolant the derivative along direction e at a site is that of the spline through
 * the line of direction e alone, since the others take the values that they interpolate; by way of nodes they take those of the
 * spline there.
 *
 * Mirrors (ends that hold the normal component, closure symmetric): u, v and a are odd in component d across faces of direction
 * d, the other components even, and so are P_dd and, for e != d, P_de odd across faces of d and of e, for the mirror image of F
 * is R F R with R the reflection, and P(R F R) = R P(F) R in an isotropic solid. */
#ifndef GRIDCROSS_SPACES_SPLINE_LATTICE_H
#define GRIDCROSS_SPACES_SPLINE_LATTICE_H

#include <gridcross/space.h>
#include <gridcross_splines.h>

/* Which of two splines of a direction. Closure papers (1-D): the odd one is the motion's, with a zero at either end for sites, the
 * even one the stress's. */
enum gx_spline_parity { GX_PARITY_ODD, GX_PARITY_EVEN, GX_PARITIES };

struct gx_spline_direction {
  size_t sites, nodes; /* particles, nodes of the grid */
  size_t stride;       /* of particles along it */
  double *x;           /* [sites + 2] places of particles with both ends around them, m, owned */
  double *target;      /* [sites + 2] the particles, then both ends, m, owned */
  double *at_node;     /* [nodes] m, owned */
  struct gx_spline_interpolant *site[GX_PARITIES], *node[GX_PARITIES];
  struct gx_spline_points *from_sites[GX_PARITIES]; /* at the particles (closure papers: and ends); nodal: at the nodes */
  struct gx_spline_points *from_nodes;              /* nodal: at the particles */
  struct gx_spline_lines *of_sites[GX_PARITIES], *of_nodes[GX_PARITIES];
};

struct gx_spline_lattice {
  int dim, degree;
  size_t n; /* particles */
  bool nodal, periodic;
  bool closed;                /* closure papers between fixed ends: zeros at the ends are sites of motion; 1-D */
  bool stress_at_ends;        /* closed, reference frame: the stress is splined through both ends, too */
  struct gx_outcome *outcome; /* borrowed */
  struct gx_spline_direction direction[GX_MAX_DIM];
  double *value;       /* closed: [n + 2] values at sites, owned */
  double *nodal_value; /* nodal: [nodes of all directions], owned */
  double *between[2];  /* nodal: what lies between two directions, owned */
  double *block;
};

/* Splines at the particles' reference positions. Zeroes lattice first; freed by the caller whatever happened. */
enum gx_status gx_spline_lattice_create(struct gx_spline_lattice *lattice, bool nodal, const struct gx_space_options *options,
                                        const struct gx_particles *particles, struct gx_outcome *outcome);
void gx_spline_lattice_free(struct gx_spline_lattice *lattice);

/* Splines at particles in x = X + u; u NULL: at X. 1-D. */
enum gx_status gx_spline_lattice_place(struct gx_spline_lattice *lattice, const double *X, const double *u);

/* slope_e <- derivative along e of component d of a motion (u or v) at the particles; stress_at_ends: and at both ends, behind
 * them. motion: [n]; slope: [dim][n, or n + 2]. */
void gx_spline_lattice_gradient(struct gx_spline_lattice *lattice, int d, const double *motion, double *const *slope);

/* out <- sum over e of the derivative along e of row d of a stress. stress: [dim][n], stress_at_ends: [n + 2], both ends behind;
 * out: [n + 2], of which n are wanted. */
void gx_spline_lattice_divergence(struct gx_spline_lattice *lattice, int d, double *const *stress, double *out);

#endif
