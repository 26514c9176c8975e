/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard MPM in 1-D, periodic, neo-Hookean bar of steffen2010 §6.1, central differences, lumped mass. */
#include "plain.h"

#include <math.h>

/* The node that a grid of N cells stands for in place of node i, 0 <= i < 2N. */
static inline int wrap(int i, int N)
{
  return i < N ? i : i - N;
}

/* Weights of the first two nodes of a cell, or of the three quadratic functions that it meets; r: fraction in the cell. */
static inline void weights(const int support, double r, int N, double *S, double *D)
{
  if (support == 2) {
    S[0] = 1 - r;
    S[1] = r;
    D[0] = -N;
    D[1] = N;
  } else {
    S[0] = 0.5 * (1 - r) * (1 - r);
    S[1] = 0.5 + r * (1 - r);
    S[2] = 0.5 * r * r;
    D[0] = (r - 1) * N;
    D[1] = (1 - 2 * r) * N;
    D[2] = r * N;
  }
}

static inline __attribute__((always_inline)) void step(struct plain *plain, const int support)
{
  const int N = plain->cells;
  const double dt = plain->dt, C = sqrt(plain->modulus / plain->density);
  const double c = plain->amplitude * cos(C * M_PI * (double)plain->step * dt);
  double *mass = plain->mass, *vi = plain->vi, *ai = plain->ai;
  for (int i = 0; i < N; i++) mass[i] = vi[i] = ai[i] = 0;
  for (size_t p = 0; p < plain->n; p++) {
    double x = plain->X[p] + plain->u[p];
    if (x < 0) x += 1;
    if (x >= 1) x -= 1;
    int cell = (int)(x * N);
    double *S = &plain->S[3 * p], *D = &plain->D[3 * p];
    plain->first[p] = cell;
    weights(support, x * N - cell, N, S, D);
    double F = plain->F[p], m = plain->m[p], sigma = 0.5 * plain->modulus * (F - 1 / F), V = F * plain->V0[p];
    double u_exact = c * plain->sine[p], F_exact = 1 + 2 * M_PI * c * plain->cosine[p];
    double b = C * C * M_PI * M_PI * u_exact * (2 / (F_exact * F_exact) + 1);
    for (int k = 0; k < support; k++) {
      int i = wrap(cell + k, N);
      mass[i] += m * S[k];
      vi[i] += m * plain->v[p] * S[k];
      ai[i] += m * b * S[k] - sigma * V * D[k];
    }
  }
  for (int i = 0; i < N; i++) {
    ai[i] = mass[i] > 0 ? ai[i] / mass[i] : 0;
    vi[i] = mass[i] > 0 ? vi[i] / mass[i] + dt * ai[i] : 0;
  }
  for (size_t p = 0; p < plain->n; p++) {
    double v = 0, a = 0, gradient = 0;
    for (int k = 0; k < support; k++) {
      int i = wrap(plain->first[p] + k, N);
      v += plain->S[3 * p + (size_t)k] * vi[i];
      a += plain->S[3 * p + (size_t)k] * ai[i];
      gradient += plain->D[3 * p + (size_t)k] * vi[i];
    }
    plain->v[p] += dt * a;
    plain->F[p] *= 1 + dt * gradient;
    plain->u[p] += dt * v;
  }
  plain->step++;
}

void plain_standard_linear(struct plain *plain)
{
  step(plain, 2);
}

void plain_standard_quadratic(struct plain *plain)
{
  step(plain, 3);
}
