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
#include "ranks.h"
#include "summary.h"

static const struct gx_option option[] = {
    GX_COMMAND_SET,
    {'o', "output", "DIR", "where the study goes; default: the run file's name with .study"},
    {'j', "jobs", "N", "threads: cases at once, longest first, and within long 2-D and 3-D cases; default: the processors"},
    {0, "repeats", "N", "time each case in N runs more without measures, and report the median; changes no result"},
    {0, "resume", NULL, "go on with an interrupted run: only the cases that it has not done, and those from their checkpoints"},
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

/* A run, from its options to its study. */
struct running {
  const struct gx_options *options;
  struct gx_ranks *ranks; /* NULL: this process is alone */
  struct gx_store_how how;
  const char *directory;
  const struct gx_study *study;
  size_t jobs;
  bool quiet;
  struct gx_store *store;
  struct gx_queue *queue; /* of the first of ranks */
  struct gx_interrupt interrupt;
  bool broken; /* ended while other ranks go on */
};

/* What is kept, for another run to go on with. */
static void tell_kept(const struct running *run, size_t done, size_t total)
{
  fputs("gridcross run: ", stderr);
  if (atomic_load(&run->interrupt.signal)) fputs("interrupted; ", stderr);
  if (run->ranks)
    fputs("what is", stderr);
  else
    fprintf(stderr, "%zu of %zu cases are", done, total);
  fprintf(stderr, " done%s kept in %s; the same command with --resume goes on\n", run->ranks ? " is" : " and", run->directory);
}

/* The cases are not done, by an error that was told or by a signal that all ranks get, of whom one has told. */
static int end_early(struct running *run)
{
  const int signal = atomic_load(&run->interrupt.signal);
  size_t done = 0, total = 0;
  if (run->store) gx_store_count(run->store, &done, &total); /* a rank that waits for the others has closed its own */
  const int failed = gx_store_close(run->store);
  if (!signal || !run->ranks) tell_kept(run, done, total);
  run->store = NULL;
  run->broken = true;
  return failed || !signal ? GX_EXIT_FAILED : 128 + signal;
}

static int finish(struct running *run, double seconds)
{
  char *command = gx_options_line(run->options);
  if (!command) return gx_command_no_memory();
  const struct gx_store_run about = {.command = command, .seconds = seconds};
  size_t done, total;
  gx_store_count(run->store, &done, &total);
  int failed = gx_store_finish(run->store, &about);
  free(command);
  if (failed) tell_kept(run, done, total);
  gx_store_close(run->store);
  run->store = NULL;
  if (failed) return GX_EXIT_FAILED;
  int code = gx_summary_print(run->options, run->study, run->directory);
  if (!run->quiet) fprintf(stderr, "study: %s\n", run->directory);
  return code;
}

/* The first of ranks makes the directory, then the others join it. */
static int open_store(struct running *run)
{
  const bool first = gx_ranks_first(run->ranks);
  run->how.joins = !first;
  if (first) run->store = gx_store_open(run->directory, run->study, &run->how, stderr);
  int code = gx_ranks_agree(run->ranks, !first || run->store ? 0 : GX_EXIT_USAGE);
  if (code) return code;
  if (!first) run->store = gx_store_open(run->directory, run->study, &run->how, stderr);
  code = gx_ranks_agree(run->ranks, run->store ? 0 : GX_EXIT_USAGE);
  if (!code) code = gx_ranks_alike(run->ranks, gx_store_number(run->store));
  gx_ranks_speak(run->ranks);
  return code;
}

/* Where this rank's cases come from. */
static int serve(struct running *run, struct gx_source *source)
{
  const bool first = gx_ranks_first(run->ranks);
  if (first) run->queue = gx_queue_create(run->study, gx_store_skip(run->store), true);
  const int code =
      first && !run->queue ? gx_command_no_memory() : gx_ranks_serve(run->ranks, run->queue, &run->interrupt.cancel, source);
  run->broken = code;
  return code;
}

/* Of all ranks the first shows what it has given out. */
struct progress_of_ranks {
  struct gx_progress_line *line;
  const struct gx_ranks *ranks;
  size_t total;
};

static void tell_given(void *context, size_t done, size_t total)
{
  const struct progress_of_ranks *progress = context;
  (void)done, (void)total;
  gx_progress_done(progress->line, gx_ranks_given(progress->ranks), progress->total);
}

static int run_cases(struct running *run)
{
  const bool first = gx_ranks_first(run->ranks);
  struct gx_source source;
  if (run->ranks) {
    const int code = serve(run, &source);
    if (code) return code;
  }
  const double start = now();
  struct gx_progress_line line;
  gx_progress_begin(&line, run->quiet || !first, "");
  struct progress_of_ranks shown = {&line, run->ranks, run->queue ? gx_queue_count(run->queue) : 0};
  const struct gx_progress progress = {.context = run->ranks ? (void *)&shown : (void *)&line,
                                       .done = run->ranks ? tell_given : gx_progress_done};
  const struct gx_study_means means = {.threads = run->jobs,
                                       .sink = gx_store_sink(run->store),
                                       .progress = first ? &progress : NULL,
                                       .skip = gx_store_skip(run->store),
                                       .source = run->ranks ? &source : NULL,
                                       .cancel = &run->interrupt.cancel,
                                       .observer = gx_store_observer(run->store)};
  int failed = gx_study_run(run->study, &means);
  gx_progress_end(&line);
  if (!failed && !first) { /* its journal is whole before the first looks for it */
    failed = gx_store_close(run->store);
    run->store = NULL;
    run->broken = failed;
    if (failed) return GX_EXIT_FAILED;
  }
  if (failed || gx_ranks_meet(run->ranks)) return end_early(run);
  return first ? finish(run, now() - start) : GX_EXIT_DONE;
}

static int run_study(struct running *run)
{
  static const char kept[] = "\ngridcross run: interrupted; what is done is kept: the same command with --resume goes on\n";
  const char *herald = run->ranks && gx_ranks_first(run->ranks) ? kept : NULL; /* mpirun may leave no time for more */
  gx_interrupt_begin(&run->interrupt, herald, run->ranks ? NULL : kept);
  int code = open_store(run);
  if (!code) {
    size_t done, total;
    gx_store_count(run->store, &done, &total);
    if (done && !run->quiet && gx_ranks_first(run->ranks))
      fprintf(stderr, "note: %zu of %zu cases are done already\n", done, total);
    code = run_cases(run);
  }
  gx_interrupt_end(&run->interrupt);
  gx_store_close(run->store);
  gx_queue_free(run->queue);
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

/* Reads what the options and the run file say. Returns 0, or an exit code after messages. */
static int prepare(struct running *run, char **directory, struct gx_study **study)
{
  const struct gx_options *options = run->options;
  if (gx_options_value(options, "csv") && gx_options_value(options, "json")) {
    fputs("gridcross run: --csv or --json, not both\n", stderr);
    return GX_EXIT_USAGE;
  }
  if (run->ranks && !strcmp(options->operand[0], "-")) {
    fputs("gridcross run: only one rank has standard input: name a file\n", stderr);
    return GX_EXIT_USAGE;
  }
  if (read_shard(options, &run->how)) return GX_EXIT_USAGE;
  const bool repeated = gx_options_value(options, "repeats");
  run->jobs = gx_command_jobs(options);
  if (!gx_options_value(options, "jobs")) run->jobs = gx_ranks_threads(run->ranks, run->jobs);
  const size_t repeats = run->jobs && repeated ? gx_command_count(options, "repeats") : 0;
  *directory = run->jobs && (repeats || !repeated) ? choose_directory(options, &run->how) : NULL;
  *study = *directory ? gx_command_read(options) : NULL;
  if (!*study) return GX_EXIT_USAGE;
  (*study)->repeats = repeats;
  if ((*study)->duplicates && !run->quiet)
    fprintf(stderr, "note: %zu cases are equal to others and run once\n", (*study)->duplicates);
  if (run->how.shards <= (*study)->count) return 0;
  fprintf(stderr, "gridcross run: --shard %zu/%zu: the study has %zu cases and no more shards\n", run->how.shard, run->how.shards,
          (*study)->count);
  return GX_EXIT_USAGE;
}

static int run(const struct gx_options *options)
{
  struct running run = {.options = options, .quiet = gx_options_value(options, "quiet")};
  struct gx_study *study = NULL;
  char *directory = NULL;
  int code = gx_ranks_begin(&run.ranks, gx_options_value(options, "shard"));
  if (code) return code;
  run.how.resume = gx_options_value(options, "resume");
  run.how.quiet = run.quiet;
  code = gx_ranks_agree(run.ranks, prepare(&run, &directory, &study));
  run.directory = directory;
  run.study = study;
  if (!code) code = run_study(&run);
  if (study) gx_runfile_free(study);
  free(directory);
  gx_ranks_end(run.ranks, run.broken, code);
  return code;
}

static const struct gx_example example[] = {
    {"gridcross run runs/quickstart.yaml", "into ./quickstart.study, and a table"},
    {"gridcross run my.yaml --set 'mesh.cells=[32,64]' --set method.clock=rk4 -o finer",
     "other values for one run, and another place"},
    {"gridcross run my.yaml --csv --no-timing > table.csv", "the whole table, equal bytes on every repetition"},
    {"gridcross run my.yaml --repeats 5 -j 1",
     "costs that can be compared: one case at a time, without measures, median of five"},
    {"mpirun -n 64 gridcross run my.yaml -q", "64 processes on any machines that see the directory, by a build with MPI"},
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
