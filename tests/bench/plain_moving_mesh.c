/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moving-mesh MPM in 1-D, periodic, neo-Hookean bar of steffen2010 §6.1, central differences, lumped mass, velocity projected
 * once: the weights at X never change, and the state is u and v of the nodes. */
#include "plain.h"

#include <math.h>

static inline int wrap(int i, int N)
{
  return i < N ? i : i - N;
}

static inline __attribute__((always_inline)) void start(struct plain *plain, const int support)
{
  const int N = plain->cells;
  for (size_t p = 0; p < plain->n; p++) {
    double *S = &plain->S[3 * p], *D = &plain->D[3 * p], m = plain->m[p];
    int cell = plain->first[p] = (int)(plain->X[p] * N);
    double r = plain->X[p] * N - cell;
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
    for (int k = 0; k < support; k++) {
      int i = wrap(cell + k, N);
      plain->mass[i] += m * S[k];
      plain->ui[i] += m * plain->u[p] * S[k];
      plain->vi[i] += m * plain->v[p] * S[k];
    }
  }
  for (int i = 0; i < N; i++) {
    plain->ui[i] /= plain->mass[i];
    plain->vi[i] /= plain->mass[i];
  }
}

static inline __attribute__((always_inline)) void step(struct plain *plain, const int support)
{
  const int N = plain->cells;
  const double dt = plain->dt, C = sqrt(plain->modulus / plain->density);
  const double c = plain->amplitude * cos(C * M_PI * (double)plain->step * dt);
  double *ui = plain->ui, *vi = plain->vi, *ai = plain->ai;
  for (int i = 0; i < N; i++) ai[i] = 0;
  for (size_t p = 0; p < plain->n; p++) {
    const double *S = &plain->S[3 * p], *D = &plain->D[3 * p];
    int cell = plain->first[p];
    double F = 1;
    for (int k = 0; k < support; k++) F += ui[wrap(cell + k, N)] * D[k];
    double P = 0.5 * plain->modulus * (F - 1 / F), m = plain->m[p], V0 = plain->V0[p];
    double u_exact = c * plain->sine[p], F_exact = 1 + 2 * M_PI * c * plain->cosine[p];
    double b = C * C * M_PI * M_PI * u_exact * (2 / (F_exact * F_exact) + 1);
    for (int k = 0; k < support; k++) ai[wrap(cell + k, N)] += m * b * S[k] - P * V0 * D[k];
  }
  for (int i = 0; i < N; i++) {
    vi[i] += dt * ai[i] / plain->mass[i];
    ui[i] += dt * vi[i];
  }
  plain->step++;
}

static inline __attribute__((always_inline)) void sample(struct plain *plain, const int support)
{
  for (size_t p = 0; p < plain->n; p++) {
    plain->u[p] = 0;
    for (int k = 0; k < support; k++)
      plain->u[p] += plain->S[3 * p + (size_t)k] * plain->ui[wrap(plain->first[p] + k, plain->cells)];
  }
}

void plain_moving_mesh_linear_start(struct plain *plain)
{
  start(plain, 2);
}

void plain_moving_mesh_linear(struct plain *plain)
{
  step(plain, 2);
}

void plain_moving_mesh_linear_sample(struct plain *plain)
{
  sample(plain, 2);
}

void plain_moving_mesh_quadratic_start(struct plain *plain)
{
  start(plain, 3);
}

void plain_moving_mesh_quadratic(struct plain *plain)
{
  step(plain, 3);
}

void plain_moving_mesh_quadratic_sample(struct plain *plain)
{
  sample(plain, 3);
}
