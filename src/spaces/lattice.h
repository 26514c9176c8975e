/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transfers between a complete lattice of particles at rest on the grid and its nodes, factored by direction: weights are
 * products (steffen2010 eq. 29), and those of a direction depend on the place along it alone, so that a sum over the nodes of a
 * particle is one sum over few nodes after another. The same sums as gx_transfer_*, up to round-off, in any dimension. */
#ifndef GRIDCROSS_SPACES_LATTICE_H
#define GRIDCROSS_SPACES_LATTICE_H

#include <gridcross/basis.h>
#include <gridcross/particles.h>

#include "../core/team.h"

struct gx_lattice;

/* The points of a lattice along a direction, alike in every cell. */
struct gx_lattice_line {
  int points, support, nodes;
  int period;          /* points of a cell */
  size_t stride;       /* of nodal fields */
  const int *first;    /* [points] lowest function met */
  const double *S, *D; /* first direction: [support][points], else [points][support] */
};

/* A row of particles along the first direction, consecutive from `first` on. [n] arrays, scratch that the visitor may change. */
struct gx_lattice_row {
  size_t first, n;
  double *gradient[GX_MAX_TENSOR]; /* of the field */
  double *value[GX_MAX_DIM];       /* of the field */
  double *T[GX_MAX_TENSOR];        /* to be scattered by gradients: as in gx_transfer_scatter_force */
  double *body[GX_MAX_DIM];        /* to be scattered by weights */
};

/* One pass over all rows: a nodal field is gathered, the visitor sees it at the particles, what it sets is scattered. */
struct gx_lattice_pass {
  double *const *field; /* [dim][stored]; NULL: none */
  bool gradient, value; /* what the visitor is given of it */
  double *const *sum;   /* [dim][stored]; NULL: none */
  bool T, body;         /* what the visitor sets for it: all n entries */
  /* Rows are visited at once and in any order. */
  void (*visit)(void *context, const struct gx_lattice_row *row);
  void *context;
};

/* NULL when the particles are not a complete lattice that sits alike in every cell of the grid, or memory runs out: then the
 * general transfers serve. team is borrowed and may be NULL. */
struct gx_lattice *gx_lattice_create(const struct gx_grid *grid, const struct gx_basis *basis,
                                     const struct gx_particles *particles, struct gx_team *team);
void gx_lattice_free(struct gx_lattice *lattice);
/* Its first direction. */
const struct gx_lattice_line *gx_lattice_line(const struct gx_lattice *lattice);
/* The same bits for any team. Allocates nothing. */
void gx_lattice_run(struct gx_lattice *lattice, const struct gx_lattice_pass *pass);
/* value[d][p] = sum_i field[d][i] S_ip; gradient[d*dim+e][p] = sum_i field[d][i] D_ip,e; either may be NULL. */
void gx_lattice_gather(struct gx_lattice *lattice, double *const *field, double *const *value, double *const *gradient);
/* moment[d][i] = sum_p m_p value[d][p] S_ip */
void gx_lattice_scatter(struct gx_lattice *lattice, const double *m, double *const *value, double *const *moment);

#endif
