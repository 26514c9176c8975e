/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross run: a run file to a study on disk and a table. */
#include "command.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <gridcross/store.h>

#include "../view/axes.h"
#include "../view/sheet.h"
#include "progress.h"

static const struct gx_option option[] = {
    GX_COMMAND_SET,
    {'o', "output", "DIR", "where the study goes; default: the run file's name with .study"},
    {'j', "jobs", "N", "threads: so many cases at once, what is left over within 2-D and 3-D cases; default: the processors"},
    {0, "repeats", "N", "time each case in N runs more without measures, and report the median; changes no result"},
    {0, "csv", NULL, "print the whole table as CSV"},
    {0, "json", NULL, "print the whole table as JSON"},
    {0, "no-timing", NULL, "print no columns that differ between equal runs"},
    {'q', "quiet", NULL, "no progress and no notes on standard error"},
    {0},
};

/* NAME.study in the working directory, owned by the caller. */
static char *default_directory(const char *run_file)
{
  const char *slash = strrchr(run_file, '/'), *name = slash ? slash + 1 : run_file, *dot = strrchr(name, '.');
  size_t length = dot && dot > name ? (size_t)(dot - name) : strlen(name);
  char *directory = malloc(length + 10);
  if (directory) sprintf(directory, "./%.*s.study", (int)length, name);
  return directory;
}

static char *choose_directory(const struct gx_options *options)
{
  const char *given = gx_options_value(options, "output");
  bool stream = !strcmp(options->operand[0], "-");
  if (given && !*given) {
    fputs("gridcross run: -o names no directory\n", stderr);
    return NULL;
  }
  if (!given && stream) {
    fputs("gridcross run: a run file from standard input needs -o DIR\n", stderr);
    return NULL;
  }
  char *directory = given ? strdup(given) : default_directory(options->operand[0]);
  if (!directory) gx_command_no_memory();
  return directory;
}

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Time and particle matter where a case did not end well, restitution where there is one, timing where it was asked for. */
static bool is_shown(const struct gx_table *table, const char *name, bool timing)
{
  if (!strcmp(name, "result.ns_per_particle_step")) return timing;
  if (strcmp(name, "result.time") != 0 && strcmp(name, "result.restitution") != 0) return true;
  long c = gx_table_find(table, strcmp(name, "result.time") ? name : "result.reason");
  for (size_t row = 0; row < table->rows; row++)
    if (gx_table_get(table, row, (size_t)c).type != GX_NULL) return true;
  return false;
}

/* What varies and what matters most. */
static struct gx_table *summary(const struct gx_table *table, bool timing)
{
  static const char *const shown[] = {"result.status",       "result.displacement.max.rms",
                                      "result.restitution",  "result.crossings",
                                      "result.energy.drift", "result.dt",
                                      "result.stable_dt",    "result.ns_per_particle_step",
                                      "result.time",         "result.particle",
                                      "result.reason"};
  size_t *column = calloc(table->columns + sizeof shown / sizeof *shown, sizeof *column);
  long count = column ? gx_axes_find(table, 0, column) : -1;
  for (size_t i = 0; i < sizeof shown / sizeof *shown && count >= 0; i++) {
    long c = gx_table_find(table, shown[i]);
    if (c >= 0 && is_shown(table, shown[i], timing)) column[count++] = (size_t)c;
  }
  struct gx_table *short_table = count < 0 ? NULL : gx_table_create((size_t)count, table->rows);
  int failed = !short_table;
  for (long c = 0; c < count && !failed; c++) failed = gx_table_copy(short_table, (size_t)c, table, column[c]);
  free(column);
  if (!failed) return short_table;
  gx_table_free(short_table);
  return NULL;
}

/* "quadrature dominates, 10.9 times the next, time" */
static void print_dominant(const struct gx_budget_values *budget, enum gx_budget_entry of, const char *what, const char *gap)
{
  enum gx_budget_entry next, largest = gx_budget_dominant(budget, of, &next);
  if (largest == GX_BUDGET_ENTRIES) return;
  printf("%sin %s %s dominates", gap, what, gx_sheet_leaf(gx_budget_columns[largest].name));
  if (next == GX_BUDGET_ENTRIES) return;
  printf(", %.3g times the next, %s", budget->value[largest] / budget->value[next], gx_sheet_leaf(gx_budget_columns[next].name));
}

/* One line a case: which term of the error of a step dominates, and by how much. */
static void print_budgets(const struct gx_study *study, const struct gx_result *results)
{
  for (size_t i = 0; i < study->count; i++) {
    enum gx_budget_entry next;
    if (gx_budget_dominant(&results[i].budget, GX_BUDGET_VELOCITY_STEP, &next) == GX_BUDGET_ENTRIES) continue;
    printf("error of a step");
    for (size_t a = 0; a < study->axes; a++) {
      const char *path = gx_parameters[study->axis[a]].path;
      char text[GX_NUMBER_LENGTH];
      printf(", %s %s", gx_sheet_leaf(path), gx_sheet_text(path, study->cases[i].value[study->axis[a]], text));
    }
    print_dominant(&results[i].budget, GX_BUDGET_VELOCITY_STEP, "velocity", ": ");
    print_dominant(&results[i].budget, GX_BUDGET_DISPLACEMENT_STEP, "displacement", "; ");
    putchar('\n');
  }
}

static int print_table(const struct gx_options *options, const struct gx_study *study, const struct gx_result *results)
{
  bool timing = !gx_options_value(options, "no-timing");
  struct gx_table *table = gx_study_table(study, results, timing), *brief = NULL;
  int failed = !table;
  if (!failed && gx_options_value(options, "csv")) {
    gx_csv_write(table, stdout);
  } else if (!failed && gx_options_value(options, "json")) {
    gx_json_write(table, stdout);
  } else if (!failed) {
    brief = summary(table, timing);
    failed = !brief || gx_command_print(brief);
    if (!failed) print_budgets(study, results);
  }
  gx_table_free(brief);
  gx_table_free(table);
  return failed ? gx_command_no_memory() : GX_EXIT_DONE;
}

static void warn_unstable(const struct gx_study *study, const struct gx_result *results)
{
  size_t above = 0;
  for (size_t i = 0; i < study->count; i++) {
    if (!(results[i].dt > results[i].stable_dt) || above++ >= 10) continue;
    if (results[i].stable_dt == 0)
      fprintf(stderr, "warning: case %s: no time step is stable for this clock with projection each-step; use projection once\n",
              study->cases[i].id);
    else
      fprintf(stderr, "warning: case %s: dt = %.4g s is above the largest stable step, about %.4g s\n", study->cases[i].id,
              results[i].dt, results[i].stable_dt);
  }
  if (above > 10) fprintf(stderr, "warning: and %zu cases more\n", above - 10);
}

static int report(const struct gx_options *options, const struct gx_study *study, const struct gx_result *results,
                  const char *directory)
{
  int code = print_table(options, study, results);
  for (size_t i = 0; i < study->count; i++) {
    if (results[i].outcome.status != GX_FAILED) continue;
    fprintf(stderr, "gridcross run: case %s failed: %s\n", study->cases[i].id, results[i].outcome.reason);
    code = GX_EXIT_FAILED;
  }
  if (gx_options_value(options, "quiet")) return code;
  warn_unstable(study, results);
  fprintf(stderr, "study: %s\n", directory);
  return code;
}

static int run_study(const struct gx_options *options, const struct gx_study *study, const char *directory, size_t jobs)
{
  struct gx_result *results = calloc(study->count + 1, sizeof *results);
  char *command = gx_options_line(options);
  int code = GX_EXIT_FAILED;
  if (!results || !command) {
    gx_command_no_memory();
  } else {
    double start = now();
    struct gx_progress_line line;
    gx_progress_begin(&line, gx_options_value(options, "quiet"), "");
    const struct gx_progress progress = {.context = &line, .done = gx_progress_done};
    gx_study_run(study, &(struct gx_study_means){.threads = jobs, .sink = gx_sink_array(results), .progress = &progress});
    gx_progress_end(&line);
    const struct gx_store_run about = {.command = command, .seconds = now() - start};
    int stored = gx_store_write(directory, study, results, &about, stderr);
    code = report(options, study, results, directory);
    if (stored) code = GX_EXIT_FAILED;
  }
  for (size_t i = 0; results && i < study->count; i++) gx_case_free(&results[i]);
  free(results);
  free(command);
  return code;
}

static int run(const struct gx_options *options)
{
  if (gx_options_value(options, "csv") && gx_options_value(options, "json")) {
    fputs("gridcross run: --csv or --json, not both\n", stderr);
    return GX_EXIT_USAGE;
  }
  bool repeated = gx_options_value(options, "repeats");
  size_t jobs = gx_command_jobs(options), repeats = jobs && repeated ? gx_command_count(options, "repeats") : 0;
  char *directory = jobs && (repeats || !repeated) ? choose_directory(options) : NULL;
  struct gx_study *study = directory ? gx_command_read(options) : NULL;
  if (study) study->repeats = repeats;
  int code = GX_EXIT_USAGE;
  if (study && study->duplicates && !gx_options_value(options, "quiet"))
    fprintf(stderr, "note: %zu cases are equal to others and run once\n", study->duplicates);
  if (study && !gx_store_prepare(directory, stderr)) code = run_study(options, study, directory, jobs);
  if (study) gx_runfile_free(study);
  free(directory);
  return code;
}

const struct gx_command gx_command_run = {
    .name = "run",
    .operands = "FILE.yaml",
    .least = 1,
    .most = 1,
    .help = "Run every case of a run file (-: standard input), write the study, and print a table.",
    .option = option,
    .run = run,
};
