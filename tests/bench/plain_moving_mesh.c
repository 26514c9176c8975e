/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moving-mesh MPM in 1-D, periodic, neo-Hookean bar of steffen2010 §6.1, central differences, lumped mass, velocity projected
 * once: the weights at X never change. Two loops: as the paper writes a step, eqs 53-61, in which the particles have a velocity, a
 * displacement and an F of their own that follow the nodes; and one that has seen that nothing but the displacement of the nodes is
 * ever looked at, so that particles are left out until they are sampled: nodal state only. */
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

static inline __attribute__((always_inline)) void start_particles(struct plain *plain, const int support)
{
  const int N = plain->cells;
  start(plain, support);
  for (size_t p = 0; p < plain->n; p++) {
    plain->F[p] = 1;
    plain->v[p] = plain->u[p] = 0;
    for (int k = 0; k < support; k++) {
      int i = wrap(plain->first[p] + k, N);
      plain->F[p] += plain->ui[i] * plain->D[3 * p + (size_t)k];
      plain->v[p] += plain->vi[i] * plain->S[3 * p + (size_t)k];
      plain->u[p] += plain->ui[i] * plain->S[3 * p + (size_t)k];
    }
  }
}

/* Body force per unit mass over what does not change, given c = A cos(C pi t). */
static inline double body(const struct plain *plain, size_t p, double c)
{
  double u_exact = c * plain->sine[p], F_exact = 1 + 2 * M_PI * c * plain->cosine[p];
  return u_exact * (2 / (F_exact * F_exact) + 1);
}

static inline double wave(const struct plain *plain, double C)
{
  return plain->amplitude * cos(C * M_PI * (double)plain->step * plain->dt);
}

static inline __attribute__((always_inline)) void step(struct plain *plain, const int support)
{
  const int N = plain->cells;
  const double dt = plain->dt, C = sqrt(plain->modulus / plain->density), c = wave(plain, C);
  double *ui = plain->ui, *vi = plain->vi, *ai = plain->ai;
  for (int i = 0; i < N; i++) ai[i] = 0;
  for (size_t p = 0; p < plain->n; p++) { /* 53, 54, 59 */
    const double *S = &plain->S[3 * p], *D = &plain->D[3 * p], F = plain->F[p];
    double P = 0.5 * plain->modulus * (F - 1 / F), m = plain->m[p], V0 = plain->V0[p];
    double b = C * C * M_PI * M_PI * body(plain, p, c);
    for (int k = 0; k < support; k++) ai[wrap(plain->first[p] + k, N)] += m * b * S[k] - P * V0 * D[k];
  }
  for (int i = 0; i < N; i++) { /* 55 to 57 */
    ai[i] /= plain->mass[i];
    vi[i] += dt * ai[i];
    ui[i] += dt * vi[i];
  }
  for (size_t p = 0; p < plain->n; p++) { /* 58, 60, 61 */
    const double *S = &plain->S[3 * p], *D = &plain->D[3 * p];
    double F = 1, a = 0, v = 0;
    for (int k = 0; k < support; k++) {
      int i = wrap(plain->first[p] + k, N);
      F += ui[i] * D[k];
      a += ai[i] * S[k];
      v += vi[i] * S[k];
    }
    plain->F[p] = F;
    plain->v[p] += dt * a;
    plain->u[p] += dt * v;
  }
  plain->step++;
}

static inline __attribute__((always_inline)) void step_nodes(struct plain *plain, const int support)
{
  const int N = plain->cells;
  const double dt = plain->dt, C = sqrt(plain->modulus / plain->density), c = wave(plain, C);
  double *ui = plain->ui, *vi = plain->vi, *ai = plain->ai;
  for (int i = 0; i < N; i++) ai[i] = 0;
  for (size_t p = 0; p < plain->n; p++) {
    const double *S = &plain->S[3 * p], *D = &plain->D[3 * p];
    int cell = plain->first[p];
    double F = 1;
    for (int k = 0; k < support; k++) F += ui[wrap(cell + k, N)] * D[k];
    double P = 0.5 * plain->modulus * (F - 1 / F), m = plain->m[p], V0 = plain->V0[p];
    double b = C * C * M_PI * M_PI * body(plain, p, c);
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
  start_particles(plain, 2);
}

void plain_moving_mesh_linear(struct plain *plain)
{
  step(plain, 2);
}

void plain_moving_mesh_quadratic_start(struct plain *plain)
{
  start_particles(plain, 3);
}

void plain_moving_mesh_quadratic(struct plain *plain)
{
  step(plain, 3);
}

void plain_nodal_linear_start(struct plain *plain)
{
  start(plain, 2);
}

void plain_nodal_linear(struct plain *plain)
{
  step_nodes(plain, 2);
}

void plain_nodal_linear_sample(struct plain *plain)
{
  sample(plain, 2);
}

void plain_nodal_quadratic_start(struct plain *plain)
{
  start(plain, 3);
}

void plain_nodal_quadratic(struct plain *plain)
{
  step_nodes(plain, 3);
}

void plain_nodal_quadratic_sample(struct plain *plain)
{
  sample(plain, 3);
}
