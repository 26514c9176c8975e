/* SPDX-License-Identifier: GPL-3.0-or-later */
/* (A (x) B)^-1 = A^-1 (x) B^-1, and the same holds of the rows and columns that ends leave free, since each end holds a component on
 * a whole layer of functions. */
#include "mass_kronecker.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "../core/kernel.h"
#include "mass_band.h"

struct gx_mass_kronecker {
  const struct gx_grid *grid;
  struct gx_mass_band *band[GX_MAX_DIM];
  int lattice[GX_MAX_DIM];
  /* of the points along a direction */
  int *first;
  double *S, *m;
  double *line; /* [functions][GX_MASS_LANES] */
};

struct gx_mass_kronecker *gx_mass_kronecker_create(const struct gx_grid *grid, const int *lattice)
{
  struct gx_mass_kronecker *kronecker = calloc(1, sizeof *kronecker);
  if (!kronecker) return NULL;
  kronecker->grid = grid;
  size_t functions = 0, support = 0, most = 1;
  bool complete = true;
  for (int d = 0; d < grid->dim; d++) {
    const struct gx_axis *axis = &grid->axis[d];
    kronecker->lattice[d] = lattice[d];
    kronecker->band[d] = gx_mass_band_create(axis, grid->dim);
    complete = complete && kronecker->band[d];
    if ((size_t)axis->functions > functions) functions = (size_t)axis->functions;
    if ((size_t)axis->support > support) support = (size_t)axis->support;
    if ((size_t)lattice[d] > most) most = (size_t)lattice[d];
  }
  kronecker->first = malloc(most * sizeof *kronecker->first);
  kronecker->S = malloc(most * (support + 1) * sizeof *kronecker->S);
  kronecker->line = malloc(functions * GX_MASS_LANES * sizeof *kronecker->line);
  if (!complete || !kronecker->first || !kronecker->S || !kronecker->line) {
    gx_mass_kronecker_free(kronecker);
    return NULL;
  }
  kronecker->m = kronecker->S + most * support;
  return kronecker;
}

void gx_mass_kronecker_free(struct gx_mass_kronecker *kronecker)
{
  if (!kronecker) return;
  for (int d = 0; d < GX_MAX_DIM; d++) gx_mass_band_free(kronecker->band[d]);
  free(kronecker->first);
  free(kronecker->S);
  free(kronecker->line);
  free(kronecker);
}

/* Whether the weights along d at p are those at the point of the same number on the first line along d. */
static bool has_weights_of(const struct gx_weights *w, int d, size_t p, size_t on_line)
{
  if (w->first[d][p] != w->first[d][on_line]) return false;
  for (int k = 0; k < w->support; k++)
    if (w->S[d][(size_t)k * w->n + p] != w->S[d][(size_t)k * w->n + on_line]) return false;
  return true;
}

bool gx_mass_kronecker_fits(const struct gx_mass_kronecker *kronecker, const struct gx_weights *weights, const double *m)
{
  const int *lattice = kronecker->lattice;
  const double round_off = 32 * DBL_EPSILON;
  size_t n = 1;
  for (int d = 0; d < weights->dim; d++) n *= (size_t)lattice[d];
  if (n == 0 || n != weights->n || !(m[0] > 0)) return false;
  for (size_t p = 0; p < n; p++) {
    double product = m[0];
    for (size_t d = 0, rest = p, stride = 1; d < (size_t)weights->dim; d++) {
      size_t on_line = rest % (size_t)lattice[d] * stride;
      if (!has_weights_of(weights, (int)d, p, on_line)) return false;
      product *= m[on_line] / m[0];
      rest /= (size_t)lattice[d];
      stride *= (size_t)lattice[d];
    }
    if (!(fabs(m[p] - product) <= round_off * product)) return false;
  }
  return true;
}

int gx_mass_kronecker_factor(struct gx_mass_kronecker *kronecker, const struct gx_weights *weights, const double *m)
{
  size_t stride = 1;
  for (int d = 0; d < weights->dim; d++) {
    size_t n = (size_t)kronecker->lattice[d];
    for (size_t k = 0; k < n; k++) {
      size_t p = k * stride;
      kronecker->first[k] = weights->first[d][p];
      kronecker->m[k] = d ? m[p] / m[0] : m[p];
      for (int j = 0; j < weights->support; j++) kronecker->S[(size_t)j * n + k] = weights->S[d][(size_t)j * weights->n + p];
    }
    if (gx_mass_band_factor(kronecker->band[d], n, kronecker->first, kronecker->S, kronecker->m)) return -1;
    stride *= n;
  }
  return 0;
}

static int factor_full_line(struct gx_mass_band *band, const struct gx_particles *line, const struct gx_basis *basis)
{
  const size_t n = line->n, support = (size_t)band->axis->support;
  int *first = malloc(n * sizeof *first);
  double *S = malloc(3 * support * n * sizeof *S); /* S, slopes, half lengths */
  int status = -2;
  if (first && S) {
    double *halves = S + 2 * support * n;
    for (size_t k = 0; k < n; k++) halves[k] = 0.25 * band->axis->h;
    basis->evaluate(band->axis, n, line->X[0], halves, first, S, S + support * n);
    status = gx_mass_band_factor(band, n, first, S, line->m);
  }
  free(first);
  free(S);
  return status;
}

int gx_mass_kronecker_factor_box(struct gx_mass_kronecker *kronecker, const struct gx_basis *basis)
{
  int status = 0;
  for (int d = 0; d < kronecker->grid->dim && !status; d++) {
    const struct gx_axis *axis = &kronecker->grid->axis[d];
    const int wanted = (axis->functions + axis->cells - 1) / axis->cells; /* of a single cell GIMP meets a function more */
    const int per_cell = wanted > axis->support ? wanted : axis->support;
    struct gx_particles *line = gx_particles_create(1, &axis->cells, per_cell, GX_LAYOUT_GAUSS, 1);
    status = line ? factor_full_line(kronecker->band[d], line, basis) : -2;
    gx_particles_free(line);
  }
  return status;
}

void gx_mass_kronecker_diagonal(const struct gx_mass_kronecker *kronecker, double *diagonal)
{
  const struct gx_grid *grid = kronecker->grid;
  for (size_t node = 0; node < grid->stored; node++) {
    diagonal[node] = 1;
    for (int d = 0; d < grid->dim; d++)
      diagonal[node] *= gx_mass_band_diagonal(kronecker->band[d], (int)(node / grid->stride[d] % (size_t)grid->axis[d].stored));
  }
}

/* GX_MASS_LANES neighbouring lines along a direction; `count` of them exist. */
struct bundle {
  double *at;
  size_t apart, along; /* from line to line, from function to function */
  int count;
};

GX_CLONES static void load(const struct gx_mass_band *band, const struct bundle *bundle, double *restrict line)
{
  for (size_t k = 0; k < band->unknowns; k++) {
    double *x = line + band->position[k] * GX_MASS_LANES;
    const double *field = bundle->at + k * bundle->along;
    if (bundle->count == GX_MASS_LANES && bundle->apart == 1)
      for (int l = 0; l < GX_MASS_LANES; l++) x[l] = field[l];
    else
      for (int l = 0; l < GX_MASS_LANES; l++) x[l] = l < bundle->count ? field[(size_t)l * bundle->apart] : 0;
  }
}

GX_CLONES static void store(const struct gx_mass_band *band, const struct bundle *bundle, const double *restrict line)
{
  for (size_t k = 0; k < band->unknowns; k++) {
    const double *x = line + band->position[k] * GX_MASS_LANES;
    double *field = bundle->at + k * bundle->along;
    if (bundle->count == GX_MASS_LANES && bundle->apart == 1)
      for (int l = 0; l < GX_MASS_LANES; l++) field[l] = x[l];
    else
      for (int l = 0; l < bundle->count; l++) field[(size_t)l * bundle->apart] = x[l];
  }
}

static void solve_along(struct gx_mass_kronecker *kronecker, int d, int component, double *field)
{
  const struct gx_grid *grid = kronecker->grid;
  const struct gx_mass_band *band = kronecker->band[d];
  size_t count[2] = {1, 1}, stride[2] = {0, 0}; /* of the other directions, the faster first */
  for (int e = 0, k = 0; e < grid->dim; e++) {
    if (e == d) continue;
    count[k] = (size_t)grid->axis[e].functions;
    stride[k++] = grid->stride[e];
  }
  for (size_t b = 0; b < count[1]; b++)
    for (size_t a = 0; a < count[0]; a += GX_MASS_LANES) {
      struct bundle bundle = {.at = field + a * stride[0] + b * stride[1], .apart = stride[0], .along = grid->stride[d]};
      bundle.count = count[0] - a < GX_MASS_LANES ? (int)(count[0] - a) : GX_MASS_LANES;
      load(band, &bundle, kronecker->line);
      gx_mass_band_solve_lines(band, component, kronecker->line);
      store(band, &bundle, kronecker->line);
    }
}

void gx_mass_kronecker_solve(struct gx_mass_kronecker *kronecker, int component, double *field)
{
  for (int d = 0; d < kronecker->grid->dim; d++) solve_along(kronecker, d, component, field);
}
