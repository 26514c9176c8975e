/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A cantilever by beam theory, independent of the material point method: geometrically exact with shear (Reissner 1972), by finite
 * differences and leapfrog, and for small deflections the modes of Euler and Bernoulli. */
#ifndef GRIDCROSS_TESTS_BEAM_H
#define GRIDCROSS_TESTS_BEAM_H

#include <math.h>

/* Of a section of unit width: stiffnesses against stretch, shear and bending, N, N, N m^2; inertias per length, kg/m, kg m. */
struct beam {
  double length, stretch, shear, bend, mass, rotary;
};

/* Rectangular section; young: E in plane stress, E/(1 - nu^2) in plane strain; mu: shear modulus. */
static inline struct beam beam_of(double length, double thickness, double young, double mu, double density)
{
  double area = thickness, second = thickness * thickness * thickness / 12;
  return (struct beam){length, young * area, mu * area * 5 / 6, young * second, density * area, density * second};
}

enum { BEAM_NODES = 61 };

/* x, y, angle of each node. */
struct beam_line {
  double q[BEAM_NODES][3];
};

/* Forces of an element on its two nodes: strains at its middle, where shear does not lock. */
static inline void beam_element(const struct beam *beam, double ds, const double *a, const double *b, double *on_a, double *on_b)
{
  double angle = 0.5 * (a[2] + b[2]), c = cos(angle), s = sin(angle), dx = (b[0] - a[0]) / ds, dy = (b[1] - a[1]) / ds;
  double stretch = c * dx + s * dy, slide = -s * dx + c * dy; /* of the centre line, along the section's normal and in it */
  double N = beam->stretch * (stretch - 1), Q = beam->shear * slide, M = beam->bend * (b[2] - a[2]) / ds;
  double x = N * c - Q * s, y = N * s + Q * c, turn = 0.5 * ds * (N * slide - Q * stretch);
  on_a[0] += x, on_a[1] += y, on_a[2] += M - turn;
  on_b[0] -= x, on_b[1] -= y, on_b[2] -= M + turn;
}

/* Largest displacement of the tip until `end`, from rest, gravity switched on at 0. */
static inline double beam_swing(const struct beam *beam, double gravity, double end)
{
  const double ds = beam->length / (BEAM_NODES - 1), dt = 0.2 * ds * sqrt(beam->mass / beam->stretch);
  struct beam_line at = {0}, speed = {0};
  double farthest = 0;
  for (int i = 0; i < BEAM_NODES; i++) at.q[i][0] = i * ds;
  for (double t = 0; t < end; t += dt) {
    struct beam_line force = {0};
    for (int i = 0; i + 1 < BEAM_NODES; i++) beam_element(beam, ds, at.q[i], at.q[i + 1], force.q[i], force.q[i + 1]);
    for (int i = 1; i < BEAM_NODES; i++) {
      double part = i + 1 < BEAM_NODES ? ds : 0.5 * ds;
      for (int k = 0; k < 3; k++) {
        double inertia = part * (k < 2 ? beam->mass : beam->rotary);
        speed.q[i][k] += (t == 0 ? 0.5 : 1) * dt * (force.q[i][k] / inertia - (k == 1 ? gravity : 0));
        at.q[i][k] += dt * speed.q[i][k];
      }
    }
    farthest = fmax(farthest, hypot(at.q[BEAM_NODES - 1][0] - beam->length, at.q[BEAM_NODES - 1][1]));
  }
  return farthest;
}

/* Modes of Euler and Bernoulli: displacement of the tip at time t after a uniform load per mass was switched on. */
static inline double beam_modes(const struct beam *beam, double gravity, double t)
{
  static const double beta[] = {1.875104068711961, 4.694091132974175, 7.854757438237613, 10.99554073487547, 14.13716839104647};
  double tip = 0;
  for (int n = 0; n < 5; n++) {
    double b = beta[n], sigma = (sinh(b) - sin(b)) / (cosh(b) + cos(b));
    double omega = b * b / (beam->length * beam->length) * sqrt(beam->bend / beam->mass);
    tip += (n % 2 ? -4 : 4) * sigma / b * gravity / (omega * omega) * (1 - cos(omega * t));
  }
  return tip;
}

#endif
