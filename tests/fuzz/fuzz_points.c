/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of particles, CSV or HDF5, in 1 to 3 dimensions, which the first byte says; a body made of them takes two steps. */
#include <gridcross/store.h>

#include <stdio.h>
#include <string.h>

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  char text[256];
  if (!size) return 0;
  snprintf(text, sizeof text,
           "problem: {name: free-flight, dimension: %d}\n"
           "body: {shape: points, file: points}\n"
           "mesh: {cells: 4}\n"
           "time: {dt: 1e-3, steps: 2}\n",
           1 + *data % 3);
  fuzz_write("points", data + 1, size - 1);
  fuzz_write("run.yaml", text, strlen(text));
  struct gx_study *study = gx_runfile_read(fuzz_path("run.yaml"), 0, NULL, &gx_hdf5_arrays, fuzz_quiet());
  for (size_t i = 0; study && i < study->count; i++) fuzz_run(&study->cases[i]);
  gx_runfile_free(study);
  return 0;
}
