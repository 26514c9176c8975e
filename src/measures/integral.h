/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals over the cells of a grid by Gauss points, of fields that are known exactly: what sums over particles stand for. */
#ifndef GRIDCROSS_MEASURES_INTEGRAL_H
#define GRIDCROSS_MEASURES_INTEGRAL_H

#include "../spaces/mesh.h"

struct gx_integral {
  bool moves;                  /* the grid is fixed: points keep x, and X is found for them */
  struct gx_particles *points; /* [n] Gauss points of the cells, with the exact X, u, F, and m the mass that they stand for */
  struct gx_mesh *mesh;        /* the grid's functions at the points; consistent mass */
  struct gx_posed *posed;      /* the problem at points->X */
  double time;                 /* of the last placement, s */
  double *x[GX_MAX_DIM];       /* [n] the grid's own coordinate of the points, m */
  double *w;                   /* [n] their share of the grid, m^dim */
};

/* For the grid of `like`, with degree + 2 points a cell and direction, at least 3. */
enum gx_status gx_integral_create(struct gx_integral **integral, const struct gx_space *like,
                                  const struct gx_space_options *options, struct gx_outcome *outcome);
void gx_integral_free(struct gx_integral *integral);
/* Moves the material under the points to time t. */
enum gx_status gx_integral_place(struct gx_integral *integral, double t);
/* Of the material under the points, where the next search for it starts. */
void gx_integral_image(struct gx_integral *integral, struct gx_image *image);
/* field = M^-1 int rho value N dx, with consistent or lumped M; ends held as in the space. value: [dim][n]; field: [dim][stored]. */
enum gx_status gx_integral_project(struct gx_integral *integral, bool lumped, double *const *value, double *const *field);
/* sqrt(int |value|^2 dx) over the grid's coordinate. value: [dim][n]. */
double gx_integral_norm(const struct gx_integral *integral, double *const *value);

#endif
