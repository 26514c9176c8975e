/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts what a case keeps, and refuses too much of it before a step is taken. */
#include "kept.h"

#include <math.h>

#include <gridcross/spectrum.h>

/* More are a slip, or more than can be looked at. */
static const double most_in_memory = 1e8, most_on_disk = 1e10; /* 80 GB */

static double every(const struct gx_case *one, int parameter)
{
  const struct gx_value *value = &one->value[parameter];
  return value->type == GX_INTEGER ? (double)value->integer : 0;
}

static double count(const struct gx_simulation *simulation, double every)
{
  return every > 0 ? floor(simulation->steps / every) + 2 : 0;
}

double gx_kept_samples(const struct gx_simulation *simulation, const struct gx_case *one)
{
  return count(simulation, every(one, GX_OUTPUT_HISTORIES)) + count(simulation, every(one, GX_OUTPUT_BUDGET));
}

double gx_kept_spectra(const struct gx_simulation *simulation, const struct gx_case *one)
{
  return count(simulation, every(one, GX_OUTPUT_SPECTRA));
}

double gx_kept_snapshots_every(const struct gx_case *one)
{
  return every(one, GX_OUTPUT_SNAPSHOTS);
}

enum gx_status gx_kept_refuse(const struct gx_simulation *simulation, const struct gx_case *one, struct gx_outcome *outcome)
{
  const struct gx_history *history = NULL;
  const bool probed = one->value[GX_OUTPUT_PROBE].type == GX_TEXT, budgeted = every(one, GX_OUTPUT_BUDGET) > 0;
  const size_t bytes = sizeof *history->sample + probed * sizeof *history->probe + budgeted * sizeof *history->budget;
  const double samples = gx_kept_samples(simulation, one), sample = (double)(bytes / sizeof(double));
  if (samples * sample > most_in_memory)
    return gx_status_set(
        outcome, GX_REFUSED, -1,
        "histories of %.3g samples of %.3g numbers each are too many: make output.histories or output.budget larger", samples,
        sample);
  const struct gx_space_options *options = &simulation->space_options;
  const int per_side = options->cells[0] * simulation->per_cell;
  const double spectra = gx_kept_spectra(simulation, one);
  const double spectrum = GX_QUANTITIES * (double)gx_spectrum_count(simulation->particles->dim, per_side, options->periodic);
  if (spectra * spectrum > most_in_memory)
    return gx_status_set(outcome, GX_REFUSED, -1, "%.3g spectra of %.3g numbers each are too many: make output.spectra larger",
                         spectra, spectrum);
  const double steps = gx_kept_snapshots_every(one), snapshots = steps > 0 ? ceil(simulation->steps / steps) + 1 : 0;
  const double snapshot = snapshots > 0 ? gx_snapshot_numbers(simulation->space, simulation->space_options.cells) : 0;
  if (snapshots * snapshot <= most_on_disk) return GX_OK;
  return gx_status_set(outcome, GX_REFUSED, -1,
                       "%.3g snapshots of %.3g numbers each would be %.3g GB: make output.snapshots larger", snapshots, snapshot,
                       snapshots * snapshot * sizeof(double) / 1e9);
}
