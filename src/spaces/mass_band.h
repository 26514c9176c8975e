/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Consistent mass of one direction, M_ij = sum_k m_k S_ik S_jk: a band matrix, factored by GSL's band Cholesky. */
#ifndef GRIDCROSS_SPACES_MASS_BAND_H
#define GRIDCROSS_SPACES_MASS_BAND_H

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

#include <gridcross/grid.h>

enum { GX_MASS_ENDS = 4 };  /* which ends are held: bit 0 the low one, bit 1 the high one */
enum { GX_MASS_LANES = 8 }; /* lines that are solved side by side */

/* A function whose M(i, i) is below this share of the largest has no mass but that of round-off in the positions of particles. */
#define GX_MASS_TRACE 1e-24
/* The same share below zero is more than round-off: the masses of points that are fitted to particles may be negative. */
#define GX_MASS_NEGATIVE -1e-12

struct gx_mass_band {
  const struct gx_axis *axis; /* borrowed */
  size_t unknowns, bandwidth;
  size_t *position;                 /* [stored] unknown of a stored function */
  bool *filled;                     /* [unknowns] some point sees the function; of the matrix assembled last */
  unsigned ends[GX_MAX_DIM];        /* of a vector component: which ends hold it */
  gsl_matrix *assembled;            /* symmetric band: (i, j) is M(i + j, i) */
  gsl_matrix *factor[GX_MASS_ENDS]; /* Cholesky factors; NULL where no component has these ends */
  double *inverse[GX_MASS_ENDS];    /* [unknowns] one over their diagonals */
  gsl_vector *x;
};

/* For components 0 ... components - 1. NULL when memory runs out. */
struct gx_mass_band *gx_mass_band_create(const struct gx_axis *axis, int components);
void gx_mass_band_free(struct gx_mass_band *band);
/* Assembles and factors M for n points: first[k], S[j * n + k], j below the axis' support. Returns 0, or -1 when M is not positive
 * definite on the functions that some point sees and no end holds; the others are taken out. */
int gx_mass_band_factor(struct gx_mass_band *band, size_t n, const int *first, const double *S, const double *m);
/* M(i, i) of a function. */
double gx_mass_band_diagonal(const struct gx_mass_band *band, int function);
/* Solves M x = field in place for a component; functions that are held or that no point sees get 0. field: [stored], folded. */
void gx_mass_band_solve(struct gx_mass_band *band, int component, double *field);
/* The same for GX_MASS_LANES lines at once. line: [unknowns][GX_MASS_LANES], by position. */
void gx_mass_band_solve_lines(const struct gx_mass_band *band, int component, double *line);

#endif
