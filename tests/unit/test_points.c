/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of points: CSV and HDF5 give the particles that they name, every error of a list is reported at its place, and a header alone
 * forces no memory. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <hdf5.h>

#include <gridcross/store.h>

#include "check.h"
#include "temporary.h"
#include "study/simulation_plan.h"

static char folder[TEMPORARY_ROOM];

static int make_folder(void **state)
{
  (void)state;
  return temporary_directory(folder, "points") ? 0 : -1;
}

static int remove_folder(void **state)
{
  (void)state;
  static const char *const files[] = {"run.yaml", "list.csv", "list.h5"};
  char path[64];
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
    snprintf(path, sizeof path, "%s/%s", folder, files[i]);
    unlink(path);
  }
  return rmdir(folder);
}

static void write_file(const char *name, const char *bytes, size_t length)
{
  char path[64];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *out = fopen(path, "wb");
  assert_non_null(out);
  assert_int_equal(fwrite(bytes, 1, length, out), length);
  fclose(out);
}

/* A run file beside the lists, of that dimension. errors: owned by the caller. */
static struct gx_study *read_run(const char *list, int dim, char **errors)
{
  char path[64], text[256];
  size_t length;
  snprintf(text, sizeof text, "{problem: {name: free-flight, dimension: %d}, body.file: %s, mesh.cells: 8, time.steps: 1}", dim,
           list);
  write_file("run.yaml", text, strlen(text));
  snprintf(path, sizeof path, "%s/run.yaml", folder);
  FILE *out = open_memstream(errors, &length);
  struct gx_study *study = gx_runfile_read(path, 0, NULL, &gx_hdf5_arrays, out);
  fclose(out);
  return study;
}

/* Every message that the list gives, in order, without the path before it. */
static void expect(const char *list, int dim, const char *const *message)
{
  char *errors;
  struct gx_study *study = read_run(list, dim, &errors);
  const char *at = errors;
  assert_null(study);
  for (; *message; message++) {
    char line[256];
    snprintf(line, sizeof line, "%s/%s:%s\n", folder, list, *message);
    CHECK(!strncmp(at, line, strlen(line)), "%s in\n%s", line, at);
    at += strlen(line);
  }
  CHECK(!*at, "unexpected: %s", at);
  free(errors);
}

static void expect_csv(const char *text, size_t length, int dim, const char *const *message)
{
  write_file("list.csv", text, length);
  expect("list.csv", dim, message);
}
#define CSV(text, dim, ...) expect_csv(text, sizeof text - 1, dim, (const char *const[]){__VA_ARGS__, NULL})

static void every_error_of_a_list_is_reported_at_its_place(void **state)
{
  (void)state;
  CSV("x,y,volume\n0.1,0.2,0.01\n0.1,abc,0.01\nnan,0.2,0\n1.5,-0.2,0.01\n0.1,0.2\n\n0.1,0.2,0.3,0.4\n", 2,
      "3:5: y: 'abc' is not a number", "4:1: x: 'nan' is not finite; give a finite number",
      "4:9: volume is 0; it must be above 0 (1e-30 at least) and at most that of the domain, 1",
      "5:1: x is 1.5, outside the domain [0, 1]; move the point or leave it out",
      "5:5: y is -0.2, outside the domain [0, 1]; move the point or leave it out",
      "6:1: 2 values in a row of 3; give one for each column of the header",
      "8:1: 4 values in a row of 3; give one for each column of the header");
  CSV("x,z,weight,x\n1,2,3,4\n", 2, "1:1: there is no column 'y'; name it in the header",
      "1:1: there is no column 'volume'; name it in the header",
      "1:3: column 'z' does not suit dimension 2; remove it, or set problem.dimension: 3",
      "1:5: unknown column 'weight'; give x, y and volume", "1:12: column 'x' is given twice; remove one");
  CSV("x,volume\n0.5,2\n", 1, "2:5: volume is 2; it must be above 0 (1e-30 at least) and at most that of the domain, 1");
  CSV("", 3, " holds no point; give a row a point below the header x,y,z,volume");
  CSV("x,y,volume\n \n", 2, " holds no point; give a row a point below the header x,y,volume");
  CSV("x,y,volume\n0.1,\0000.2,0.1\n", 2, "2:1: holds a NUL byte: not a list of points");
  CSV("X;Y;volume\n0,5;0,5;0,1\n", 2, "1:1: no column is named x, y or volume; begin with the line x,y,volume");
  CSV("x,volume\n0.25,0.5\n0.5,0.75\n", 1, " the volumes add up to 1.25, more than that of the domain, 1; give smaller ones");
  char wide[3000] = "x,volume\n";
  memset(wide + 9, '0', sizeof wide - 9);
  expect_csv(wide, sizeof wide, 1,
             (const char *const[]){"2:1: the line is longer than 1023 characters: not a list of points", NULL});
}

/* A thousand errors are enough. */
static void errors_without_end_end(void **state)
{
  (void)state;
  enum { ROWS = 5000 };
  char *text = malloc(16 + 8 * ROWS), *errors, *at = text + sprintf(text, "x,volume\n");
  for (int i = 0; i < ROWS; i++) at += sprintf(at, "2,0.1\n");
  write_file("list.csv", text, (size_t)(at - text));
  assert_null(read_run("list.csv", 1, &errors));
  assert_non_null(strstr(errors, "too many errors"));
  assert_true(strlen(errors) < 200000);
  free(errors);
  free(text);
}

/* Once, where the run file names it, whatever the number of cases that ask for it. */
static void a_list_that_is_not_there_is_an_error_of_the_run_file(void **state)
{
  (void)state;
  const char text[] = "{problem: {name: free-flight, dimension: [1, 2]},\n body.file: [none.csv, other.csv]}";
  char *errors, path[64], expected[512];
  size_t length;
  write_file("run.yaml", text, sizeof text - 1);
  snprintf(path, sizeof path, "%s/run.yaml", folder);
  snprintf(expected, sizeof expected,
           "%s:2:14: body.file: '%s/none.csv' cannot be opened: No such file or directory\n"
           "%s:2:24: body.file: '%s/other.csv' cannot be opened: No such file or directory\n",
           path, folder, path, folder);
  FILE *out = open_memstream(&errors, &length);
  assert_null(gx_runfile_read(path, 0, NULL, &gx_hdf5_arrays, out));
  fclose(out);
  assert_string_equal(errors, expected);
  free(errors);
}

enum { N = 4 };
static const double X[3][N] = {{0.25, 0.5, 0, 1}, {0.125, 1, 0, 0.75}, {0.375, 0.625, 1, 0}};
static const double volume[N] = {0.001, 0.008, 0.027, 0.000125};

static void check_particles(const char *list, int dim)
{
  char *errors;
  struct gx_study *study = read_run(list, dim, &errors);
  CHECK(study, "%s", errors);
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  assert_int_equal(gx_simulation_plan(&simulation, &study->cases[0], &outcome), GX_OK);
  assert_int_equal(gx_simulation_lay_out(&simulation, &outcome), GX_OK);
  const struct gx_particles *particles = simulation.particles;
  assert_int_equal(particles->n, N);
  assert_int_equal(particles->dim, dim);
  for (size_t p = 0; p < N; p++) {
    NEAR(particles->V0[p], volume[p], 0);
    NEAR(particles->m[p], volume[p], 0); /* density 1 */
    for (int d = 0; d < dim; d++) {
      NEAR(particles->X[d][p], X[d][p], 0);
      CLOSE(pow(2 * particles->half_length[d][p], dim), volume[p], 1e-15);
      for (int e = 0; e < dim; e++) NEAR(particles->F[d * dim + e][p], d == e, 0);
    }
  }
  gx_simulation_free(&simulation);
  gx_runfile_free(study);
  free(errors);
}

static void csv_gives_its_particles(void **state)
{
  (void)state;
  static const char *const header[] = {"volume, \"x\"", "\xef\xbb\xbfx,volume,y", "z,y,x,volume"};
  static const int order[][4] = {{3, 0}, {0, 3, 1}, {2, 1, 0, 3}};
  for (int dim = 1; dim <= 3; dim++) {
    char text[512], *at = text + sprintf(text, "%s\r\n\r\n", header[dim - 1]);
    for (int p = 0; p < N; p++)
      for (int k = 0; k <= dim; k++) {
        int column = order[dim - 1][k];
        at += sprintf(at, " %.17g%s", column < 3 ? X[column][p] : volume[p], k < dim ? "," : p % 2 ? "\r\n" : "\n");
      }
    write_file("list.csv", text, (size_t)(at - text));
    check_particles("list.csv", dim);
  }
}

static void a_pipe_gives_its_particles(void **state)
{
  (void)state;
  const char text[] = "volume,x\n0.001,0.25\n0.008,\"0.5\"\n0.027,0\n0.000125,1\n";
  char name[32];
  int end[2];
  assert_int_equal(pipe(end), 0);
  assert_int_equal(write(end[1], text, sizeof text - 1), sizeof text - 1);
  close(end[1]);
  snprintf(name, sizeof name, "/dev/fd/%d", end[0]);
  check_particles(name, 1);
  close(end[0]);
}

/* value NULL: a dataset that claims `rows` rows and holds none */
static void put_dataset(hid_t file, const char *name, hid_t type, hsize_t rows, const void *value)
{
  hid_t space = H5Screate_simple(1, &rows, NULL);
  hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (value) assert_true(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
  H5Dclose(dataset);
  H5Sclose(space);
}

static hid_t begin_hdf5(void)
{
  char path[64];
  snprintf(path, sizeof path, "%s/list.h5", folder);
  hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  assert_true(file >= 0);
  return file;
}

static void hdf5_gives_its_particles(void **state)
{
  (void)state;
  static const char *const name[] = {"x", "y", "z"};
  for (int dim = 1; dim <= 3; dim++) {
    hid_t file = begin_hdf5();
    for (int d = 0; d < dim; d++) put_dataset(file, name[d], H5T_NATIVE_DOUBLE, N, X[d]);
    put_dataset(file, "volume", H5T_NATIVE_DOUBLE, N, volume);
    H5Fclose(file);
    check_particles("list.h5", dim);
  }
}

static void errors_of_datasets_are_reported(void **state)
{
  (void)state;
  const double bad[N] = {0.5, NAN, 2, 0.5};
  hid_t file = begin_hdf5();
  put_dataset(file, "x", H5T_NATIVE_DOUBLE, N, bad);
  put_dataset(file, "volume", H5T_NATIVE_DOUBLE, N, bad);
  H5Fclose(file);
  const char *const values[] = {" point 1: x is not finite; give a finite number",
                                " point 2: x is 2, outside the domain [0, 1]; move the point or leave it out",
                                " point 1: volume is not finite; give a finite number",
                                " point 2: volume is 2; it must be above 0 (1e-30 at least) and at most that of the domain, 1",
                                NULL};
  expect("list.h5", 1, values);
  file = begin_hdf5();
  put_dataset(file, "x", H5T_NATIVE_DOUBLE, N, bad);
  put_dataset(file, "y", H5T_NATIVE_DOUBLE, N - 1, bad);
  put_dataset(file, "z", H5T_NATIVE_DOUBLE, N, bad);
  H5Fclose(file);
  const char *const shapes[] = {" dataset 'y' has another length than the datasets before it", " dataset 'volume' is missing",
                                " dataset 'z' does not suit the dimension; remove it, or set problem.dimension", NULL};
  expect("list.h5", 2, shapes);
  file = begin_hdf5();
  put_dataset(file, "x", H5T_NATIVE_DOUBLE, 9000000, NULL);
  put_dataset(file, "y", H5T_NATIVE_DOUBLE, (hsize_t)1 << 50, NULL);
  put_dataset(file, "volume", H5T_NATIVE_DOUBLE, 0, NULL);
  H5Fclose(file);
  const char *const claims[] = {" dataset 'x' claims more rows than the file holds",
                                " dataset 'y' has more rows than can be taken", " dataset 'volume' is empty", NULL};
  expect("list.h5", 2, claims);
  file = begin_hdf5();
  hid_t wide = H5Tcopy(H5T_NATIVE_DOUBLE);
  H5Tset_size(wide, 1000);
  put_dataset(file, "x", wide, N, NULL);
  put_dataset(file, "volume", H5T_NATIVE_DOUBLE, N, volume);
  H5Tclose(wide);
  H5Fclose(file);
  expect("list.h5", 1, (const char *const[]){" dataset 'x' is not one row of numbers", NULL});
  write_file("list.h5", "\x89HDF\r\n\x1a\nand no more", 19);
  expect("list.h5", 1, (const char *const[]){" is damaged or not an HDF5 file", NULL});
}

/* Of whoever sends a list, no other file is read, and no more memory taken than its particles need. */
static void datasets_are_in_the_file_itself(void **state)
{
  (void)state;
  enum { CHUNK = 10000001 };
  char path[128];
  snprintf(path, sizeof path, "%s/list.h5", folder);
  hid_t file = begin_hdf5();
  put_dataset(file, "other", H5T_NATIVE_DOUBLE, N, volume);
  H5Lcreate_external(path, "/other", file, "x", H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t rows = N, chunk = CHUNK;
  hid_t space = H5Screate_simple(1, &rows, NULL), outside = H5Pcreate(H5P_DATASET_CREATE),
        chunked = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_external(outside, path, 0, H5F_UNLIMITED);
  H5Dclose(H5Dcreate2(file, "y", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, outside, H5P_DEFAULT));
  const hsize_t any = H5S_UNLIMITED;
  H5Sset_extent_simple(space, 1, &rows, &any);
  H5Pset_chunk(chunked, 1, &chunk);
  H5Dclose(H5Dcreate2(file, "volume", H5T_NATIVE_INT8, space, H5P_DEFAULT, chunked, H5P_DEFAULT));
  H5Pclose(chunked);
  H5Pclose(outside);
  H5Sclose(space);
  H5Fclose(file);
  expect("list.h5", 2,
         (const char *const[]){" dataset 'x' is missing",
                               " dataset 'y' is kept in other files or in too large chunks; copy it into this one",
                               " dataset 'volume' is kept in other files or in too large chunks; copy it into this one", NULL});
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_error_of_a_list_is_reported_at_its_place),
      cmocka_unit_test(errors_without_end_end),
      cmocka_unit_test(a_list_that_is_not_there_is_an_error_of_the_run_file),
      cmocka_unit_test(csv_gives_its_particles),
      cmocka_unit_test(a_pipe_gives_its_particles),
      cmocka_unit_test(hdf5_gives_its_particles),
      cmocka_unit_test(errors_of_datasets_are_reported),
      cmocka_unit_test(datasets_are_in_the_file_itself),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
