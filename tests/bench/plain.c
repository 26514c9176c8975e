/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Storage of the plain loops. */
#include "plain.h"

#include <math.h>
#include <stdlib.h>

static double *take(double **at, size_t count)
{
  double *array = *at;
  *at += count;
  return array;
}

static void copy(struct plain *plain, const struct gx_particles *start)
{
  int dim = plain->dim;
  for (size_t p = 0; p < plain->n; p++) {
    plain->m[p] = start->m[p];
    plain->V0[p] = start->V0[p];
    for (int d = 0; d < dim; d++) {
      size_t i = p * (size_t)dim + (size_t)d;
      plain->X[i] = start->X[d][p];
      plain->u[i] = start->u[d][p];
      plain->v[i] = start->v[d][p];
      plain->sine[i] = sin(2 * M_PI * start->X[d][p]);
      plain->cosine[i] = cos(2 * M_PI * start->X[d][p]);
    }
    for (int k = 0; k < dim * dim; k++) plain->F[p * (size_t)(dim * dim) + (size_t)k] = start->F[k][p];
  }
}

struct plain *plain_create(const struct gx_particles *start, int cells, double modulus, double density, double amplitude,
                           double dt)
{
  size_t dim = (size_t)start->dim, n = start->n, nodes = 1;
  for (size_t d = 0; d < dim; d++) nodes *= (size_t)cells + 3;
  struct plain *plain = calloc(1, sizeof *plain);
  double *at = calloc(n * (5 * dim + dim * dim + 2 + 6) + nodes * (1 + 3 * dim), sizeof *at);
  int *first = calloc(n, sizeof *first);
  if (!plain || !at || !first) {
    free(plain);
    free(at);
    free(first);
    return NULL;
  }
  *plain = (struct plain){.dim = start->dim, .cells = cells, .n = n, .nodes = nodes, .first = first};
  plain->modulus = modulus;
  plain->density = density;
  plain->amplitude = amplitude;
  plain->dt = dt;
  plain->X = take(&at, n * dim);
  plain->u = take(&at, n * dim);
  plain->v = take(&at, n * dim);
  plain->F = take(&at, n * dim * dim);
  plain->m = take(&at, n);
  plain->V0 = take(&at, n);
  plain->sine = take(&at, n * dim);
  plain->cosine = take(&at, n * dim);
  plain->S = take(&at, 3 * n);
  plain->D = take(&at, 3 * n);
  plain->mass = take(&at, nodes);
  plain->vi = take(&at, nodes * dim);
  plain->ai = take(&at, nodes * dim);
  plain->ui = take(&at, nodes * dim);
  copy(plain, start);
  return plain;
}

void plain_free(struct plain *plain)
{
  if (!plain) return;
  free(plain->X);
  free(plain->first);
  free(plain);
}
