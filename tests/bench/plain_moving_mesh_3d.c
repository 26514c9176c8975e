/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moving-mesh MPM in 3-D, periodic, quadratic B-splines, axis-aligned waves in a neo-Hookean solid, central differences, velocity
 * projected once. */
#include "plain_3d.h"

void plain_moving_mesh_3d_start(struct plain *plain)
{
  const int nodes = plain->cells * plain->cells * plain->cells;
  for (size_t p = 0; p < plain->n; p++) {
    struct plain_3d_weights w;
    plain_3d_weigh(&plain->X[3 * p], plain->cells, &w);
    for (int k2 = 0; k2 < 3; k2++)
      for (int k1 = 0; k1 < 3; k1++)
        for (int k0 = 0; k0 < 3; k0++) {
          int i = w.node[0][k0] + w.node[1][k1] + w.node[2][k2];
          double mS = plain->m[p] * w.S[0][k0] * w.S[1][k1] * w.S[2][k2];
          plain->mass[i] += mS;
          for (int d = 0; d < 3; d++) {
            plain->ui[3 * i + d] += mS * plain->u[3 * p + (size_t)d];
            plain->vi[3 * i + d] += mS * plain->v[3 * p + (size_t)d];
          }
        }
  }
  for (int i = 0; i < 3 * nodes; i++) {
    plain->ui[i] /= plain->mass[i / 3];
    plain->vi[i] /= plain->mass[i / 3];
  }
}

/* V0 P, P = mu (F - F^-T) */
static inline void stress(const struct plain *plain, size_t p, const double *F, double *t)
{
  double C[9];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      C[3 * i + j] = F[3 * i1 + j1] * F[3 * i2 + j2] - F[3 * i1 + j2] * F[3 * i2 + j1];
    }
  double scale = 0.5 * plain->modulus * plain->V0[p], inverse = 1 / (F[0] * C[0] + F[1] * C[1] + F[2] * C[2]);
  for (int k = 0; k < 9; k++) t[k] = scale * (F[k] - inverse * C[k]);
}

static void force(struct plain *plain)
{
  const double C = sqrt(plain->modulus / plain->density);
  const double c = plain->amplitude * cos(C * M_PI * (double)plain->step * plain->dt);
  for (size_t p = 0; p < plain->n; p++) {
    struct plain_3d_weights w;
    double F[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, t[9], b[3], D[27][3], S[27];
    int node[27], q = 0;
    plain_3d_weigh(&plain->X[3 * p], plain->cells, &w);
    for (int k2 = 0; k2 < 3; k2++)
      for (int k1 = 0; k1 < 3; k1++)
        for (int k0 = 0; k0 < 3; k0++, q++) {
          node[q] = w.node[0][k0] + w.node[1][k1] + w.node[2][k2];
          S[q] = w.S[0][k0] * w.S[1][k1] * w.S[2][k2];
          D[q][0] = w.D[0][k0] * w.S[1][k1] * w.S[2][k2];
          D[q][1] = w.S[0][k0] * w.D[1][k1] * w.S[2][k2];
          D[q][2] = w.S[0][k0] * w.S[1][k1] * w.D[2][k2];
          for (int d = 0; d < 3; d++)
            for (int e = 0; e < 3; e++) F[3 * d + e] += plain->ui[3 * node[q] + d] * D[q][e];
        }
    stress(plain, p, F, t);
    plain_3d_body(plain, p, c, C * C * M_PI * M_PI, b);
    for (q = 0; q < 27; q++)
      for (int d = 0; d < 3; d++)
        plain->ai[3 * node[q] + d] +=
            plain->m[p] * b[d] * S[q] - (t[3 * d] * D[q][0] + t[3 * d + 1] * D[q][1] + t[3 * d + 2] * D[q][2]);
  }
}

void plain_moving_mesh_3d(struct plain *plain)
{
  const int nodes = plain->cells * plain->cells * plain->cells;
  for (int i = 0; i < 3 * nodes; i++) plain->ai[i] = 0;
  force(plain);
  for (int i = 0; i < nodes; i++)
    for (int d = 0; d < 3; d++) {
      plain->vi[3 * i + d] += plain->dt * plain->ai[3 * i + d] / plain->mass[i];
      plain->ui[3 * i + d] += plain->dt * plain->vi[3 * i + d];
    }
  plain->step++;
}

void plain_moving_mesh_3d_sample(struct plain *plain)
{
  for (size_t p = 0; p < plain->n; p++) {
    struct plain_3d_weights w;
    double u[3] = {0};
    plain_3d_weigh(&plain->X[3 * p], plain->cells, &w);
    for (int k2 = 0; k2 < 3; k2++)
      for (int k1 = 0; k1 < 3; k1++)
        for (int k0 = 0; k0 < 3; k0++)
          for (int d = 0; d < 3; d++)
            u[d] += w.S[0][k0] * w.S[1][k1] * w.S[2][k2] * plain->ui[3 * (w.node[0][k0] + w.node[1][k1] + w.node[2][k2]) + d];
    for (size_t d = 0; d < 3; d++) plain->u[3 * p + d] = u[d];
  }
}
