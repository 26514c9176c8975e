/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What commands share. */
#include "command.h"

#include <stdlib.h>

int gx_command_no_memory(void)
{
  fputs("gridcross: out of memory\n", stderr);
  return GX_EXIT_FAILED;
}

struct gx_study *gx_command_read(const struct gx_options *options)
{
  const char **set = calloc(options->count + 1, sizeof *set);
  if (!set) {
    gx_command_no_memory();
    return NULL;
  }
  size_t sets = gx_options_values(options, "set", set);
  struct gx_study *study = gx_runfile_read(options->operand[0], sets, set, stderr);
  free(set);
  return study;
}
