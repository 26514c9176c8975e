/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays of numbers from HDF5 files of any origin. */
#include <gridcross/store.h>

#include <stdlib.h>

#include "handle.h"

/* Whether its numbers are in the file itself, in pieces no larger than it may be: HDF5 takes memory for whole ones. */
static bool is_plain(hid_t dataset, size_t most)
{
  hid_t creation = H5Dget_create_plist(dataset);
  H5D_layout_t layout = creation < 0 ? H5D_LAYOUT_ERROR : H5Pget_layout(creation);
  hsize_t chunk[1] = {0};
  bool plain = (layout == H5D_COMPACT || layout == H5D_CONTIGUOUS) && H5Pget_external_count(creation) == 0;
  if (layout == H5D_CHUNKED) plain = H5Pget_chunk(creation, 1, chunk) == 1 && chunk[0] <= most;
  if (creation >= 0) H5Pclose(creation);
  return plain;
}

/* A dataset of numbers as doubles, owned by the caller; NULL: wrong says why. rows: 0 at first, then what each must have. */
static double *get_numbers(hid_t dataset, size_t most, size_t *rows, const char **wrong)
{
  const double densest = 2000; /* bytes out of one that is stored: what claims more holds nothing */
  enum gx_type type;
  hssize_t count = gx_handle_shape(dataset, &type);
  double *array = NULL;
  *wrong = NULL;
  if (count < 0 || type == GX_TEXT) *wrong = "is not one row of numbers";
  if (!*wrong && count == 0) *wrong = "is empty";
  if (!*wrong && (size_t)count > most) *wrong = "has more rows than can be taken";
  if (!*wrong && !is_plain(dataset, most)) *wrong = "is kept in other files or in too large chunks; copy it into this one";
  if (!*wrong && densest * (double)H5Dget_storage_size(dataset) < (double)sizeof *array * (double)count)
    *wrong = "claims more rows than the file holds";
  if (!*wrong && *rows && *rows != (size_t)count) *wrong = "has another length than the datasets before it";
  if (*wrong) return NULL;
  *rows = (size_t)count;
  array = malloc(*rows * sizeof *array);
  if (array && H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array) >= 0) return array;
  *wrong = array ? "is damaged" : "is too large for the memory there is";
  free(array);
  return NULL;
}

/* Whether a name is of something in this file. */
static bool is_own(hid_t file, const char *name)
{
  H5L_info_t info;
  return H5Lexists(file, name, H5P_DEFAULT) > 0 && H5Lget_info(file, name, &info, H5P_DEFAULT) >= 0 &&
         (info.type == H5L_TYPE_HARD || info.type == H5L_TYPE_SOFT);
}

static int complain(FILE *errors, const char *path, const char *dataset, const char *wrong)
{
  fprintf(errors, "%s: dataset '%s' %s\n", path, dataset, wrong);
  return -1;
}

static int read_arrays(const char *path, size_t count, const char *const *name, const char *const *absent, size_t most,
                       double **array, size_t *rows, FILE *errors)
{
  struct gx_handle_silence old = gx_handle_silence();
  hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  int failed = file < 0 ? -1 : 0;
  if (failed) fprintf(errors, "%s: is damaged or not an HDF5 file\n", path);
  *rows = 0;
  for (size_t i = 0; i < count && file >= 0; i++) {
    const char *wrong = "is missing";
    hid_t dataset = is_own(file, name[i]) ? H5Dopen2(file, name[i], H5P_DEFAULT) : -1;
    array[i] = dataset < 0 ? NULL : get_numbers(dataset, most, rows, &wrong);
    if (!array[i]) failed = complain(errors, path, name[i], wrong);
    if (dataset >= 0) H5Dclose(dataset);
  }
  for (; *absent && file >= 0; absent++)
    if (H5Lexists(file, *absent, H5P_DEFAULT) > 0)
      failed = complain(errors, path, *absent, "does not suit the dimension; remove it, or set problem.dimension");
  if (file >= 0) H5Fclose(file);
  gx_handle_restore(old);
  return failed;
}

const struct gx_array_reader gx_hdf5_arrays = {.read = read_arrays};
