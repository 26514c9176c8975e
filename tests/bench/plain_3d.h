/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the two plain 3-D loops share: periodic quadratic weights, neo-Hookean stress and body force of axis-aligned waves. */
#ifndef GRIDCROSS_BENCH_PLAIN_3D_H
#define GRIDCROSS_BENCH_PLAIN_3D_H

#include <math.h>

#include "plain.h"

/* Weights and slopes per direction, and the node indices along each. */
struct plain_3d_weights {
  double S[3][3], D[3][3];
  int node[3][3];
};

static inline void plain_3d_weigh(const double *x, int N, struct plain_3d_weights *w)
{
  int stride = 1;
  for (int d = 0; d < 3; d++, stride *= N) {
    double s = x[d] < 0 ? x[d] + 1 : x[d] >= 1 ? x[d] - 1 : x[d];
    int cell = (int)(s * N);
    double r = s * N - cell;
    w->S[d][0] = 0.5 * (1 - r) * (1 - r);
    w->S[d][1] = 0.5 + r * (1 - r);
    w->S[d][2] = 0.5 * r * r;
    w->D[d][0] = (r - 1) * N;
    w->D[d][1] = (1 - 2 * r) * N;
    w->D[d][2] = r * N;
    for (int k = 0; k < 3; k++) w->node[d][k] = (cell + k < N ? cell + k : cell + k - N) * stride;
  }
}

/* b_d = C^2 pi^2 u_d (2 / F_d^2 + 1) of the exact solution; c = A cos(C pi t). */
static inline void plain_3d_body(const struct plain *plain, size_t p, double c, double stiffness, double *b)
{
  for (int d = 0; d < 3; d++) {
    double F = 1 + 2 * M_PI * c * plain->cosine[3 * p + (size_t)d];
    b[d] = stiffness * c * plain->sine[3 * p + (size_t)d] * (2 / (F * F) + 1);
  }
}

#endif
