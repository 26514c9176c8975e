/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross run: a run file to a study on disk and a table. */
#include "command.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <gridcross/store.h>

#include "interrupt.h"
#include "progress.h"
#include "summary.h"

static const struct gx_option option[] = {
    GX_COMMAND_SET,
    {'o', "output", "DIR", "where the study goes; default: the run file's name with .study"},
    {'j', "jobs", "N", "threads: cases at once, longest first, and within long 2-D and 3-D cases; default: the processors"},
    {0, "repeats", "N", "time each case in N runs more without measures, and report the median; changes no result"},
    {0, "resume", NULL, "go on with an interrupted run: only the cases that it has not done"},
    {0, "shard", "i/n", "only every n-th case from the i-th, 1 to n: a study in n parts, to be joined by gridcross merge"},
    {0, "csv", NULL, "print the whole table as CSV"},
    {0, "json", NULL, "print the whole table as JSON"},
    {0, "no-timing", NULL, "print no columns that differ between equal runs"},
    {'q', "quiet", NULL, "no progress and no notes on standard error"},
    {0},
};

/* NAME.study in the working directory, NAME-2-of-5.study for a shard, owned by the caller. */
static char *default_directory(const char *run_file, const struct gx_store_how *how)
{
  const char *slash = strrchr(run_file, '/'), *name = slash ? slash + 1 : run_file, *dot = strrchr(name, '.');
  size_t length = dot && dot > name ? (size_t)(dot - name) : strlen(name);
  char shard[64] = "", *directory = malloc(length + sizeof shard + 10);
  if (how->shards) snprintf(shard, sizeof shard, "-%zu-of-%zu", how->shard, how->shards);
  if (directory) sprintf(directory, "./%.*s%s.study", (int)length, name, shard);
  return directory;
}

static char *choose_directory(const struct gx_options *options, const struct gx_store_how *how)
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
  char *directory = given ? strdup(given) : default_directory(options->operand[0], how);
  if (!directory) gx_command_no_memory();
  return directory;
}

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int end_interrupted(struct gx_store *store, const char *directory, int signal)
{
  size_t done, total;
  gx_store_count(store, &done, &total);
  int failed = gx_store_close(store);
  fprintf(stderr,
          "gridcross run: interrupted; %zu of %zu cases are done and kept in %s; the same command with --resume goes on\n", done,
          total, directory);
  return failed ? GX_EXIT_FAILED : 128 + signal;
}

static int end_failed(struct gx_store *store, const char *directory)
{
  size_t done, total;
  gx_store_count(store, &done, &total);
  gx_store_close(store);
  fprintf(stderr, "gridcross run: %zu of %zu cases are done and kept in %s; the same command with --resume goes on\n", done,
          total, directory);
  return GX_EXIT_FAILED;
}

static int finish(const struct gx_options *options, const struct gx_study *study, struct gx_store *store, const char *directory,
                  double seconds)
{
  char *command = gx_options_line(options);
  if (!command) return gx_command_no_memory();
  const struct gx_store_run about = {.command = command, .seconds = seconds};
  int code = gx_store_finish(store, &about) ? end_failed(store, directory) : GX_EXIT_DONE;
  free(command);
  if (code) return code;
  gx_store_close(store);
  code = gx_summary_print(options, study, directory);
  if (!gx_options_value(options, "quiet")) fprintf(stderr, "study: %s\n", directory);
  return code;
}

static int run_study(const struct gx_options *options, const struct gx_study *study, const char *directory, size_t jobs,
                     const struct gx_store_how *how)
{
  bool quiet = gx_options_value(options, "quiet");
  struct gx_interrupt interrupt;
  gx_interrupt_begin(&interrupt, "\ngridcross run: interrupted; what is done is kept: the same command with --resume goes on\n");
  struct gx_store *store = gx_store_open(directory, study, how, stderr);
  if (!store) {
    gx_interrupt_end(&interrupt);
    return GX_EXIT_USAGE;
  }
  size_t done, total;
  gx_store_count(store, &done, &total);
  if (done && !quiet) fprintf(stderr, "note: %zu of %zu cases are done already\n", done, total);
  double start = now();
  struct gx_progress_line line;
  gx_progress_begin(&line, quiet, "");
  const struct gx_progress progress = {.context = &line, .done = gx_progress_done};
  const struct gx_study_means means = {.threads = jobs,
                                       .sink = gx_store_sink(store),
                                       .progress = &progress,
                                       .skip = gx_store_skip(store),
                                       .cancel = &interrupt.cancel,
                                       .observer = gx_store_observer(store)};
  int failed = gx_study_run(study, &means);
  gx_progress_end(&line);
  int code = !failed                          ? finish(options, study, store, directory, now() - start)
             : atomic_load(&interrupt.signal) ? end_interrupted(store, directory, atomic_load(&interrupt.signal))
                                              : end_failed(store, directory);
  gx_interrupt_end(&interrupt);
  return code;
}

/* "2/5" of --shard. Returns 0, or an exit code after a message. */
static int read_shard(const struct gx_options *options, struct gx_store_how *how)
{
  const char *given = gx_options_value(options, "shard");
  if (!given) return 0;
  char *slash, *end = NULL;
  long shard = isdigit((unsigned char)*given) ? strtol(given, &slash, 10) : 0, shards = 0;
  if (shard && *slash == '/' && isdigit((unsigned char)slash[1])) shards = strtol(slash + 1, &end, 10);
  if (end && !*end && shard >= 1 && shard <= shards && shards <= 1000000) {
    how->shard = (size_t)shard;
    how->shards = (size_t)shards;
    return 0;
  }
  fprintf(stderr, "gridcross run: --shard takes i/n, which of how many, as 1/4 to 4/4, not '%s'\n", given);
  return GX_EXIT_USAGE;
}

static int run(const struct gx_options *options)
{
  if (gx_options_value(options, "csv") && gx_options_value(options, "json")) {
    fputs("gridcross run: --csv or --json, not both\n", stderr);
    return GX_EXIT_USAGE;
  }
  struct gx_store_how how = {.resume = gx_options_value(options, "resume")};
  int code = read_shard(options, &how);
  if (code) return code;
  bool repeated = gx_options_value(options, "repeats");
  size_t jobs = gx_command_jobs(options), repeats = jobs && repeated ? gx_command_count(options, "repeats") : 0;
  char *directory = jobs && (repeats || !repeated) ? choose_directory(options, &how) : NULL;
  struct gx_study *study = directory ? gx_command_read(options) : NULL;
  if (study) study->repeats = repeats;
  code = GX_EXIT_USAGE;
  if (study && study->duplicates && !gx_options_value(options, "quiet"))
    fprintf(stderr, "note: %zu cases are equal to others and run once\n", study->duplicates);
  if (study && how.shards > study->count)
    fprintf(stderr, "gridcross run: --shard %zu/%zu: the study has %zu cases and no more shards\n", how.shard, how.shards,
            study->count);
  else if (study)
    code = run_study(options, study, directory, jobs, &how);
  if (study) gx_runfile_free(study);
  free(directory);
  return code;
}

static const struct gx_example example[] = {
    {"gridcross run runs/quickstart.yaml", "into ./quickstart.study, and a table"},
    {"gridcross run my.yaml --set mesh.cells=[32,64] --set method.clock=rk4 -o finer",
     "other values for one run, and another place"},
    {"gridcross run my.yaml --csv --no-timing > table.csv", "the whole table, equal bytes on every repetition"},
    {"gridcross run my.yaml --repeats 5 -j 1",
     "costs that can be compared: one case at a time, without measures, median of five"},
    {0},
};

const struct gx_command gx_command_run = {
    .name = "run",
    .operands = "FILE.yaml",
    .least = 1,
    .most = 1,
    .help = "Run every case of a run file (-: standard input), write the study, and print a table.",
    .option = option,
    .example = example,
    .run = run,
};
