/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gauss points of the grid's cells, and the fields at them that the integrals are made of. */
#include "reconstruction.h"

#include <math.h>
#include <stdlib.h>

#include "../core/aligned.h"
#include "../core/kernel.h"
#include "../core/tensor.h"
#include "../core/vector.h"
#include "least_squares.h"
#include "spline_fit.h"

static int allocate(struct gx_reconstruction *r, const struct gx_space_options *options)
{
  const double everywhere[GX_MAX_DIM] = {1, 1, 1}, nowhere[GX_MAX_DIM] = {0};
  const int dim = r->grid->dim;
  const size_t n = r->particles->n, stride = (n + 7) / 8 * 8 + 8; /* a cache line between arrays, as in a mesh */
  r->points = gx_particles_points(dim, options->cells, r->grid->axis[0].degree + 1);
  double *arrays = gx_aligned_zeros(stride * (size_t)(dim * dim + 1) * sizeof(double), &r->block);
  if (!r->points || !arrays ||
      gx_blocks_init(&r->blocks, r->grid, options->basis, r->points->n, r->points->X, options->consistent, options->team))
    return -1;
  r->inverse_volume = arrays;
  for (int k = 0; k < dim * dim; k++) r->field[k] = arrays + stride * (size_t)(k + 1);
  for (int d = 0; d < dim; d++) r->blocks.half[d] = r->points->half_length[d];
  gx_blocks_place(&r->blocks, NULL, nowhere, everywhere);
  return 0;
}

/* Splines run from end to end of a line that particles fill; all else is fitted cell by cell. */
static enum gx_status choose_fit(struct gx_reconstruction *r, struct gx_outcome *outcome)
{
  enum { BEYOND = 1 }; /* degrees of the polynomials above that of the basis */
  const struct gx_axis *axis = &r->grid->axis[0];
  const struct gx_particles *particles = r->particles;
  const bool ended = axis->periodic || (axis->held[0] && axis->held[1]);
  if (r->grid->dim == 1 && ended && fabs(gx_vector_sum(particles->n, particles->V0) - 1) < 1e-6)
    return gx_spline_fit_create(&r->fit, axis->degree, axis->periodic, particles->n, particles->X[0], r->points->n,
                                r->points->X[0], outcome);
  return gx_least_squares_create(&r->fit, r->grid, axis->degree + BEYOND, axis->degree + 1, r->points, particles->n, outcome);
}

enum gx_status gx_reconstruction_create(struct gx_reconstruction **out, const struct gx_grid *grid,
                                        const struct gx_space_options *options, const struct gx_particles *particles,
                                        bool current, struct gx_outcome *outcome)
{
  struct gx_reconstruction *r = calloc(1, sizeof *r);
  if (!r) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  *r = (struct gx_reconstruction){.grid = grid, .particles = particles, .current = current};
  enum gx_status status = allocate(r, options)
                              ? gx_status_set(outcome, GX_FAILED, -1, "out of memory for the points of the quadrature")
                              : choose_fit(r, outcome);
  if (status == GX_OK)
    *out = r;
  else
    gx_reconstruction_free(r);
  return status;
}

void gx_reconstruction_free(struct gx_reconstruction *r)
{
  if (!r) return;
  if (r->fit) r->fit->kind->free(r->fit);
  gx_blocks_free(&r->blocks);
  gx_particles_free(r->points);
  free(r->block);
  free(r);
}

enum gx_status gx_reconstruction_place(struct gx_reconstruction *r, const double *const *x)
{
  return r->fit->kind->place(r->fit, x);
}

/* 1 / (V0 det F) */
GX_CORE void invert_volumes(const int dim, size_t n, double *const *F, const double *restrict V0, double *restrict inverse)
{
  const double *f[GX_MAX_TENSOR];
  for (int k = 0; k < dim * dim; k++) f[k] = F[k];
  for (size_t p = 0; p < n; p++) {
    double tensor[GX_MAX_TENSOR], cofactor[GX_MAX_TENSOR];
    for (int k = 0; k < dim * dim; k++) tensor[k] = f[k][p];
    inverse[p] = 1 / (V0[p] * gx_tensor_cofactor(dim, tensor, cofactor));
  }
}

GX_CLONES static void measure_volumes(struct gx_reconstruction *r)
{
  const struct gx_particles *particles = r->particles;
  if (r->current)
    GX_FOR_DIM(particles->dim, invert_volumes(dim, particles->n, particles->F, particles->V0, r->inverse_volume))
  else
    for (size_t p = 0; p < particles->n; p++) r->inverse_volume[p] = 1 / particles->V0[p];
}

GX_CLONES static void product(size_t n, const double *restrict a, const double *restrict b, double *restrict out)
{
  for (size_t p = 0; p < n; p++) out[p] = a[p] * b[p];
}

GX_CLONES static void weigh(size_t n, const double *restrict weight, double *restrict value)
{
  for (size_t p = 0; p < n; p++) value[p] *= weight[p];
}

GX_CLONES static void scale(size_t n, double factor, double *value)
{
  for (size_t q = 0; q < n; q++) value[q] *= factor;
}

/* Sum of m value, value NULL: of m, over the particles that the fields stand for. */
static double represented(const struct gx_reconstruction *r, const double *value)
{
  const struct gx_particles *particles = r->particles;
  const double all = value ? gx_vector_dot(particles->n, particles->m, value) : gx_vector_sum(particles->n, particles->m);
  double left = 0;
  for (size_t p = 0; r->fit->left && p < particles->n; p++)
    if (r->fit->left[p]) left += value ? particles->m[p] * value[p] : particles->m[p];
  return all - left;
}

void gx_reconstruction_mass(struct gx_reconstruction *r)
{
  const struct gx_particles *particles = r->particles;
  struct gx_particles *points = r->points;
  measure_volumes(r);
  product(particles->n, particles->m, r->inverse_volume, r->field[0]);
  r->fit->kind->take(r->fit, 1, false, r->field, &points->m);
  weigh(points->n, points->V0, points->m);
  const double taken = gx_vector_sum(points->n, points->m);
  if (r->fit->kind->scales && taken > 0) scale(points->n, represented(r, NULL) / taken, points->m);
}

/* Whether an end of the grid holds component d. */
static bool is_held(const struct gx_grid *grid, int d)
{
  unsigned held = 0;
  for (int e = 0; e < grid->dim; e++) held |= grid->axis[e].held[0] | grid->axis[e].held[1];
  return held >> d & 1;
}

/* Shifts value so that sum m value is moment. */
static void shift_to(size_t n, const double *m, double moment, double *value)
{
  const double mass = gx_vector_sum(n, m);
  const double by = mass > 0 ? (moment - gx_vector_dot(n, m, value)) / mass : 0;
  for (size_t p = 0; p < n; p++) value[p] += by;
}

void gx_reconstruction_value(struct gx_reconstruction *r, double *const *value)
{
  const struct gx_particles *particles = r->particles;
  r->fit->kind->take(r->fit, particles->dim, true, value, r->points->v);
  for (int d = 0; d < particles->dim; d++)
    if (!is_held(r->grid, d)) shift_to(r->points->n, r->points->m, represented(r, value[d]), r->points->v[d]);
}

void gx_reconstruction_force(struct gx_reconstruction *r, double *const *b)
{
  const struct gx_particles *particles = r->particles;
  const int components = particles->dim * particles->dim;
  measure_volumes(r);
  for (int k = 0; k < components; k++) weigh(particles->n, r->inverse_volume, r->field[k]);
  r->fit->kind->take(r->fit, components, false, r->field, r->points->P);
  for (int k = 0; k < components; k++) weigh(r->points->n, r->points->V0, r->points->P[k]);
  if (!b) return;
  r->fit->kind->take(r->fit, particles->dim, true, b, r->points->b);
  for (int d = 0; d < particles->dim; d++) weigh(r->points->n, r->points->m, r->points->b[d]);
}

void gx_reconstruction_keep(const struct gx_reconstruction *r, const double *moment, double *const *value)
{
  const struct gx_particles *particles = r->particles;
  for (int d = 0; d < particles->dim; d++)
    if (!is_held(r->grid, d)) shift_to(particles->n, particles->m, moment[d], value[d]);
}
