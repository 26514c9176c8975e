/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study whose study.h5, or, where the first byte is above 127, timing.csv, is damaged as the rest says: everything that reads studies. */
#include <gridcross/store.h>

#include <stdlib.h>

#include "fuzz.h"

static struct {
  char id[2][17];
  uint8_t *study, *timing; /* good bytes */
  size_t study_size, timing_size;
} whole;

static void begin(void)
{
  fuzz_study(whole.id);
  whole.study = fuzz_read("study.h5", &whole.study_size);
  whole.timing = fuzz_read("timing.csv", &whole.timing_size);
}

static void read_table(void)
{
  const char *directory = fuzz_directory();
  FILE *quiet = fuzz_quiet();
  struct gx_table *table = gx_store_read(directory, quiet);
  for (size_t r = 0; table && r < table->rows && r < 2; r++)
    gx_store_free_spectra(gx_store_read_spectra(directory, table, r, quiet));
  gx_table_free(table);
  gx_store_read_repeats(directory);
}

static void read_rest(void)
{
  static const char *const texts[] = {"title", "run_file", "version", "git_revision", "compiler", "flags"};
  const char *directory = fuzz_directory();
  FILE *quiet = fuzz_quiet();
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) free(gx_store_read_provenance(directory, texts[i], quiet));
  gx_table_free(gx_store_read_history(directory, whole.id[0], "displacement.rms", quiet));
  gx_table_free(gx_store_read_history(directory, whole.id[1], "none", quiet));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  if (!whole.study) begin();
  const bool timing = size && *data > 127;
  if (size) data++, size--;
  fuzz_damage("study.h5", whole.study, whole.study_size, timing ? (const uint8_t *)"\2" : data, timing ? 1 : size);
  if (timing) fuzz_damage("timing.csv", whole.timing, whole.timing_size, data, size);
  read_table();
  read_rest();
  if (timing) fuzz_write("timing.csv", whole.timing, whole.timing_size);
  return 0;
}
