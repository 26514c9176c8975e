/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CSV, JSON, HDF5 and the study directory. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <hdf5.h>

#include <gridcross/store.h>

#include "check.h"
#include "temporary.h"
#include "store/hdf5_write.h"
#include "store/seal.h"

enum { ROWS = 4 };

static const struct gx_value example[ROWS][3] = {
    {{.type = GX_TEXT, .text = "plain"}, {.type = GX_INTEGER, .integer = -3}, {.type = GX_REAL, .real = 0.1}},
    {{.type = GX_TEXT, .text = "say \"hi\", now"}, {.type = GX_NULL}, {.type = GX_REAL, .real = 1.0 / 3}},
    {{.type = GX_TEXT, .text = "two\nlines, h\xC3\xB6h\xC3\xB6 \\"},
     {.type = GX_INTEGER, .integer = 9007199254740993},
     {.type = GX_NULL}},
    {{.type = GX_NULL}, {.type = GX_INTEGER, .integer = 0}, {.type = GX_REAL, .real = 1e-300}},
};

static struct gx_value of_integer(long integer)
{
  return (struct gx_value){.type = GX_INTEGER, .integer = integer};
}

static struct gx_table *example_table(void)
{
  struct gx_table *table = gx_table_create(3, ROWS);
  gx_table_column(table, 0, "z,word", "", GX_TEXT);
  gx_table_column(table, 1, "count", "", GX_INTEGER);
  gx_table_column(table, 2, "a.real", "m/s", GX_REAL);
  for (size_t r = 0; r < ROWS; r++)
    for (size_t c = 0; c < 3; c++) assert_int_equal(gx_table_set(table, r, c, example[r][c]), 0);
  return table;
}

static void csv_quotes_and_leaves_null_empty(void **state)
{
  (void)state;
  char *text;
  size_t length;
  FILE *out = open_memstream(&text, &length);
  struct gx_table *table = example_table();
  gx_csv_write(table, out);
  fclose(out);
  assert_string_equal(text, "\"z,word\",count,a.real\n"
                            "plain,-3,0.1\n"
                            "\"say \"\"hi\"\", now\",,0.3333333333333333\n"
                            "\"two\nlines, h\xC3\xB6h\xC3\xB6 \\\",9007199254740993,\n"
                            ",0,1e-300\n");
  free(text);
  gx_table_free(table);
}

/* What a row shares with the one above, and a text longer than what is written at once. */
static void csv_repeats_what_is_repeated(void **state)
{
  enum { LONG = 20000, REPEATED = 8 };
  (void)state;
  static const char *const lines[REPEATED] = {"\"a,b\",0,0", "\"a,b\",0,-0", ",1,0.1", "\"a,b\",1,0.1",
                                              "\"\",,1",     "\"\",2,",      "1,1,1",  "1,1,1"};
  static const struct gx_value none = {.type = GX_NULL};
  const struct gx_value comma = {.type = GX_TEXT, .text = "a,b"}, empty = {.type = GX_TEXT, .text = ""},
                        word = {.type = GX_TEXT, .text = "1"};
  const struct gx_value text[] = {comma, comma, none, comma, empty, empty, word, word};
  const struct gx_value integer[] = {of_integer(0), of_integer(0), of_integer(1), of_integer(1),
                                     none,          of_integer(2), of_integer(1), of_integer(1)};
  const struct gx_value real[] = {gx_value_from(0),   gx_value_from(-0.0), gx_value_from(0.1),
                                  gx_value_from(0.1), gx_value_from(1),    none,
                                  gx_value_from(1),   gx_value_from(1)};
  struct gx_table *table = gx_table_create(3, REPEATED + 2);
  for (size_t c = 0; c < 3; c++) gx_table_column(table, c, "n", "", c == 0 ? GX_TEXT : c == 1 ? GX_INTEGER : GX_REAL);
  for (size_t r = 0; r < REPEATED; r++) {
    gx_table_set(table, r, 0, text[r]);
    gx_table_set(table, r, 1, integer[r]);
    gx_table_set(table, r, 2, real[r]);
  }
  char *longest = calloc(LONG + 1, 1), *written;
  memset(longest, 'x', LONG);
  for (size_t r = REPEATED; r < REPEATED + 2; r++) gx_table_set(table, r, 0, (struct gx_value){.type = GX_TEXT, .text = longest});
  size_t length;
  FILE *out = open_memstream(&written, &length);
  gx_csv_write(table, out);
  fclose(out);
  const char *at = written;
  assert_int_equal(strncmp(at, "n,n,n\n", 6), 0);
  at += 6;
  for (size_t r = 0; r < REPEATED + 2; r++) {
    const char *line = r < REPEATED ? lines[r] : longest, *rest = r < REPEATED ? "\n" : ",,\n";
    assert_int_equal(strncmp(at, line, strlen(line)), 0);
    at += strlen(line);
    assert_int_equal(strncmp(at, rest, strlen(rest)), 0);
    at += strlen(rest);
  }
  assert_int_equal(*at, 0);
  free(written);
  free(longest);
  gx_table_free(table);
}

static void json_escapes_and_says_null(void **state)
{
  (void)state;
  char *text;
  size_t length;
  FILE *out = open_memstream(&text, &length);
  struct gx_table *table = example_table();
  gx_table_set(table, 3, 2, (struct gx_value){.type = GX_REAL, .real = INFINITY});
  gx_table_set(table, 3, 0, (struct gx_value){.type = GX_TEXT, .text = "\x01"});
  gx_json_write(table, out);
  fclose(out);
  assert_string_equal(text, "[\n {\"z,word\": \"plain\", \"count\": -3, \"a.real\": 0.1},\n"
                            " {\"z,word\": \"say \\\"hi\\\", now\", \"count\": null, \"a.real\": 0.3333333333333333},\n"
                            " {\"z,word\": \"two\\nlines, h\xC3\xB6h\xC3\xB6 \\\\\", \"count\": 9007199254740993, "
                            "\"a.real\": null},\n"
                            " {\"z,word\": \"\\u0001\", \"count\": 0, \"a.real\": null}\n]\n");
  free(text);
  gx_table_free(table);
}

/* A study of two cases, one with a history. */
struct fixture {
  char directory[TEMPORARY_ROOM], path[128], other[128];
  struct gx_case cases[2];
  struct gx_sample samples[2];
  struct gx_result results[2];
  struct gx_study study;
  char title[16], source[32];
};

static int set_up(void **state)
{
  struct fixture *f = calloc(1, sizeof *f);
  if (!temporary_directory(f->directory, "store")) return -1;
  snprintf(f->path, sizeof f->path, "%s/a.h5", f->directory);
  snprintf(f->other, sizeof f->other, "%s/b.h5", f->directory);
  strcpy(f->title, "a \xE2\x82\xAC title");
  strcpy(f->source, "mesh: {cells: [1, 2]}\n");
  strcpy(f->cases[0].id, "0123456789abcdef");
  strcpy(f->cases[1].id, "fedcba9876543210");
  f->cases[1].value[GX_MESH_CELLS] = (struct gx_value){.type = GX_INTEGER, .integer = 2};
  f->samples[0] = (struct gx_sample){.time = 0.5, .defect = NAN};
  f->samples[1] = (struct gx_sample){.time = 1, .error[GX_STRESS][GX_RMS] = 0.25, .kinetic = 3};
  f->results[0].history = (struct gx_history){.samples = 2, .sample = f->samples};
  f->results[0].seconds = 1.5;
  f->results[0].ns_per_particle_step = 20.25;
  f->study = (struct gx_study){.title = f->title, .source = f->source, .cases = f->cases, .count = 2};
  *state = f;
  return 0;
}

/* study.h5 with another table than the study's own, in pieces of two rows. */
static int write_study(const struct fixture *f, const char *path, const struct gx_table *table)
{
  struct gx_hdf5_writer *writer = gx_hdf5_write_begin(path, table, table->columns, table->rows, stderr);
  int failed = writer ? 0 : -1;
  struct gx_table *part = gx_table_create(table->columns, 2);
  for (size_t c = 0; c < table->columns; c++) gx_table_column_like(part, c, &table->column[c]);
  for (size_t r = 0; r < table->rows && !failed; r += 2) {
    size_t rows = table->rows - r < 2 ? table->rows - r : 2;
    for (size_t k = 0; k < rows; k++)
      for (size_t c = 0; c < table->columns; c++) gx_table_set(part, k, c, gx_table_get(table, r + k, c));
    failed = gx_hdf5_write_rows(writer, part, rows);
  }
  gx_table_free(part);
  for (size_t i = 0; i < f->study.count && !failed; i++) {
    struct gx_table *history = gx_study_table_history(&f->results[i]);
    if (history->rows) failed = gx_hdf5_write_kept(writer, GX_HDF5_HISTORIES, f->study.cases[i].id, history);
    gx_table_free(history);
  }
  const struct gx_provenance provenance = gx_provenance_of(&f->study);
  return writer && gx_hdf5_write_end(writer, &provenance) ? -1 : failed;
}

static int tear_down(void **state)
{
  struct fixture *f = *state;
  char command[128];
  snprintf(command, sizeof command, "rm -rf %s", f->directory);
  int failed = system(command);
  free(f);
  return failed;
}

static char *contents(const char *path, size_t *length)
{
  FILE *in = fopen(path, "rb");
  if (!in) return NULL;
  fseek(in, 0, SEEK_END);
  *length = (size_t)ftell(in);
  rewind(in);
  char *bytes = malloc(*length + 1);
  assert_int_equal(fread(bytes, 1, *length, in), *length);
  bytes[*length] = '\0';
  fclose(in);
  return bytes;
}

static void put(const char *path, const char *bytes, size_t length)
{
  FILE *out = fopen(path, "wb");
  assert_int_equal(fwrite(bytes, 1, length, out), length);
  fclose(out);
}

static void hdf5_gives_back_what_was_written(void **state)
{
  struct fixture *f = *state;
  struct gx_table *table = example_table();
  assert_int_equal(write_study(f, f->path, table), 0);
  struct gx_table *back = gx_hdf5_read(f->path, stderr);
  assert_non_null(back);
  assert_int_equal(back->rows, ROWS);
  assert_int_equal(back->columns, 3);
  for (size_t c = 0; c < 3; c++) {
    assert_string_equal(back->column[c].name, table->column[c].name);
    assert_string_equal(back->column[c].unit, table->column[c].unit);
    assert_int_equal(back->column[c].type, table->column[c].type);
    for (size_t r = 0; r < ROWS; r++) {
      assert_int_equal(gx_table_get(back, r, c).type, example[r][c].type);
      assert_int_equal(gx_value_compare(gx_table_get(back, r, c), example[r][c]), 0);
    }
  }
  gx_table_free(back);
  gx_table_free(table);
}

static void equal_studies_give_equal_bytes(void **state)
{
  struct fixture *f = *state;
  struct gx_table *table = example_table();
  assert_int_equal(write_study(f, f->path, table), 0);
  sleep(1); /* object times have a resolution of one second */
  char *litter[64];
  for (int i = 0; i < 64; i++) memset(litter[i] = malloc(4096), 0xA5, 4096);
  for (int i = 0; i < 64; i++) free(litter[i]);
  assert_int_equal(write_study(f, f->other, table), 0);
  size_t n, m;
  char *a = contents(f->path, &n), *b = contents(f->other, &m);
  assert_int_equal(n, m);
  assert_memory_equal(a, b, n);
  free(a);
  free(b);
  gx_table_free(table);
}

/* Reads a file that must be refused, with a message and nothing else on standard error. */
static void refuse(const char *path)
{
  char *message;
  size_t length;
  FILE *errors = open_memstream(&message, &length), *seen = tmpfile();
  int saved = dup(STDERR_FILENO);
  dup2(fileno(seen), STDERR_FILENO);
  struct gx_table *table = gx_hdf5_read(path, errors);
  dup2(saved, STDERR_FILENO);
  close(saved);
  fclose(errors);
  struct stat status;
  fstat(fileno(seen), &status);
  fclose(seen);
  assert_null(table);
  assert_int_equal(status.st_size, 0);
  assert_int_equal(strncmp(message, path, strlen(path)), 0);
  free(message);
}

static void damaged_files_are_refused(void **state)
{
  struct fixture *f = *state;
  struct gx_table *table = example_table();
  assert_int_equal(write_study(f, f->path, table), 0);
  gx_table_free(table);
  size_t length;
  char *bytes = contents(f->path, &length);
  for (size_t keep = 0; keep < length; keep += length / 37 + 1) {
    put(f->other, bytes, keep);
    refuse(f->other);
  }
  free(bytes);
  put(f->other, "case,mesh.cells\n", 16);
  refuse(f->other);
  refuse(f->directory);
  refuse("/nowhere/study.h5");
  static const char *const ours[] = {"study", "result.seconds", "result.ns_per_particle_step"};
  snprintf(f->other, sizeof f->other, "%s/study.h5", f->directory);
  for (size_t i = 0; i < sizeof ours / sizeof *ours; i++) { /* columns that reading adds */
    table = example_table();
    gx_table_column(table, 1, ours[i], "", GX_INTEGER);
    assert_int_equal(write_study(f, f->other, table), 0);
    gx_table_free(table);
    FILE *quiet = tmpfile();
    assert_null(gx_store_read(f->directory, quiet));
    fclose(quiet);
  }
}

/* A column that claims more rows than the file could hold: its header alone is cheap to forge. */
static void claims_of_a_header_take_no_memory(void **state)
{
  struct fixture *f = *state;
  const hsize_t rows = (hsize_t)1 << 27;
  struct gx_table *table = example_table();
  assert_int_equal(write_study(f, f->path, table), 0);
  gx_table_free(table);
  hid_t file = H5Fopen(f->path, H5F_ACC_RDWR, H5P_DEFAULT), group = H5Gopen2(file, "table", H5P_DEFAULT);
  static const char *const names[] = {"z,word", "count", "a.real"};
  for (int i = 0; i < 3; i++) assert_true(H5Ldelete(group, names[i], H5P_DEFAULT) >= 0);
  hid_t space = H5Screate_simple(1, &rows, NULL);
  hid_t dataset = H5Dcreate2(group, "case", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dclose(dataset);
  H5Sclose(space);
  H5Gclose(group);
  H5Fclose(file);
  refuse(f->path); /* for its checksums */
  int descriptor = open(f->path, O_RDWR);
  assert_int_equal(gx_seal_put(descriptor), 0);
  close(descriptor);
  refuse(f->path);
}

/* What another program reads of a column: null, but for one row of some. */
static void column_has(hid_t group, const char *name, enum gx_type type, size_t rows, size_t value)
{
  union {
    double real;
    int64_t integer;
    char *text;
  } entry[8];
  hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT), stored = H5Dget_type(dataset);
  hid_t memory_type = type == GX_REAL ? H5T_NATIVE_DOUBLE : type == GX_INTEGER ? H5T_NATIVE_INT64 : stored;
  assert_int_equal(H5Dget_storage_size(dataset) > 0, value < rows);
  memset(entry, 1, sizeof entry);
  assert_true(H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, entry) >= 0);
  for (size_t r = 0; r < rows; r++) {
    if (type == GX_REAL) assert_int_equal(isnan(entry[r].real), r != value);
    if (type == GX_INTEGER) assert_int_equal(entry[r].integer == INT64_MIN, r != value);
    if (type == GX_TEXT) assert_int_equal(!entry[r].text, r != value);
    if (type == GX_TEXT && entry[r].text) H5free_memory(entry[r].text);
  }
  H5Tclose(stored);
  H5Dclose(dataset);
}

/* Columns that have no value, or none in the first pieces. */
static void columns_without_values_take_no_room(void **state)
{
  enum { PIECES = 8, LATE = 5 };
  static const char *const names[] = {"no.text", "no.integer", "no.real", "late.text", "late.integer", "late.real"};
  static const enum gx_type types[] = {GX_TEXT, GX_INTEGER, GX_REAL};
  static const struct gx_value late[] = {
      {.type = GX_TEXT, .text = "late"}, {.type = GX_INTEGER, .integer = 7}, {.type = GX_REAL, .real = 0.5}};
  struct fixture *f = *state;
  struct gx_table *table = gx_table_create(6, PIECES);
  for (size_t c = 0; c < 6; c++) gx_table_column(table, c, names[c], "", types[c % 3]);
  for (size_t c = 3; c < 6; c++) gx_table_set(table, LATE, c, late[c - 3]);
  assert_int_equal(write_study(f, f->path, table), 0);
  gx_table_free(table);
  table = gx_hdf5_read(f->path, stderr);
  assert_non_null(table);
  for (size_t c = 0; c < 6; c++) {
    assert_string_equal(table->column[c].name, names[c]);
    for (size_t r = 0; r < PIECES; r++) {
      const struct gx_value value = gx_table_get(table, r, c);
      if (c < 3 || r != LATE)
        assert_int_equal(value.type, GX_NULL);
      else
        assert_int_equal(gx_value_compare(value, late[c - 3]), 0);
    }
  }
  gx_table_free(table);
  hid_t file = H5Fopen(f->path, H5F_ACC_RDONLY, H5P_DEFAULT), group = H5Gopen2(file, "table", H5P_DEFAULT);
  for (size_t c = 0; c < 6; c++) column_has(group, names[c], types[c % 3], PIECES, c < 3 ? PIECES : LATE);
  H5Gclose(group);
  H5Fclose(file);
}

/* Any one bit: it is seen, and HDF5, which would crash on some of them, is not asked. */
static void flipped_bits_are_seen(void **state)
{
  struct fixture *f = *state;
  struct gx_table *table = example_table();
  assert_int_equal(write_study(f, f->path, table), 0);
  gx_table_free(table);
  size_t length;
  char *bytes = contents(f->path, &length);
  for (size_t at = 0; at < length; at += 1 + at % 61) {
    bytes[at] ^= (char)(1 << at % 8);
    put(f->path, bytes, length);
    refuse(f->path);
    bytes[at] ^= (char)(1 << at % 8);
  }
  bytes[length] = '\0'; /* and any more byte */
  put(f->path, bytes, length + 1);
  refuse(f->path);
  put(f->path, bytes, length);
  gx_table_free(table = gx_hdf5_read(f->path, stderr));
  assert_non_null(table);
  free(bytes);
}

static void a_study_is_stored_and_read_with_its_timing(void **state)
{
  struct fixture *f = *state;
  char directory[128];
  snprintf(directory, sizeof directory, "%s/new/study", f->directory);
  struct gx_store_run run = {.command = "gridcross run 'a b'", .seconds = 2};
  f->study.repeats = 3;
  for (int twice = 0; twice < 2; twice++) {
    assert_int_equal(gx_store_prepare(directory, stderr), 0);
    assert_int_equal(gx_store_write(directory, &f->study, f->results, &run, stderr), 0);
  }
  struct gx_table *table = gx_store_read(directory, stderr);
  assert_non_null(table);
  NEAR(gx_table_get(table, 0, (size_t)gx_table_find(table, "result.seconds")).real, 1.5, 0);
  NEAR(gx_table_get(table, 0, (size_t)gx_table_find(table, "result.ns_per_particle_step")).real, 20.25, 0);
  assert_int_equal(gx_table_get(table, 1, (size_t)gx_table_find(table, "mesh.cells")).integer, 2);
  gx_table_free(table);
  char path[256];
  size_t length;
  snprintf(path, sizeof path, "%s/timing.csv", directory);
  char *bytes = contents(path, &length);
  assert_string_equal(bytes, "case,seconds,ns_per_particle_step,repeats\n0123456789abcdef,1.5,20.25,3\nfedcba9876543210,0,0,3\n");
  free(bytes);
  assert_int_equal(gx_store_read_repeats(directory), 3);
  /* written by others: a time that is none, and a row of fewer repeats */
  const char foreign[] = "case,seconds,ns_per_particle_step,repeats\n0123456789abcdef,nan,20.25,3\nfedcba9876543210,2,3,2\n";
  put(path, foreign, sizeof foreign - 1);
  table = gx_store_read(directory, stderr);
  long seconds = gx_table_find(table, "result.seconds");
  assert_int_equal(gx_table_get(table, 0, (size_t)seconds).type, GX_NULL);
  NEAR(gx_table_get(table, 1, (size_t)seconds).real, 2, 0);
  gx_table_free(table);
  assert_int_equal(gx_store_read_repeats(directory), 2);
  unlink(path);
  assert_int_equal(gx_store_read_repeats(directory), 0);
  snprintf(path, sizeof path, "%s/run.json", directory);
  bytes = contents(path, &length);
  assert_non_null(strstr(bytes, "\"command\": \"gridcross run 'a b'\", \"seconds\": 2}"));
  free(bytes);
}

static void only_studies_are_overwritten(void **state)
{
  struct fixture *f = *state;
  FILE *quiet = tmpfile();
  char path[256];
  snprintf(path, sizeof path, "%s/.study.h5.partial", f->directory);
  put(path, "", 0);
  assert_int_equal(gx_store_prepare(f->directory, quiet), 0); /* what a kill leaves does no harm */
  put(f->path, "mine", 4);
  assert_int_equal(gx_store_prepare(f->directory, quiet), -1);
  assert_int_equal(gx_store_prepare(f->path, quiet), -1);
  snprintf(path, sizeof path, "%s/below", f->path);
  assert_int_equal(gx_store_prepare(path, quiet), -1);
  unlink(f->path);
  snprintf(path, sizeof path, "%s/study.h5", f->directory);
  put(path, "not ours", 8);
  assert_int_equal(gx_store_prepare(f->directory, quiet), -1);
  fclose(quiet);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(csv_quotes_and_leaves_null_empty),
      cmocka_unit_test(csv_repeats_what_is_repeated),
      cmocka_unit_test(json_escapes_and_says_null),
      cmocka_unit_test_setup_teardown(hdf5_gives_back_what_was_written, set_up, tear_down),
      cmocka_unit_test_setup_teardown(equal_studies_give_equal_bytes, set_up, tear_down),
      cmocka_unit_test_setup_teardown(damaged_files_are_refused, set_up, tear_down),
      cmocka_unit_test_setup_teardown(claims_of_a_header_take_no_memory, set_up, tear_down),
      cmocka_unit_test_setup_teardown(columns_without_values_take_no_room, set_up, tear_down),
      cmocka_unit_test_setup_teardown(flipped_bits_are_seen, set_up, tear_down),
      cmocka_unit_test_setup_teardown(a_study_is_stored_and_read_with_its_timing, set_up, tear_down),
      cmocka_unit_test_setup_teardown(only_studies_are_overwritten, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
