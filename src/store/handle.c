/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What reading and writing HDF5 share. */
#include "handle.h"

#include <stdlib.h>
#include <string.h>

struct gx_handle_silence gx_handle_silence(void)
{
  struct gx_handle_silence old = {0};
  H5dont_atexit(); /* closing what a damaged file has left behind can go on for ever; all else is closed here */
  H5Eget_auto2(H5E_DEFAULT, &old.function, &old.data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  return old;
}

void gx_handle_restore(struct gx_handle_silence old)
{
  H5Eset_auto2(H5E_DEFAULT, old.function, old.data);
}

hid_t gx_handle_text_type(size_t width)
{
  hid_t type = H5Tcopy(H5T_C_S1);
  if (type < 0) return type;
  if (H5Tset_size(type, width ? width : H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0 ||
      (width && H5Tset_strpad(type, H5T_STR_NULLPAD) < 0)) {
    H5Tclose(type);
    return -1;
  }
  return type;
}

int gx_handle_put_attribute(hid_t object, const char *name, hid_t file_type, hid_t memory_type, const void *value)
{
  int failed = -1;
  hid_t space = H5Screate(H5S_SCALAR);
  hid_t attribute = space < 0 ? -1 : H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute >= 0 && H5Awrite(attribute, memory_type, value) >= 0) failed = 0;
  if (attribute >= 0 && H5Aclose(attribute) < 0) failed = -1;
  if (space >= 0) H5Sclose(space);
  return failed;
}

int gx_handle_put_text(hid_t object, const char *name, const char *text)
{
  hid_t type = gx_handle_text_type(0);
  int failed = type < 0 ? -1 : gx_handle_put_attribute(object, name, type, type, &text);
  if (type >= 0) H5Tclose(type);
  return failed;
}

int gx_handle_put_integer(hid_t object, const char *name, int64_t value)
{
  return gx_handle_put_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

hid_t gx_handle_make_group(hid_t parent, const char *name)
{
  hid_t group = -1, property = H5Pcreate(H5P_GROUP_CREATE);
  if (property < 0) return -1;
  if (H5Pset_obj_track_times(property, false) >= 0 &&
      H5Pset_link_creation_order(property, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) >= 0)
    group = H5Gcreate2(parent, name, H5P_DEFAULT, property, H5P_DEFAULT);
  H5Pclose(property);
  return group;
}

hid_t gx_handle_make_dataset(hid_t group, const char *name, hid_t type, size_t rows, hid_t memory, const void *null)
{
  hsize_t shape[1] = {rows};
  hid_t dataset = -1, space = H5Screate_simple(1, shape, NULL), property = H5Pcreate(H5P_DATASET_CREATE);
  if (space >= 0 && property >= 0 && H5Pset_obj_track_times(property, false) >= 0 &&
      H5Pset_alloc_time(property, H5D_ALLOC_TIME_LATE) >= 0 && H5Pset_fill_time(property, H5D_FILL_TIME_ALLOC) >= 0 &&
      (!null || H5Pset_fill_value(property, memory, null) >= 0))
    dataset = H5Dcreate2(group, name, type, space, H5P_DEFAULT, property, H5P_DEFAULT);
  if (property >= 0) H5Pclose(property);
  if (space >= 0) H5Sclose(space);
  return dataset;
}

char *gx_handle_get_text(hid_t object, const char *name)
{
  char *text = NULL, *copy = NULL;
  hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
  if (attribute < 0) return NULL;
  hid_t type = gx_handle_text_type(0), stored = H5Aget_type(attribute), space = H5Aget_space(attribute);
  if (type >= 0 && stored >= 0 && space >= 0 && H5Tis_variable_str(stored) > 0 && H5Sget_simple_extent_npoints(space) == 1 &&
      H5Aread(attribute, type, &text) >= 0) {
    copy = strdup(text ? text : "");
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, &text);
  }
  if (space >= 0) H5Sclose(space);
  if (stored >= 0) H5Tclose(stored);
  if (type >= 0) H5Tclose(type);
  H5Aclose(attribute);
  return copy;
}

int gx_handle_get_integer(hid_t object, const char *name, int64_t *value)
{
  hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
  if (attribute < 0) return -1;
  hid_t space = H5Aget_space(attribute), stored = H5Aget_type(attribute);
  const bool fits = space >= 0 && stored >= 0 && H5Sget_simple_extent_npoints(space) == 1 &&
                    H5Tget_class(stored) == H5T_INTEGER && H5Tget_size(stored) <= sizeof *value;
  int failed = fits && H5Aread(attribute, H5T_NATIVE_INT64, value) >= 0 ? 0 : -1;
  if (stored >= 0) H5Tclose(stored);
  if (space >= 0) H5Sclose(space);
  H5Aclose(attribute);
  return failed;
}

/* 0: not of texts that are all as wide. */
static size_t width_of(hid_t type)
{
  return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0 ? H5Tget_size(type) : 0;
}

hssize_t gx_handle_shape(hid_t dataset, enum gx_type *type)
{
  enum { WIDEST = 16 }; /* bytes of a number: HDF5 converts damaged types of any width, for ever */
  hssize_t rows = -1;
  hid_t space = H5Dget_space(dataset), stored = H5Dget_type(dataset);
  if (space >= 0 && stored >= 0 && H5Sget_simple_extent_ndims(space) == 1) {
    H5T_class_t class = H5Tget_class(stored);
    *type = class == H5T_FLOAT ? GX_REAL : class == H5T_INTEGER ? GX_INTEGER : class == H5T_STRING ? GX_TEXT : GX_NULL;
    if (H5Tget_size(stored) > (width_of(stored) ? GX_HANDLE_WIDEST : WIDEST)) *type = GX_NULL;
    if (*type != GX_NULL) rows = H5Sget_simple_extent_npoints(space);
  }
  if (stored >= 0) H5Tclose(stored);
  if (space >= 0) H5Sclose(space);
  return rows;
}

size_t gx_handle_width(hid_t dataset)
{
  hid_t stored = H5Dget_type(dataset);
  const size_t width = stored < 0 ? 0 : width_of(stored);
  if (stored >= 0) H5Tclose(stored);
  return width;
}

bool gx_handle_holds(hid_t object, double numbers)
{
  hsize_t bytes = 0;
  hid_t file = H5Iget_file_id(object);
  const bool known = file >= 0 && H5Fget_filesize(file, &bytes) >= 0;
  if (file >= 0) H5Fclose(file);
  return known && numbers * 8 <= (double)bytes;
}

bool gx_handle_is_stored(hid_t dataset)
{
  return H5Dget_storage_size(dataset) > 0;
}

bool gx_handle_fits(hid_t object, double rows, size_t columns, size_t stored)
{
  enum { MOST_EMPTY = 64 }; /* beside each that is stored, in any table */
  return columns / MOST_EMPTY <= stored && gx_handle_holds(object, rows * (stored ? (double)stored : 1));
}

hssize_t gx_handle_members(hid_t group)
{
  H5G_info_t info;
  return H5Gget_info(group, &info) >= 0 && gx_handle_holds(group, (double)info.nlinks) ? (hssize_t)info.nlinks : -1;
}

bool gx_handle_member(hid_t group, hsize_t i, char name[GX_HANDLE_NAME])
{
  return H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, name, GX_HANDLE_NAME, H5P_DEFAULT) > 0;
}

hid_t gx_handle_open_group(hid_t file, const char *name)
{
  return H5Lexists(file, name, H5P_DEFAULT) > 0 ? H5Gopen2(file, name, H5P_DEFAULT) : -1;
}
