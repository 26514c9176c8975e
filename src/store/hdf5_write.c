/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writing study.h5. Object times are off, so that equal studies give equal bytes. */
#include "hdf5_write.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "disk.h"
#include "hdf5_column.h"
#include "seal.h"

const char *const gx_hdf5_write_kept_name[GX_HDF5_KEPT] = {"histories", "spectra"};

/* A table in a group, its datasets open for rows to come. */
struct sheet {
  size_t columns, rows, written;
  hid_t *dataset; /* [columns], owned */
  hid_t group, space, transfer;
};

struct gx_hdf5_writer {
  const char *path;
  FILE *errors;
  struct gx_handle_silence silence;
  struct gx_disk disk;
  int descriptor;
  hid_t file, kept[GX_HDF5_KEPT];
  struct sheet table;
};

static int close_sheet(struct sheet *sheet)
{
  int failed = 0;
  for (size_t c = 0; sheet->dataset && c < sheet->columns; c++)
    if (sheet->dataset[c] > 0 && H5Dclose(sheet->dataset[c]) < 0) failed = -1;
  if (sheet->space > 0) H5Sclose(sheet->space);
  if (sheet->transfer > 0) H5Pclose(sheet->transfer);
  if (sheet->group > 0 && H5Gclose(sheet->group) < 0) failed = -1;
  free(sheet->dataset);
  *sheet = (struct sheet){0};
  return failed;
}

/* HDF5 clears a buffer of 1 MiB by default for each piece of a column of texts, which takes longer than writing it. */
static hid_t small_transfers(void)
{
  const size_t bytes = 1 << 14;
  hid_t property = H5Pcreate(H5P_DATASET_XFER);
  if (property < 0 || H5Pset_buffer(property, bytes, NULL, NULL) >= 0) return property;
  H5Pclose(property);
  return -1;
}

static int make_sheet(struct sheet *sheet, hid_t parent, const char *name, const struct gx_table *table, size_t columns,
                      size_t rows)
{
  hsize_t shape[1] = {rows};
  *sheet = (struct sheet){.columns = columns, .rows = rows};
  sheet->dataset = calloc(columns + 1, sizeof *sheet->dataset);
  sheet->transfer = small_transfers();
  sheet->space = H5Screate_simple(1, shape, NULL);
  sheet->group = gx_handle_make_group(parent, name);
  if (!sheet->dataset || sheet->transfer < 0 || sheet->space < 0 || sheet->group < 0) return -1;
  for (size_t c = 0; c < columns; c++)
    if ((sheet->dataset[c] = gx_hdf5_column_create(sheet->group, &table->column[c], rows)) < 0) return -1;
  return 0;
}

static int write_rows(struct sheet *sheet, const struct gx_table *part, size_t rows)
{
  hsize_t first[1] = {sheet->written}, count[1] = {rows};
  if (!rows) return 0;
  if (part->columns < sheet->columns || rows > sheet->rows - sheet->written) return -1;
  hid_t memory = H5Screate_simple(1, count, NULL);
  int failed = memory < 0 || H5Sselect_hyperslab(sheet->space, H5S_SELECT_SET, first, NULL, count, NULL) < 0 ? -1 : 0;
  for (size_t c = 0; c < sheet->columns && !failed; c++)
    failed = gx_hdf5_column_write(sheet->dataset[c], part, c, rows, memory, sheet->space, sheet->transfer);
  if (memory >= 0) H5Sclose(memory);
  sheet->written += rows;
  return failed;
}

/* 0 unless something has gone wrong, on disk or in HDF5. */
static int check(struct gx_hdf5_writer *writer, int failed)
{
  const int disk = writer->disk.failed;
  if (!failed && !disk) return 0;
  if (writer->errors) fprintf(writer->errors, "%s: cannot write: %s\n", writer->path, disk ? strerror(disk) : "HDF5 failed");
  writer->errors = NULL; /* once is enough */
  return -1;
}

static hid_t create_file(struct gx_hdf5_writer *writer)
{
  hid_t access = gx_disk_access(&writer->disk, writer->descriptor), property = H5Pcreate(H5P_FILE_CREATE), file = -1;
  if (access >= 0 && property >= 0 && H5Pset_obj_track_times(property, false) >= 0)
    file = H5Fcreate(writer->path, H5F_ACC_TRUNC, property, access);
  if (access >= 0) H5Pclose(access);
  if (property >= 0) H5Pclose(property);
  return file;
}

struct gx_hdf5_writer *gx_hdf5_write_begin(const char *path, const struct gx_table *table, size_t columns, size_t rows,
                                           FILE *errors)
{
  struct gx_hdf5_writer *writer = calloc(1, sizeof *writer);
  int descriptor = writer ? open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
  if (descriptor < 0) {
    fprintf(errors, "%s: cannot write: %s\n", path, strerror(writer ? errno : ENOMEM));
    free(writer);
    return NULL;
  }
  *writer = (struct gx_hdf5_writer){
      .path = path, .errors = errors, .silence = gx_handle_silence(), .descriptor = descriptor, .file = -1};
  writer->file = create_file(writer);
  int failed = writer->file < 0 || make_sheet(&writer->table, writer->file, "table", table, columns, rows) ? -1 : 0;
  for (int k = 0; k < GX_HDF5_KEPT && !failed; k++)
    if ((writer->kept[k] = gx_handle_make_group(writer->file, gx_hdf5_write_kept_name[k])) < 0) failed = -1;
  if (!check(writer, failed)) return writer;
  gx_hdf5_write_end(writer, NULL);
  return NULL;
}

int gx_hdf5_write_rows(struct gx_hdf5_writer *writer, const struct gx_table *part, size_t rows)
{
  return check(writer, write_rows(&writer->table, part, rows));
}

int gx_hdf5_write_kept(struct gx_hdf5_writer *writer, enum gx_hdf5_kept what, const char *id, const struct gx_table *table)
{
  struct sheet sheet;
  int failed = make_sheet(&sheet, writer->kept[what], id, table, table->columns, table->rows);
  if (!failed) failed = write_rows(&sheet, table, table->rows);
  if (close_sheet(&sheet)) failed = -1;
  return check(writer, failed);
}

static int put_provenance(hid_t file, const struct gx_provenance *provenance)
{
  hid_t group = gx_handle_make_group(file, "provenance");
  if (group < 0) return -1;
  int failed = gx_handle_put_integer(group, "format", GX_HDF5_FORMAT);
  for (int i = 0; i < GX_PROVENANCE_TEXTS && !failed; i++)
    failed = gx_handle_put_text(group, gx_provenance_name[i], provenance->text[i]);
  if (provenance->identity && !failed)
    failed = gx_handle_put_integer(group, "shard", (int64_t)provenance->shard) ||
             gx_handle_put_integer(group, "shards", (int64_t)provenance->shards) ||
             gx_handle_put_integer(group, "cases", (int64_t)provenance->cases) ||
             gx_handle_put_text(group, "identity", provenance->identity);
  return H5Gclose(group) < 0 || failed ? -1 : 0;
}

int gx_hdf5_write_end(struct gx_hdf5_writer *writer, const struct gx_provenance *provenance)
{
  int failed = !provenance || writer->table.written != writer->table.rows ? -1 : 0;
  if (!provenance) writer->errors = NULL;
  if (close_sheet(&writer->table)) failed = -1;
  for (int k = 0; k < GX_HDF5_KEPT; k++)
    if (writer->kept[k] > 0 && H5Gclose(writer->kept[k]) < 0) failed = -1;
  if (!failed) failed = put_provenance(writer->file, provenance);
  if (writer->file >= 0 && H5Fclose(writer->file) < 0) failed = -1;
  gx_disk_end(&writer->disk);
  gx_handle_restore(writer->silence);
  if (!failed && !writer->disk.failed) writer->disk.failed = gx_seal_put(writer->descriptor);
  /* EINVAL: a file system that cannot; nothing more to be done there. */
  if (!failed && !writer->disk.failed && fsync(writer->descriptor) && errno != EINVAL) writer->disk.failed = errno;
  if (close(writer->descriptor) && !writer->disk.failed) writer->disk.failed = errno;
  failed = check(writer, failed);
  free(writer);
  return failed;
}
