/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moving-mesh MPM in 3-D, periodic, quadratic B-splines, axis-aligned waves in a neo-Hookean solid, central differences, velocity
 * projected once; as steffen2010 writes a step, eqs 53-61, and with nodal state only, see plain_moving_mesh.c. */
#include "plain_3d.h"

void plain_nodal_3d_start(struct plain *plain)
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

/* Products of the weights of a particle. */
struct products {
  int node[27];
  double S[27], D[27][3];
};

static inline void multiply_out(const struct plain *plain, size_t p, struct products *products)
{
  struct plain_3d_weights w;
  int q = 0;
  plain_3d_weigh(&plain->X[3 * p], plain->cells, &w);
  for (int k2 = 0; k2 < 3; k2++)
    for (int k1 = 0; k1 < 3; k1++)
      for (int k0 = 0; k0 < 3; k0++, q++) {
        products->node[q] = w.node[0][k0] + w.node[1][k1] + w.node[2][k2];
        products->S[q] = w.S[0][k0] * w.S[1][k1] * w.S[2][k2];
        products->D[q][0] = w.D[0][k0] * w.S[1][k1] * w.S[2][k2];
        products->D[q][1] = w.S[0][k0] * w.D[1][k1] * w.S[2][k2];
        products->D[q][2] = w.S[0][k0] * w.S[1][k1] * w.D[2][k2];
      }
}

/* F = 1 + grad u */
static inline void deform(const struct plain *plain, const struct products *w, double *F)
{
  for (int k = 0; k < 9; k++) F[k] = k % 4 == 0;
  for (int q = 0; q < 27; q++)
    for (int d = 0; d < 3; d++)
      for (int e = 0; e < 3; e++) F[3 * d + e] += plain->ui[3 * w->node[q] + d] * w->D[q][e];
}

/* nodal: F of the nodes, else the particles' own. */
static inline __attribute__((always_inline)) void force(struct plain *plain, const int nodal)
{
  const double C = sqrt(plain->modulus / plain->density);
  const double c = plain->amplitude * cos(C * M_PI * (double)plain->step * plain->dt);
  for (size_t p = 0; p < plain->n; p++) {
    struct products w;
    double F[9], t[9], b[3];
    multiply_out(plain, p, &w);
    if (nodal) deform(plain, &w, F);
    stress(plain, p, nodal ? F : &plain->F[9 * p], t);
    plain_3d_body(plain, p, c, C * C * M_PI * M_PI, b);
    for (int q = 0; q < 27; q++)
      for (int d = 0; d < 3; d++)
        plain->ai[3 * w.node[q] + d] +=
            plain->m[p] * b[d] * w.S[q] - (t[3 * d] * w.D[q][0] + t[3 * d + 1] * w.D[q][1] + t[3 * d + 2] * w.D[q][2]);
  }
}

static inline __attribute__((always_inline)) void step(struct plain *plain, const int nodal)
{
  const int nodes = plain->cells * plain->cells * plain->cells;
  for (int i = 0; i < 3 * nodes; i++) plain->ai[i] = 0;
  force(plain, nodal);
  for (int i = 0; i < nodes; i++)
    for (int d = 0; d < 3; d++) {
      plain->ai[3 * i + d] /= plain->mass[i];
      plain->vi[3 * i + d] += plain->dt * plain->ai[3 * i + d];
      plain->ui[3 * i + d] += plain->dt * plain->vi[3 * i + d];
    }
  plain->step++;
}

static void follow(struct plain *plain)
{
  for (size_t p = 0; p < plain->n; p++) {
    struct products w;
    double a[3] = {0}, v[3] = {0};
    multiply_out(plain, p, &w);
    deform(plain, &w, &plain->F[9 * p]);
    for (int q = 0; q < 27; q++)
      for (int d = 0; d < 3; d++) {
        a[d] += w.S[q] * plain->ai[3 * w.node[q] + d];
        v[d] += w.S[q] * plain->vi[3 * w.node[q] + d];
      }
    for (size_t d = 0; d < 3; d++) {
      plain->v[3 * p + d] += plain->dt * a[d];
      plain->u[3 * p + d] += plain->dt * v[d];
    }
  }
}

void plain_moving_mesh_3d(struct plain *plain)
{
  step(plain, 0);
  follow(plain);
}

void plain_nodal_3d(struct plain *plain)
{
  step(plain, 1);
}

static void sample(const struct plain *plain, const double *field, double *value)
{
  for (size_t p = 0; p < plain->n; p++) {
    struct products w;
    multiply_out(plain, p, &w);
    for (int d = 0; d < 3; d++) {
      value[3 * p + (size_t)d] = 0;
      for (int q = 0; q < 27; q++) value[3 * p + (size_t)d] += w.S[q] * field[3 * w.node[q] + d];
    }
  }
}

void plain_nodal_3d_sample(struct plain *plain)
{
  sample(plain, plain->ui, plain->u);
}

void plain_moving_mesh_3d_start(struct plain *plain)
{
  plain_nodal_3d_start(plain);
  sample(plain, plain->ui, plain->u);
  sample(plain, plain->vi, plain->v);
  for (size_t p = 0; p < plain->n; p++) {
    struct products w;
    multiply_out(plain, p, &w);
    deform(plain, &w, &plain->F[9 * p]);
  }
}
