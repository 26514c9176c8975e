/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard MPM in 3-D, periodic, quadratic B-splines, axis-aligned waves in a neo-Hookean solid, central differences. */
#include "plain_3d.h"

/* V sigma = V0 mu (F F^T - I) */
static inline void stress(const struct plain *plain, size_t p, double *t)
{
  const double *F = &plain->F[9 * p], scale = 0.5 * plain->modulus * plain->V0[p];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      double B = F[3 * i] * F[3 * j] + F[3 * i + 1] * F[3 * j + 1] + F[3 * i + 2] * F[3 * j + 2];
      t[3 * i + j] = scale * (B - (i == j));
    }
}

static void scatter(struct plain *plain)
{
  const double C = sqrt(plain->modulus / plain->density);
  const double c = plain->amplitude * cos(C * M_PI * (double)plain->step * plain->dt);
  for (size_t p = 0; p < plain->n; p++) {
    struct plain_3d_weights w;
    double x[3], t[9], b[3], m = plain->m[p];
    const double *v = &plain->v[3 * p];
    for (size_t d = 0; d < 3; d++) x[d] = plain->X[3 * p + d] + plain->u[3 * p + d];
    plain_3d_weigh(x, plain->cells, &w);
    stress(plain, p, t);
    plain_3d_body(plain, p, c, C * C * M_PI * M_PI, b);
    for (int k2 = 0; k2 < 3; k2++)
      for (int k1 = 0; k1 < 3; k1++)
        for (int k0 = 0; k0 < 3; k0++) {
          int i = w.node[0][k0] + w.node[1][k1] + w.node[2][k2];
          double S = w.S[0][k0] * w.S[1][k1] * w.S[2][k2];
          double D[3] = {w.D[0][k0] * w.S[1][k1] * w.S[2][k2], w.S[0][k0] * w.D[1][k1] * w.S[2][k2],
                         w.S[0][k0] * w.S[1][k1] * w.D[2][k2]};
          plain->mass[i] += m * S;
          for (int d = 0; d < 3; d++) {
            plain->vi[3 * i + d] += m * v[d] * S;
            plain->ai[3 * i + d] += m * b[d] * S - (t[3 * d] * D[0] + t[3 * d + 1] * D[1] + t[3 * d + 2] * D[2]);
          }
        }
  }
}

static void update(struct plain *plain, size_t p, const double *a, const double *v, const double *L)
{
  const double dt = plain->dt;
  double *F = &plain->F[9 * p], G[9];
  for (int i = 0; i < 9; i++) G[i] = F[i];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) F[3 * i + j] += dt * (L[3 * i] * G[j] + L[3 * i + 1] * G[3 + j] + L[3 * i + 2] * G[6 + j]);
  for (size_t d = 0; d < 3; d++) {
    plain->v[3 * p + d] += dt * a[d];
    plain->u[3 * p + d] += dt * v[d];
  }
}

static void gather(struct plain *plain)
{
  for (size_t p = 0; p < plain->n; p++) {
    struct plain_3d_weights w;
    double x[3], a[3] = {0}, v[3] = {0}, L[9] = {0};
    for (size_t d = 0; d < 3; d++) x[d] = plain->X[3 * p + d] + plain->u[3 * p + d];
    plain_3d_weigh(x, plain->cells, &w);
    for (int k2 = 0; k2 < 3; k2++)
      for (int k1 = 0; k1 < 3; k1++)
        for (int k0 = 0; k0 < 3; k0++) {
          int i = w.node[0][k0] + w.node[1][k1] + w.node[2][k2];
          double S = w.S[0][k0] * w.S[1][k1] * w.S[2][k2];
          double D[3] = {w.D[0][k0] * w.S[1][k1] * w.S[2][k2], w.S[0][k0] * w.D[1][k1] * w.S[2][k2],
                         w.S[0][k0] * w.S[1][k1] * w.D[2][k2]};
          for (int d = 0; d < 3; d++) {
            a[d] += S * plain->ai[3 * i + d];
            v[d] += S * plain->vi[3 * i + d];
            for (int e = 0; e < 3; e++) L[3 * d + e] += plain->vi[3 * i + d] * D[e];
          }
        }
    update(plain, p, a, v, L);
  }
}

void plain_standard_3d(struct plain *plain)
{
  const int nodes = plain->cells * plain->cells * plain->cells;
  for (int i = 0; i < nodes; i++) plain->mass[i] = 0;
  for (int i = 0; i < 3 * nodes; i++) plain->vi[i] = plain->ai[i] = 0;
  scatter(plain);
  for (int i = 0; i < nodes; i++)
    for (int d = 0; d < 3; d++) {
      plain->ai[3 * i + d] /= plain->mass[i];
      plain->vi[3 * i + d] = plain->vi[3 * i + d] / plain->mass[i] + plain->dt * plain->ai[3 * i + d];
    }
  gather(plain);
  plain->step++;
}
