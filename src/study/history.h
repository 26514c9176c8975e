/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run keeps of its samples: histories and spectra. */
#ifndef GRIDCROSS_STUDY_HISTORY_H
#define GRIDCROSS_STUDY_HISTORY_H

#include <gridcross/simulation.h>
#include <gridcross/study.h>

/* Room in the result for so many samples, of a simulation that was built; budgeted: each with a budget. */
enum gx_status gx_history_begin(struct gx_result *result, const struct gx_simulation *simulation, double samples, bool budgeted);
/* The same for spectra. spectrum: NULL when it fails, to be freed in any case. */
enum gx_status gx_history_begin_spectra(struct gx_result *result, const struct gx_simulation *simulation, double samples,
                                        struct gx_spectrum **spectrum);
/* Of the samples so far, for which there is that room. */
void gx_history_image(struct gx_result *result, double samples, double spectra, struct gx_image *image);

#endif
