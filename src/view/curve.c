/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads what figures of one line a case draw: histories and spectra. */
#include "curve.h"

#include <math.h>
#include <string.h>

#include <gridcross/spectra.h>
#include <gridcross/store.h>

static struct gx_curve read_history(const struct gx_plot *plot, size_t study, size_t row, const char *name, FILE *errors)
{
  const struct gx_table *table = plot->table[study];
  const char *id = gx_table_get(table, row, (size_t)gx_table_find(table, "case")).text;
  return (struct gx_curve){gx_store_read_history(plot->directory[study], id, name, errors), NAN};
}

static struct gx_curve read_spectrum(const struct gx_plot *plot, size_t study, size_t row, const char *name, FILE *errors)
{
  struct gx_curve curve = {.nyquist = NAN};
  int q = 0;
  while (q < GX_QUANTITIES && strcmp(name, gx_measure_quantity[q].name) != 0) q++;
  if (q == GX_QUANTITIES) {
    fprintf(errors, "gridcross: no spectrum '%s'; there are displacement, velocity and stress\n", name);
    return curve;
  }
  struct gx_spectra *spectra = gx_store_read_spectra(plot->directory[study], plot->table[study], row, errors);
  if (!spectra) return curve;
  curve = (struct gx_curve){gx_spectra_last(spectra, (enum gx_quantity)q), spectra->nyquist};
  gx_store_free_spectra(spectra);
  if (!curve.table) fputs("gridcross: out of memory\n", errors);
  return curve;
}

bool gx_curve_is_error(const char *name)
{
  for (int q = 0; q < GX_QUANTITIES; q++)
    if (!strncmp(name, gx_measure_quantity[q].name, strlen(gx_measure_quantity[q].name))) return true;
  return false;
}

const struct gx_curves gx_curve_history = {.name = "displacement.rms", .in_time = true, .read = read_history};
const struct gx_curves gx_curve_spectrum = {.name = "displacement", .read = read_spectrum};
