/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What targets share. */
#include "fuzz.h"

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gridcross/status.h>
#include <gridcross/store.h>

#include "temporary.h"

static char directory[TEMPORARY_ROOM];

/* HDF5 loses memory over files that it finds damaged. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
  return "leak:libhdf5";
}

static void require(int holds, const char *what)
{
  if (holds) return;
  fprintf(stderr, "fuzz: %s\n", what);
  abort();
}

static void clear(const char *path, int depth)
{
  DIR *stream = opendir(path);
  for (struct dirent *entry; stream && (entry = readdir(stream));) {
    char below[2 * FUZZ_PATH];
    if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..")) continue;
    snprintf(below, sizeof below, "%s/%s", path, entry->d_name);
    if (unlink(below) && depth) clear(below, depth - 1);
  }
  if (stream) closedir(stream);
  rmdir(path);
}

static void remove_directory(void)
{
  clear(directory, 1);
}

void fuzz_clear(const char *name)
{
  clear(fuzz_path(name), 0);
}

void fuzz_make(const char *name)
{
  require(!mkdir(fuzz_path(name), 0777), "cannot make a directory");
}

const char *fuzz_directory(void)
{
  if (*directory) return directory;
  require(temporary_directory(directory, "fuzz"), "no directory");
  atexit(remove_directory);
  gx_status_quiet_gsl();
  return directory;
}

const char *fuzz_path(const char *name)
{
  static char path[FUZZ_PATH];
  snprintf(path, sizeof path, "%s/%s", fuzz_directory(), name);
  return path;
}

FILE *fuzz_quiet(void)
{
  static FILE *quiet;
  if (!quiet) quiet = fopen("/dev/null", "w");
  require(quiet != NULL, "no /dev/null");
  return quiet;
}

void fuzz_write(const char *name, const void *data, size_t size)
{
  FILE *out = fopen(fuzz_path(name), "wb");
  require(out && fwrite(data, 1, size, out) == size && !fclose(out), "cannot write");
}

uint8_t *fuzz_read(const char *name, size_t *size)
{
  FILE *in = fopen(fuzz_path(name), "rb");
  require(in && !fseek(in, 0, SEEK_END), "cannot read");
  *size = (size_t)ftell(in);
  uint8_t *bytes = malloc(*size + 1);
  rewind(in);
  require(bytes && fread(bytes, 1, *size, in) == *size, "cannot read");
  fclose(in);
  return bytes;
}

void fuzz_damage(const char *name, const uint8_t *good, size_t length, const uint8_t *data, size_t size)
{
  const uint8_t how = size ? *data : 0;
  if (size) data++, size--;
  if (!how) {
    fuzz_write(name, data, size);
    return;
  }
  uint8_t *bytes = malloc(length + 1);
  require(bytes != NULL, "out of memory");
  memcpy(bytes, good, length);
  size_t left = length;
  if (how % 2 && size >= 2) {
    left = length * (size_t)(data[0] << 8 | data[1]) / 65536;
    data += 2;
    size -= 2;
  }
  for (; size >= 5; data += 5, size -= 5) {
    const size_t at = (size_t)data[0] << 24 | (size_t)data[1] << 16 | (size_t)data[2] << 8 | data[3];
    bytes[at % length] = (uint8_t)(bytes[at % length] + data[4]);
  }
  fuzz_write(name, bytes, left);
  free(bytes);
}

static long integer(const struct gx_case *one, enum gx_parameter_id id)
{
  return one->value[id].type == GX_INTEGER ? one->value[id].integer : 1;
}

/* A result that ended well is made of numbers. */
static void check_row(const struct gx_case *one, const struct gx_result *result)
{
  struct gx_table *table = gx_study_table_begin(1, false);
  require(table && !gx_study_table_fill(table, 0, one, result, false), "no row");
  for (size_t c = 0; c < table->columns; c++) {
    const struct gx_value value = gx_table_get(table, 0, c);
    require(value.type != GX_REAL || isfinite(value.real), table->column[c].name);
  }
  gx_table_free(table);
}

void fuzz_run(const struct gx_case *one)
{
  enum { MOST = 200 }; /* particles, and steps */
  const long dim = integer(one, GX_PROBLEM_DIMENSION);
  const double cells = (double)integer(one, GX_MESH_CELLS), per_cell = (double)integer(one, GX_MESH_PARTICLES_PER_CELL);
  if (pow(cells * per_cell, (double)dim) > MOST || pow(cells + 9, (double)dim) > 4 * MOST) return;
  if (one->points && one->points->n > MOST) return;
  const struct gx_plan plan = gx_case_plan(one);
  if (plan.outcome.status != GX_OK || plan.steps * (1 + (double)integer(one, GX_OUTPUT_REFERENCE)) > MOST) return;
  struct gx_result result = gx_case_run(one);
  check_row(one, &result);
  gx_case_free(&result);
}

struct gx_study *fuzz_study(const char *name, size_t shard, size_t shards)
{
  static const char text[] = "title: everything\n"
                             "problem: {name: bar-neo-hookean}\n"
                             "mesh: {cells: [4, 5], particles_per_cell: 2}\n"
                             "method: {degree: [1, 2]}\n"
                             "time: {steps: 2}\n"
                             "output: {histories: 1, spectra: 1, snapshots: 1, budget: 1, probe: '0.5', jumps: 'yes'}\n";
  const struct gx_store_how how = {.shard = shard, .shards = shards};
  FILE *errors = stderr;
  fuzz_directory();
  struct gx_study *study = gx_runfile_parse("everything.yaml", text, errors);
  require(study && study->count == 4, "no study");
  struct gx_store *store = gx_store_open(fuzz_path(name), study, &how, errors);
  require(store != NULL, "no store");
  struct gx_study_means means = {
      .threads = 1, .sink = gx_store_sink(store), .observer = gx_store_observer(store), .skip = gx_store_skip(store)};
  require(!gx_study_run(study, &means), "no run");
  require(!gx_store_finish(store, &(struct gx_store_run){.command = "fuzz"}), "not finished");
  require(!gx_store_close(store), "not closed");
  return study;
}
