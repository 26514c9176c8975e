/* SPDX-License-Identifier: GPL-3.0-or-later */
/* study.h5. The only file that sees HDF5. Object times are off, so that equal studies give equal bytes. */
#include <gridcross/store.h>

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <hdf5.h>

#include <gridcross/build.h>

#include "../core/nearest.h"
#include "entry.h"

enum { FORMAT = 1, NAME = 256 };

/* HDF5 prints its error stack by default; we print one message instead. */
struct silence {
  H5E_auto2_t function;
  void *data;
};

static struct silence silence_begin(void)
{
  struct silence old = {0};
  H5dont_atexit(); /* closing what a damaged file has left behind can go on for ever; all else is closed here */
  H5Eget_auto2(H5E_DEFAULT, &old.function, &old.data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  return old;
}

static void silence_end(struct silence old)
{
  H5Eset_auto2(H5E_DEFAULT, old.function, old.data);
}

static hid_t text_type(void)
{
  hid_t type = H5Tcopy(H5T_C_S1);
  if (type < 0) return type;
  if (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0) {
    H5Tclose(type);
    return -1;
  }
  return type;
}

static int put_attribute(hid_t object, const char *name, hid_t file_type, hid_t memory_type, const void *value)
{
  int failed = -1;
  hid_t space = H5Screate(H5S_SCALAR);
  hid_t attribute = space < 0 ? -1 : H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute >= 0 && H5Awrite(attribute, memory_type, value) >= 0) failed = 0;
  if (attribute >= 0 && H5Aclose(attribute) < 0) failed = -1;
  if (space >= 0) H5Sclose(space);
  return failed;
}

static int put_text(hid_t object, const char *name, const char *text)
{
  hid_t type = text_type();
  int failed = type < 0 ? -1 : put_attribute(object, name, type, type, &text);
  if (type >= 0) H5Tclose(type);
  return failed;
}

static int put_integer(hid_t object, const char *name, int64_t value)
{
  return put_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

/* A group whose members are listed in the order in which they were made. */
static hid_t make_group(hid_t parent, const char *name)
{
  hid_t group = -1, property = H5Pcreate(H5P_GROUP_CREATE);
  if (property < 0) return -1;
  if (H5Pset_obj_track_times(property, false) >= 0 &&
      H5Pset_link_creation_order(property, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) >= 0)
    group = H5Gcreate2(parent, name, H5P_DEFAULT, property, H5P_DEFAULT);
  H5Pclose(property);
  return group;
}

static hid_t make_dataset(hid_t group, const char *name, hid_t type, size_t rows)
{
  hsize_t shape[1] = {rows};
  hid_t dataset = -1, space = H5Screate_simple(1, shape, NULL), property = H5Pcreate(H5P_DATASET_CREATE);
  if (space >= 0 && property >= 0 && H5Pset_obj_track_times(property, false) >= 0)
    dataset = H5Dcreate2(group, name, type, space, H5P_DEFAULT, property, H5P_DEFAULT);
  if (property >= 0) H5Pclose(property);
  if (space >= 0) H5Sclose(space);
  return dataset;
}

static int put_column(hid_t group, const struct gx_table *table, size_t c, hid_t text, union gx_entry *entry)
{
  const struct gx_column *column = &table->column[c];
  bool real = column->type == GX_REAL, integer = column->type == GX_INTEGER;
  hid_t file_type = real ? H5T_IEEE_F64LE : integer ? H5T_STD_I64LE : text;
  hid_t memory_type = real ? H5T_NATIVE_DOUBLE : integer ? H5T_NATIVE_INT64 : text;
  for (size_t r = 0; r < table->rows; r++) entry[r] = gx_entry_from(column->type, gx_table_get(table, r, c));
  hid_t dataset = make_dataset(group, column->name, file_type, table->rows);
  if (dataset < 0) return -1;
  int failed = put_text(dataset, "unit", column->unit);
  if (!failed && integer) failed = put_integer(dataset, "null", gx_entry_null);
  if (!failed && H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, entry) < 0) failed = -1;
  return H5Dclose(dataset) < 0 ? -1 : failed;
}

static int put_table(hid_t parent, const char *name, const struct gx_table *table)
{
  int failed = -1;
  union gx_entry *entry = calloc(table->rows + 1, sizeof *entry);
  hid_t text = text_type(), group = make_group(parent, name);
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
  hid_t group = make_group(file, name);
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
  hid_t group = make_group(file, "provenance");
  if (group < 0) return -1;
  int failed = put_integer(group, "format", FORMAT);
  for (size_t i = 0; i < sizeof rows / sizeof *rows && !failed; i++) failed = put_text(group, rows[i].name, rows[i].text);
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
  struct silence old = silence_begin();
  size_t size = 0;
  void *image = make_image(study, results, table, &size);
  silence_end(old);
  errno = 0;
  int failed = image ? write_image(path, image, size) : -1;
  if (failed) fprintf(errors, "%s: cannot write: %s\n", path, errno ? strerror(errno) : "HDF5 failed");
  free(image);
  return failed;
}

/* A text attribute, owned by the caller; NULL when there is none. */
static char *get_text(hid_t object, const char *name)
{
  char *text = NULL, *copy = NULL;
  hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
  if (attribute < 0) return NULL;
  hid_t type = text_type(), stored = H5Aget_type(attribute), space = H5Aget_space(attribute);
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

static int get_integer(hid_t object, const char *name, int64_t *value)
{
  hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
  if (attribute < 0) return -1;
  hid_t space = H5Aget_space(attribute);
  int failed =
      space >= 0 && H5Sget_simple_extent_npoints(space) == 1 && H5Aread(attribute, H5T_NATIVE_INT64, value) >= 0 ? 0 : -1;
  if (space >= 0) H5Sclose(space);
  H5Aclose(attribute);
  return failed;
}

/* Number of rows and type of a dataset that can be a column, or -1. */
static hssize_t column_shape(hid_t dataset, enum gx_type *type)
{
  enum { WIDEST = 16 }; /* bytes of a number: HDF5 converts damaged types of any width, for ever */
  hssize_t rows = -1;
  hid_t space = H5Dget_space(dataset), stored = H5Dget_type(dataset);
  if (space >= 0 && stored >= 0 && H5Sget_simple_extent_ndims(space) == 1) {
    H5T_class_t class = H5Tget_class(stored);
    *type = class == H5T_FLOAT ? GX_REAL : class == H5T_INTEGER ? GX_INTEGER : H5Tis_variable_str(stored) > 0 ? GX_TEXT : GX_NULL;
    if (H5Tget_size(stored) > WIDEST) *type = GX_NULL;
    if (*type != GX_NULL) rows = H5Sget_simple_extent_npoints(space);
  }
  if (stored >= 0) H5Tclose(stored);
  if (space >= 0) H5Sclose(space);
  return rows;
}

static int get_column(hid_t dataset, const char *name, struct gx_table *table, size_t c)
{
  enum gx_type type;
  if (column_shape(dataset, &type) != (hssize_t)table->rows) return -1;
  int failed = -1;
  char *unit = get_text(dataset, "unit");
  union gx_entry *entry = calloc(table->rows + 1, sizeof *entry);
  hid_t text = text_type(), space = H5Dget_space(dataset);
  hid_t memory_type = type == GX_REAL ? H5T_NATIVE_DOUBLE : type == GX_INTEGER ? H5T_NATIVE_INT64 : text;
  if (entry && text >= 0 && space >= 0 && H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, entry) >= 0) {
    failed = gx_table_column(table, c, name, unit ? unit : "", type);
    for (size_t r = 0; r < table->rows && !failed; r++) failed = gx_table_set(table, r, c, gx_entry_value(type, entry[r]));
    if (type == GX_TEXT) H5Dvlen_reclaim(text, space, H5P_DEFAULT, entry);
  }
  if (space >= 0) H5Sclose(space);
  if (text >= 0) H5Tclose(text);
  free(entry);
  free(unit);
  return failed;
}

/* Name of a group's member in the order in which they were made; false: there is none. */
static bool member_name(hid_t group, hsize_t i, char name[NAME])
{
  return H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, name, NAME, H5P_DEFAULT) > 0;
}

static struct gx_table *get_table(hid_t group)
{
  struct gx_table *table = NULL;
  H5G_info_t info;
  if (H5Gget_info(group, &info) < 0 || info.nlinks == 0) return NULL;
  for (hsize_t c = 0; c < info.nlinks; c++) {
    char name[NAME];
    enum gx_type type;
    int failed = -1;
    if (member_name(group, c, name)) {
      hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT);
      hssize_t rows = dataset < 0 ? -1 : column_shape(dataset, &type);
      if (!table && rows >= 0) table = gx_table_create(info.nlinks, (size_t)rows);
      if (table && dataset >= 0) failed = get_column(dataset, name, table, c);
      if (dataset >= 0) H5Dclose(dataset);
    }
    if (!failed) continue;
    gx_table_free(table);
    return NULL;
  }
  return table;
}

/* Opens a member only when it is there. */
static hid_t open_group(hid_t file, const char *name)
{
  return H5Lexists(file, name, H5P_DEFAULT) > 0 ? H5Gopen2(file, name, H5P_DEFAULT) : -1;
}

/* A study file of our format, or -1 after a message. */
static hid_t open_study(const char *path, FILE *errors)
{
  int64_t format = 0;
  FILE *probe = fopen(path, "rb");
  if (!probe) {
    fprintf(errors, "%s: %s\n", path, strerror(errno));
    return -1;
  }
  fclose(probe);
  hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) {
    fprintf(errors, "%s: is damaged or not an HDF5 file\n", path);
    return -1;
  }
  hid_t provenance = open_group(file, "provenance"), table = open_group(file, "table");
  bool ours = provenance >= 0 && table >= 0 && !get_integer(provenance, "format", &format);
  if (!ours)
    fprintf(errors, "%s: is not a study that gridcross wrote\n", path);
  else if (format != FORMAT)
    fprintf(errors, "%s: has format %lld; this gridcross reads format %d\n", path, (long long)format, FORMAT);
  if (table >= 0) H5Gclose(table);
  if (provenance >= 0) H5Gclose(provenance);
  if (ours && format == FORMAT) return file;
  H5Fclose(file);
  return -1;
}

struct gx_table *gx_hdf5_read(const char *path, FILE *errors)
{
  struct silence old = silence_begin();
  struct gx_table *table = NULL;
  hid_t file = open_study(path, errors), group = file < 0 ? -1 : open_group(file, "table");
  if (group >= 0 && !(table = get_table(group))) fprintf(errors, "%s: its table is damaged\n", path);
  if (group >= 0) H5Gclose(group);
  if (file >= 0) H5Fclose(file);
  silence_end(old);
  return table;
}

char *gx_hdf5_read_title(const char *path, FILE *errors)
{
  struct silence old = silence_begin();
  char *title = NULL;
  hid_t file = open_study(path, errors), provenance = file < 0 ? -1 : open_group(file, "provenance");
  if (provenance >= 0 && !(title = get_text(provenance, "title"))) fprintf(errors, "%s: its title is damaged\n", path);
  if (provenance >= 0) H5Gclose(provenance);
  if (file >= 0) H5Fclose(file);
  silence_end(old);
  return title;
}

static void name_histories(hid_t group, const char *wanted, FILE *errors)
{
  struct gx_nearest near = {.word = wanted};
  const char *gap = "; there are: ";
  char name[NAME];
  for (hsize_t i = 0; member_name(group, i, name); i++) gx_nearest_try(&near, name);
  fprintf(errors, "gridcross: no history '%s'", wanted);
  if (*near.best) fprintf(errors, ": did you mean %s?", near.best);
  for (hsize_t i = 0; member_name(group, i, name); i++, gap = ", ") fprintf(errors, "%s%s", gap, name);
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
    hssize_t rows = dataset < 0 ? -1 : column_shape(dataset, &type);
    if (!table && rows >= 0) table = gx_table_create(2, (size_t)rows);
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
  hid_t all = open_group(file, name), group = all < 0 ? -1 : open_group(all, id);
  if (group < 0)
    fprintf(errors, "%s: has no %s of case %s: set output.%s in its run file, and run that again\n", path, name, id, name);
  if (all >= 0) H5Gclose(all);
  return group;
}

struct gx_table *gx_hdf5_read_history(const char *path, const char *id, const char *name, FILE *errors)
{
  struct silence old = silence_begin();
  struct gx_table *table = NULL;
  hid_t file = open_study(path, errors), group = file < 0 ? -1 : open_kept(file, path, "histories", id, errors);
  if (group >= 0 && (!*name || strchr(name, '/') || H5Lexists(group, name, H5P_DEFAULT) <= 0))
    name_histories(group, name, errors);
  else if (group >= 0 && !(table = get_history(group, name)))
    fprintf(errors, "%s: the history of case %s is damaged\n", path, id);
  if (group >= 0) H5Gclose(group);
  if (file >= 0) H5Fclose(file);
  silence_end(old);
  return table;
}

struct gx_table *gx_hdf5_read_spectra(const char *path, const char *id, FILE *errors)
{
  struct silence old = silence_begin();
  struct gx_table *table = NULL;
  hid_t file = open_study(path, errors), group = file < 0 ? -1 : open_kept(file, path, "spectra", id, errors);
  if (group >= 0 && !(table = get_table(group))) fprintf(errors, "%s: the spectra of case %s are damaged\n", path, id);
  if (group >= 0) H5Gclose(group);
  if (file >= 0) H5Fclose(file);
  silence_end(old);
  return table;
}

/* A dataset of numbers as doubles, owned by the caller; NULL: wrong says why. rows: 0 at first, then what each must have. */
static double *get_numbers(hid_t dataset, size_t most, size_t *rows, const char **wrong)
{
  const double densest = 2000; /* bytes out of one that is stored: what claims more holds nothing */
  enum gx_type type;
  hssize_t count = column_shape(dataset, &type);
  double *array = NULL;
  *wrong = NULL;
  if (count < 0 || type == GX_TEXT) *wrong = "is not one row of numbers";
  if (!*wrong && count == 0) *wrong = "is empty";
  if (!*wrong && (size_t)count > most) *wrong = "has more rows than can be taken";
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

static int complain(FILE *errors, const char *path, const char *dataset, const char *wrong)
{
  fprintf(errors, "%s: dataset '%s' %s\n", path, dataset, wrong);
  return -1;
}

static int read_arrays(const char *path, size_t count, const char *const *name, const char *const *absent, size_t most,
                       double **array, size_t *rows, FILE *errors)
{
  struct silence old = silence_begin();
  hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  int failed = file < 0 ? -1 : 0;
  if (failed) fprintf(errors, "%s: is damaged or not an HDF5 file\n", path);
  *rows = 0;
  for (size_t i = 0; i < count && file >= 0; i++) {
    const char *wrong = "is missing";
    hid_t dataset = H5Lexists(file, name[i], H5P_DEFAULT) > 0 ? H5Dopen2(file, name[i], H5P_DEFAULT) : -1;
    array[i] = dataset < 0 ? NULL : get_numbers(dataset, most, rows, &wrong);
    if (!array[i]) failed = complain(errors, path, name[i], wrong);
    if (dataset >= 0) H5Dclose(dataset);
  }
  for (; *absent && file >= 0; absent++)
    if (H5Lexists(file, *absent, H5P_DEFAULT) > 0)
      failed = complain(errors, path, *absent, "does not suit the dimension; remove it, or set problem.dimension");
  if (file >= 0) H5Fclose(file);
  silence_end(old);
  return failed;
}

const struct gx_array_reader gx_hdf5_arrays = {.read = read_arrays};
