/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frequency at which a run vibrates in the mode that the problem drives: the displacement's projection on sin(2 pi m X), sampled
 * at equal times. One mode of a linear scheme, damped or growing, obeys a recurrence of three samples exactly, so that its
 * frequency does not suffer from windows and whole periods as a transform's would. */
#ifndef GRIDCROSS_FREQUENCY_H
#define GRIDCROSS_FREQUENCY_H

#include <gridcross/space.h>

struct gx_frequency {
  double interval; /* s between samples */
  size_t samples;
  double before[2], largest; /* last samples, newest first; largest of all in magnitude */
  double xx, xb, bb, xa, ba; /* sums over triples: x the middle, b the centred and a the second difference */
};

/* What the samples x follow: x = A exp(growth t) cos(2 pi frequency t + phase). */
struct gx_vibration {
  double frequency, growth; /* 1/s; NaN: none */
};

/* Projection of the displacement in the first active direction on sin(2 pi m X), with the particles' volumes as weights, m. */
double gx_frequency_project(struct gx_space *space);
void gx_frequency_add(struct gx_frequency *frequency, double sample);
/* NaN with fewer than four samples, or when none exceeds `noise`, m, or when they do not vibrate. Frequencies above half a sample's
 * are mirrored there. */
struct gx_vibration gx_frequency_fit(const struct gx_frequency *frequency, double noise);

#endif
