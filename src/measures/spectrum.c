/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transforms of the errors at the particles. One real transform serves every boundary: waves as cosines and sines on a periodic
 * domain, sines of half waves for what is odd at fixed ends, cosines for what is even; in each of them products over the
 * directions. The only file here that sees FFTW. */
#include <gridcross/spectrum.h>

#include <math.h>
#include <stdlib.h>

#include <fftw3.h>
#include <gsl/gsl_fit.h>

enum { PARITIES = 1 << GX_MAX_DIM };

struct gx_spectrum {
  int dim, per_side;
  bool periodic;
  size_t n, bins;
  double spacing;
  fftw_plan plan[PARITIES]; /* bit d: odd at the ends of direction d */
  size_t *place;            /* [n] of a particle in the lattice, last direction fastest */
  double *error, *lattice;  /* [n]; lattice is transformed in place */
};

static fftw_r2r_kind kind_of(const struct gx_spectrum *spectrum, unsigned parity, int d)
{
  if (spectrum->periodic) return FFTW_R2HC;
  return parity >> d & 1 ? FFTW_RODFT10 : FFTW_REDFT10;
}

/* Entry j of a transform along one direction: its wavenumber in bins, and what the mean square is of its square. FFTW does not
 * scale; its half-wave transforms also double. */
struct line {
  int wavenumber;
  double weight;
};

static struct line line_of(fftw_r2r_kind kind, int n, int j)
{
  double scale = 1.0 / ((double)n * n);
  if (kind == FFTW_R2HC) {
    int k = j <= n / 2 ? j : n - j;
    return (struct line){k, k == 0 || 2 * k == n ? scale : 2 * scale};
  }
  if (kind == FFTW_RODFT10) return (struct line){j + 1, j + 1 == n ? scale / 4 : scale / 2};
  return (struct line){j, j == 0 ? scale / 4 : scale / 2};
}

static bool plan(struct gx_spectrum *spectrum)
{
  fftw_make_planner_thread_safe();
  for (unsigned parity = 0; parity < (spectrum->periodic ? 1U : 1U << spectrum->dim); parity++) {
    int count[GX_MAX_DIM];
    fftw_r2r_kind kind[GX_MAX_DIM];
    for (int d = 0; d < spectrum->dim; d++) {
      count[d] = spectrum->per_side;
      kind[d] = kind_of(spectrum, parity, d);
    }
    spectrum->plan[parity] = fftw_plan_r2r(spectrum->dim, count, spectrum->lattice, spectrum->lattice, kind, FFTW_ESTIMATE);
    if (!spectrum->plan[parity]) return false;
  }
  return true;
}

static void find_places(struct gx_spectrum *spectrum, const struct gx_particles *particles)
{
  for (size_t p = 0; p < spectrum->n; p++) {
    size_t place = 0;
    for (int d = 0; d < spectrum->dim; d++)
      place = place * (size_t)spectrum->per_side + (size_t)(particles->X[d][p] * spectrum->per_side);
    spectrum->place[p] = place;
  }
}

size_t gx_spectrum_count(int dim, int per_side, bool periodic)
{
  const int highest = periodic ? per_side / 2 : per_side;
  return (size_t)lround(sqrt(dim) * highest) + 1;
}

struct gx_spectrum *gx_spectrum_create(const struct gx_particles *particles, int per_side, bool periodic)
{
  struct gx_spectrum *spectrum = calloc(1, sizeof *spectrum);
  if (!spectrum) return NULL;
  *spectrum = (struct gx_spectrum){
      .dim = particles->dim,
      .per_side = per_side,
      .periodic = periodic,
      .n = particles->n,
      .bins = gx_spectrum_count(particles->dim, per_side, periodic),
      .spacing = periodic ? 1 : 0.5,
      .place = malloc(particles->n * sizeof(size_t)),
      .error = malloc(particles->n * sizeof(double)),
      .lattice = fftw_malloc(particles->n * sizeof(double)),
  };
  if (!spectrum->place || !spectrum->error || !spectrum->lattice || !plan(spectrum)) {
    gx_spectrum_free(spectrum);
    return NULL;
  }
  find_places(spectrum, particles);
  return spectrum;
}

void gx_spectrum_free(struct gx_spectrum *spectrum)
{
  if (!spectrum) return;
  for (int i = 0; i < PARITIES; i++)
    if (spectrum->plan[i]) fftw_destroy_plan(spectrum->plan[i]);
  free(spectrum->place);
  free(spectrum->error);
  fftw_free(spectrum->lattice);
  free(spectrum);
}

size_t gx_spectrum_bins(const struct gx_spectrum *spectrum)
{
  return spectrum->bins;
}

double gx_spectrum_spacing(const struct gx_spectrum *spectrum)
{
  return spectrum->spacing;
}

/* Adds the mean squares of the transformed lattice to their bins. */
static void add_squares(const struct gx_spectrum *spectrum, unsigned parity, double *square)
{
  const int n = spectrum->per_side;
  for (size_t i = 0; i < spectrum->n; i++) {
    double weight = 1, length = 0;
    size_t rest = i;
    for (int d = spectrum->dim - 1; d >= 0; d--, rest /= (size_t)n) {
      struct line line = line_of(kind_of(spectrum, parity, d), n, (int)(rest % (size_t)n));
      weight *= line.weight;
      length += (double)line.wavenumber * line.wavenumber;
    }
    square[lround(sqrt(length))] += weight * spectrum->lattice[i] * spectrum->lattice[i];
  }
}

/* A component changes sign at the ends of direction d once for each of its indices that is d. */
static unsigned parity_of(const struct gx_spectrum *spectrum, enum gx_quantity quantity, int component)
{
  if (spectrum->periodic) return 0;
  if (quantity != GX_STRESS) return 1U << component;
  return 1U << component / spectrum->dim ^ 1U << component % spectrum->dim;
}

void gx_spectrum_take(struct gx_spectrum *spectrum, struct gx_measure *measure, double *rms)
{
  for (int q = 0; q < GX_QUANTITIES; q++, rms += spectrum->bins) {
    int components = q == GX_STRESS ? spectrum->dim * spectrum->dim : spectrum->dim;
    for (size_t b = 0; b < spectrum->bins; b++) rms[b] = 0;
    for (int k = 0; k < components; k++) {
      unsigned parity = parity_of(spectrum, (enum gx_quantity)q, k);
      gx_measure_error(measure, (enum gx_quantity)q, k, spectrum->error);
      for (size_t p = 0; p < spectrum->n; p++) spectrum->lattice[spectrum->place[p]] = spectrum->error[p];
      fftw_execute(spectrum->plan[parity]);
      add_squares(spectrum, parity, rms);
    }
    for (size_t b = 0; b < spectrum->bins; b++) rms[b] = sqrt(rms[b]);
  }
}

double gx_spectrum_band(const struct gx_spectra *spectra, size_t sample, enum gx_quantity quantity, double low, double high)
{
  const double *rms = spectra->rms + (sample * GX_QUANTITIES + quantity) * spectra->bins;
  double sum = 0;
  for (size_t b = 0; b < spectra->bins; b++) {
    double wavenumber = (double)b * spectra->spacing;
    if (wavenumber > low && wavenumber <= high) sum += rms[b] * rms[b];
  }
  return sqrt(sum);
}

double gx_spectrum_growth(const struct gx_spectra *spectra, enum gx_quantity quantity, double low, double high)
{
  double *time = malloc(2 * (spectra->samples + 1) * sizeof *time), *logarithm = time + spectra->samples;
  size_t count = 0;
  double start, rate = NAN, cov[3], residue;
  for (size_t i = 0; time && i < spectra->samples; i++) {
    double part = gx_spectrum_band(spectra, i, quantity, low, high);
    if (!(part > 0)) continue;
    time[count] = spectra->time[i];
    logarithm[count++] = log(part);
  }
  if (count > 1) gsl_fit_linear(time, 1, logarithm, 1, count, &start, &rate, &cov[0], &cov[1], &cov[2], &residue);
  free(time);
  return rate;
}
