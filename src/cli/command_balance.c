/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross balance: the time step at which space and time errors of one step meet. */
#include "command.h"

#include <stdlib.h>
#include <string.h>

#include <gridcross/balance.h>
#include <gridcross/store.h>

#include "../view/sheet.h"

static const struct gx_option option[] = {
    GX_COMMAND_SET,
    {'j', "jobs", "N", "threads: cases at once, longest first, and within long 2-D and 3-D cases; default: the processors"},
    {0, "csv", NULL, "print one line a method as CSV, with all digits"},
    {0, "json", NULL, "the same as JSON"},
    {0},
};

/* The table without its advice, then that, method by method. */
static int print_sheet(const struct gx_table *table)
{
  size_t advice = table->columns - 1;
  struct gx_table *sheet = gx_table_create(advice, table->rows);
  int failed = !sheet;
  for (size_t c = 0; c < advice && !failed; c++) failed = gx_table_copy(sheet, c, table, c);
  if (!failed) failed = gx_command_print(sheet);
  for (size_t r = 0; r < table->rows && !failed; r++) {
    const char *gap = "\n";
    for (size_t c = 0; strcmp(table->column[c].name, "mesh.cells") != 0; c++, gap = ", ") {
      char text[GX_NUMBER_LENGTH];
      printf("%s%s %s", gap, gx_sheet_leaf(table->column[c].name),
             gx_sheet_text(table->column[c].name, gx_table_get(table, r, c), text));
    }
    struct gx_value value = gx_table_get(table, r, advice);
    printf("%s%s\n", *gap == '\n' ? "\n" : ": ", value.type == GX_TEXT ? value.text : "-");
  }
  gx_table_free(sheet);
  return failed ? gx_command_no_memory() : GX_EXIT_DONE;
}

static int print(const struct gx_options *options, const struct gx_table *table)
{
  if (!gx_options_value(options, "csv") && !gx_options_value(options, "json")) return print_sheet(table);
  if (gx_options_value(options, "csv"))
    gx_csv_write(table, stdout);
  else
    gx_json_write(table, stdout);
  return GX_EXIT_DONE;
}

static int balance(const struct gx_options *options, struct gx_study *study, size_t jobs)
{
  const char *file = options->operand[0];
  if (gx_balance_prepare(study, file, stderr)) return GX_EXIT_USAGE;
  struct gx_result *results = calloc(study->count + 1, sizeof *results);
  if (!results) return gx_command_no_memory();
  gx_study_run(study, &(struct gx_study_means){.threads = jobs, .sink = gx_sink_array(results)});
  int code = GX_EXIT_DONE;
  for (size_t i = 0; i < study->count && !code; i++) {
    if (results[i].outcome.status != GX_FAILED) continue;
    fprintf(stderr, "gridcross balance: %s\n", results[i].outcome.reason);
    code = GX_EXIT_FAILED;
  }
  struct gx_table *all = code ? NULL : gx_study_table(study, results, false), *table = NULL;
  if (!code && !all) code = gx_command_no_memory();
  if (!code) {
    table = gx_balance_table(all, file, stderr);
    code = table ? print(options, table) : GX_EXIT_USAGE;
  }
  for (size_t i = 0; i < study->count; i++) gx_case_free(&results[i]);
  gx_table_free(table);
  gx_table_free(all);
  free(results);
  return code;
}

static int run(const struct gx_options *options)
{
  if (gx_options_value(options, "csv") && gx_options_value(options, "json")) {
    fputs("gridcross balance: --csv or --json, not both\n", stderr);
    return GX_EXIT_USAGE;
  }
  size_t jobs = gx_command_jobs(options);
  struct gx_study *study = jobs ? gx_command_read(options) : NULL;
  int code = study ? balance(options, study, jobs) : GX_EXIT_USAGE;
  if (study) gx_runfile_free(study);
  return code;
}

static const struct gx_example example[] = {
    {"gridcross balance runs/balance.yaml", "where a smaller step no longer pays"},
    {0},
};

const struct gx_command gx_command_balance = {
    .name = "balance",
    .operands = "FILE.yaml",
    .least = 1,
    .most = 1,
    .help = "Fit space and time errors of one step over mesh.cells and time.dt, and find the step where they meet.",
    .option = option,
    .example = example,
    .run = run,
};
