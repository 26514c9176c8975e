/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A periodic direction couples its last functions to its first: numbering 0, n-1, 1, n-2, ... turns the cyclic band of half
 * width w into a plain one of half width 2w, so that one band solver serves every direction. */
#include "mass_band.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include "../core/kernel.h"

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

static unsigned ends_of(const struct gx_axis *axis, int component)
{
  if (axis->periodic) return 0;
  return (axis->held[0] >> component & 1) | (axis->held[1] >> component & 1) << 1;
}

struct gx_mass_band *gx_mass_band_create(const struct gx_axis *axis, int components)
{
  struct gx_mass_band *band = calloc(1, sizeof *band);
  if (!band) return NULL;
  band->axis = axis;
  band->unknowns = (size_t)axis->functions;
  band->bandwidth = bandwidth_on_axis(axis);
  band->position = malloc((size_t)axis->stored * sizeof *band->position);
  band->filled = calloc(band->unknowns, sizeof *band->filled);
  band->assembled = gsl_matrix_alloc(band->unknowns, band->bandwidth + 1);
  band->x = gsl_vector_alloc(band->unknowns);
  bool complete = band->position && band->filled && band->assembled && band->x;
  for (int d = 0; d < components; d++) {
    unsigned ends = band->ends[d] = ends_of(axis, d);
    if (band->factor[ends]) continue;
    band->factor[ends] = gsl_matrix_alloc(band->unknowns, band->bandwidth + 1);
    band->inverse[ends] = malloc(band->unknowns * sizeof(double));
    complete = complete && band->factor[ends] && band->inverse[ends];
  }
  if (!complete) {
    gx_mass_band_free(band);
    return NULL;
  }
  for (size_t k = 0; k < (size_t)axis->stored; k++) band->position[k] = number_on_axis(axis, k);
  return band;
}

void gx_mass_band_free(struct gx_mass_band *band)
{
  if (!band) return;
  free(band->position);
  free(band->filled);
  gsl_matrix_free(band->assembled);
  for (int v = 0; v < GX_MASS_ENDS; v++) {
    gsl_matrix_free(band->factor[v]);
    free(band->inverse[v]);
  }
  gsl_vector_free(band->x);
  free(band);
}

/* Returns -1 when a function has a negative mass. */
static int assemble(struct gx_mass_band *band, size_t n, const int *first, const double *S, const double *m)
{
  const int s = band->axis->support;
  gsl_matrix_set_zero(band->assembled);
  double *entry = band->assembled->data;
  const size_t width = band->assembled->tda;
  for (size_t p = 0; p < n; p++) {
    const size_t *position = band->position + first[p];
    for (int q = 0; q < s; q++)
      for (int r = 0; r < s; r++)
        if (position[q] >= position[r])
          entry[position[r] * width + position[q] - position[r]] += m[p] * (S[(size_t)q * n + p] * S[(size_t)r * n + p]);
  }
  double least = 0, most = 0;
  for (size_t i = 0; i < band->unknowns; i++) {
    least = fmin(least, entry[i * width]);
    most = fmax(most, entry[i * width]);
  }
  for (size_t i = 0; i < band->unknowns; i++) band->filled[i] = entry[i * width] > GX_MASS_TRACE * most;
  return least < GX_MASS_NEGATIVE * most ? -1 : 0;
}

/* Decouples an unknown from the others: unit diagonal, zero row and column. */
static void hold(gsl_matrix *factor, size_t i)
{
  for (size_t j = 1; j < factor->size2; j++) {
    gsl_matrix_set(factor, i, j, 0);
    if (j <= i) gsl_matrix_set(factor, i - j, j, 0);
  }
  gsl_matrix_set(factor, i, 0, 1);
}

/* Whether the unknown of a bounded direction belongs to an end that is held. */
static bool is_held(const struct gx_mass_band *band, unsigned ends, size_t i)
{
  size_t edge = (size_t)band->axis->edge;
  return (ends & 1 && i < edge) || (ends & 2 && i + edge >= band->unknowns);
}

/* Whether a pivot is no more than round-off of the assembled diagonal: a singular matrix leaves noise of either sign, which
 * grows with the number of unknowns, since every row of a regular grid errs alike. */
static bool has_noise(const struct gx_mass_band *band, unsigned ends)
{
  double noise = 4 * (double)band->unknowns * DBL_EPSILON;
  for (size_t i = 0; i < band->unknowns; i++) {
    double root = gsl_matrix_get(band->factor[ends], i, 0);
    if (band->filled[i] && !is_held(band, ends, i) && !(root * root > noise * gsl_matrix_get(band->assembled, i, 0))) return true;
  }
  return false;
}

int gx_mass_band_factor(struct gx_mass_band *band, size_t n, const int *first, const double *S, const double *m)
{
  if (assemble(band, n, first, S, m)) return -1;
  for (unsigned v = 0; v < GX_MASS_ENDS; v++) {
    gsl_matrix *factor = band->factor[v];
    if (!factor) continue;
    gsl_matrix_memcpy(factor, band->assembled);
    for (size_t i = 0; i < band->unknowns; i++)
      if (is_held(band, v, i) || !band->filled[i]) hold(factor, i);
    if (gsl_linalg_cholesky_band_decomp(factor) != GSL_SUCCESS || has_noise(band, v)) return -1;
    for (size_t i = 0; i < band->unknowns; i++) band->inverse[v][i] = 1 / gsl_matrix_get(factor, i, 0);
  }
  return 0;
}

double gx_mass_band_diagonal(const struct gx_mass_band *band, int function)
{
  return gsl_matrix_get(band->assembled, band->position[function], 0);
}

void gx_mass_band_solve(struct gx_mass_band *band, int component, double *field)
{
  const size_t stored = (size_t)band->axis->stored;
  const unsigned ends = band->ends[component];
  gsl_vector_set_zero(band->x);
  /* images hold zeros, so adding visits each function once */
  for (size_t k = 0; k < stored; k++) band->x->data[band->position[k]] += field[k];
  for (size_t i = 0; i < band->unknowns; i++)
    if (is_held(band, ends, i) || !band->filled[i]) band->x->data[i] = 0;
  gsl_linalg_cholesky_band_svx(band->factor[ends], band->x);
  for (size_t k = 0; k < stored; k++) field[k] = band->x->data[band->position[k]];
}

/* L y = x, then L^T x = y. */
GX_CLONES static void substitute(size_t unknowns, size_t bandwidth, size_t width, const double *restrict L,
                                 const double *restrict inverse, double *restrict line)
{
  enum { LANES = GX_MASS_LANES };
  double y[LANES];
  for (size_t i = 0; i < unknowns; i++) {
    const size_t reach = bandwidth < unknowns - 1 - i ? bandwidth : unknowns - 1 - i;
    double *x = line + i * LANES;
    for (int l = 0; l < LANES; l++) y[l] = x[l] *= inverse[i];
    for (size_t j = 1; j <= reach; j++)
      for (int l = 0; l < LANES; l++) x[j * LANES + (size_t)l] -= L[i * width + j] * y[l];
  }
  for (size_t i = unknowns; i-- > 0;) {
    const size_t reach = bandwidth < unknowns - 1 - i ? bandwidth : unknowns - 1 - i;
    double *x = line + i * LANES;
    for (int l = 0; l < LANES; l++) y[l] = x[l];
    for (size_t j = 1; j <= reach; j++)
      for (int l = 0; l < LANES; l++) y[l] -= L[i * width + j] * x[j * LANES + (size_t)l];
    for (int l = 0; l < LANES; l++) x[l] = y[l] * inverse[i];
  }
}

void gx_mass_band_solve_lines(const struct gx_mass_band *band, int component, double *line)
{
  const unsigned ends = band->ends[component];
  const gsl_matrix *factor = band->factor[ends];
  for (size_t i = 0; i < band->unknowns; i++)
    if (is_held(band, ends, i) || !band->filled[i])
      for (int l = 0; l < GX_MASS_LANES; l++) line[i * GX_MASS_LANES + (size_t)l] = 0;
  substitute(band->unknowns, band->bandwidth, factor->tda, factor->data, band->inverse[ends], line);
}
