/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All room is taken at the start. */
#include "history.h"

#include <stdlib.h>

enum gx_status gx_history_begin(struct gx_result *result, const struct gx_simulation *simulation, double samples, bool budgeted)
{
  struct gx_history *history = &result->history;
  const bool probed = result->probe >= 0;
  history->jumps = simulation->jumps;
  history->dim = simulation->particles->dim;
  history->sample = malloc((size_t)samples * sizeof *history->sample);
  history->probe = probed ? malloc((size_t)samples * sizeof *history->probe) : NULL;
  history->budget = budgeted ? malloc((size_t)samples * sizeof *history->budget) : NULL;
  if (history->sample && (history->probe || !probed) && (history->budget || !budgeted)) return GX_OK;
  return gx_status_set(&result->outcome, GX_FAILED, -1, "out of memory for %.3g history samples", samples);
}

enum gx_status gx_history_begin_spectra(struct gx_result *result, const struct gx_simulation *simulation, double samples,
                                        struct gx_spectrum **spectrum)
{
  const struct gx_space_options *options = &simulation->space_options;
  int cells = options->cells[0];
  *spectrum = gx_spectrum_create(simulation->particles, cells * simulation->per_cell, options->periodic);
  if (!*spectrum) return gx_status_set(&result->outcome, GX_FAILED, -1, "out of memory for spectra");
  struct gx_spectra *spectra = &result->spectra;
  *spectra = (struct gx_spectra){
      .bins = gx_spectrum_bins(*spectrum),
      .spacing = gx_spectrum_spacing(*spectrum),
      .nyquist = 0.5 * cells,
      .driven = simulation->problem_options.mode,
  };
  spectra->time = malloc((size_t)samples * sizeof(double));
  spectra->rms = malloc((size_t)samples * GX_QUANTITIES * spectra->bins * sizeof(double));
  if (spectra->time && spectra->rms) return GX_OK;
  return gx_status_set(&result->outcome, GX_FAILED, -1, "out of memory for %.3g spectra", samples);
}

void gx_history_image(struct gx_result *result, double samples, double lines, struct gx_image *image)
{
  struct gx_history *history = &result->history;
  struct gx_spectra *spectra = &result->spectra;
  GX_IMAGE(image, history->samples);
  GX_IMAGE(image, spectra->samples);
  if ((double)history->samples > samples || (double)spectra->samples > lines) image->failed = true;
  if (image->failed) return;
  gx_image_bytes(image, history->sample, history->samples * sizeof *history->sample);
  if (history->probe) gx_image_bytes(image, history->probe, history->samples * sizeof *history->probe);
  if (history->budget) gx_image_bytes(image, history->budget, history->samples * sizeof *history->budget);
  gx_image_bytes(image, spectra->time, spectra->samples * sizeof *spectra->time);
  gx_image_bytes(image, spectra->rms, spectra->samples * GX_QUANTITIES * spectra->bins * sizeof *spectra->rms);
}
