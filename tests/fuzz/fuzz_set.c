/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts of --set, one a line, on a run file with lists, zip and cases. */
#include <gridcross/store.h>

#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

enum { MOST_SETS = 16, MOST_CASES = 4 };

static const char base[] = "problem: {name: bar-linear, amplitude: [0.01, 0.02]}\n"
                           "mesh: {cells: [2, 4], particles_per_cell: 1}\n"
                           "time: {cfl: [0.1, 0.2], steps: 2}\n"
                           "zip: [mesh.cells, time.cfl]\n"
                           "cases:\n"
                           "  - {method: {space: moving-mesh}}\n"
                           "  - {method: {space: standard, degree: [1, 2]}}\n";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  char *texts = malloc(size + 1);
  if (!texts) return 0;
  memcpy(texts, data, size);
  texts[size] = '\0';
  const char *set[MOST_SETS];
  size_t sets = 0;
  for (char *line = texts; line && sets < MOST_SETS;) {
    char *end = strchr(line, '\n');
    if (end) *end++ = '\0';
    set[sets++] = line;
    line = end;
  }
  fuzz_write("run.yaml", base, sizeof base - 1);
  struct gx_study *study = gx_runfile_read(fuzz_path("run.yaml"), sets, set, &gx_hdf5_arrays, fuzz_quiet());
  for (size_t i = 0; study && i < study->count && i < MOST_CASES; i++) fuzz_run(&study->cases[i]);
  gx_runfile_free(study);
  free(texts);
  return 0;
}
