/* SPDX-License-Identifier: GPL-3.0-or-later */
/* cpGIMP in 1-D between fixed ends, linear bar of berzins2022, symplectic Euler with the stress first, lumped mass. */
#include "plain.h"

/* r = x_p - x_i, l: half the width of the particle. */
static inline void weight(double r, double l, double h, double *S, double *D)
{
  double q = r < 0 ? -r : r, sign = r < 0 ? -1 : 1;
  if (q < l) {
    *S = 1 - (r * r + l * l) / (2 * h * l);
    *D = -r / (h * l);
  } else if (q <= h - l) {
    *S = 1 - q / h;
    *D = -sign / h;
  } else if (q < h + l) {
    double w = h + l - q;
    *S = w * w / (4 * h * l);
    *D = -sign * w / (2 * h * l);
  } else {
    *S = 0;
    *D = 0;
  }
}

/* Node i is stored at i + 1, after a ghost node; the ghosts and the ends do not move. */
static void fix_ends(double *field, int N)
{
  field[0] = field[1] = field[N + 1] = field[N + 2] = 0;
}

static void scatter_momentum(struct plain *plain)
{
  const int N = plain->cells;
  const double h = 1.0 / N;
  for (int i = 0; i < N + 3; i++) plain->mass[i] = plain->vi[i] = plain->ai[i] = 0;
  for (size_t p = 0; p < plain->n; p++) {
    double x = plain->X[p] + plain->u[p], m = plain->m[p], l = 0.5 * plain->F[p] * plain->V0[p];
    int nearest = (int)(x / h + 0.5);
    plain->first[p] = nearest;
    for (int k = 0; k < 3; k++) {
      double S;
      weight(x - (nearest + k - 1) * h, l, h, &S, &plain->D[3 * p + (size_t)k]);
      plain->S[3 * p + (size_t)k] = S;
      plain->mass[nearest + k] += m * S;
      plain->vi[nearest + k] += m * plain->v[p] * S;
    }
  }
  for (int i = 0; i < N + 3; i++) plain->vi[i] = plain->mass[i] > 0 ? plain->vi[i] / plain->mass[i] : 0;
  fix_ends(plain->vi, N);
}

void plain_cpgimp(struct plain *plain)
{
  const int N = plain->cells;
  const double dt = plain->dt;
  double *vi = plain->vi, *ai = plain->ai;
  scatter_momentum(plain);
  for (size_t p = 0; p < plain->n; p++) {
    const double *D = &plain->D[3 * p];
    int i = plain->first[p];
    double F = plain->F[p] * (1 + dt * (D[0] * vi[i] + D[1] * vi[i + 1] + D[2] * vi[i + 2]));
    double sigma = plain->modulus * (F - 1), V = F * plain->V0[p];
    plain->F[p] = F;
    for (int k = 0; k < 3; k++) ai[i + k] -= sigma * V * D[k];
  }
  for (int i = 0; i < N + 3; i++) ai[i] = plain->mass[i] > 0 ? ai[i] / plain->mass[i] : 0;
  fix_ends(ai, N);
  for (int i = 0; i < N + 3; i++) vi[i] += dt * ai[i];
  for (size_t p = 0; p < plain->n; p++) {
    const double *S = &plain->S[3 * p];
    int i = plain->first[p];
    plain->v[p] += dt * (S[0] * ai[i] + S[1] * ai[i + 1] + S[2] * ai[i + 2]);
    plain->u[p] += dt * (S[0] * vi[i] + S[1] * vi[i + 1] + S[2] * vi[i + 2]);
  }
  plain->step++;
}
