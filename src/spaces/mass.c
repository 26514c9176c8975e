/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A periodic direction couples its last functions to its first: numbering 0, n-1, 1, n-2, ... turns the cyclic band of half
 * width w into a plain one of half width 2w, so that one band solver serves every grid. */
#include "mass.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

struct gx_mass {
  const struct gx_grid *grid;
  size_t unknowns, bandwidth;
  size_t *position;               /* [stored] unknown of a stored function */
  unsigned *held;                 /* [unknowns] bit d: held at zero in component d */
  int variants;                   /* factors: one when no component is held, else one per component */
  gsl_matrix *assembled;          /* symmetric band: (i, j) is M(i + j, i) */
  gsl_matrix *factor[GX_MAX_DIM]; /* Cholesky factors */
  gsl_vector *x;
};

static size_t interleaved(size_t i, size_t n)
{
  return i < (n + 1) / 2 ? 2 * i : 2 * (n - 1 - i) + 1;
}

static size_t number_on_axis(const struct gx_axis *axis, size_t k)
{
  size_t n = (size_t)axis->functions;
  return axis->periodic ? interleaved(k % n, n) : k;
}

/* Largest distance between the numbers of two functions that share a cell. */
static size_t bandwidth_on_axis(const struct gx_axis *axis)
{
  size_t widest = 0;
  for (int first = 0; first + axis->support <= axis->stored; first++)
    for (int a = 0; a < axis->support; a++)
      for (int b = 0; b < a; b++) {
        size_t i = number_on_axis(axis, (size_t)(first + a)), j = number_on_axis(axis, (size_t)(first + b));
        size_t apart = i > j ? i - j : j - i;
        if (apart > widest) widest = apart;
      }
  return widest;
}

static void number_functions(struct gx_mass *mass)
{
  const struct gx_grid *grid = mass->grid;
  for (size_t node = 0; node < grid->stored; node++) {
    size_t position = 0, stride = 1;
    for (int d = 0; d < grid->dim; d++) {
      const struct gx_axis *axis = &grid->axis[d];
      int k = (int)(node / grid->stride[d] % (size_t)axis->stored);
      position += number_on_axis(axis, (size_t)k) * stride;
      stride *= (size_t)axis->functions;
    }
    mass->position[node] = position;
    mass->held[position] = gx_grid_held(grid, node);
  }
}

/* Band matrices: the assembled one, and a factor for each set of held functions. */
static void dimensions(const struct gx_grid *grid, size_t *unknowns, size_t *bandwidth, int *variants)
{
  *unknowns = 1;
  *bandwidth = 0;
  *variants = 1;
  for (int d = 0; d < grid->dim; d++) {
    *bandwidth += bandwidth_on_axis(&grid->axis[d]) * *unknowns;
    *unknowns *= (size_t)grid->axis[d].functions;
    if (grid->axis[d].held[0] || grid->axis[d].held[1]) *variants = grid->dim;
  }
  if (*bandwidth >= *unknowns) *bandwidth = *unknowns - 1;
}

double gx_mass_bytes(const struct gx_grid *grid)
{
  size_t unknowns, bandwidth;
  int variants;
  dimensions(grid, &unknowns, &bandwidth, &variants);
  return (double)sizeof(double) * (double)unknowns * (double)(bandwidth + 1) * (variants + 1);
}

struct gx_mass *gx_mass_create(const struct gx_grid *grid)
{
  struct gx_mass *mass = calloc(1, sizeof *mass);
  if (!mass) return NULL;
  mass->grid = grid;
  dimensions(grid, &mass->unknowns, &mass->bandwidth, &mass->variants);
  mass->position = malloc(grid->stored * sizeof *mass->position);
  mass->held = calloc(mass->unknowns, sizeof *mass->held);
  mass->assembled = gsl_matrix_alloc(mass->unknowns, mass->bandwidth + 1);
  mass->x = gsl_vector_alloc(mass->unknowns);
  bool complete = mass->position && mass->held && mass->assembled && mass->x;
  for (int v = 0; v < mass->variants; v++) {
    mass->factor[v] = gsl_matrix_alloc(mass->unknowns, mass->bandwidth + 1);
    complete = complete && mass->factor[v];
  }
  if (!complete) {
    gx_mass_free(mass);
    return NULL;
  }
  number_functions(mass);
  return mass;
}

void gx_mass_free(struct gx_mass *mass)
{
  if (!mass) return;
  free(mass->position);
  free(mass->held);
  gsl_matrix_free(mass->assembled);
  for (int v = 0; v < GX_MAX_DIM; v++) gsl_matrix_free(mass->factor[v]);
  gsl_vector_free(mass->x);
  free(mass);
}

static void assemble(struct gx_mass *mass, const struct gx_weights *w, const double *m)
{
  enum { MOST = GX_MAX_DEGREE + 1 };
  size_t position[MOST * MOST * MOST];
  double S[MOST * MOST * MOST];
  int s = w->support, count = 1;
  for (int d = 0; d < w->dim; d++) count *= s;
  gsl_matrix_set_zero(mass->assembled);
  double *band = mass->assembled->data;
  size_t width = mass->assembled->tda;
  for (size_t p = 0; p < w->n; p++) {
    for (int q = 0; q < count; q++) {
      size_t node = 0;
      int rest = q;
      S[q] = 1;
      for (int d = 0; d < w->dim; d++, rest /= s) {
        node += (size_t)(w->first[d][p] + rest % s) * w->stride[d];
        S[q] *= w->S[d][(size_t)(rest % s) * w->n + p];
      }
      position[q] = mass->position[node];
    }
    for (int q = 0; q < count; q++)
      for (int r = 0; r < count; r++)
        if (position[q] >= position[r]) band[position[r] * width + position[q] - position[r]] += m[p] * (S[q] * S[r]);
  }
}

/* Decouples an unknown from the others: unit diagonal, zero row and column. */
static void hold(gsl_matrix *band, size_t i)
{
  for (size_t j = 1; j < band->size2; j++) {
    gsl_matrix_set(band, i, j, 0);
    if (j <= i) gsl_matrix_set(band, i - j, j, 0);
  }
  gsl_matrix_set(band, i, 0, 1);
}

/* Whether a pivot is no more than round-off of the assembled diagonal: a singular matrix leaves noise of either sign, which
 * grows with the number of unknowns, since every row of a regular grid errs alike. */
static bool has_noise(const struct gx_mass *mass, const gsl_matrix *factor, int v)
{
  double noise = 4 * (double)mass->unknowns * DBL_EPSILON;
  for (size_t i = 0; i < mass->unknowns; i++) {
    double root = gsl_matrix_get(factor, i, 0);
    if (!(mass->held[i] >> v & 1) && !(root * root > noise * gsl_matrix_get(mass->assembled, i, 0))) return true;
  }
  return false;
}

int gx_mass_factor(struct gx_mass *mass, const struct gx_weights *weights, const double *m)
{
  assemble(mass, weights, m);
  for (int v = 0; v < mass->variants; v++) {
    gsl_matrix *factor = mass->factor[v];
    gsl_matrix_memcpy(factor, mass->assembled);
    for (size_t i = 0; i < mass->unknowns; i++)
      if (mass->held[i] >> v & 1 || gsl_matrix_get(factor, i, 0) == 0) hold(factor, i);
    if (gsl_linalg_cholesky_band_decomp(factor) != GSL_SUCCESS || has_noise(mass, factor, v)) return -1;
  }
  return 0;
}

void gx_mass_solve(struct gx_mass *mass, int d, double *field)
{
  const struct gx_grid *grid = mass->grid;
  int v = mass->variants > 1 ? d : 0;
  gsl_vector_set_zero(mass->x);
  /* images hold zeros, so adding visits each function once */
  for (size_t node = 0; node < grid->stored; node++) mass->x->data[mass->position[node]] += field[node];
  for (size_t i = 0; i < mass->unknowns; i++)
    if (mass->held[i] >> d & 1) mass->x->data[i] = 0;
  gsl_linalg_cholesky_band_svx(mass->factor[v], mass->x);
  for (size_t node = 0; node < grid->stored; node++) field[node] = mass->x->data[mass->position[node]];
}
