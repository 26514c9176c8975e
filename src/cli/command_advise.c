/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross advise: the cheapest cases of studies that meet an error. */
#include "command.h"

#include <stdlib.h>

#include <gridcross/advise.h>
#include <gridcross/store.h>

#include "../study/number.h"

static const struct gx_option option[] = {
    {0, "error", "VALUE", "the error to meet; as often as wanted; without it the front alone"},
    {0, "value", "COLUMN", "the error; default: result.displacement.max.rms"},
    {0, "csv", NULL, "print the front as CSV, with reasons and the run file of each case"},
    {0, "json", NULL, "the same as JSON"},
    {0, "yaml", NULL, "print the cheapest cases as a run file, to run them again"},
    GX_COMMAND_WHERE,
    {0},
};

static int show(const struct gx_options *options, const struct gx_advice *advice)
{
  bool csv = gx_options_value(options, "csv"), json = gx_options_value(options, "json");
  if (gx_options_value(options, "yaml")) return gx_advise_write(advice, stdout, stderr) ? GX_EXIT_USAGE : GX_EXIT_DONE;
  const struct gx_page page = gx_terminal_page(stdout);
  if (!csv && !json) return gx_advise_print(advice, &page, stdout, stderr) ? GX_EXIT_USAGE : GX_EXIT_DONE;
  struct gx_table *table = gx_advise_table(advice, stderr);
  if (!table) return GX_EXIT_USAGE;
  if (csv)
    gx_csv_write(table, stdout);
  else
    gx_json_write(table, stdout);
  gx_table_free(table);
  return GX_EXIT_DONE;
}

/* Returns 0, or an exit code after a message. */
static int read_bounds(const struct gx_options *options, size_t count, const char *const *text, double *bound)
{
  for (size_t b = 0; b < count; b++) {
    const char *problem = gx_number_real(text[b], &bound[b]);
    if (!problem && bound[b] > 0) continue;
    fprintf(stderr, "gridcross %s: --error takes a positive number, not '%s'\n", options->command->name, text[b]);
    return GX_EXIT_USAGE;
  }
  return GX_EXIT_DONE;
}

/* Measures between the steps slow cheap methods down, so that a front of such costs favours the others. */
static void note_repeats(const struct gx_options *options)
{
  for (size_t s = 0; s < options->operands; s++)
    if (!gx_store_read_repeats(options->operand[s]))
      fprintf(stderr,
              "note: %s was timed once, with its measures around the steps; gridcross run --repeats 5 times the steps alone\n",
              options->operand[s]);
}

static int run(const struct gx_options *options)
{
  if (!!gx_options_value(options, "csv") + !!gx_options_value(options, "json") + !!gx_options_value(options, "yaml") > 1) {
    fputs("gridcross advise: --csv, --json or --yaml, not two of them\n", stderr);
    return GX_EXIT_USAGE;
  }
  struct gx_command_studies studies = {0};
  const char **text = calloc(options->count + 1, sizeof *text);
  double *bound = calloc(options->count + 1, sizeof *bound);
  size_t bounds = text ? gx_options_values(options, "error", text) : 0;
  int code = text && bound ? read_bounds(options, bounds, text, bound) : gx_command_no_memory();
  if (!code) code = gx_command_studies_read(&studies, options, options->operands);
  if (!code) {
    note_repeats(options);
    const struct gx_advice advice = {
        .studies = studies.count,
        .table = (const struct gx_table *const *)studies.table,
        .name = (const char *const *)studies.name,
        .value = gx_options_value(options, "value"),
        .bounds = bounds,
        .bound = bound,
    };
    code = show(options, &advice);
  }
  gx_command_studies_free(&studies);
  free(text);
  free(bound);
  return code;
}

static const struct gx_example example[] = {
    {"gridcross advise choice.study --error 1e-3 --error 1e-6", "the cheapest case for each, as a run file, and why"},
    {"gridcross advise choice.study --error 1e-6 --yaml > best.yaml", "to run it again"},
    {0},
};

const struct gx_command gx_command_advise = {
    .name = "advise",
    .operands = "DIR...",
    .least = 1,
    .most = -1,
    .help = "Find the cheapest cases of studies that meet an error, the error-cost front, and why.",
    .option = option,
    .example = example,
    .run = run,
};
