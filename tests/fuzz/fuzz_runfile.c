/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run files: read, expanded, planned, and run where that is short. */
#include <gridcross/store.h>

#include "fuzz.h"

enum { MOST_CASES = 8 };

/* Ranges of hundreds of thousands of values are allowed, and take seconds where sanitizers look. */
static bool has_long_number(const uint8_t *data, size_t size)
{
  size_t digits = 0;
  for (size_t i = 0; i < size && digits < 6; i++) digits = data[i] >= '0' && data[i] <= '9' ? digits + 1 : 0;
  return digits >= 6;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  if (has_long_number(data, size)) return 0;
  fuzz_write("run.yaml", data, size);
  struct gx_study *study = gx_runfile_read(fuzz_path("run.yaml"), 0, NULL, &gx_hdf5_arrays, fuzz_quiet());
  for (size_t i = 0; study && i < study->count && i < MOST_CASES; i++) fuzz_run(&study->cases[i]);
  gx_runfile_free(study);
  return 0;
}
