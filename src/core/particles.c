/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocation of the particle store and the initial layouts of particles in cells. */
#include <gridcross/particles.h>

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_integration.h>

#include "aligned.h"
#include "tensor.h"

/* Sets the component pointers to consecutive stretches of `stride` doubles from `at`; returns what follows them. */
static double *place(double **component, int count, double *at, size_t stride)
{
  for (int i = 0; i < count; i++, at += stride) component[i] = at;
  return at;
}

static size_t arrays_of(int dim)
{
  return 5 * (size_t)dim + 2 * (size_t)(dim * dim) + 2;
}

/* One cache line more, or arrays of 2^k entries would share a cache set. */
static size_t stride_of(size_t n)
{
  return (n + 7) / 8 * 8 + 8;
}

static struct gx_particles *allocate(int dim, size_t n)
{
  size_t arrays = arrays_of(dim), stride = stride_of(n);
  if (stride < n || stride > SIZE_MAX / sizeof(double) / arrays) return NULL;
  struct gx_particles *particles = calloc(1, sizeof *particles);
  if (!particles) return NULL;
  double *at = gx_aligned_zeros(stride * arrays * sizeof(double), &particles->block);
  if (!at) {
    free(particles);
    return NULL;
  }
  particles->dim = dim;
  particles->n = n;
  at = place(particles->X, dim, at, stride);
  at = place(particles->u, dim, at, stride);
  at = place(particles->v, dim, at, stride);
  at = place(particles->b, dim, at, stride);
  at = place(particles->half_length, dim, at, stride);
  at = place(particles->F, dim * dim, at, stride);
  at = place(particles->P, dim * dim, at, stride);
  at = place(&particles->m, 1, at, stride);
  place(&particles->V0, 1, at, stride);
  return particles;
}

/* Positions in (0,1) and lengths (summing to 1) of the particles of one cell along one direction. */
static int points_of_cell(int per_cell, enum gx_layout layout, double *point, double *length)
{
  if (layout == GX_LAYOUT_UNIFORM) {
    for (int j = 0; j < per_cell; j++) {
      point[j] = (j + 0.5) / per_cell;
      length[j] = 1.0 / per_cell;
    }
    return 0;
  }
  gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc((size_t)per_cell);
  if (!table) return -1;
  for (int j = 0; j < per_cell; j++) gsl_integration_glfixed_point(0, 1, (size_t)j, &point[j], &length[j], table);
  gsl_integration_glfixed_table_free(table);
  return 0;
}

/* The places of the particles in the box. */
struct places {
  int dim, per_cell, count[GX_MAX_DIM]; /* along each direction */
  const int *cells;
  double *point, *length; /* [per_cell] of a cell */
};

/* Digits of i: the point along each direction, first direction fastest. */
static void locate(const struct places *places, size_t i, double *X, double *length)
{
  for (int d = 0; d < places->dim; d++) {
    int k = (int)(i % (size_t)places->count[d]), cell = k / places->per_cell, inside = k % places->per_cell;
    i /= (size_t)places->count[d];
    X[d] = (cell + places->point[inside]) / places->cells[d];
    length[d] = places->length[inside] / places->cells[d];
  }
}

static void put(struct gx_particles *particles, size_t p, const double *X, const double *length, double volume, double density)
{
  int dim = particles->dim;
  for (int d = 0; d < dim; d++) {
    particles->X[d][p] = X[d];
    particles->half_length[d][p] = 0.5 * length[d];
    particles->F[d * dim + d][p] = 1;
  }
  particles->V0[p] = volume;
  particles->m[p] = density * volume;
}

/* total: of the places. */
static struct gx_particles *fill(const struct places *places, size_t total, double density,
                                 bool (*inside)(const void *body, const double *X), const void *body)
{
  double X[GX_MAX_DIM], length[GX_MAX_DIM];
  size_t n = inside ? 0 : total;
  for (size_t i = 0; i < total && inside; i++) {
    locate(places, i, X, length);
    n += inside(body, X);
  }
  struct gx_particles *particles = allocate(places->dim, n);
  if (particles && n == total) memcpy(particles->lattice, places->count, sizeof particles->lattice);
  for (size_t i = 0, p = 0; particles && p < n; i++) {
    locate(places, i, X, length);
    if (inside && !inside(body, X)) continue;
    double volume = 1;
    for (int d = 0; d < places->dim; d++) volume *= length[d];
    put(particles, p++, X, length, volume, density);
  }
  return particles;
}

struct gx_particles *gx_particles_fill(int dim, const int *cells, int per_cell, enum gx_layout layout, double density,
                                       bool (*inside)(const void *body, const double *X), const void *body)
{
  struct places places = {.dim = dim, .per_cell = per_cell, .cells = cells};
  size_t total = 1;
  for (int d = 0; d < dim; d++)
    if (__builtin_mul_overflow(cells[d], per_cell, &places.count[d]) ||
        __builtin_mul_overflow(total, (size_t)places.count[d], &total))
      return NULL;
  double *point = malloc(2 * (size_t)per_cell * sizeof(double));
  struct gx_particles *particles = NULL;
  places.point = point;
  places.length = point + per_cell;
  if (point && !points_of_cell(per_cell, layout, places.point, places.length))
    particles = fill(&places, total, density, inside, body);
  free(point);
  return particles;
}

struct gx_particles *gx_particles_create(int dim, const int *cells, int per_cell, enum gx_layout layout, double density)
{
  return gx_particles_fill(dim, cells, per_cell, layout, density, NULL, NULL);
}

struct gx_particles *gx_particles_points(int dim, const int *cells, int per_cell)
{
  struct gx_particles *points = gx_particles_create(dim, cells, per_cell, GX_LAYOUT_GAUSS, 1);
  for (int d = 0; points && d < dim; d++)
    for (size_t q = 0; q < points->n; q++) points->half_length[d][q] *= 1e-12;
  return points;
}

struct gx_particles *gx_particles_list(const struct gx_points *points, double density)
{
  struct gx_particles *particles = allocate(points->dim, points->n);
  for (size_t p = 0; particles && p < points->n; p++) {
    double X[GX_MAX_DIM], length[GX_MAX_DIM];
    for (int d = 0; d < points->dim; d++) {
      X[d] = points->X[d][p];
      length[d] = pow(points->V0[p], 1.0 / points->dim);
    }
    put(particles, p, X, length, points->V0[p], density);
  }
  return particles;
}

struct gx_particles *gx_particles_copy(const struct gx_particles *particles)
{
  struct gx_particles *copy = allocate(particles->dim, particles->n);
  if (!copy) return NULL;
  memcpy(copy->lattice, particles->lattice, sizeof copy->lattice);
  memcpy(copy->X[0], particles->X[0], stride_of(copy->n) * arrays_of(copy->dim) * sizeof(double));
  return copy;
}

void gx_particles_free(struct gx_particles *particles)
{
  if (!particles) return;
  free(particles->block);
  free(particles);
}

void gx_particles_image(struct gx_particles *particles, struct gx_image *image)
{
  const int dim = particles->dim;
  gx_image_reals(image, dim, particles->u, particles->n);
  gx_image_reals(image, dim, particles->v, particles->n);
  gx_image_reals(image, dim, particles->b, particles->n);
  gx_image_reals(image, dim * dim, particles->F, particles->n);
  gx_image_reals(image, dim * dim, particles->P, particles->n);
}

double gx_particles_volume(const struct gx_particles *particles)
{
  const double volume = particles->V0[0];
  for (size_t p = 0; p < particles->n; p++)
    if (fabs(particles->V0[p] - volume) > 64 * DBL_EPSILON * volume) return 0;
  return volume;
}

double gx_particles_jacobian(const struct gx_particles *particles, size_t p)
{
  double F[GX_MAX_TENSOR], cofactor[GX_MAX_TENSOR], J;
  GX_FOR_DIM(particles->dim, gx_tensor_load(dim, particles->F, p, F); J = gx_tensor_cofactor(dim, F, cofactor))
  return J;
}
