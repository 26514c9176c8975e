/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of particles; in 3-D of the layer of them that starts in the middle of the body. */
#include "snap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/series.h>

const char gx_snap_fields[] =
    "displacement, velocity, stress, error, error.velocity, error.stress; with .x, .xy, ... by component";

int gx_snap_find(const char *name, struct gx_snap_field *field)
{
  *field = (struct gx_snap_field){.row = -1};
  size_t skip = strcspn(name, ".");
  if (skip == strlen("error") && !strncmp(name, "error", skip)) {
    field->error = true;
    if (!name[skip]) return 0;
    name += skip + 1;
    if (strspn(name, "xyz") == strlen(name)) { /* of the displacement */
      if (strlen(name) != 1) return -1;
      field->row = *name - 'x';
      return 0;
    }
  }
  for (int q = 0; q < GX_QUANTITIES; q++) {
    size_t length = strlen(gx_measure_quantity[q].name);
    if (strncmp(name, gx_measure_quantity[q].name, length) != 0) continue;
    field->quantity = (enum gx_quantity)q;
    name += length;
    size_t components = q == GX_STRESS ? 2 : 1;
    if (!*name) return 0;
    if (*name++ != '.' || strlen(name) != components || strspn(name, "xyz") != components) return -1;
    field->row = name[0] - 'x';
    field->column = q == GX_STRESS ? name[1] - 'x' : 0;
    return 0;
  }
  return -1;
}

void gx_snap_free(struct gx_snap *snap)
{
  free(snap->x[0]);
  free(snap->x[1]);
  free(snap->value);
  free(snap->exact_x);
  free(snap->exact);
  *snap = (struct gx_snap){0};
}

static const char *record_of(const struct gx_snap_field *field, bool error)
{
  static const char *const value[] = {
      [GX_DISPLACEMENT] = "displacement", [GX_VELOCITY] = "velocity", [GX_STRESS] = "cauchy_stress"};
  static const char *const errors[] = {
      [GX_DISPLACEMENT] = "displacement_error", [GX_VELOCITY] = "velocity_error", [GX_STRESS] = "stress_error"};
  return (error ? errors : value)[field->quantity];
}

/* The field of all particles. */
static double *read_field(const struct gx_series *series, size_t i, const struct gx_snap_field *field, FILE *errors)
{
  const char *record = record_of(field, field->error);
  int dim = series->dim, components = field->quantity == GX_STRESS ? dim * dim : dim;
  if (dim == 1) return gx_series_read(series, i, GX_SERIES_PARTICLES, record, 0, errors);
  if (field->row >= 0)
    return gx_series_read(series, i, GX_SERIES_PARTICLES, record,
                          field->quantity == GX_STRESS ? field->row * dim + field->column : field->row, errors);
  double *value = calloc(series->particles, sizeof *value), *part = value;
  for (int c = 0; c < components && value && part; c++) {
    part = gx_series_read(series, i, GX_SERIES_PARTICLES, record, c, errors);
    for (size_t p = 0; p < series->particles && part; p++) value[p] = hypot(value[p], part[p]);
    free(part);
  }
  if (part) return value;
  free(value);
  return NULL;
}

static size_t nearest_to(const struct gx_series *series, double time)
{
  size_t best = series->count - 1;
  for (size_t i = 0; i < series->count; i++)
    if (fabs(series->time[i] - time) < fabs(series->time[best] - time)) best = i;
  return best;
}

static int read_spacing(struct gx_snap *snap, const struct gx_series *series, FILE *errors)
{
  double *volume = gx_series_read(series, 0, GX_SERIES_PARTICLES, "volume", 0, errors), sum = 0;
  for (size_t p = 0; p < series->particles && volume; p++) sum += volume[p];
  if (series->particles) snap->spacing = pow(sum / (double)series->particles, 1.0 / series->dim);
  free(volume);
  return volume ? 0 : -1;
}

/* Keeps the particles of the layer in the middle. */
static int cut_slice(struct gx_snap *snap, const struct gx_series *series, FILE *errors)
{
  double *Z = gx_series_read(series, 0, GX_SERIES_PARTICLES, "reference_position", 2, errors), least = INFINITY, most = -INFINITY;
  if (!Z) return -1;
  for (size_t p = 0; p < snap->n; p++) {
    least = fmin(least, Z[p]);
    most = fmax(most, Z[p]);
  }
  double middle = 0.5 * (least + most);
  snap->slice = Z[0];
  for (size_t p = 0; p < snap->n; p++)
    if (fabs(Z[p] - middle) < fabs(snap->slice - middle)) snap->slice = Z[p];
  size_t kept = 0;
  for (size_t p = 0; p < snap->n; p++) {
    if (fabs(Z[p] - snap->slice) > 0.25 * snap->spacing) continue;
    snap->x[0][kept] = snap->x[0][p];
    snap->x[1][kept] = snap->x[1][p];
    snap->value[kept++] = snap->value[p];
  }
  snap->n = kept;
  free(Z);
  return 0;
}

/* Where particles should be and what they should have: less the errors. */
static int find_exact(struct gx_snap *snap, const struct gx_series *series, size_t i, const struct gx_snap_field *field,
                      FILE *errors)
{
  const enum gx_series_set set = GX_SERIES_PARTICLES;
  if (!gx_series_has(series, set, record_of(field, true))) return 0;
  snap->exact_x = gx_series_read(series, i, set, "displacement_error", 0, errors);
  snap->exact = snap->exact_x ? gx_series_read(series, i, set, record_of(field, true), 0, errors) : NULL;
  if (!snap->exact) return -1;
  for (size_t p = 0; p < snap->n; p++) {
    snap->exact_x[p] = snap->x[0][p] - snap->exact_x[p];
    snap->exact[p] = snap->value[p] - snap->exact[p];
  }
  return 0;
}

static int check(const struct gx_series *series, const struct gx_snap_field *field, FILE *errors)
{
  if (field->row >= series->dim || field->column >= series->dim) {
    fprintf(errors, "gridcross: there is no such component in %d-D\n", series->dim);
    return -1;
  }
  if (!field->error || gx_series_has(series, GX_SERIES_PARTICLES, record_of(field, true))) return 0;
  fputs("gridcross: this problem has no exact solution, so that no errors are known: leave out --y or name another\n", errors);
  return -1;
}

int gx_snap_read(struct gx_snap *snap, const char *directory, const char *id, const struct gx_snap_field *field, double time,
                 FILE *errors)
{
  *snap = (struct gx_snap){0};
  struct gx_series *series = gx_series_open(directory, id, errors);
  if (!series) return -1;
  int failed = check(series, field, errors);
  size_t i = isnan(time) ? series->count - 1 : nearest_to(series, time);
  snap->dim = series->dim;
  snap->time = series->time[i];
  snap->n = series->particles;
  if (!failed) failed = read_spacing(snap, series, errors);
  for (int d = 0; d < 2 && d < series->dim && !failed; d++)
    failed = (snap->x[d] = gx_series_read(series, i, GX_SERIES_PARTICLES, "position", d, errors)) ? 0 : -1;
  if (!failed) failed = (snap->value = read_field(series, i, field, errors)) ? 0 : -1;
  if (!failed && series->dim == 1 && !field->error) failed = find_exact(snap, series, i, field, errors);
  if (!failed && series->dim == 3) failed = cut_slice(snap, series, errors);
  gx_series_close(series);
  return failed;
}
