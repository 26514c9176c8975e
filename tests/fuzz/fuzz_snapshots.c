/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots of a case. The first byte says whether the file is damaged, or a sound HDF5 file of other contents. */
#include <gridcross/series.h>

#include <stdlib.h>
#include <string.h>

#include "edit.h"
#include "fuzz.h"

static char name[64], id[GX_ID_LENGTH];
static uint8_t *good;
static size_t length;

static void read_all(void)
{
  static const char *const records[] = {"position", "velocity", "cauchy_stress", "mass", "density"};
  FILE *quiet = fuzz_quiet();
  struct gx_series *series = gx_series_open(fuzz_path("study"), id, quiet);
  for (size_t i = 0; series && i < series->count && i < 4; i++)
    for (int set = 0; set < GX_SERIES_SETS; set++)
      for (size_t r = 0; r < sizeof records / sizeof *records; r++) {
        gx_series_offset(series, i, (enum gx_series_set)set, records[r]);
        free(gx_series_read(series, i, (enum gx_series_set)set, records[r], 0, quiet));
      }
  gx_series_close(series);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  if (!good) {
    struct gx_study *study = fuzz_study("study", 0, 0);
    memcpy(id, study->cases[0].id, sizeof id);
    gx_runfile_free(study);
    snprintf(name, sizeof name, "study/case-%s.h5", id);
    good = fuzz_read(name, &length);
  }
  const bool edited = size && *data % 4;
  if (size) data++, size--;
  if (edited)
    fuzz_edit(name, good, length, data, size);
  else
    fuzz_damage(name, good, length, data, size);
  read_all();
  return 0;
}
