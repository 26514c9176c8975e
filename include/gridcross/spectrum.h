/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spectra: errors at particles that lie at equal distances in X, by wavenumber. In 1-D a bin is one wavenumber: full waves a unit
 * length on a periodic domain, half waves between fixed ends. In 2-D and 3-D it is the shell of wave vectors whose length rounds
 * to it. The content of a bin is the root mean square over the particles of that part of the error, so that the squares of all
 * bins sum to the square of the error's own (Parseval); a wave of amplitude A has A/sqrt(2). */
#ifndef GRIDCROSS_SPECTRUM_H
#define GRIDCROSS_SPECTRUM_H

#include <gridcross/measure.h>

struct gx_spectrum;

/* particles: uniform, per_side of them along each direction (cells times particles per cell). Between fixed ends displacement and
 * velocity of a direction are odd there and all else is even: sines and cosines in place of full waves. Allocates and plans; may
 * be called from several threads. NULL when memory runs out. */
struct gx_spectrum *gx_spectrum_create(const struct gx_particles *particles, int per_side, bool periodic);
void gx_spectrum_free(struct gx_spectrum *spectrum);
/* Wavenumbers of such a spectrum, 0 included. */
size_t gx_spectrum_count(int dim, int per_side, bool periodic);
size_t gx_spectrum_bins(const struct gx_spectrum *spectrum);
/* Wavenumber of bin i is i times this: 1 periodic, 1/2 between fixed ends; 1/m. */
double gx_spectrum_spacing(const struct gx_spectrum *spectrum);
/* Of the errors at the measure's last sample. rms: [GX_QUANTITIES][bins], m, m/s, Pa. */
void gx_spectrum_take(struct gx_spectrum *spectrum, struct gx_measure *measure, double *rms);

/* Spectra of a run, as it keeps them. */
struct gx_spectra {
  size_t samples, bins;
  double spacing, nyquist, driven; /* 1/m: between bins, of the grid (cells / 2), of the exact solution */
  double *time;                    /* [samples] s, owned */
  double *rms;                     /* [samples][GX_QUANTITIES][bins], owned */
};

/* Root mean square of the part of an error with low < wavenumber <= high; all of it from -1 to INFINITY. Above nyquist it is what
 * the grid's functions cannot hold, and their images. */
double gx_spectrum_band(const struct gx_spectra *spectra, size_t sample, enum gx_quantity quantity, double low, double high);
/* Rate r of the exponential growth exp(r t) that fits such a part best over all samples where it is not zero, by its logarithm,
 * 1/s; NaN with fewer than two. */
double gx_spectrum_growth(const struct gx_spectra *spectra, enum gx_quantity quantity, double low, double high);

#endif
