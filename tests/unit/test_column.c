/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns as datasets, of a file in memory: texts that have a width. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "store/hdf5_column.h"

enum { WIDTH = 4 };

static hid_t file_in_memory(void)
{
  hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, false);
  hid_t file = H5Fcreate("none.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  H5Pclose(access);
  assert_true(file >= 0);
  return file;
}

static struct gx_table *table_of(size_t rows, const char *const *texts)
{
  struct gx_table *table = gx_table_create(1, rows);
  gx_table_column(table, 0, "word", "m", GX_TEXT);
  table->column[0].width = WIDTH;
  for (size_t r = 0; r < rows; r++)
    if (texts[r]) gx_table_set(table, r, 0, (struct gx_value){.type = GX_TEXT, .text = texts[r]});
  return table;
}

/* All rows of a dataset at once. */
static int write_all(hid_t dataset, const struct gx_table *table)
{
  hid_t space = H5Dget_space(dataset);
  int failed = gx_hdf5_column_write(dataset, table, 0, table->rows, space, space, H5P_DEFAULT);
  H5Sclose(space);
  return failed;
}

/* Each takes as many bytes, and the empty one is null. */
static void texts_are_given_back(void **state)
{
  (void)state;
  static const char *const texts[] = {"four", "", "abc", "h\xC3\xB6h", NULL};
  enum { ROWS = sizeof texts / sizeof *texts };
  hid_t file = file_in_memory();
  struct gx_table *table = table_of(ROWS, texts), *back = gx_table_create(1, ROWS - 1);
  hid_t dataset = gx_hdf5_column_create(file, &table->column[0], ROWS);
  assert_int_equal(write_all(dataset, table), 0);
  assert_int_equal(H5Dget_storage_size(dataset), ROWS * WIDTH);
  assert_int_equal(gx_hdf5_column_name(dataset, "word", back, 0), 0);
  assert_string_equal(back->column[0].unit, "m");
  assert_int_equal(back->column[0].width, WIDTH);
  assert_int_equal(gx_hdf5_column_read(dataset, 1, back, 0), 0);
  for (size_t r = 0; r + 1 < ROWS; r++) {
    const struct gx_value value = gx_table_get(back, r, 0);
    const char *text = texts[r + 1];
    assert_int_equal(value.type, text && *text ? GX_TEXT : GX_NULL);
    if (value.type == GX_TEXT) assert_string_equal(value.text, text);
  }
  H5Dclose(dataset);
  H5Fclose(file);
  gx_table_free(table);
  gx_table_free(back);
}

static void longer_texts_are_not_cut(void **state)
{
  (void)state;
  static const char *const texts[] = {"four", "fives"};
  hid_t file = file_in_memory();
  struct gx_table *table = table_of(2, texts);
  hid_t dataset = gx_hdf5_column_create(file, &table->column[0], 2);
  assert_int_equal(write_all(dataset, table), -1);
  assert_int_equal(H5Dget_storage_size(dataset), 0);
  H5Dclose(dataset);
  H5Fclose(file);
  gx_table_free(table);
}

/* Of other programs, or damaged: texts as wide as any column's, without an end, and wider ones, which are none of ours. */
static void widths_have_a_limit(void **state)
{
  (void)state;
  const hsize_t rows = 1;
  for (size_t width = GX_HANDLE_WIDEST; width <= GX_HANDLE_WIDEST + 1; width++) {
    hid_t file = file_in_memory(), space = H5Screate_simple(1, &rows, NULL), type = H5Tcopy(H5T_C_S1);
    char word[GX_HANDLE_WIDEST + 1];
    memset(word, 'w', sizeof word);
    H5Tset_size(type, width);
    H5Tset_strpad(type, H5T_STR_SPACEPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
    hid_t dataset = H5Dcreate2(file, "word", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, word) >= 0);
    struct gx_table *table = gx_table_create(1, 1);
    assert_int_equal(gx_hdf5_column_name(dataset, "word", table, 0), width > GX_HANDLE_WIDEST ? -1 : 0);
    if (width == GX_HANDLE_WIDEST) {
      assert_int_equal(gx_hdf5_column_read(dataset, 0, table, 0), 0);
      assert_int_equal(strspn(gx_table_get(table, 0, 0).text, "w"), width);
    }
    gx_table_free(table);
    H5Dclose(dataset);
    H5Tclose(type);
    H5Sclose(space);
    H5Fclose(file);
  }
}

int main(void)
{
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(texts_are_given_back),
      cmocka_unit_test(longer_texts_are_not_cut),
      cmocka_unit_test(widths_have_a_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
