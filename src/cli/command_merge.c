/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross merge: shards of a study to the study. */
#include "command.h"

#include <stdlib.h>

#include <gridcross/store.h>

static const struct gx_option option[] = {
    {'o', "output", "DIR", "where the study goes; needed"},
    {'q', "quiet", NULL, "no notes on standard error"},
    {0},
};

static int run(const struct gx_options *options)
{
  const char *directory = gx_options_value(options, "output");
  if (!directory || !*directory) {
    fputs("gridcross merge: -o DIR says where the study goes\n", stderr);
    return GX_EXIT_USAGE;
  }
  char *line = gx_options_line(options);
  if (!line) return gx_command_no_memory();
  int code = gx_store_merge(options->operands, options->operand, directory, line, stderr) ? GX_EXIT_USAGE : GX_EXIT_DONE;
  free(line);
  if (!code && !gx_options_value(options, "quiet")) fprintf(stderr, "study: %s\n", directory);
  return code;
}

static const struct gx_example example[] = {
    {"gridcross merge choice-*-of-4.study -o choice.study", "what run --shard 1/4 to 4/4 have left, on as many machines"},
    {0},
};

const struct gx_command gx_command_merge = {
    .name = "merge",
    .operands = "DIR...",
    .least = 1,
    .most = -1,
    .help = "Join the shards that run --shard has left into the study of one run, byte for byte.",
    .option = option,
    .example = example,
    .run = run,
};
