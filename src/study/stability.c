/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Power iteration on the square of the Jacobian of the rates. Its eigenvalues are -omega^2 where the method vibrates, so the
 * growth of a vector under two applications is omega^2. Jacobian times vector is a difference of rates. */
#include "stability.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>

#include "../core/large.h"

enum { LEAST_ITERATIONS = (GX_STABILITY_LEAST - 1) / 2, MOST_ITERATIONS = (GX_STABILITY_EVALUATIONS - 1) / 2 };
static const double settled = 3e-4; /* relative change that ends the iteration */
/* Of a displacement, in widths of the domain: far above round-off, of which rates divided by masses near zero have most; where
 * particles move through cells, below what takes many to another one. */
static const double reach = 1e-6, reach_through_cells = 1e-8;

struct iteration {
  struct gx_space *space;
  struct gx_state state;
  size_t total, displacements; /* numbers of the state; the first of them */
  double *start, *rest, *vector, *rate;
};

static void load(struct iteration *it, const double *base, const double *direction, double scale)
{
  for (int i = 0; i < it->state.count; base += it->state.length[i], direction += it->state.length[i], i++)
    for (size_t k = 0; k < it->state.length[i]; k++) it->state.array[i][k] = base[k] + scale * direction[k];
}

static int evaluate(struct iteration *it, double *rate)
{
  double *part[GX_MAX_STATE];
  for (int i = 0; i < it->state.count; rate += it->state.length[i], i++) part[i] = rate;
  const struct gx_space_kind *kind = it->space->kind;
  if (kind->weights(it->space) || kind->project(it->space) || kind->accelerate(it->space, 0)) return -1;
  kind->rates(it->space, part);
  return 0;
}

static double norm(const double *vector, size_t n)
{
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += vector[i] * vector[i];
  return sqrt(sum);
}

/* How much of the vector is added to the state for a difference: rates are linear in velocities, however large. */
static double scale_of(const struct iteration *it)
{
  const double most = it->space->through_cells ? reach_through_cells : reach;
  double largest = 0;
  for (size_t i = 0; i < it->displacements; i++) largest = fmax(largest, fabs(it->vector[i]));
  return most / (largest > 0 ? largest : norm(it->vector, it->total));
}

/* vector <- J vector */
static int apply(struct iteration *it)
{
  const double scale = scale_of(it);
  load(it, it->start, it->vector, scale);
  if (evaluate(it, it->rate)) return -1;
  for (size_t i = 0; i < it->total; i++) it->vector[i] = (it->rate[i] - it->rest[i]) / scale;
  return 0;
}

static double iterate(struct iteration *it)
{
  uint64_t seed = 1;
  load(it, it->start, it->start, 0);
  if (evaluate(it, it->rest)) return NAN;
  for (size_t i = 0; i < it->total; i++) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    it->vector[i] = (double)(seed >> 11) * 0x1p-53 - 0.5;
  }
  double omega = NAN, previous = 0;
  for (int k = 0; k < MOST_ITERATIONS && !(k >= LEAST_ITERATIONS && fabs(omega - previous) < settled * omega); k++) {
    double before = norm(it->vector, it->total);
    if (apply(it) || apply(it)) return NAN;
    double after = norm(it->vector, it->total);
    if (!(after > 0 && isfinite(after))) return NAN;
    previous = omega;
    omega = sqrt(after / before);
    for (size_t i = 0; i < it->total; i++) it->vector[i] /= after;
  }
  return omega;
}

static double with_state(struct gx_space *space, double (*compute)(struct iteration *))
{
  struct iteration it = {.space = space};
  space->kind->state(space, &it.state);
  for (int i = 0; i < it.state.count; i++) it.total += it.state.length[i];
  for (int d = 0; d < space->particles->dim; d++) it.displacements += it.state.length[d];
  double *block = gx_large_zeros(4 * it.total * sizeof(double));
  if (!block) return NAN;
  it.start = block;
  it.rest = block + it.total;
  it.vector = block + 2 * it.total;
  it.rate = block + 3 * it.total;
  double *at = it.start;
  for (int i = 0; i < it.state.count; at += it.state.length[i], i++)
    memcpy(at, it.state.array[i], it.state.length[i] * sizeof(double));
  double result = compute(&it);
  load(&it, it.start, it.start, 0);
  free(block);
  return result;
}

double gx_stability_frequency(struct gx_space *space)
{
  return with_state(space, iterate);
}

/* The whole Jacobian by columns, and its eigenvalues. */
static double largest_real_part(struct iteration *it)
{
  enum { MOST = 200 };
  size_t n = it->total;
  if (n > MOST) return NAN;
  gsl_matrix *jacobian = gsl_matrix_alloc(n, n);
  gsl_vector_complex *eigenvalue = gsl_vector_complex_alloc(n);
  gsl_eigen_nonsymm_workspace *workspace = gsl_eigen_nonsymm_alloc(n);
  double largest = NAN;
  load(it, it->start, it->start, 0);
  bool failed = !jacobian || !eigenvalue || !workspace || evaluate(it, it->rest);
  for (size_t j = 0; j < n && !failed; j++) {
    memset(it->vector, 0, n * sizeof(double));
    it->vector[j] = 1;
    failed = apply(it);
    for (size_t i = 0; i < n && !failed; i++) gsl_matrix_set(jacobian, i, j, it->vector[i]);
  }
  if (!failed && gsl_eigen_nonsymm(jacobian, eigenvalue, workspace) == GSL_SUCCESS) {
    largest = -INFINITY;
    for (size_t i = 0; i < n; i++) largest = fmax(largest, GSL_REAL(gsl_vector_complex_get(eigenvalue, i)));
  }
  if (workspace) gsl_eigen_nonsymm_free(workspace);
  gsl_vector_complex_free(eigenvalue);
  gsl_matrix_free(jacobian);
  return largest;
}

double gx_stability_growth(struct gx_space *space)
{
  return with_state(space, largest_real_part);
}
