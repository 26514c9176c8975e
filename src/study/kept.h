/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a case keeps beside its results: samples of histories and budgets, spectra, snapshots. */
#ifndef GRIDCROSS_STUDY_KEPT_H
#define GRIDCROSS_STUDY_KEPT_H

#include <gridcross/simulation.h>
#include <gridcross/study.h>

/* Samples of the histories at most: each output.histories and each output.budget steps, and the ends. */
double gx_kept_samples(const struct gx_simulation *simulation, const struct gx_case *one);
/* Spectra at most: each output.spectra steps, and the ends. */
double gx_kept_spectra(const struct gx_simulation *simulation, const struct gx_case *one);
/* Steps between snapshots; 0: none. */
double gx_kept_snapshots_every(const struct gx_case *one);
/* Refuses more than memory or a disk should take. Of a simulation that was built. */
enum gx_status gx_kept_refuse(const struct gx_simulation *simulation, const struct gx_case *one, struct gx_outcome *outcome);

#endif
