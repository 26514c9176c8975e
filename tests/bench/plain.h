/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops that gridcross is timed against: each method as one would write it in C from the papers, for one dimension and one
 * basis, with sin and cos of 2 pi X tabulated, cos(C pi t) once a step, and no norms. */
#ifndef GRIDCROSS_BENCH_PLAIN_H
#define GRIDCROSS_BENCH_PLAIN_H

#include <stddef.h>

#include <gridcross/particles.h>

/* Particle and nodal vectors are arrays of structures: component d of entry i is [dim * i + d]. SI units. */
struct plain {
  int dim, cells;
  size_t n, nodes;
  double modulus, density, amplitude, dt;
  long step;                      /* steps taken */
  double *X, *u, *v, *F, *m, *V0; /* particles */
  double *sine, *cosine;          /* of 2 pi X, [dim * n] */
  double *mass, *vi, *ai, *ui;    /* nodes; vi and ai begin a step as momentum and force */
  double *S, *D;                  /* up to 3 weights per particle and direction, 1-D methods */
  int *first;                     /* first node met */
};

/* A copy of the initial particles; a cell-wise grid with room for three more nodes per direction. NULL: out of memory. */
struct plain *plain_create(const struct gx_particles *start, int cells, double modulus, double density, double amplitude,
                           double dt);
void plain_free(struct plain *plain);

/* Methods: an optional start (nodal fields), a step from time step * dt, and an optional sampling of u at the particles. */
void plain_standard_linear(struct plain *plain);
void plain_standard_quadratic(struct plain *plain);
void plain_cpgimp(struct plain *plain);
void plain_moving_mesh_linear_start(struct plain *plain);
void plain_moving_mesh_linear(struct plain *plain);
void plain_moving_mesh_quadratic_start(struct plain *plain);
void plain_moving_mesh_quadratic(struct plain *plain);
void plain_standard_3d(struct plain *plain);
void plain_moving_mesh_3d_start(struct plain *plain);
void plain_moving_mesh_3d(struct plain *plain);
/* The moving mesh without state of the particles, a better method than the papers write. */
void plain_nodal_linear_start(struct plain *plain);
void plain_nodal_linear(struct plain *plain);
void plain_nodal_linear_sample(struct plain *plain);
void plain_nodal_quadratic_start(struct plain *plain);
void plain_nodal_quadratic(struct plain *plain);
void plain_nodal_quadratic_sample(struct plain *plain);
void plain_nodal_3d_start(struct plain *plain);
void plain_nodal_3d(struct plain *plain);
void plain_nodal_3d_sample(struct plain *plain);

#endif
