/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading study.h5 piece by piece. */
#include "hdf5_rows.h"

#include <stdlib.h>
#include <string.h>

#include "hdf5_column.h"
#include "hdf5_read.h"
#include "seal.h"

struct gx_hdf5_rows {
  const char *path;
  FILE *errors;
  struct gx_handle_silence silence;
  hid_t file, group;
  hid_t *dataset;        /* [like->columns], owned */
  size_t stored;         /* of them; the others are null */
  struct gx_table *like; /* owned: names, units and types of the columns */
  size_t total, next;    /* rows */
  struct gx_provenance provenance;
  char *owned[GX_PROVENANCE_TEXTS + 1]; /* of the provenance */
};

static bool is_wanted(const char *member, size_t columns, const char *const *name)
{
  for (size_t i = 0; name && i < columns; i++)
    if (!strcmp(name[i], member)) return true;
  return !name;
}

static int open_column(struct gx_hdf5_rows *rows, const char *name)
{
  size_t c = rows->like->columns;
  enum gx_type type;
  hid_t dataset = H5Dopen2(rows->group, name, H5P_DEFAULT);
  rows->dataset[c] = dataset;
  hssize_t total = dataset < 0 ? -1 : gx_handle_shape(dataset, &type);
  if (total < 0 || (c && (size_t)total != rows->total)) {
    if (dataset >= 0) H5Dclose(dataset);
    return -1;
  }
  rows->total = (size_t)total;
  rows->stored += gx_handle_is_stored(dataset);
  rows->like->columns++;
  return gx_hdf5_column_name(dataset, name, rows->like, c);
}

static int open_columns(struct gx_hdf5_rows *rows, size_t columns, const char *const *name)
{
  const hssize_t members = rows->group < 0 ? -1 : gx_handle_members(rows->group);
  if (members <= 0) return -1;
  rows->dataset = calloc((size_t)members, sizeof *rows->dataset);
  rows->like = gx_table_create((size_t)members, 0);
  if (!rows->dataset || !rows->like) return -1;
  rows->like->columns = 0;
  for (hsize_t i = 0; i < (hsize_t)members; i++) {
    char member[GX_HANDLE_NAME];
    if (!gx_handle_member(rows->group, i, member)) return -1;
    if (is_wanted(member, columns, name) && open_column(rows, member)) return -1;
  }
  return gx_handle_fits(rows->group, (double)rows->total, rows->like->columns, rows->stored) ? 0 : -1;
}

struct gx_hdf5_rows *gx_hdf5_rows_begin(const char *path, size_t columns, const char *const *name, FILE *errors)
{
  struct gx_hdf5_rows *rows = calloc(1, sizeof *rows);
  if (!rows) {
    fprintf(errors, "%s: out of memory\n", path);
    return NULL;
  }
  *rows = (struct gx_hdf5_rows){.path = path, .errors = errors, .silence = gx_handle_silence()};
  rows->file = gx_hdf5_read_open(path, errors);
  rows->group = rows->file < 0 ? -1 : gx_handle_open_group(rows->file, "table");
  if (rows->file >= 0 && !open_columns(rows, columns, name)) return rows;
  if (rows->file >= 0) fprintf(errors, "%s: its table is damaged" GX_SEAL_REMEDY "\n", path);
  gx_hdf5_rows_end(rows);
  return NULL;
}

size_t gx_hdf5_rows_total(const struct gx_hdf5_rows *rows)
{
  return rows->total;
}

void gx_hdf5_rows_seek(struct gx_hdf5_rows *rows, size_t row)
{
  rows->next = row < rows->total ? row : rows->total;
}

struct gx_table *gx_hdf5_rows_next(struct gx_hdf5_rows *rows, size_t most, size_t more)
{
  size_t left = rows->total - rows->next, count = left < most ? left : most;
  struct gx_table *table = gx_table_create(rows->like->columns + more, count);
  int failed = !table;
  for (size_t c = 0; c < rows->like->columns && !failed; c++)
    failed =
        gx_table_column_like(table, c, &rows->like->column[c]) || gx_hdf5_column_read(rows->dataset[c], rows->next, table, c);
  if (failed) fprintf(rows->errors, "%s: its table is damaged" GX_SEAL_REMEDY "\n", rows->path);
  rows->next += count;
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

bool gx_hdf5_rows_keeps(struct gx_hdf5_rows *rows, enum gx_hdf5_kept what)
{
  hid_t group = gx_handle_open_group(rows->file, gx_hdf5_write_kept_name[what]);
  const bool any = group >= 0 && gx_handle_members(group) > 0;
  if (group >= 0) H5Gclose(group);
  return any;
}

struct gx_table *gx_hdf5_rows_kept(struct gx_hdf5_rows *rows, enum gx_hdf5_kept what, const char *id, int *failed)
{
  const char *name = gx_hdf5_write_kept_name[what];
  hid_t all = gx_handle_open_group(rows->file, name), group = all < 0 ? -1 : gx_handle_open_group(all, id);
  struct gx_table *table = group < 0 ? NULL : gx_hdf5_read_group(group);
  *failed = group >= 0 && !table ? -1 : 0;
  if (*failed) fprintf(rows->errors, "%s: the %s of case %s are damaged" GX_SEAL_REMEDY "\n", rows->path, name, id);
  if (group >= 0) H5Gclose(group);
  if (all >= 0) H5Gclose(all);
  return table;
}

const struct gx_provenance *gx_hdf5_rows_provenance(struct gx_hdf5_rows *rows)
{
  struct gx_provenance *provenance = &rows->provenance;
  hid_t group = gx_handle_open_group(rows->file, "provenance");
  int failed = group < 0;
  for (int i = 0; i < GX_PROVENANCE_TEXTS && !failed; i++) {
    free(rows->owned[i]);
    provenance->text[i] = rows->owned[i] = gx_handle_get_text(group, gx_provenance_name[i]);
    failed = !rows->owned[i];
  }
  char **identity = &rows->owned[GX_PROVENANCE_TEXTS];
  free(*identity);
  *identity = !failed && H5Aexists(group, "identity") > 0 ? gx_handle_get_text(group, "identity") : NULL;
  provenance->identity = *identity;
  int64_t shard, shards, cases;
  if (*identity && (gx_handle_get_integer(group, "shard", &shard) || gx_handle_get_integer(group, "shards", &shards) ||
                    gx_handle_get_integer(group, "cases", &cases) || shard < 1 || shards < shard || cases < 0))
    failed = -1;
  if (*identity && !failed) {
    provenance->shard = (size_t)shard;
    provenance->shards = (size_t)shards;
    provenance->cases = (size_t)cases;
  }
  if (group >= 0) H5Gclose(group);
  if (!failed) return provenance;
  fprintf(rows->errors, "%s: its provenance is damaged" GX_SEAL_REMEDY "\n", rows->path);
  return NULL;
}

void gx_hdf5_rows_end(struct gx_hdf5_rows *rows)
{
  if (!rows) return;
  for (size_t c = 0; rows->like && c < rows->like->columns; c++) H5Dclose(rows->dataset[c]);
  if (rows->group >= 0) H5Gclose(rows->group);
  if (rows->file >= 0) gx_seal_close(rows->file);
  gx_handle_restore(rows->silence);
  gx_table_free(rows->like);
  for (int i = 0; i <= GX_PROVENANCE_TEXTS; i++) free(rows->owned[i]);
  free(rows->dataset);
  free(rows);
}
