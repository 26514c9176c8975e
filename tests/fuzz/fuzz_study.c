/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A shard of a study. The first byte says what becomes of it: study.h5 or timing.csv damaged, or study.h5 a sound HDF5 file of other
 * contents; and what reads it: all that reads studies, merge, or --resume. */
#include <gridcross/store.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "edit.h"
#include "fuzz.h"

static struct {
  struct gx_study *study;
  char first[FUZZ_PATH], second[FUZZ_PATH], joined[FUZZ_PATH];
  uint8_t *bytes, *timing; /* good ones, of the second shard */
  size_t size, timing_size;
} whole;

static void begin(void)
{
  gx_runfile_free(fuzz_study("first", 1, 2));
  whole.study = fuzz_study("second", 2, 2);
  whole.bytes = fuzz_read("second/study.h5", &whole.size);
  whole.timing = fuzz_read("second/timing.csv", &whole.timing_size);
  snprintf(whole.first, sizeof whole.first, "%s", fuzz_path("first"));
  snprintf(whole.second, sizeof whole.second, "%s", fuzz_path("second"));
  snprintf(whole.joined, sizeof whole.joined, "%s", fuzz_path("joined"));
}

static void read_table(void)
{
  FILE *quiet = fuzz_quiet();
  struct gx_table *table = gx_store_read(whole.second, quiet);
  for (size_t r = 0; table && r < table->rows && r < 2; r++)
    gx_store_free_spectra(gx_store_read_spectra(whole.second, table, r, quiet));
  gx_table_free(table);
  gx_store_read_repeats(whole.second);
}

static void read_rest(void)
{
  static const char *const texts[] = {"title", "run_file", "version", "git_revision", "compiler", "flags"};
  FILE *quiet = fuzz_quiet();
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) free(gx_store_read_provenance(whole.second, texts[i], quiet));
  gx_table_free(gx_store_read_history(whole.second, whole.study->cases[1].id, "displacement.rms", quiet));
  gx_table_free(gx_store_read_history(whole.second, whole.study->cases[3].id, "none", quiet));
}

static void merge(void)
{
  const char *const shards[] = {whole.first, whole.second};
  gx_store_merge(2, shards, whole.joined, "fuzz", fuzz_quiet());
  fuzz_clear("joined");
}

static void resume(void)
{
  const struct gx_store_how how = {.resume = true, .shard = 2, .shards = 2};
  gx_store_close(gx_store_open(whole.second, whole.study, &how, fuzz_quiet()));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  if (!whole.study) begin();
  const int how = size ? *data % 4 : 1, reader = size ? *data / 4 % 4 : 0;
  if (size) data++, size--;
  if (how == 0) fuzz_damage("second/study.h5", whole.bytes, whole.size, data, size);
  if (how == 1) fuzz_damage("second/timing.csv", whole.timing, whole.timing_size, data, size);
  if (how > 1) fuzz_edit("second/study.h5", whole.bytes, whole.size, data, size);
  if (reader == 0) read_table();
  if (reader == 1) read_rest();
  if (reader == 2) merge();
  if (reader == 3) resume();
  if (how == 1) fuzz_write("second/timing.csv", whole.timing, whole.timing_size);
  if (how != 1) fuzz_write("second/study.h5", whole.bytes, whole.size);
  return 0;
}
