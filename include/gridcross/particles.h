/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The particle store that every space shares: a structure of arrays, one contiguous aligned array per component. */
#ifndef GRIDCROSS_PARTICLES_H
#define GRIDCROSS_PARTICLES_H

#include <stdbool.h>
#include <stddef.h>

#include <gridcross/image.h>
#include <gridcross/status.h>

enum { GX_MAX_DIM = 3, GX_MAX_TENSOR = 9 };

enum gx_layout {
  GX_LAYOUT_UNIFORM, /* centres of equal parts of a cell: the midpoint rule */
  GX_LAYOUT_GAUSS    /* Gauss points of a cell, Gauss weights as volumes */
};

/* Tensors are row-major: component (i, j) is array i * dim + j. All arrays have n entries, 64-byte aligned, owned. SI units.
 * On a complete lattice particle p is point (k0, k1, k2), p = (k2 lattice[1] + k1) lattice[0] + k0, and its X and half_length along d
 * depend on k_d alone: sums over it factor by directions. Whoever moves X or changes the order clears `lattice`. */
struct gx_particles {
  int dim;                         /* 1, 2 or 3 */
  size_t n;                        /* number of particles */
  int lattice[GX_MAX_DIM];         /* points per direction; zeros: not a complete lattice */
  double *X[GX_MAX_DIM];           /* reference position, m */
  double *u[GX_MAX_DIM];           /* displacement, m; current position x = X + u, never wrapped */
  double *v[GX_MAX_DIM];           /* velocity, m/s */
  double *b[GX_MAX_DIM];           /* body force per unit mass at the last acceleration, m/s^2 */
  double *F[GX_MAX_TENSOR];        /* deformation gradient dx/dX, – */
  double *P[GX_MAX_TENSOR];        /* first Piola–Kirchhoff stress, Pa */
  double *m;                       /* mass, kg (per unit area in 1-D, per unit length in 2-D) */
  double *V0;                      /* reference volume, m^dim */
  double *half_length[GX_MAX_DIM]; /* half the reference edge of the particle's domain, m */
  void *block;                     /* the memory behind all of the above */
};

/* Particles at rest, F = I, in the box [0,1]^dim of cells[d] cells with per_cell particles per cell and direction,
 * a complete lattice. density: kg/m^dim. NULL when memory runs out or the particles cannot be counted. */
struct gx_particles *gx_particles_create(int dim, const int *cells, int per_cell, enum gx_layout layout, double density);
/* Those of them, in the same order, that are inside a body (NULL: all); there may be none. */
struct gx_particles *gx_particles_fill(int dim, const int *cells, int per_cell, enum gx_layout layout, double density,
                                       bool (*inside)(const void *body, const double *X), const void *body);

/* Gauss points of the cells as particles of density 1, V0 their weights, with domains so narrow that functions averaged over them are
 * what they average. */
struct gx_particles *gx_particles_points(int dim, const int *cells, int per_cell);

/* A list of particles; all owned by whoever made it. */
struct gx_points {
  char *path; /* where they were read */
  int dim;
  size_t n;
  double *X[GX_MAX_DIM]; /* [n] reference position, m */
  double *V0;            /* [n] reference volume, m^dim */
};

/* The same of a list; their domains are cubes of their volumes. */
struct gx_particles *gx_particles_list(const struct gx_points *points, double density);
/* A copy with its own memory; NULL when that runs out. */
struct gx_particles *gx_particles_copy(const struct gx_particles *particles);
void gx_particles_free(struct gx_particles *particles);
/* Of what a run changes: u, v, b, F and P. */
void gx_particles_image(struct gx_particles *particles, struct gx_image *image);

/* det F of one particle */
double gx_particles_jacobian(const struct gx_particles *particles, size_t p);
/* V0 of all particles, m^dim, where they differ by no more than round-off, else 0. */
double gx_particles_volume(const struct gx_particles *particles);

#endif
