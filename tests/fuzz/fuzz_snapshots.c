/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots of a case, damaged as the input says. */
#include <gridcross/series.h>

#include <stdlib.h>

#include "fuzz.h"

static char id[2][17], name[32];
static uint8_t *good;
static size_t length;

static void read_all(void)
{
  static const char *const records[] = {"position", "velocity", "cauchy_stress", "mass", "density"};
  FILE *quiet = fuzz_quiet();
  struct gx_series *series = gx_series_open(fuzz_directory(), id[0], quiet);
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
    fuzz_study(id);
    snprintf(name, sizeof name, "case-%s.h5", id[0]);
    good = fuzz_read(name, &length);
  }
  fuzz_damage(name, good, length, data, size);
  read_all();
  return 0;
}
