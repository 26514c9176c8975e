/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns as datasets. */
#include "hdf5_column.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As HDF5 takes them in memory; texts that have a width are that many bytes, padded with zeros. */
union entry {
  double real;
  int64_t integer;
  const char *text;
};

static const int64_t null_integer = INT64_MIN;

static size_t size_of(const struct gx_column *column)
{
  return column->width ? column->width : sizeof(union entry);
}

static hid_t file_type(const struct gx_column *column)
{
  if (column->type == GX_TEXT) return gx_handle_text_type(column->width);
  return H5Tcopy(column->type == GX_REAL ? H5T_IEEE_F64LE : H5T_STD_I64LE);
}

static hid_t memory_type(const struct gx_column *column)
{
  if (column->type == GX_TEXT) return gx_handle_text_type(column->width);
  return H5Tcopy(column->type == GX_REAL ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64);
}

/* at: size_of the column, zeros. Returns 0, or -1 for a text that is too long. */
static int put(const struct gx_column *column, const struct gx_value *value, char *at)
{
  union entry entry = {.integer = null_integer};
  const bool null = value->type == GX_NULL;
  if (column->width) {
    const size_t length = null ? 0 : strlen(value->text);
    if (length > column->width) return -1;
    if (length) memcpy(at, value->text, length);
    return 0;
  }
  if (column->type == GX_TEXT)
    entry.text = null ? NULL : value->text;
  else if (column->type == GX_REAL)
    entry.real = null ? NAN : value->type == GX_INTEGER ? (double)value->integer : value->real;
  else if (!null)
    entry.integer = value->integer;
  memcpy(at, &entry, sizeof entry);
  return 0;
}

/* text: room for a text of the column's width and its end. */
static struct gx_value get(const struct gx_column *column, const char *at, char *text)
{
  union entry entry;
  if (column->width) {
    memcpy(text, at, column->width);
    return *text ? (struct gx_value){.type = GX_TEXT, .text = text} : (struct gx_value){.type = GX_NULL};
  }
  memcpy(&entry, at, sizeof entry);
  if (column->type == GX_REAL && !isnan(entry.real)) return (struct gx_value){.type = GX_REAL, .real = entry.real};
  if (column->type == GX_INTEGER && entry.integer != null_integer)
    return (struct gx_value){.type = GX_INTEGER, .integer = (long)entry.integer};
  if (column->type == GX_TEXT && entry.text) return (struct gx_value){.type = GX_TEXT, .text = entry.text};
  return (struct gx_value){.type = GX_NULL};
}

hid_t gx_hdf5_column_create(hid_t group, const struct gx_column *column, size_t rows)
{
  const union entry real = {.real = NAN}, integer = {.integer = null_integer};
  const void *null = column->type == GX_REAL ? &real : column->type == GX_INTEGER ? &integer : NULL;
  const hid_t file = file_type(column), memory = memory_type(column);
  hid_t dataset = file < 0 || memory < 0 ? -1 : gx_handle_make_dataset(group, column->name, file, rows, memory, null);
  if (memory >= 0) H5Tclose(memory);
  if (file >= 0) H5Tclose(file);
  if (dataset < 0 || (!gx_handle_put_text(dataset, "unit", column->unit) &&
                      (column->type != GX_INTEGER || !gx_handle_put_integer(dataset, "null", null_integer))))
    return dataset;
  H5Dclose(dataset);
  return -1;
}

int gx_hdf5_column_write(hid_t dataset, const struct gx_table *part, size_t c, size_t rows, hid_t memory, hid_t space,
                         hid_t transfer)
{
  const struct gx_column *column = &part->column[c];
  const struct gx_value *value = part->value + c;
  size_t nulls = 0;
  while (nulls < rows && value[nulls * part->columns].type == GX_NULL) nulls++;
  if (nulls == rows) return 0;
  char *buffer = calloc(rows, size_of(column));
  hid_t type = memory_type(column);
  int failed = buffer && type >= 0 ? 0 : -1;
  for (size_t r = 0; r < rows && !failed; r++) failed = put(column, &value[r * part->columns], buffer + r * size_of(column));
  if (!failed && H5Dwrite(dataset, type, memory, space, transfer, buffer) < 0) failed = -1;
  if (type >= 0) H5Tclose(type);
  free(buffer);
  return failed;
}

int gx_hdf5_column_name(hid_t dataset, const char *name, struct gx_table *table, size_t c)
{
  enum gx_type type;
  if (gx_handle_shape(dataset, &type) < 0) return -1;
  char *unit = gx_handle_get_text(dataset, "unit");
  int failed = gx_table_column(table, c, name, unit ? unit : "", type);
  table->column[c].width = gx_handle_width(dataset);
  free(unit);
  return failed;
}

int gx_hdf5_column_read(hid_t dataset, size_t first, struct gx_table *table, size_t c)
{
  const struct gx_column *column = &table->column[c];
  const size_t size = size_of(column);
  const hsize_t from[1] = {first}, count[1] = {table->rows};
  char text[GX_HANDLE_WIDEST + 1] = "";
  if (!gx_handle_is_stored(dataset)) return 0;
  char *buffer = calloc(table->rows + 1, size); /* zeros: what a damaged file leaves out */
  hid_t type = memory_type(column), space = H5Dget_space(dataset), memory = H5Screate_simple(1, count, NULL);
  int failed = -1;
  if (buffer && type >= 0 && space >= 0 && memory >= 0 &&
      H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, count, NULL) >= 0 &&
      H5Dread(dataset, type, memory, space, H5P_DEFAULT, buffer) >= 0) {
    failed = 0;
    for (size_t r = 0; r < table->rows && !failed; r++) failed = gx_table_set(table, r, c, get(column, buffer + r * size, text));
    if (column->type == GX_TEXT && !column->width) H5Dvlen_reclaim(type, memory, H5P_DEFAULT, buffer);
  }
  if (memory >= 0) H5Sclose(memory);
  if (space >= 0) H5Sclose(space);
  if (type >= 0) H5Tclose(type);
  free(buffer);
  return failed;
}
