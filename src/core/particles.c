/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocation of the particle store and the initial layouts of particles in cells. */
#include <gridcross/particles.h>

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

/* Digits of p: the point along each direction, first direction fastest. */
static void place_particle(struct gx_particles *particles, size_t p, const int *cells, int per_cell, const double *point,
                           const double *length, double density)
{
  int dim = particles->dim;
  size_t rest = p;
  double volume = 1;
  for (int d = 0; d < dim; d++) {
    int k = (int)(rest % (size_t)particles->lattice[d]), cell = k / per_cell, inside = k % per_cell;
    rest /= (size_t)particles->lattice[d];
    particles->X[d][p] = (cell + point[inside]) / cells[d];
    particles->half_length[d][p] = 0.5 * length[inside] / cells[d];
    particles->F[d * dim + d][p] = 1;
    volume *= length[inside] / cells[d];
  }
  particles->V0[p] = volume;
  particles->m[p] = density * volume;
}

struct gx_particles *gx_particles_create(int dim, const int *cells, int per_cell, enum gx_layout layout, double density)
{
  size_t n = 1;
  int lattice[GX_MAX_DIM] = {0};
  for (int d = 0; d < dim; d++)
    if (__builtin_mul_overflow(cells[d], per_cell, &lattice[d]) || __builtin_mul_overflow(n, (size_t)lattice[d], &n)) return NULL;
  struct gx_particles *particles = allocate(dim, n);
  double *point = malloc(2 * (size_t)per_cell * sizeof(double));
  if (!particles || !point || points_of_cell(per_cell, layout, point, point + per_cell)) {
    gx_particles_free(particles);
    free(point);
    return NULL;
  }
  memcpy(particles->lattice, lattice, sizeof lattice);
  for (size_t p = 0; p < n; p++) place_particle(particles, p, cells, per_cell, point, point + per_cell, density);
  free(point);
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

double gx_particles_jacobian(const struct gx_particles *particles, size_t p)
{
  double F[GX_MAX_TENSOR], cofactor[GX_MAX_TENSOR], J;
  GX_FOR_DIM(particles->dim, gx_tensor_load(dim, particles->F, p, F); J = gx_tensor_cofactor(dim, F, cofactor))
  return J;
}
