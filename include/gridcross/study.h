/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study: the cases that a run file expands to, and how to run them. */
#ifndef GRIDCROSS_STUDY_H
#define GRIDCROSS_STUDY_H

#include <stdatomic.h>
#include <stdio.h>

#include <gridcross/budget.h>
#include <gridcross/frequency.h>
#include <gridcross/measure.h>
#include <gridcross/parameter.h>
#include <gridcross/snapshot.h>
#include <gridcross/spectrum.h>
#include <gridcross/status.h>
#include <gridcross/table.h>

enum { GX_ID_LENGTH = 17 };

struct gx_case {
  char id[GX_ID_LENGTH];                /* hash of the resolved parameters, 16 hexadecimal digits */
  struct gx_value value[GX_PARAMETERS]; /* resolved; texts owned by the study */
  const struct gx_points *points;       /* of body.file, owned by the study; NULL: none */
};

/* Reads arrays of numbers from a file, for those who must not know its format. */
struct gx_array_reader {
  /* array: [count] <- what name[i] holds, [rows], owned by the caller, also when it fails; NULL where it is not there. All have as
   * many rows, at most `most`. absent: NULL-ended, names that must not be there. Returns 0, or -1 after messages. */
  int (*read)(const char *path, size_t count, const char *const *name, const char *const *absent, size_t most, double **array,
              size_t *rows, FILE *errors);
};

struct gx_study {
  char *title;  /* owned, "" when absent */
  char *source; /* owned: the run file's text */
  struct gx_case *cases;
  size_t count;
  size_t repeats;                           /* timed runs of each case, see gx_case_time */
  size_t duplicates;                        /* cases that resolved equal to an earlier one and were dropped */
  enum gx_parameter_id axis[GX_PARAMETERS]; /* parameters that the file varies and that differ between cases, in file order */
  size_t axes;
  char **texts; /* texts that values point to, owned */
  size_t text_count;
  struct gx_points **points; /* [point_lists] that cases take their particles from, owned */
  size_t point_lists;
};

/* Reads a run file ("-": standard input) and the lists of points that it names, applies `--set` strings "path=value" in order,
 * validates and expands. hdf5: reads lists that are HDF5 files; NULL: they are refused.
 * Every error goes to `errors` in one pass as file:line:column: message. Returns NULL when there was one. */
struct gx_study *gx_runfile_read(const char *path, size_t sets, const char *const *set, const struct gx_array_reader *hdf5,
                                 FILE *errors);
/* The same of a text; name: what messages call it. */
struct gx_study *gx_runfile_parse(const char *name, const char *text, FILE *errors);
void gx_runfile_free(struct gx_study *study);

struct gx_history {
  size_t samples;
  struct gx_sample *sample;        /* [samples], owned */
  struct gx_probe *probe;          /* [samples], owned; NULL: none asked for */
  int dim;                         /* components of the probe's vectors */
  bool jumps;                      /* jump errors were measured */
  struct gx_budget_values *budget; /* [samples] of the step that ended there, owned; NULL: not asked */
};

struct gx_result {
  struct gx_outcome outcome;
  double dt;         /* s */
  double steps;      /* taken */
  double time;       /* s, reached */
  double stable_dt;  /* s, estimated at the start; 0: no step is stable; NaN: unknown */
  double left_cells; /* most cells at once that quadrature reconstructed left to sums over particles; NaN: does not apply */
  struct gx_measured measured;
  long probe;                                /* index of the particle followed; -1: none */
  double restitution;                        /* of two bodies that have parted; NaN: not so */
  double reference[GX_QUANTITIES][GX_NORMS]; /* final state less that of dt / output.reference; NaN: not asked */
  struct gx_budget_values budget;            /* over the steps that output.budget names; NaN: not asked */
  /* Of processor time in steps, all threads, less measures; of a few steps of few particles, which take less than that takes to read, of
   * time on the wall. NaN: lost in the noise of the measures. */
  double seconds;
  double ns_per_particle_step; /* NaN: no step was taken, or no seconds */
  struct gx_history history;
  struct gx_spectra spectra;
  struct gx_vibration vibration; /* of the driven mode; NaN: not asked for, or none */
  double frequency;              /* of the exact solution, 1/s */
  double kh;                     /* its wavenumber times the width of a cell, rad */
};

/* What a case will do, without running it. */
struct gx_plan {
  struct gx_outcome outcome; /* GX_REFUSED with the reason when it cannot run */
  double dt, end;            /* s */
  double steps, particles;   /* numbers of them */
  double stable_dt;          /* s; 0: no step is stable; NaN: unknown */
  double growth;             /* largest real part of the eigenvalues at the start, 1/s; NaN: unknown */
};

/* Builds the case, so that it can fail for want of memory; once gx_status_quiet_gsl was called. */
struct gx_plan gx_case_plan(const struct gx_case *one);
/* A case in the middle of its steps, for those who keep it to go on with later. */
struct gx_checkpoint {
  double step; /* taken; when it is loaded: of no meaning */
  void *run;
  /* Names everything of the run that an equal case lacks at its start. */
  void (*image)(void *run, struct gx_image *image);
};

/* Watches cases as they run. Called by any of the threads, by several at once for different cases. Where a call fails the case ends with
 * the status cancelled. */
struct gx_observer {
  void *context;
  /* A case that asks for snapshots or checkpoints begins. Returns what the other calls are given; NULL: it fails. */
  void *(*begin)(void *context, const struct gx_case *one);
  /* The start, every n-th step as output.snapshots says, and the last. Returns 0, or other than 0 when it fails. */
  int (*show)(void *watched, const struct gx_snapshot *snapshot);
  /* The case ends, before its result is told; whole: it has a result, whatever its status. Likewise. */
  int (*end)(void *watched, bool whole);
  /* Of output.checkpoint, both or neither. Before the first step: loads what was kept, if there is anything. Returns 1 when it did, 0 when
   * there is none, or less than 0 when that fails. */
  int (*restore)(void *watched, const struct gx_checkpoint *checkpoint);
  /* Every n-th step but the last, after it was shown, and the one that a case is cancelled after. Returns 0, or other than 0 when it fails. */
  int (*keep)(void *watched, const struct gx_checkpoint *checkpoint);
};

/* What a case runs with; all is borrowed, and NULL where there is none. */
struct gx_case_means {
  struct gx_team *team; /* its threads share out the particles of 2-D and 3-D cases; equal bits for any team */
  /* Looked at between steps: once true the case ends with the status cancelled, which is no result. */
  const atomic_bool *cancel;
  const struct gx_observer *observer; /* of output.snapshots and output.checkpoint */
};

/* Runs one case; never aborts, once gx_status_quiet_gsl was called (gx_study_run does). */
struct gx_result gx_case_run(const struct gx_case *one);
/* The same with means. Results then count the processor time of all threads. */
struct gx_result gx_case_run_by(const struct gx_case *one, const struct gx_case_means *means);
/* Runs a case that ended ok as often again without measures, which slow down the steps around them, and sets seconds and
 * ns_per_particle_step to the medians. Changes nothing else, unless it is cancelled. */
void gx_case_time(const struct gx_case *one, const struct gx_case_means *means, size_t repeats, struct gx_result *result);
void gx_case_free(struct gx_result *result);

/* Told after every case, by one thread at a time. total: of those that are run. */
struct gx_progress {
  void *context;
  void (*done)(void *context, size_t done, size_t total);
};

/* Takes the results of a study one by one, as cases end. */
struct gx_sink {
  void *context;
  /* Called once for each case that was run, by any of the threads, by several at once for different cases. What the result owns may
   * be moved out of it; the rest is freed afterwards. Other than 0: no case is begun any more, and those under way are cancelled. */
  int (*done)(void *context, size_t index, struct gx_result *result);
};

/* A sink that keeps everything. results: [count], to be freed by gx_case_free one by one. */
struct gx_sink gx_sink_array(struct gx_result *results);

/* Where the cases to run come from. */
struct gx_source {
  void *context;
  /* The next one, and its share of the cost of all that are left, this one among them; false: there is none. By one thread at a time. */
  bool (*take)(void *context, size_t *index, double *share);
};

/* The cases of a study, longest first by a guess from their parameters, as they stand in the study where that is equal. */
struct gx_queue;

/* skip: [count] cases that are not run, NULL: none; sorted: otherwise as they stand. NULL when memory runs out. */
struct gx_queue *gx_queue_create(const struct gx_study *study, const bool *skip, bool sorted);
void gx_queue_free(struct gx_queue *queue);
/* Cases that were in it at first. */
size_t gx_queue_count(const struct gx_queue *queue);
/* Sources of one queue may be used at the same time. */
struct gx_source gx_queue_source(struct gx_queue *queue);

/* How a study is run. */
struct gx_study_means {
  size_t threads;      /* as many cases at once; a 2-D or 3-D case whose share of what is left is larger has more of them */
  struct gx_sink sink; /* where results go */
  const struct gx_progress *progress; /* borrowed; NULL: none */
  const bool *skip;                   /* [count] cases that are not run, borrowed; NULL: none */
  const struct gx_source *source;     /* borrowed; NULL: all that are not skipped, longest first, or in order on one thread */
  atomic_bool *cancel;                /* set by anyone at any time to end early, borrowed; NULL: nobody does */
  const struct gx_observer *observer; /* of output.snapshots and output.checkpoint, borrowed; NULL: nobody */
};

/* Runs every case, or those that the source gives. Equal bits for any number of threads. Keeps no result. Returns 0, or -1 when it was cancelled or the sink failed:
 * cases that the sink was not told of then have no result. */
int gx_study_run(const struct gx_study *study, const struct gx_study_means *means);

/* Columns case, every parameter, every result; timing columns last and only if asked. results: [count]. NULL when memory runs out. */
struct gx_table *gx_study_table(const struct gx_study *study, const struct gx_result *results, bool timing);
/* The same row by row: `rows` rows of null, and one filled in. Returns 0, or -1 when memory runs out. */
struct gx_table *gx_study_table_begin(size_t rows, bool timing);
int gx_study_table_fill(struct gx_table *table, size_t row, const struct gx_case *one, const struct gx_result *result,
                        bool timing);
/* One row a sample: time, displacement.inf, ..., energy.kinetic, ..., crossings; with output.jumps also jump.step, jump.inf, ...;
 * with output.probe also probe.displacement, ..., in 2-D and 3-D by component, probe.displacement.x. NULL when memory runs out. */
struct gx_table *gx_study_table_history(const struct gx_result *result);
/* One row a sample and bin: time, wavenumber, displacement, velocity, stress. NULL when memory runs out. */
struct gx_table *gx_study_table_spectra(const struct gx_result *result);

#endif
