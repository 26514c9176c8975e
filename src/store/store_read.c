/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading the study in a directory. */
#include <gridcross/store.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "assembly.h"

struct gx_table *gx_store_read(const char *directory, FILE *errors)
{
  struct gx_store_rows *rows = gx_store_rows_begin(directory, 0, NULL, errors);
  struct gx_table *table = rows ? gx_store_rows_next(rows, SIZE_MAX) : NULL;
  gx_store_rows_end(rows);
  return table;
}

long gx_store_read_repeats(const char *directory)
{
  char *path = gx_assembly_path(directory, "", gx_assembly_name[GX_ASSEMBLY_TIMING], ""), line[256];
  FILE *in = path ? fopen(path, "rb") : NULL;
  long least = -1, repeats;
  for (int row = 0; in && fgets(line, sizeof line, in); row++) {
    if (!row) continue;
    if (sscanf(line, "%*[^,],%*[^,],%*[^,],%ld", &repeats) != 1) repeats = 0;
    if (least < 0 || repeats < least) least = repeats;
  }
  if (in) fclose(in);
  free(path);
  return least > 0 ? least : 0;
}

char *gx_store_read_provenance(const char *directory, const char *name, FILE *errors)
{
  char *study = gx_assembly_path(directory, "", gx_assembly_name[GX_ASSEMBLY_STUDY], ""),
       *text = study ? gx_hdf5_read_provenance(study, name, errors) : NULL;
  if (!study) gx_assembly_say(errors, NULL);
  free(study);
  return text;
}

struct gx_table *gx_store_read_history(const char *directory, const char *id, const char *name, FILE *errors)
{
  char *study = gx_assembly_path(directory, "", gx_assembly_name[GX_ASSEMBLY_STUDY], "");
  struct gx_table *history = study ? gx_hdf5_read_history(study, id, name, errors) : NULL;
  if (!study) gx_assembly_say(errors, NULL);
  free(study);
  return history;
}

static double real_at(const struct gx_table *table, size_t row, size_t column)
{
  struct gx_value value = gx_table_get(table, row, column);
  return value.type == GX_REAL ? value.real : NAN;
}

static struct gx_value value_named(const struct gx_table *table, size_t row, const char *name)
{
  long column = gx_table_find(table, name);
  return column < 0 ? (struct gx_value){.type = GX_NULL} : gx_table_get(table, row, (size_t)column);
}

/* Samples and bins of the rows of stored spectra, which must be whole samples of the same wavenumbers, in order. */
static int measure_spectra(const struct gx_table *stored, struct gx_spectra *spectra)
{
  static const char *const names_of[] = {"time", "wavenumber", "displacement", "velocity", "stress"};
  enum { COLUMNS = sizeof names_of / sizeof *names_of };
  if (stored->columns != COLUMNS || !stored->rows) return -1;
  for (size_t c = 0; c < COLUMNS; c++)
    if (strcmp(stored->column[c].name, names_of[c])) return -1;
  size_t bins = 1;
  while (bins < stored->rows && real_at(stored, bins, 0) == real_at(stored, 0, 0)) bins++;
  double spacing = bins > 1 ? real_at(stored, 1, 1) : 1;
  for (size_t r = 0; r < stored->rows; r++) {
    if (real_at(stored, r, 0) != real_at(stored, r - r % bins, 0)) return -1;
    if (real_at(stored, r, 1) != (double)(r % bins) * spacing) return -1;
    for (size_t c = 2; c < COLUMNS; c++)
      if (real_at(stored, r, c) < 0) return -1; /* null: not a number */
  }
  *spectra = (struct gx_spectra){.samples = stored->rows / bins, .bins = bins, .spacing = spacing};
  return stored->rows % bins ? -1 : 0;
}

/* Owned by the caller; NULL when memory runs out. */
static struct gx_spectra *to_spectra(const struct gx_table *stored, const struct gx_spectra *shape)
{
  struct gx_spectra *spectra = calloc(1, sizeof *spectra);
  if (!spectra) return NULL;
  *spectra = *shape;
  spectra->time = malloc(spectra->samples * sizeof(double));
  spectra->rms = malloc(stored->rows * GX_QUANTITIES * sizeof(double));
  if (!spectra->time || !spectra->rms) {
    gx_store_free_spectra(spectra);
    return NULL;
  }
  for (size_t r = 0; r < stored->rows; r++) {
    size_t sample = r / spectra->bins, bin = r % spectra->bins;
    spectra->time[sample] = real_at(stored, r, 0);
    for (size_t q = 0; q < GX_QUANTITIES; q++)
      spectra->rms[(sample * GX_QUANTITIES + q) * spectra->bins + bin] = real_at(stored, r, 2 + q);
  }
  return spectra;
}

struct gx_spectra *gx_store_read_spectra(const char *directory, const struct gx_table *table, size_t row, FILE *errors)
{
  struct gx_value id = value_named(table, row, "case"), mode = value_named(table, row, gx_parameters[GX_PROBLEM_MODE].path);
  struct gx_value cells = value_named(table, row, gx_parameters[GX_MESH_CELLS].path);
  char *path = gx_assembly_path(directory, "", gx_assembly_name[GX_ASSEMBLY_STUDY], "");
  struct gx_table *stored = path && id.type == GX_TEXT ? gx_hdf5_read_spectra(path, id.text, errors) : NULL;
  struct gx_spectra *spectra = NULL, shape;
  if (!path)
    gx_assembly_say(errors, NULL);
  else if (id.type != GX_TEXT || (stored && (cells.type != GX_INTEGER || measure_spectra(stored, &shape))))
    fprintf(errors, "%s: the spectra of case %s are damaged\n", path, id.type == GX_TEXT ? id.text : "?");
  else if (stored && !(spectra = to_spectra(stored, &shape)))
    gx_assembly_say(errors, NULL);
  if (spectra) {
    spectra->nyquist = 0.5 * (double)cells.integer;
    spectra->driven = mode.type == GX_INTEGER ? (double)mode.integer : 1;
  }
  gx_table_free(stored);
  free(path);
  return spectra;
}
