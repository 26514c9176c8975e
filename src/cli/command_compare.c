/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross compare: studies side by side. */
#include "command.h"

#include <stdlib.h>

#include <gridcross/compare.h>
#include <gridcross/store.h>

static const struct gx_option option[] = {
    {0, "rows", "PATH", "parameter that runs down; default: mesh.cells where it varies, else time.dt, time.cfl, ..."},
    {0, "columns", "PATH", "parameter that runs across; as often as wanted; default: all that vary but the rows"},
    {0, "value", "COLUMN", "column to show; as often as wanted; default: result.displacement.max.rms"},
    {0, "csv", NULL, "print one line a case as CSV, with all digits"},
    {0, "json", NULL, "the same as JSON"},
    GX_COMMAND_WHERE,
    {0},
};

static int show(const struct gx_options *options, const struct gx_comparison *comparison)
{
  bool csv = gx_options_value(options, "csv"), json = gx_options_value(options, "json");
  const struct gx_page page = gx_terminal_page(stdout);
  if (!csv && !json) return gx_compare_print(comparison, &page, stdout, stderr) ? GX_EXIT_USAGE : GX_EXIT_DONE;
  struct gx_table *table = gx_compare_table(comparison, stderr);
  if (!table) return GX_EXIT_USAGE;
  if (csv)
    gx_csv_write(table, stdout);
  else
    gx_json_write(table, stdout);
  gx_table_free(table);
  return GX_EXIT_DONE;
}

static int compare(const struct gx_options *options, const struct gx_command_studies *studies, const char **column,
                   const char **value)
{
  const struct gx_comparison comparison = {
      .studies = studies->count,
      .table = (const struct gx_table *const *)studies->table,
      .name = (const char *const *)studies->name,
      .rows = gx_options_value(options, "rows"),
      .columns = gx_options_values(options, "columns", column),
      .column = column,
      .values = gx_options_values(options, "value", value),
      .value = value,
  };
  return show(options, &comparison);
}

static int run(const struct gx_options *options)
{
  if (gx_options_value(options, "csv") && gx_options_value(options, "json")) {
    fputs("gridcross compare: --csv or --json, not both\n", stderr);
    return GX_EXIT_USAGE;
  }
  struct gx_command_studies studies;
  int code = gx_command_studies_read(&studies, options, options->operands);
  const char **column = calloc(options->count + 1, sizeof *column), **value = calloc(options->count + 1, sizeof *value);
  if (!column || !value)
    code = gx_command_no_memory();
  else if (!code)
    code = compare(options, &studies, column, value);
  gx_command_studies_free(&studies);
  free(column);
  free(value);
  return code;
}

static const struct gx_example example[] = {
    {"gridcross compare quickstart.study", "error by mesh.cells, methods side by side, orders between rows"},
    {"gridcross compare quickstart.study --rows method.degree --value result.energy.drift", "another question to the same study"},
    {"gridcross compare old.study new.study --where method.space=standard", "the same cases of two studies"},
    {0},
};

const struct gx_command gx_command_compare = {
    .name = "compare",
    .operands = "DIR...",
    .least = 1,
    .most = -1,
    .help = "Show studies side by side, with observed orders between rows that refine.",
    .option = option,
    .example = example,
    .run = run,
};
