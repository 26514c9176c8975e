/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of spectra. Their columns are named as results, so that people see few digits. */
#include <gridcross/spectra.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static struct gx_table *keep(struct gx_table *table, int failed)
{
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

/* result.<quantity>.<what> */
static int name_part(struct gx_table *table, size_t column, enum gx_quantity quantity, const char *what)
{
  char name[80];
  snprintf(name, sizeof name, "result.%s.%s", gx_measure_quantity[quantity].name, what);
  return gx_table_column(table, column, name, gx_measure_quantity[quantity].unit, GX_REAL);
}

/* The i-th of `count` places from 0 to last. */
static size_t spread(size_t i, size_t count, size_t last)
{
  return count < 2 ? last : (size_t)((double)last * (double)i / (double)(count - 1) + 0.5);
}

struct gx_table *gx_spectra_times(const struct gx_spectra *spectra, enum gx_quantity quantity, size_t rows)
{
  static const char *const part[] = {"rms", "below", "above", "driven"};
  enum { PARTS = sizeof part / sizeof *part };
  double half = 0.5 * spectra->spacing, nyquist = spectra->nyquist;
  const double low[PARTS] = {-1, -1, nyquist, spectra->driven - half};
  const double high[PARTS] = {INFINITY, nyquist, INFINITY, spectra->driven + half};
  if (rows > spectra->samples) rows = spectra->samples;
  struct gx_table *table = gx_table_create(PARTS + 2, rows);
  int failed = !table || gx_table_column(table, 0, "result.time", "s", GX_REAL);
  for (size_t c = 0; c < PARTS && !failed; c++) failed = name_part(table, c + 1, quantity, part[c]);
  if (!failed) failed = gx_table_column(table, PARTS + 1, "result.share above", "", GX_REAL);
  for (size_t r = 0; r < rows && !failed; r++) {
    size_t sample = spread(r, rows, spectra->samples - 1);
    double value[PARTS];
    failed = gx_table_set(table, r, 0, gx_value_from(spectra->time[sample]));
    for (size_t c = 0; c < PARTS && !failed; c++) {
      value[c] = gx_spectrum_band(spectra, sample, quantity, low[c], high[c]);
      failed = gx_table_set(table, r, c + 1, gx_value_from(value[c]));
    }
    if (!failed) failed = gx_table_set(table, r, PARTS + 1, gx_value_from(value[2] * value[2] / (value[0] * value[0])));
  }
  return keep(table, failed);
}

static double content(const struct gx_spectra *spectra, enum gx_quantity quantity, size_t sample, size_t bin)
{
  return spectra->rms[(sample * GX_QUANTITIES + quantity) * spectra->bins + bin];
}

static const char *mark_of(const struct gx_spectra *spectra, double wavenumber)
{
  if (wavenumber == spectra->driven) return "driven";
  return wavenumber == spectra->nyquist ? "Nyquist" : NULL;
}

/* Whether a wavenumber holds more than a thousandth of what the fullest does at one of these samples. */
static bool is_seen(const struct gx_spectra *spectra, enum gx_quantity quantity, size_t bin, size_t samples, const size_t *sample)
{
  for (size_t i = 0; i < samples; i++) {
    double most = 0;
    for (size_t b = 0; b < spectra->bins; b++) most = fmax(most, content(spectra, quantity, sample[i], b));
    if (content(spectra, quantity, sample[i], bin) > 1e-3 * most) return true;
  }
  return false;
}

struct gx_table *gx_spectra_wavenumbers(const struct gx_spectra *spectra, enum gx_quantity quantity)
{
  enum { SHOWN = 3, GROWTH = SHOWN + 1, MARK, COLUMNS };
  size_t last = spectra->samples - 1, sample[SHOWN] = {last > 0, (last + 1) / 2, last};
  struct gx_table *table = gx_table_create(COLUMNS, spectra->bins);
  int failed = !table || gx_table_column(table, 0, "wavenumber", "1/m", GX_REAL) ||
               gx_table_column(table, GROWTH, "result.growth", "1/s", GX_REAL) ||
               gx_table_column(table, MARK, "grid", "", GX_TEXT);
  for (size_t i = 0; i < SHOWN && !failed; i++) {
    char name[40];
    snprintf(name, sizeof name, "t=%.4g s", spectra->time[sample[i]]);
    failed = name_part(table, 1 + i, quantity, name);
  }
  size_t row = 0;
  for (size_t b = 0; b < spectra->bins && !failed; b++) {
    double wavenumber = (double)b * spectra->spacing, half = 0.5 * spectra->spacing;
    const char *mark = mark_of(spectra, wavenumber);
    if (!mark && !is_seen(spectra, quantity, b, SHOWN, sample)) continue;
    failed = gx_table_set(table, row, 0, gx_value_from(wavenumber));
    for (size_t i = 0; i < SHOWN && !failed; i++)
      failed = gx_table_set(table, row, 1 + i, gx_value_from(content(spectra, quantity, sample[i], b)));
    if (!failed) {
      double growth = gx_spectrum_growth(spectra, quantity, wavenumber - half, wavenumber + half);
      failed = gx_table_set(table, row, GROWTH, gx_value_from(growth));
    }
    if (!failed && mark) failed = gx_table_set(table, row, MARK, (struct gx_value){.type = GX_TEXT, .text = mark});
    row++;
  }
  if (!failed) table->rows = row;
  return keep(table, failed);
}

struct gx_table *gx_spectra_last(const struct gx_spectra *spectra, enum gx_quantity quantity)
{
  struct gx_table *table = gx_table_create(2, spectra->bins - 1);
  const struct gx_measure_name *name = &gx_measure_quantity[quantity];
  int failed = !table || gx_table_column(table, 0, "wavenumber", "1/m", GX_REAL) ||
               gx_table_column(table, 1, name->name, name->unit, GX_REAL);
  double most = 0;
  for (size_t b = 1; b < spectra->bins; b++) most = fmax(most, content(spectra, quantity, spectra->samples - 1, b));
  for (size_t b = 1; b < spectra->bins && !failed; b++) {
    double part = content(spectra, quantity, spectra->samples - 1, b);
    failed = gx_table_set(table, b - 1, 0, gx_value_from((double)b * spectra->spacing)) ||
             gx_table_set(table, b - 1, 1, gx_value_from(part > 1e-12 * most ? part : NAN));
  }
  return keep(table, failed);
}

struct gx_table *gx_spectra_all(size_t cases, struct gx_spectra *const *spectra, const char *const *id, enum gx_quantity quantity)
{
  const struct gx_measure_name *name = &gx_measure_quantity[quantity];
  size_t rows = 0, row = 0;
  for (size_t i = 0; i < cases; i++) rows += spectra[i]->samples * spectra[i]->bins;
  struct gx_table *table = gx_table_create(4, rows);
  int failed = !table || gx_table_column(table, 0, "case", "", GX_TEXT) || gx_table_column(table, 1, "time", "s", GX_REAL) ||
               gx_table_column(table, 2, "wavenumber", "1/m", GX_REAL) ||
               gx_table_column(table, 3, name->name, name->unit, GX_REAL);
  for (size_t i = 0; i < cases; i++)
    for (size_t r = 0; r < spectra[i]->samples * spectra[i]->bins && !failed; r++, row++) {
      size_t sample = r / spectra[i]->bins, bin = r % spectra[i]->bins;
      failed = gx_table_set(table, row, 0, (struct gx_value){.type = GX_TEXT, .text = id[i]}) ||
               gx_table_set(table, row, 1, gx_value_from(spectra[i]->time[sample])) ||
               gx_table_set(table, row, 2, gx_value_from((double)bin * spectra[i]->spacing)) ||
               gx_table_set(table, row, 3, gx_value_from(content(spectra[i], quantity, sample, bin)));
    }
  return keep(table, failed);
}
