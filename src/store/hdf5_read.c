/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading study.h5. */
#include <gridcross/store.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "../core/nearest.h"
#include "hdf5_column.h"
#include "hdf5_read.h"
#include "hdf5_rows.h"
#include "seal.h"

static int get_column(hid_t dataset, const char *name, struct gx_table *table, size_t c)
{
  enum gx_type type;
  if (gx_handle_shape(dataset, &type) != (hssize_t)table->rows) return -1;
  return gx_hdf5_column_name(dataset, name, table, c) || gx_hdf5_column_read(dataset, 0, table, c) ? -1 : 0;
}

struct gx_table *gx_hdf5_read_group(hid_t group)
{
  struct gx_table *table = NULL;
  const hssize_t columns = gx_handle_members(group);
  if (columns <= 0) return NULL;
  for (size_t c = 0; c < (size_t)columns; c++) {
    char name[GX_HANDLE_NAME];
    enum gx_type type;
    int failed = -1;
    if (gx_handle_member(group, c, name)) {
      hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT);
      hssize_t rows = dataset < 0 ? -1 : gx_handle_shape(dataset, &type);
      if (!table && rows >= 0 && gx_handle_fits(dataset, (double)rows, (size_t)columns, 1))
        table = gx_table_create((size_t)columns, (size_t)rows);
      if (table && dataset >= 0) failed = get_column(dataset, name, table, c);
      if (dataset >= 0) H5Dclose(dataset);
    }
    if (!failed) continue;
    gx_table_free(table);
    return NULL;
  }
  return table;
}

hid_t gx_hdf5_read_open(const char *path, FILE *errors)
{
  int64_t format = 0;
  FILE *probe = fopen(path, "rb");
  if (!probe) {
    const bool none = errno == ENOENT || errno == ENOTDIR;
    fprintf(errors, "%s: %s%s\n", path, strerror(errno),
            none ? ": give the directory of a finished study, which gridcross run writes" : "");
    return -1;
  }
  fclose(probe);
  const char *wrong;
  hid_t file = gx_seal_open(path, &wrong);
  if (file < 0) {
    fprintf(errors, "%s: is not a study, or %s" GX_SEAL_REMEDY "\n", path, wrong);
    return -1;
  }
  hid_t provenance = gx_handle_open_group(file, "provenance"), table = gx_handle_open_group(file, "table");
  bool known = false, ours = provenance >= 0 && table >= 0 && !gx_handle_get_integer(provenance, "format", &format);
  if (!ours)
    fprintf(errors, "%s: is not a study, or is damaged" GX_SEAL_REMEDY "\n", path);
  else if (!(known = format >= GX_HDF5_OLDEST && format <= GX_HDF5_FORMAT))
    fprintf(errors, "%s: has format %lld; this gridcross reads formats %d to %d\n", path, (long long)format, GX_HDF5_OLDEST,
            GX_HDF5_FORMAT);
  if (table >= 0) H5Gclose(table);
  if (provenance >= 0) H5Gclose(provenance);
  if (known) return file;
  gx_seal_close(file);
  return -1;
}

struct gx_table *gx_hdf5_read(const char *path, FILE *errors)
{
  struct gx_hdf5_rows *rows = gx_hdf5_rows_begin(path, 0, NULL, errors);
  struct gx_table *table = rows ? gx_hdf5_rows_next(rows, gx_hdf5_rows_total(rows), 0) : NULL;
  gx_hdf5_rows_end(rows);
  return table;
}

char *gx_hdf5_read_provenance(const char *path, const char *name, FILE *errors)
{
  struct gx_handle_silence old = gx_handle_silence();
  char *text = NULL;
  hid_t file = gx_hdf5_read_open(path, errors), provenance = file < 0 ? -1 : gx_handle_open_group(file, "provenance");
  if (provenance >= 0 && !(text = gx_handle_get_text(provenance, name)))
    fprintf(errors, "%s: its %s is damaged" GX_SEAL_REMEDY "\n", path, name);
  if (provenance >= 0) H5Gclose(provenance);
  if (file >= 0) gx_seal_close(file);
  gx_handle_restore(old);
  return text;
}

static void name_histories(hid_t group, const char *wanted, FILE *errors)
{
  struct gx_nearest near = {.word = wanted};
  const char *gap = "; there are: ";
  char name[GX_HANDLE_NAME];
  for (hsize_t i = 0; gx_handle_member(group, i, name); i++) gx_nearest_try(&near, name);
  fprintf(errors, "gridcross: no history '%s'", wanted);
  if (*near.best) fprintf(errors, ": did you mean %s?", near.best);
  for (hsize_t i = 0; gx_handle_member(group, i, name); i++, gap = ", ") fprintf(errors, "%s%s", gap, name);
  putc('\n', errors);
}

static struct gx_table *get_history(hid_t group, const char *name)
{
  const char *const column[] = {"time", name};
  struct gx_table *table = NULL;
  int failed = 0;
  for (size_t c = 0; c < 2 && !failed; c++) {
    enum gx_type type;
    hid_t dataset = H5Dopen2(group, column[c], H5P_DEFAULT);
    hssize_t rows = dataset < 0 ? -1 : gx_handle_shape(dataset, &type);
    if (!table && rows >= 0 && gx_handle_fits(dataset, (double)rows, 2, 1)) table = gx_table_create(2, (size_t)rows);
    failed = !table || rows < 0 || get_column(dataset, column[c], table, c);
    if (dataset >= 0) H5Dclose(dataset);
  }
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

/* A group that put_kept wrote, or -1 after a message. */
static hid_t open_kept(hid_t file, const char *path, const char *name, const char *id, FILE *errors)
{
  hid_t all = gx_handle_open_group(file, name), group = all < 0 ? -1 : gx_handle_open_group(all, id);
  if (group < 0)
    fprintf(errors, "%s: has no %s of case %s: set output.%s in its run file, and run that again\n", path, name, id, name);
  if (all >= 0) H5Gclose(all);
  return group;
}

struct gx_table *gx_hdf5_read_history(const char *path, const char *id, const char *name, FILE *errors)
{
  struct gx_handle_silence old = gx_handle_silence();
  struct gx_table *table = NULL;
  hid_t file = gx_hdf5_read_open(path, errors), group = file < 0 ? -1 : open_kept(file, path, "histories", id, errors);
  if (group >= 0 && (!*name || strchr(name, '/') || H5Lexists(group, name, H5P_DEFAULT) <= 0))
    name_histories(group, name, errors);
  else if (group >= 0 && !(table = get_history(group, name)))
    fprintf(errors, "%s: the history of case %s is damaged" GX_SEAL_REMEDY "\n", path, id);
  if (group >= 0) H5Gclose(group);
  if (file >= 0) gx_seal_close(file);
  gx_handle_restore(old);
  return table;
}

struct gx_table *gx_hdf5_read_spectra(const char *path, const char *id, FILE *errors)
{
  struct gx_handle_silence old = gx_handle_silence();
  struct gx_table *table = NULL;
  hid_t file = gx_hdf5_read_open(path, errors), group = file < 0 ? -1 : open_kept(file, path, "spectra", id, errors);
  if (group >= 0 && !(table = gx_hdf5_read_group(group)))
    fprintf(errors, "%s: the spectra of case %s are damaged" GX_SEAL_REMEDY "\n", path, id);
  if (group >= 0) H5Gclose(group);
  if (file >= 0) gx_seal_close(file);
  gx_handle_restore(old);
  return table;
}
