/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes of HDF5 files: values, attributes, members that are other things, or gone, or elsewhere. */
#include "edit.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "store/seal.h"

enum { OBJECTS = 1024, NAME = 128, MOST_EDITS = 32 };

struct edit {
  uint8_t how, object[2], which, type, shape, value, at;
};

struct names {
  size_t count;
  char name[OBJECTS][NAME];
};

static herr_t note(hid_t file, const char *name, const H5O_info_t *info, void *context)
{
  struct names *names = context;
  (void)file, (void)info;
  if (names->count < OBJECTS && strlen(name) < NAME) strcpy(names->name[names->count++], name);
  return 0;
}

static double number(uint8_t value)
{
  static const double special[] = {0,       -1,           1,     2,   3,   0.5,     1e308, -1e308, 1e-320, 9.2e18,
                                   -9.3e18, 4294967296.0, 65536, 255, NAN, INFINITY};
  return value < 128 ? (double)value : special[value % (sizeof special / sizeof *special)];
}

static const char *text(uint8_t value)
{
  static char long_text[2000];
  static const char *const some[] = {
      "",     "ok",  "x",    "standard",     "\n",     "\xff\xfe", "1/1",    "shard\t1", "0123456789abcdef",
      "../x", "nan", "%s%n", "method.space", "a,b\"c", "<script>", long_text};
  memset(long_text, 'y', sizeof long_text - 1);
  return some[value % (sizeof some / sizeof *some)];
}

static hid_t string_type(size_t length)
{
  hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, length);
  return type;
}

/* To be closed. */
static hid_t type_of(const struct edit *edit)
{
  const hsize_t three = 3;
  hid_t type;
  switch (edit->type % 12) {
  case 0:
    return H5Tcopy(H5T_IEEE_F64LE);
  case 1:
    return H5Tcopy(H5T_IEEE_F32BE);
  case 2:
    return H5Tcopy(H5T_STD_I64LE);
  case 3:
    return H5Tcopy(H5T_STD_U8LE);
  case 4:
    return H5Tcopy(H5T_STD_U64BE);
  case 5:
    return string_type(edit->value + 1u);
  case 6:
    return string_type(H5T_VARIABLE);
  case 7:
    return H5Tarray_create2(H5T_IEEE_F64LE, 1, &three);
  case 8:
    return H5Tvlen_create(H5T_STD_I32LE);
  case 9:
    return H5Tcreate(H5T_OPAQUE, 8);
  case 10:
    return H5Tcopy(H5T_STD_REF_OBJ);
  default:
    type = H5Tcreate(H5T_COMPOUND, 16);
    H5Tinsert(type, "a", 0, H5T_IEEE_F64LE);
    H5Tinsert(type, "b", 8, H5T_STD_I64LE);
    return type;
  }
}

/* Much data is claimed of datasets alone: HDF5 itself takes memory for what an attribute claims. */
static hid_t space_of(const struct edit *edit, bool attribute)
{
  const hsize_t shape[] = {edit->at, edit->value % 5u}, huge = (hsize_t)1 << 40;
  switch (edit->shape % 6) {
  case 0:
    return H5Screate(H5S_SCALAR);
  case 1:
    return H5Screate(H5S_NULL);
  case 2:
    return H5Screate_simple(2, shape, NULL);
  case 3:
    return H5Screate_simple(1, attribute ? shape : &huge, NULL);
  default:
    return H5Screate_simple(1, shape, NULL);
  }
}

/* What a number or a text is written from, and its type. */
static hid_t memory(hid_t stored, const struct edit *edit, double *real, const char **word)
{
  *real = number(edit->value);
  *word = text(edit->value);
  return H5Tis_variable_str(stored) > 0                                             ? string_type(H5T_VARIABLE)
         : H5Tget_class(stored) == H5T_FLOAT || H5Tget_class(stored) == H5T_INTEGER ? H5Tcopy(H5T_NATIVE_DOUBLE)
                                                                                    : -1;
}

static void set_one(hid_t dataset, const struct edit *edit)
{
  double real;
  const char *word;
  hid_t stored = H5Dget_type(dataset), space = H5Dget_space(dataset), type = memory(stored, edit, &real, &word);
  const hssize_t points = H5Sget_simple_extent_npoints(space);
  const hsize_t at = points > 0 ? edit->at % (hsize_t)points : 0, one = 1;
  hid_t place = H5Screate_simple(1, &one, NULL);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (type >= 0 && points > 0 && rank == 1 && H5Sselect_hyperslab(space, H5S_SELECT_SET, &at, NULL, &one, NULL) >= 0)
    H5Dwrite(dataset, type, place, space, H5P_DEFAULT, H5Tis_variable_str(stored) > 0 ? (const void *)&word : &real);
  if (type >= 0) H5Tclose(type);
  H5Sclose(place);
  H5Sclose(space);
  H5Tclose(stored);
}

static void make_dataset(hid_t file, const char *name, const struct edit *edit)
{
  const hsize_t chunk[] = {64, 2};
  hid_t type = type_of(edit), space = space_of(edit, false), property = H5Pcreate(H5P_DATASET_CREATE);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (edit->shape % 6 == 3 || (rank > 0 && edit->which % 2)) H5Pset_chunk(property, rank, chunk);
  if (rank > 0 && edit->which % 4 == 3) H5Pset_deflate(property, 1);
  hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, property, H5P_DEFAULT);
  if (dataset >= 0) {
    set_one(dataset, edit);
    H5Dclose(dataset);
  }
  H5Pclose(property);
  H5Sclose(space);
  H5Tclose(type);
}

static void edit_attribute(hid_t object, const struct edit *edit, bool make)
{
  char name[NAME];
  H5O_info_t info;
  if (H5Oget_info1(object, &info) < 0 || !info.num_attrs) return;
  if (H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, edit->which % info.num_attrs, name, NAME, H5P_DEFAULT) <= 0)
    return;
  hid_t old = H5Aopen(object, name, H5P_DEFAULT), type = make ? type_of(edit) : H5Aget_type(old), space = H5Aget_space(old);
  if (make) {
    H5Sclose(space);
    space = space_of(edit, true);
  }
  H5Aclose(old);
  H5Adelete(object, name);
  hid_t fresh = edit->shape == 255 ? -1 : H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  double real;
  const char *word;
  hid_t given = memory(type, edit, &real, &word);
  if (fresh >= 0 && given >= 0 && H5Sget_simple_extent_npoints(space) == 1)
    H5Awrite(fresh, given, H5Tis_variable_str(type) > 0 ? (const void *)&word : &real);
  if (given >= 0) H5Tclose(given);
  if (fresh >= 0) H5Aclose(fresh);
  H5Sclose(space);
  H5Tclose(type);
}

static void change(hid_t file, const struct names *names, const struct edit *edit)
{
  const char *name = names->name[(edit->object[0] << 8 | edit->object[1]) % names->count],
             *other = names->name[edit->at % names->count];
  hid_t object = H5Oopen(file, name, H5P_DEFAULT);
  if (object < 0) return;
  switch (edit->how % 8) {
  case 0:
  case 1:
    if (H5Iget_type(object) == H5I_DATASET) set_one(object, edit);
    break;
  case 2:
    edit_attribute(object, edit, false);
    break;
  case 3:
    edit_attribute(object, edit, true);
    break;
  case 4:
    H5Ldelete(file, name, H5P_DEFAULT);
    break;
  case 5:
    if (H5Ldelete(file, name, H5P_DEFAULT) >= 0) make_dataset(file, name, edit);
    break;
  case 6:
    if (H5Ldelete(file, name, H5P_DEFAULT) < 0) break;
    if (edit->which % 3 == 0) H5Lcreate_soft(other, file, name, H5P_DEFAULT, H5P_DEFAULT);
    if (edit->which % 3 == 1) H5Lcreate_hard(file, other, file, name, H5P_DEFAULT, H5P_DEFAULT);
    if (edit->which % 3 == 2) H5Lcreate_external("elsewhere.h5", other, file, name, H5P_DEFAULT, H5P_DEFAULT);
    break;
  default:
    H5Lmove(file, name, file, edit->which % 2 ? "stray" : other, H5P_DEFAULT, H5P_DEFAULT);
  }
  H5Oclose(object);
}

void fuzz_edit(const char *name, const uint8_t *good, size_t length, const uint8_t *data, size_t size)
{
  static struct names names;
  fuzz_write(name, good, length);
  struct gx_handle_silence old = gx_handle_silence();
  hid_t file = H5Fopen(fuzz_path(name), H5F_ACC_RDWR, H5P_DEFAULT);
  if (file < 0) abort();
  if (!names.count) H5Ovisit1(file, H5_INDEX_NAME, H5_ITER_INC, note, &names);
  for (int i = 0; i < MOST_EDITS && size >= sizeof(struct edit); i++, data += sizeof(struct edit), size -= sizeof(struct edit)) {
    struct edit edit;
    memcpy(&edit, data, sizeof edit);
    change(file, &names, &edit);
  }
  H5Fclose(file);
  gx_handle_restore(old);
  const int descriptor = open(fuzz_path(name), O_RDWR);
  if (descriptor < 0 || gx_seal_put(descriptor)) abort();
  close(descriptor);
}
