/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error's last spectrum by wavenumber, one line a case, the grid's Nyquist wavenumber marked. */
#include <math.h>
#include <string.h>

#include <gridcross/spectra.h>
#include <gridcross/store.h>

#include "curves.h"

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

static enum gx_plot_status draw(const struct gx_plot *plot, FILE *errors)
{
  static const struct gx_curves curves = {.name = "displacement", .read = read_spectrum};
  return gx_curves_plot(plot, &curves, errors);
}

const struct gx_plot_kind gx_plot_spectrum = {
    .name = "spectrum",
    .help = "the error at the end by wavenumber, one line a case; of studies run with output.spectra",
    .y = "displacement, velocity or stress",
    .across = "wavenumber",
    .example = "gridcross plot FILE.study spectrum --y stress --where mesh.cells=32 -o spectrum.svg",
    .draw = draw,
};
