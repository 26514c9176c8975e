/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots as openPMD. What fails once is kept in the file's struct, and found when it is closed. */
#include "openpmd.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <gridcross/build.h>

#include "disk.h"
#include "handle.h"
#include "seal.h"

enum { NAME = 64, MEMBERS = 24, ATTRIBUTES = 16 }; /* so many links and attributes of an object stay in its header */

struct gx_openpmd {
  int descriptor;
  struct gx_disk disk;
  hid_t file;
  hid_t groups, datasets; /* properties to make them by */
  bool failed;
  char first[NAME]; /* /data/<step of the first snapshot>; "": none yet */
  double *triples;  /* [triple_room][3] */
  size_t triple_room;
};

const char *gx_openpmd_component(int dim, int rank, int component, char name[3])
{
  const char *const axes = "xyz";
  snprintf(name, 3, "%.*s%.*s", rank > 1, axes + component / dim, rank > 0, axes + component % dim);
  return name;
}

static bool is_bad(struct gx_openpmd *file, hid_t handle)
{
  file->failed |= handle < 0;
  return handle < 0;
}

/* count: 0: a scalar */
static void put_attribute(struct gx_openpmd *file, hid_t object, const char *name, hid_t stored, hid_t given, hsize_t count,
                          const void *value)
{
  hid_t space = count ? H5Screate_simple(1, &count, NULL) : H5Screate(H5S_SCALAR);
  hid_t attribute = is_bad(file, space) ? -1 : H5Acreate2(object, name, stored, space, H5P_DEFAULT, H5P_DEFAULT);
  if (!is_bad(file, attribute)) {
    is_bad(file, H5Awrite(attribute, given, value));
    is_bad(file, H5Aclose(attribute));
  }
  if (space >= 0) H5Sclose(space);
}

static void put_reals(struct gx_openpmd *file, hid_t object, const char *name, hsize_t count, const double *value)
{
  put_attribute(file, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, count, value);
}

static void put_real(struct gx_openpmd *file, hid_t object, const char *name, double value)
{
  put_reals(file, object, name, 0, &value);
}

/* Of fixed length, as the standard wants them; count texts of `length` bytes each, ended by NUL. */
static void put_texts(struct gx_openpmd *file, hid_t object, const char *name, size_t length, hsize_t count, const char *text)
{
  hid_t type = H5Tcopy(H5T_C_S1);
  if (is_bad(file, type)) return;
  is_bad(file, H5Tset_size(type, length));
  put_attribute(file, object, name, type, type, count, text);
  H5Tclose(type);
}

static void put_text(struct gx_openpmd *file, hid_t object, const char *name, const char *text)
{
  put_texts(file, object, name, strlen(text) + 1, 0, text);
}

static hid_t make_group(struct gx_openpmd *file, hid_t parent, const char *name)
{
  hid_t group = parent < 0 ? -1 : H5Gcreate2(parent, name, H5P_DEFAULT, file->groups, H5P_DEFAULT);
  is_bad(file, group);
  return group;
}

static void close_group(struct gx_openpmd *file, hid_t group)
{
  if (group >= 0) is_bad(file, H5Gclose(group));
}

/* Left open; less than 0: it failed. */
static hid_t put_array(struct gx_openpmd *file, hid_t parent, const char *name, int rank, const hsize_t *shape, hid_t stored,
                       hid_t given, const void *value)
{
  hid_t space = parent < 0 ? -1 : H5Screate_simple(rank, shape, NULL);
  hid_t dataset = is_bad(file, space) ? -1 : H5Dcreate2(parent, name, stored, space, H5P_DEFAULT, file->datasets, H5P_DEFAULT);
  if (!is_bad(file, dataset)) is_bad(file, H5Dwrite(dataset, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, value));
  if (space >= 0) H5Sclose(space);
  return dataset;
}

static void put_unit(struct gx_openpmd *file, hid_t object, int length, int mass, int time, double offset)
{
  const double dimension[7] = {length, mass, time};
  put_reals(file, object, "unitDimension", 7, dimension);
  put_real(file, object, "timeOffset", offset);
}

/* What every mesh record says of its grid. Labels and spacings go from the slowest index to the fastest. */
static void put_mesh(struct gx_openpmd *file, hid_t object, const struct gx_snapshot *snapshot)
{
  const double origin[GX_MAX_DIM] = {0};
  double spacing[GX_MAX_DIM];
  char labels[GX_MAX_DIM][2] = {""};
  for (int d = 0; d < snapshot->dim; d++) {
    labels[snapshot->dim - 1 - d][0] = "xyz"[d];
    spacing[snapshot->dim - 1 - d] = snapshot->spacing[d];
  }
  put_text(file, object, "geometry", "cartesian");
  put_text(file, object, "dataOrder", "C");
  put_texts(file, object, "axisLabels", sizeof labels[0], (hsize_t)snapshot->dim, labels[0]);
  put_reals(file, object, "gridSpacing", (hsize_t)snapshot->dim, spacing);
  put_reals(file, object, "gridGlobalOffset", (hsize_t)snapshot->dim, origin);
  put_real(file, object, "gridUnitSI", 1);
}

static void put_component(struct gx_openpmd *file, hid_t object, const struct gx_snapshot *snapshot, bool mesh)
{
  const double at_vertices[GX_MAX_DIM] = {0};
  put_real(file, object, "unitSI", 1);
  if (mesh) put_reals(file, object, "position", (hsize_t)snapshot->dim, at_vertices);
}

static void put_record(struct gx_openpmd *file, hid_t parent, const struct gx_snapshot *snapshot, const struct gx_record_set *set,
                       const struct gx_record *record)
{
  const bool mesh = set == &snapshot->vertices;
  const int rank = mesh ? snapshot->dim : 1;
  hsize_t shape[GX_MAX_DIM];
  for (int d = 0; d < rank; d++) shape[rank - 1 - d] = set->shape[d];
  hid_t group = record->rank ? make_group(file, parent, record->name) : -1, object = group;
  for (int k = 0; k < gx_snapshot_components(snapshot->dim, record->rank); k++) {
    char name[3];
    gx_openpmd_component(snapshot->dim, record->rank, k, name);
    hid_t dataset = put_array(file, record->rank ? group : parent, record->rank ? name : record->name, rank, shape,
                              H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, record->value[k]);
    if (dataset < 0) break;
    put_component(file, dataset, snapshot, mesh);
    if (!record->rank) object = dataset;
    if (record->rank) is_bad(file, H5Dclose(dataset));
  }
  if (object < 0) return;
  put_unit(file, object, record->length, record->mass, record->time, record->offset);
  if (mesh) put_mesh(file, object, snapshot);
  is_bad(file, record->rank ? H5Gclose(object) : H5Dclose(object));
}

/* The same as in the first snapshot. */
static void link_record(struct gx_openpmd *file, hid_t parent, const char *name)
{
  char path[3 * NAME];
  snprintf(path, sizeof path, "%s/" GX_OPENPMD_PARTICLES "/%s", file->first, name);
  is_bad(file, H5Lcreate_hard(file->file, path, parent, name, H5P_DEFAULT, H5P_DEFAULT));
}

/* Zeros, as a constant record. */
static void put_offsets(struct gx_openpmd *file, hid_t parent, const struct gx_snapshot *snapshot)
{
  const uint64_t n = snapshot->particles.n;
  hid_t group = make_group(file, parent, "positionOffset");
  for (int d = 0; d < snapshot->dim; d++) {
    char name[3];
    hid_t component = make_group(file, group, gx_openpmd_component(snapshot->dim, 1, d, name));
    if (component < 0) break;
    put_real(file, component, "value", 0);
    put_attribute(file, component, "shape", H5T_STD_U64LE, H5T_NATIVE_UINT64, 1, &n);
    put_real(file, component, "unitSI", 1);
    close_group(file, component);
  }
  if (group >= 0) put_unit(file, group, 1, 0, 0, 0);
  close_group(file, group);
}

static void put_ids(struct gx_openpmd *file, hid_t parent, size_t n)
{
  const hsize_t shape = n;
  uint64_t *id = malloc(n * sizeof *id);
  file->failed |= !id;
  if (!id) return;
  for (size_t p = 0; p < n; p++) id[p] = p;
  hid_t dataset = put_array(file, parent, "id", 1, &shape, H5T_STD_U64LE, H5T_NATIVE_UINT64, id);
  if (dataset >= 0) {
    put_real(file, dataset, "unitSI", 1);
    put_unit(file, dataset, 0, 0, 0, 0);
    is_bad(file, H5Dclose(dataset));
  }
  free(id);
}

static void put_particles(struct gx_openpmd *file, hid_t iteration, const struct gx_snapshot *snapshot)
{
  const struct gx_record_set *set = &snapshot->particles;
  hid_t all = make_group(file, iteration, "particles"), group = make_group(file, all, "material_points");
  const bool first = !*file->first;
  for (int i = 0; i < set->count; i++) {
    if (set->record[i].constant && !first)
      link_record(file, group, set->record[i].name);
    else
      put_record(file, group, snapshot, set, &set->record[i]);
  }
  if (first) {
    put_offsets(file, group, snapshot);
    put_ids(file, group, set->n);
  } else {
    link_record(file, group, "positionOffset");
    link_record(file, group, "id");
  }
  close_group(file, group);
  close_group(file, all);
}

static void put_meshes(struct gx_openpmd *file, hid_t iteration, const struct gx_snapshot *snapshot)
{
  const struct gx_record_set *set = &snapshot->vertices;
  hid_t group = make_group(file, iteration, GX_OPENPMD_VERTICES);
  for (int i = 0; i < set->count; i++) put_record(file, group, snapshot, set, &set->record[i]);
  if (group >= 0 && snapshot->moving)
    put_text(file, group, "comment",
             "The grid moves with the material: vertices are at their places at rest, and displacement moves them.");
  close_group(file, group);
}

/* [n][3] of a vector, zeros behind its components. */
static void put_triples(struct gx_openpmd *file, hid_t parent, const char *name, int dim, size_t n, double *const *value)
{
  const hsize_t shape[] = {n, 3};
  for (size_t i = 0; i < n; i++)
    for (int d = 0; d < 3; d++) file->triples[3 * i + (size_t)d] = d < dim ? value[d][i] : 0;
  hid_t dataset = put_array(file, parent, name, 2, shape, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, file->triples);
  if (dataset >= 0) is_bad(file, H5Dclose(dataset));
}

/* Where vertices are. */
static void put_places(struct gx_openpmd *file, hid_t parent, const struct gx_snapshot *snapshot)
{
  const struct gx_record_set *set = &snapshot->vertices;
  const struct gx_record *u = gx_snapshot_record(set, "displacement");
  const hsize_t shape[] = {set->n, 3};
  size_t stride = 1;
  for (size_t d = 0; d < 3; stride *= set->shape[d++])
    for (size_t i = 0; i < set->n; i++)
      file->triples[3 * i + d] =
          (double)(i / stride % set->shape[d]) * snapshot->spacing[d] + (u && (int)d < snapshot->dim ? u->value[d][i] : 0);
  hid_t dataset = put_array(file, parent, "position", 2, shape, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, file->triples);
  if (dataset >= 0) is_bad(file, H5Dclose(dataset));
}

static int take_room(struct gx_openpmd *file, const struct gx_snapshot *snapshot)
{
  const size_t most = snapshot->particles.n > snapshot->vertices.n ? snapshot->particles.n : snapshot->vertices.n;
  if (most <= file->triple_room) return 0;
  free(file->triples);
  file->triples = malloc(most * 3 * sizeof *file->triples);
  file->triple_room = file->triples ? most : 0;
  return file->triples ? 0 : -1;
}

static void put_xdmf(struct gx_openpmd *file, const char *step, const struct gx_snapshot *snapshot)
{
  const struct gx_record_set *const sets[] = {&snapshot->particles, &snapshot->vertices};
  const char *const names[] = {"particles", "vertices"};
  hid_t all = H5Gopen2(file->file, "xdmf", H5P_DEFAULT), group = make_group(file, all, step);
  for (int i = 0; i < 2; i++) {
    if (!sets[i]->n) continue;
    hid_t member = make_group(file, group, names[i]);
    if (member < 0) break;
    if (i == 0)
      put_triples(file, member, "position", snapshot->dim, sets[i]->n, gx_snapshot_record(sets[i], "position")->value);
    else
      put_places(file, member, snapshot);
    put_triples(file, member, "velocity", snapshot->dim, sets[i]->n, gx_snapshot_record(sets[i], "velocity")->value);
    close_group(file, member);
  }
  close_group(file, group);
  close_group(file, all);
}

static void put_iteration(struct gx_openpmd *file, const char *step, const struct gx_snapshot *snapshot)
{
  hid_t data = H5Gopen2(file->file, "data", H5P_DEFAULT), iteration = make_group(file, data, step);
  if (iteration >= 0) {
    put_real(file, iteration, "time", snapshot->time);
    put_real(file, iteration, "dt", snapshot->dt);
    put_real(file, iteration, "timeUnitSI", 1);
    put_particles(file, iteration, snapshot);
    if (snapshot->vertices.n) put_meshes(file, iteration, snapshot);
  }
  close_group(file, iteration);
  close_group(file, data);
}

/* 0, or -1 with errno as the disk said. */
static int check(struct gx_openpmd *file)
{
  errno = file->disk.failed;
  return file->failed || file->disk.failed ? -1 : 0;
}

int gx_openpmd_put(struct gx_openpmd *file, const struct gx_snapshot *snapshot)
{
  char step[NAME / 2];
  struct gx_handle_silence old = gx_handle_silence();
  snprintf(step, sizeof step, "%.0f", snapshot->step);
  file->failed |= take_room(file, snapshot) != 0;
  if (!file->failed && !*file->first && snapshot->vertices.n) put_text(file, file->file, "meshesPath", GX_OPENPMD_VERTICES "/");
  if (!file->failed) put_iteration(file, step, snapshot);
  if (!file->failed) put_xdmf(file, step, snapshot);
  if (!*file->first) snprintf(file->first, sizeof file->first, "/data/%s", step);
  gx_handle_restore(old);
  return check(file);
}

static void put_root(struct gx_openpmd *file, const char *id)
{
  const uint32_t no_extension = 0;
  char comment[NAME];
  snprintf(comment, sizeof comment, "case %.40s", id);
  put_text(file, file->file, "openPMD", "1.1.0");
  put_attribute(file, file->file, "openPMDextension", H5T_STD_U32LE, H5T_NATIVE_UINT32, 0, &no_extension);
  put_text(file, file->file, "basePath", "/data/%T/");
  put_text(file, file->file, "particlesPath", "particles/");
  put_text(file, file->file, "iterationEncoding", "groupBased");
  put_text(file, file->file, "iterationFormat", "/data/%T/");
  put_text(file, file->file, "software", "gridcross");
  put_text(file, file->file, "softwareVersion", gx_build.version);
  put_text(file, file->file, "comment", comment);
  close_group(file, make_group(file, file->file, "data"));
  close_group(file, make_group(file, file->file, "xdmf"));
}

/* Object headers of the format that HDF5 1.8 brought: a third of the bytes of the first one for objects as small as these. */
static void open_file(struct gx_openpmd *file)
{
  hid_t access = gx_disk_access(&file->disk, file->descriptor), creation = H5Pcreate(H5P_FILE_CREATE);
  file->groups = H5Pcreate(H5P_GROUP_CREATE);
  file->datasets = H5Pcreate(H5P_DATASET_CREATE);
  if (is_bad(file, access) || is_bad(file, creation) || is_bad(file, file->groups) || is_bad(file, file->datasets) ||
      is_bad(file, H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18)) ||
      is_bad(file, H5Pset_obj_track_times(creation, false)) || is_bad(file, H5Pset_obj_track_times(file->groups, false)) ||
      is_bad(file, H5Pset_obj_track_times(file->datasets, false)) ||
      is_bad(file, H5Pset_link_phase_change(file->groups, MEMBERS, MEMBERS)) ||
      is_bad(file, H5Pset_attr_phase_change(file->groups, ATTRIBUTES, ATTRIBUTES)) ||
      is_bad(file, H5Pset_attr_phase_change(file->datasets, ATTRIBUTES, ATTRIBUTES)))
    file->file = -1;
  else
    is_bad(file, file->file = H5Fcreate("snapshots", H5F_ACC_TRUNC, creation, access));
  if (access >= 0) H5Pclose(access);
  if (creation >= 0) H5Pclose(creation);
}

struct gx_openpmd *gx_openpmd_create(const char *path, const char *id)
{
  struct gx_openpmd *file = calloc(1, sizeof *file);
  const int descriptor = file ? open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
  if (descriptor < 0) {
    free(file);
    return NULL;
  }
  *file = (struct gx_openpmd){.descriptor = descriptor, .file = -1, .groups = -1, .datasets = -1};
  struct gx_handle_silence old = gx_handle_silence();
  open_file(file);
  if (!file->failed) put_root(file, id);
  gx_handle_restore(old);
  if (!check(file)) return file;
  gx_openpmd_close(file);
  return NULL;
}

int gx_openpmd_close(struct gx_openpmd *file)
{
  struct gx_handle_silence old = gx_handle_silence();
  if (file->file >= 0 && H5Fclose(file->file) < 0) file->failed = true;
  if (file->groups >= 0) H5Pclose(file->groups);
  if (file->datasets >= 0) H5Pclose(file->datasets);
  gx_disk_end(&file->disk);
  gx_handle_restore(old);
  if (!file->failed && !file->disk.failed) file->disk.failed = gx_seal_put(file->descriptor);
  if (close(file->descriptor) && !file->disk.failed) file->disk.failed = errno;
  int failed = check(file);
  free(file->triples);
  free(file);
  return failed;
}
