/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writing study.h5. Object times are off, so that equal studies give equal bytes. */
#include <gridcross/store.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/build.h>

#include "entry.h"
#include "handle.h"

static int put_column(hid_t group, const struct gx_table *table, size_t c, hid_t text, union gx_entry *entry)
{
  const struct gx_column *column = &table->column[c];
  bool real = column->type == GX_REAL, integer = column->type == GX_INTEGER;
  hid_t file_type = real ? H5T_IEEE_F64LE : integer ? H5T_STD_I64LE : text;
  hid_t memory_type = real ? H5T_NATIVE_DOUBLE : integer ? H5T_NATIVE_INT64 : text;
  for (size_t r = 0; r < table->rows; r++) entry[r] = gx_entry_from(column->type, gx_table_get(table, r, c));
  hid_t dataset = gx_handle_make_dataset(group, column->name, file_type, table->rows);
  if (dataset < 0) return -1;
  int failed = gx_handle_put_text(dataset, "unit", column->unit);
  if (!failed && integer) failed = gx_handle_put_integer(dataset, "null", gx_entry_null);
  if (!failed && H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, entry) < 0) failed = -1;
  return H5Dclose(dataset) < 0 ? -1 : failed;
}

static int put_table(hid_t parent, const char *name, const struct gx_table *table)
{
  int failed = -1;
  union gx_entry *entry = calloc(table->rows + 1, sizeof *entry);
  hid_t text = gx_handle_text_type(), group = gx_handle_make_group(parent, name);
  if (entry && text >= 0 && group >= 0) failed = 0;
  for (size_t c = 0; c < table->columns && !failed; c++) failed = put_column(group, table, c, text, entry);
  if (group >= 0 && H5Gclose(group) < 0) failed = -1;
  if (text >= 0) H5Tclose(text);
  free(entry);
  return failed;
}

/* What cases keep beside the study's table, one table each. */
static int put_kept(hid_t file, const char *name, const struct gx_study *study, const struct gx_result *results,
                    struct gx_table *(*table_of)(const struct gx_result *result))
{
  hid_t group = gx_handle_make_group(file, name);
  int failed = group < 0 ? -1 : 0;
  for (size_t i = 0; i < study->count && !failed; i++) {
    struct gx_table *table = table_of(&results[i]);
    failed = !table ? -1 : table->rows ? put_table(group, study->cases[i].id, table) : 0;
    gx_table_free(table);
  }
  if (group >= 0 && H5Gclose(group) < 0) failed = -1;
  return failed;
}

static int put_provenance(hid_t file, const struct gx_study *study)
{
  const struct {
    const char *name, *text;
  } rows[] = {{"title", study->title},         {"run_file", study->source},
              {"version", gx_build.version},   {"git_revision", gx_build.git_revision},
              {"compiler", gx_build.compiler}, {"flags", gx_build.flags},
              {"gsl", gx_build.gsl},           {"fftw", gx_build.fftw},
              {"hdf5", gx_build.hdf5},         {"yaml", gx_build.yaml}};
  hid_t group = gx_handle_make_group(file, "provenance");
  if (group < 0) return -1;
  int failed = gx_handle_put_integer(group, "format", GX_HDF5_FORMAT);
  for (size_t i = 0; i < sizeof rows / sizeof *rows && !failed; i++)
    failed = gx_handle_put_text(group, rows[i].name, rows[i].text);
  return H5Gclose(group) < 0 ? -1 : failed;
}

static int put_study(hid_t file, const struct gx_study *study, const struct gx_result *results, const struct gx_table *table)
{
  if (put_table(file, "table", table)) return -1;
  if (put_kept(file, "histories", study, results, gx_study_table_history)) return -1;
  if (put_kept(file, "spectra", study, results, gx_study_table_spectra)) return -1;
  return put_provenance(file, study);
}

/* The whole file as bytes, owned by the caller: HDF5 that cannot write to a full disk leaves a file open which crashes at exit,
 * so that it never touches the disk here. */
static void *make_image(const struct gx_study *study, const struct gx_result *results, const struct gx_table *table, size_t *size)
{
  enum { GROWTH = 1 << 20 };
  void *image = NULL;
  hid_t file = -1, property = H5Pcreate(H5P_FILE_CREATE), access = H5Pcreate(H5P_FILE_ACCESS);
  if (property >= 0 && access >= 0 && H5Pset_obj_track_times(property, false) >= 0 &&
      H5Pset_fapl_core(access, GROWTH, false) >= 0)
    file = H5Fcreate("study.h5", H5F_ACC_TRUNC, property, access);
  if (file >= 0 && !put_study(file, study, results, table) && H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0) {
    ssize_t length = H5Fget_file_image(file, NULL, 0);
    image = length > 0 ? malloc((size_t)length) : NULL;
    *size = image ? (size_t)length : 0;
    if (image && H5Fget_file_image(file, image, *size) != length) {
      free(image);
      image = NULL;
    }
  }
  if (file >= 0) H5Fclose(file);
  if (access >= 0) H5Pclose(access);
  if (property >= 0) H5Pclose(property);
  return image;
}

static int write_image(const char *path, const void *image, size_t size)
{
  FILE *out = fopen(path, "wb");
  if (!out) return -1;
  int failed = fwrite(image, 1, size, out) == size ? 0 : -1;
  return fclose(out) ? -1 : failed;
}

int gx_hdf5_write(const char *path, const struct gx_study *study, const struct gx_result *results, const struct gx_table *table,
                  FILE *errors)
{
  struct gx_handle_silence old = gx_handle_silence();
  size_t size = 0;
  void *image = make_image(study, results, table, &size);
  gx_handle_restore(old);
  errno = 0;
  int failed = image ? write_image(path, image, size) : -1;
  if (failed) fprintf(errors, "%s: cannot write: %s\n", path, errno ? strerror(errno) : "HDF5 failed");
  free(image);
  return failed;
}
