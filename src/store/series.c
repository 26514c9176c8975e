/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads files that openpmd.c wrote. Whatever a file says of itself is checked before it is believed. */
#include <gridcross/series.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "handle.h"
#include "openpmd.h"
#include "seal.h"

struct gx_series_file {
  hid_t file;
  char *path; /* owned */
};

static const char *const sets[GX_SERIES_SETS] = {
    [GX_SERIES_PARTICLES] = GX_OPENPMD_PARTICLES, [GX_SERIES_VERTICES] = GX_OPENPMD_VERTICES};

enum { PATH = 256 };

/* /data/<step>/<set>[/<record>] of snapshot i; false: does not fit. */
static bool path_of(const struct gx_series *series, size_t i, enum gx_series_set set, const char *record, char path[PATH])
{
  int length = snprintf(path, PATH, "/data/%.0f/%s%s%s", series->step[i], sets[set], *record ? "/" : "", record);
  return length > 0 && length < PATH && strspn(record, "abcdefghijklmnopqrstuvwxyz_ABCDEFGHIJKLMNOPQRSTUVWXYZ") == strlen(record);
}

/* An object at a path all of whose groups are there; less than 0: not so. */
static hid_t open_object(hid_t file, const char *path)
{
  char part[PATH];
  for (const char *c = path + 1;; c++) {
    if (*c && *c != '/') continue;
    memcpy(part, path, (size_t)(c - path));
    part[c - path] = '\0';
    if (H5Lexists(file, part, H5P_DEFAULT) <= 0) return -1;
    if (!*c) return H5Oopen(file, path, H5P_DEFAULT);
  }
}

static int get_real(hid_t object, const char *name, double *value)
{
  hid_t attribute = H5Aexists(object, name) > 0 ? H5Aopen(object, name, H5P_DEFAULT) : -1;
  hid_t space = attribute < 0 ? -1 : H5Aget_space(attribute), type = attribute < 0 ? -1 : H5Aget_type(attribute);
  bool fits = space >= 0 && type >= 0 && H5Sget_simple_extent_npoints(space) == 1 && H5Tget_class(type) == H5T_FLOAT &&
              H5Tget_size(type) == sizeof *value;
  int failed = fits && H5Aread(attribute, H5T_NATIVE_DOUBLE, value) >= 0 ? 0 : -1;
  if (type >= 0) H5Tclose(type);
  if (space >= 0) H5Sclose(space);
  if (attribute >= 0) H5Aclose(attribute);
  return failed;
}

/* Shape of a dataset of doubles that the file holds, fastest index first; its rank, or -1. */
static int shape_of(hid_t dataset, size_t shape[GX_MAX_DIM])
{
  hid_t space = H5Dget_space(dataset), type = H5Dget_type(dataset);
  int rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
  hsize_t extent[GX_MAX_DIM];
  bool fits = rank >= 1 && rank <= GX_MAX_DIM && type >= 0 && H5Tget_class(type) == H5T_FLOAT &&
              H5Tget_size(type) == sizeof(double) && H5Sget_simple_extent_dims(space, extent, NULL) == rank;
  double numbers = 1;
  for (int d = 0; d < GX_MAX_DIM && fits; d++) {
    shape[d] = d < rank ? (size_t)extent[rank - 1 - d] : 1;
    numbers *= (double)shape[d];
  }
  if (fits &&
      (numbers < 1 || (double)H5Dget_storage_size(dataset) != numbers * sizeof(double) || !gx_handle_holds(dataset, numbers)))
    fits = false;
  if (type >= 0) H5Tclose(type);
  if (space >= 0) H5Sclose(space);
  return fits ? rank : -1;
}

/* The dataset of a component, less than 0: there is none. */
static hid_t open_component(const struct gx_series *series, size_t i, enum gx_series_set set, const char *record, int component)
{
  char path[PATH], name[3];
  if (component < 0 || component >= series->dim * series->dim || !path_of(series, i, set, record, path)) return -1;
  hid_t object = open_object(series->file->file, path), dataset = -1;
  if (object < 0) return -1;
  if (H5Iget_type(object) == H5I_DATASET) {
    if (component == 0) return object;
  } else if (H5Iget_type(object) == H5I_GROUP) {
    gx_openpmd_component(series->dim, 2, component, name);
    const bool tensor = H5Lexists(object, "xx", H5P_DEFAULT) > 0;
    if (!tensor && component < series->dim) gx_openpmd_component(series->dim, 1, component, name);
    if (H5Lexists(object, name, H5P_DEFAULT) > 0) dataset = H5Oopen(object, name, H5P_DEFAULT);
    if (dataset >= 0 && H5Iget_type(dataset) != H5I_DATASET) {
      H5Oclose(dataset);
      dataset = -1;
    }
  }
  H5Oclose(object);
  return dataset;
}

static double *get_numbers(hid_t dataset, size_t n)
{
  size_t shape[GX_MAX_DIM];
  if (shape_of(dataset, shape) < 0 || shape[0] * shape[1] * shape[2] != n) return NULL;
  double *array = malloc(n * sizeof *array);
  if (array && H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array) >= 0) return array;
  free(array);
  return NULL;
}

double *gx_series_read(const struct gx_series *series, size_t i, enum gx_series_set set, const char *record, int component,
                       FILE *errors)
{
  struct gx_handle_silence old = gx_handle_silence();
  const size_t *vertices = series->vertices;
  const size_t n = set == GX_SERIES_PARTICLES ? series->particles : vertices[0] * vertices[1] * vertices[2];
  hid_t dataset = open_component(series, i, set, record, component);
  double *array = dataset < 0 ? NULL : get_numbers(dataset, n);
  if (dataset < 0)
    fprintf(errors, "%s: its %s have no %s of component %d\n", series->file->path,
            set == GX_SERIES_PARTICLES ? "particles" : "vertices", record, component);
  else if (!array)
    fprintf(errors, "%s: %s of step %.0f is damaged, or too large for the memory there is\n", series->file->path, record,
            series->step[i]);
  if (dataset >= 0) H5Oclose(dataset);
  gx_handle_restore(old);
  return array;
}

/* Of the first snapshot, which all are like. */
static hid_t open_record(const struct gx_series *series, size_t i, enum gx_series_set set, const char *record)
{
  char path[PATH];
  return path_of(series, i, set, record, path) ? open_object(series->file->file, path) : -1;
}

bool gx_series_has(const struct gx_series *series, enum gx_series_set set, const char *record)
{
  struct gx_handle_silence old = gx_handle_silence();
  hid_t object = open_record(series, 0, set, record);
  if (object >= 0) H5Oclose(object);
  gx_handle_restore(old);
  return object >= 0;
}

double gx_series_offset(const struct gx_series *series, size_t i, enum gx_series_set set, const char *record)
{
  struct gx_handle_silence old = gx_handle_silence();
  double offset = 0;
  hid_t object = open_record(series, i, set, record);
  if (object >= 0) get_real(object, "timeOffset", &offset);
  if (object >= 0) H5Oclose(object);
  gx_handle_restore(old);
  return offset;
}

static int compare_steps(const void *a, const void *b)
{
  const double first = *(const double *)a, second = *(const double *)b;
  return (first > second) - (first < second);
}

/* Steps and times. */
static int list_snapshots(struct gx_series *series)
{
  hid_t data = gx_handle_open_group(series->file->file, "data");
  const hssize_t members = data < 0 ? -1 : gx_handle_members(data);
  int failed = members <= 0 ? -1 : 0;
  series->count = failed ? 0 : (size_t)members;
  series->step = malloc((series->count + 1) * sizeof *series->step);
  series->time = malloc((series->count + 1) * sizeof *series->time);
  if (!series->step || !series->time) failed = -1;
  for (size_t i = 0; i < series->count && !failed; i++) {
    char name[GX_HANDLE_NAME];
    ssize_t length = H5Lget_name_by_idx(data, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT);
    failed = length <= 0 || length > 15 || strspn(name, "0123456789") != (size_t)length ? -1 : 0;
    if (!failed) series->step[i] = strtod(name, NULL);
  }
  if (!failed) qsort(series->step, series->count, sizeof *series->step, compare_steps);
  for (size_t i = 0; i < series->count && !failed; i++) {
    char name[32];
    snprintf(name, sizeof name, "%.0f", series->step[i]);
    hid_t iteration = gx_handle_open_group(data, name);
    failed = iteration < 0 || get_real(iteration, "time", &series->time[i]) || get_real(iteration, "dt", &series->dt) ? -1 : 0;
    if (iteration >= 0) H5Gclose(iteration);
  }
  if (data >= 0) H5Gclose(data);
  return failed;
}

/* dim, particles, vertices, moving: from positions of particles and the density of the grid. */
static int measure_sets(struct gx_series *series)
{
  size_t shape[GX_MAX_DIM];
  char path[PATH];
  path_of(series, 0, GX_SERIES_PARTICLES, "position", path);
  hid_t position = open_object(series->file->file, path);
  for (int d = 0; d < GX_MAX_DIM && position >= 0; d++)
    if (H5Lexists(position, (const char *[]){"x", "y", "z"}[d], H5P_DEFAULT) > 0) series->dim = d + 1;
  if (position >= 0) H5Oclose(position);
  hid_t dataset = open_component(series, 0, GX_SERIES_PARTICLES, "position", 0);
  int failed = dataset < 0 || shape_of(dataset, shape) != 1 ? -1 : 0;
  series->particles = failed ? 0 : shape[0];
  if (dataset >= 0) H5Oclose(dataset);
  if (failed || !gx_series_has(series, GX_SERIES_VERTICES, "density")) return failed;
  dataset = open_component(series, 0, GX_SERIES_VERTICES, "density", 0);
  failed = dataset < 0 || shape_of(dataset, series->vertices) != series->dim ? -1 : 0;
  if (dataset >= 0) H5Oclose(dataset);
  series->moving = gx_series_has(series, GX_SERIES_VERTICES, "displacement");
  return failed;
}

/* A new series of the file at a path; NULL after a message. */
static struct gx_series *open_path(char *path, FILE *errors)
{
  struct gx_series *series = calloc(1, sizeof *series);
  struct gx_series_file *file = calloc(1, sizeof *file);
  if (!series || !file) {
    fprintf(errors, "%s: out of memory\n", path);
    free(series);
    free(file);
    free(path);
    return NULL;
  }
  const char *wrong;
  *file = (struct gx_series_file){.file = gx_seal_open(path, &wrong), .path = path};
  series->file = file;
  if (file->file >= 0 && !list_snapshots(series) && !measure_sets(series)) return series;
  fprintf(errors, "%s: %s" GX_SEAL_REMEDY "\n", path, file->file < 0 ? wrong : "is damaged, or not a file of snapshots");
  gx_series_close(series);
  return NULL;
}

struct gx_series *gx_series_open(const char *directory, const char *id, FILE *errors)
{
  size_t room = strlen(directory) + strlen(id) + 16;
  char *path = malloc(room);
  if (!path) {
    fprintf(errors, "%s: out of memory\n", directory);
    return NULL;
  }
  snprintf(path, room, "%s/case-%s.h5", directory, id);
  FILE *probe = fopen(path, "rb");
  if (!probe) {
    fprintf(errors, "%s: %s: set output.snapshots in the run file of the study, and run that again\n", path, strerror(errno));
    free(path);
    return NULL;
  }
  fclose(probe);
  struct gx_handle_silence old = gx_handle_silence();
  struct gx_series *series = open_path(path, errors);
  gx_handle_restore(old);
  return series;
}

void gx_series_close(struct gx_series *series)
{
  if (!series) return;
  struct gx_handle_silence old = gx_handle_silence();
  if (series->file->file >= 0) gx_seal_close(series->file->file);
  gx_handle_restore(old);
  free(series->file->path);
  free(series->file);
  free(series->step);
  free(series->time);
  free(series);
}
