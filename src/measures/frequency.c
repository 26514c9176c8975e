/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares for the recurrence x(n+1) - 2 x(n) + x(n-1) = -kappa x(n) + gamma (x(n+1) - x(n-1)), which samples of one damped
 * mode obey exactly (Prony's method). In this form its unknowns are nearly orthogonal and small, so that many samples a period
 * cost no digits. Its roots exp((growth +- i omega) interval) give
 *   exp(2 growth interval) = (1 + gamma)/(1 - gamma),  cos(omega interval) = (1 - kappa/2)/sqrt(1 - gamma^2). */
#include <gridcross/frequency.h>

#include <math.h>

double gx_frequency_project(struct gx_space *space)
{
  const struct gx_particles *particles = space->particles;
  const struct gx_problem_options *options = &space->posed->options;
  int d = 0;
  while (d + 1 < options->dim && !options->active[d]) d++;
  if (space->kind->settle) space->kind->settle(space);
  const double *u = particles->u[d], *sine = space->posed->sine[d];
  double sum = 0, norm = 0;
  for (size_t p = 0; p < particles->n; p++) {
    sum += particles->V0[p] * sine[p] * u[p];
    norm += particles->V0[p] * sine[p] * sine[p];
  }
  return sum / norm;
}

void gx_frequency_add(struct gx_frequency *frequency, double sample)
{
  double middle = frequency->before[0], first = frequency->before[1];
  if (frequency->samples++ >= 2) {
    double a = (sample - middle) - (middle - first), b = sample - first;
    frequency->xx += middle * middle;
    frequency->xb += middle * b;
    frequency->bb += b * b;
    frequency->xa += middle * a;
    frequency->ba += b * a;
  }
  frequency->largest = fmax(frequency->largest, fabs(sample));
  frequency->before[1] = middle;
  frequency->before[0] = sample;
}

struct gx_vibration gx_frequency_fit(const struct gx_frequency *frequency, double noise)
{
  const struct gx_frequency *f = frequency;
  struct gx_vibration none = {NAN, NAN};
  double det = f->xx * f->bb - f->xb * f->xb;
  if (f->samples < 4 || !(f->largest > noise) || !(det > 0)) return none;
  double kappa = (f->xb * f->ba - f->bb * f->xa) / det, gamma = (f->xx * f->ba - f->xb * f->xa) / det;
  if (!(fabs(gamma) < 1)) return none;
  double root = sqrt(1 - gamma * gamma);
  double versine = (kappa / 2 - gamma * gamma / (1 + root)) / root; /* 1 - cos(omega interval) */
  if (!(versine > 0 && versine <= 2)) return none;
  return (struct gx_vibration){2 * asin(sqrt(versine / 2)) / (2 * M_PI * f->interval), atanh(gamma) / f->interval};
}
