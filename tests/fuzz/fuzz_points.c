/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of particles, CSV or HDF5, in 1 to 3 dimensions, which the first byte says, or above 127 a sound HDF5 file of other contents; a
 * body made of them takes two steps. HDF5 crashes on damaged files of others, and takes the memory that they claim: libFuzzer is kept
 * from these. */
#include <gridcross/store.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "edit.h"
#include "fuzz.h"
#include "store/handle.h"

static const char signature[] = "\x89HDF\r\n\x1a\n";

/* Three particles. */
static uint8_t *sound_file(size_t *size)
{
  static const char *const names[] = {"x", "y", "z", "volume"};
  const double value[] = {0.3, 0.5, 0.7};
  const hsize_t rows = 3;
  fuzz_write("points", "", 0);
  hid_t file = H5Fcreate(fuzz_path("points"), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), space = H5Screate_simple(1, &rows, NULL);
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    hid_t dataset = H5Dcreate2(file, names[i], H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) < 0) abort();
    H5Dclose(dataset);
  }
  H5Sclose(space);
  if (H5Fclose(file) < 0) abort();
  return fuzz_read("points", size);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static uint8_t *good;
  static size_t length;
  char text[256];
  if (!size) return 0;
  const bool edited = *data > 127;
#ifdef FUZZ_DRIVEN
  if (!edited && size > sizeof signature && !memcmp(data + 1, signature, sizeof signature - 1)) return 0;
#else
  (void)signature;
#endif
  if (!good) good = sound_file(&length);
  snprintf(text, sizeof text,
           "problem: {name: free-flight, dimension: %d}\n"
           "body: {shape: points, file: points}\n"
           "mesh: {cells: 4}\n"
           "time: {dt: 1e-3, steps: 2}\n",
           edited ? 3 : 1 + *data % 3);
  if (edited)
    fuzz_edit("points", good, length, data + 1, size - 1);
  else
    fuzz_write("points", data + 1, size - 1);
  fuzz_write("run.yaml", text, strlen(text));
  struct gx_study *study = gx_runfile_read(fuzz_path("run.yaml"), 0, NULL, &gx_hdf5_arrays, fuzz_quiet());
  for (size_t i = 0; study && i < study->count; i++) fuzz_run(&study->cases[i]);
  gx_runfile_free(study);
  return 0;
}
