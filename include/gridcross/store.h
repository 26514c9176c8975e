/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables as CSV, JSON and HDF5, and the study directory that holds them:
 *   study.h5    /table, /histories/<case id>, /spectra/<case id>, /provenance; equal runs give equal bytes
 *   table.csv   the same table
 *   timing.csv  case, seconds, ns_per_particle_step, repeats
 *   run.json    host, date, command, seconds
 *   case-<id>.h5, .xmf, -grid.xmf   snapshots, see <gridcross/recorder.h>
 * Functions that return int give 0, or -1 after a message to `errors`. */
#ifndef GRIDCROSS_STORE_H
#define GRIDCROSS_STORE_H

#include <stdint.h>
#include <stdio.h>

#include <gridcross/study.h>
#include <gridcross/table.h>

/* RFC 4180 with \n line ends. Null is empty; numbers read back bit for bit. The stream's own error flag tells of failure. */
void gx_csv_write(const struct gx_table *table, FILE *out);
/* The same by pieces, of the first columns and rows. */
void gx_csv_write_head(const struct gx_table *table, size_t columns, FILE *out);
void gx_csv_write_rows(const struct gx_table *table, size_t columns, size_t rows, FILE *out);

/* An array of flat objects; null and numbers that JSON cannot hold are null. */
void gx_json_write(const struct gx_table *table, FILE *out);
/* The same by pieces, of the first columns; then its end. */
void gx_json_write_rows(const struct gx_table *table, size_t columns, bool first, FILE *out);
void gx_json_write_end(FILE *out);
/* One row as an object. */
void gx_json_write_object(const struct gx_table *table, size_t row, FILE *out);

/* /table of a study.h5, NULL after a message. */
struct gx_table *gx_hdf5_read(const char *path, FILE *errors);
/* What a study keeps of where it comes from: title, run_file, version, git_revision, compiler, flags, gsl, fftw, hdf5 or yaml, owned
 * by the caller; NULL after a message. */
char *gx_hdf5_read_provenance(const char *path, const char *name, FILE *errors);
/* Columns time and `name` ("displacement.rms", "energy.kinetic", ...) of a case's history; NULL after a message. */
struct gx_table *gx_hdf5_read_history(const char *path, const char *id, const char *name, FILE *errors);

/* A case's spectra as gx_study_table_spectra gives them; NULL after a message. */
struct gx_table *gx_hdf5_read_spectra(const char *path, const char *id, FILE *errors);

/* For gx_runfile_read. */
extern const struct gx_array_reader gx_hdf5_arrays;

/* Makes the directory where needed, and checks that a study may be written there: it is empty or holds a study. */
int gx_store_prepare(const char *directory, FILE *errors);

struct gx_store_run {
  const char *command; /* borrowed: the command line */
  double seconds;      /* wall time */
};

/* Replaces the study in a prepared directory; a kill leaves the old study or the new one. */
int gx_store_write(const char *directory, const struct gx_study *study, const struct gx_result *results,
                   const struct gx_store_run *run, FILE *errors);

/* How a study is run into a directory. */
struct gx_store_how {
  bool resume;          /* goes on with what is there, which must be of the same study; if not, nothing may be under way there */
  size_t shard, shards; /* only cases k with k mod shards = shard - 1; shards 0: all */
  bool quiet;           /* no notes of cases that go on from their checkpoints */
  bool joins; /* one more writer beside the one that opened the directory first: a journal of its own and nothing else */
};

/* A directory that a study is run into. Each result is on disk as soon as its case has ended, in a journal; a kill at any instant
 * loses only the cases under way. */
struct gx_store;

/* Prepares the directory, and keeps others from it. directory is copied, the rest borrowed until it is closed. NULL after a
 * message. */
struct gx_store *gx_store_open(const char *directory, const struct gx_study *study, const struct gx_store_how *how, FILE *errors);
/* Equal for writers of one study by one build. */
uint64_t gx_store_number(const struct gx_store *store);
/* [study->count] cases that are not to be run: they have a result, or belong to another shard. */
const bool *gx_store_skip(const struct gx_store *store);
struct gx_sink gx_store_sink(struct gx_store *store);
/* Keeps what output.snapshots and output.checkpoint ask for, as <gridcross/recorder.h> says. */
const struct gx_observer *gx_store_observer(const struct gx_store *store);
/* Cases that have a result, and all that this run is about, without those of other shards. */
void gx_store_count(struct gx_store *store, size_t *done, size_t *total);
/* Puts the study together from all journals, in the order of its cases, and removes them. Nothing is lost when it fails. Once all
 * writers are done. */
int gx_store_finish(struct gx_store *store, const struct gx_store_run *run);
/* Flushes what there is to disk, for another run to go on with. */
int gx_store_close(struct gx_store *store);

/* Joins the shards of a study, each in a directory, into one that holds the study as an undivided run would have left it, byte for
 * byte, with its snapshots. command: the command line. */
int gx_store_merge(size_t shards, const char *const *shard, const char *directory, const char *command, FILE *errors);

/* The table of a study directory piece by piece, with the timing columns. column: [columns] that are wanted, "case" among them where a
 * timing column is; NULL: all. Without a timing column among them there are none. NULL after a message. errors is borrowed to the end. */
struct gx_store_rows *gx_store_rows_begin(const char *directory, size_t columns, const char *const *column, FILE *errors);
size_t gx_store_rows_total(const struct gx_store_rows *rows);
/* The next rows, so many or what is left; NULL after a message. */
struct gx_table *gx_store_rows_next(struct gx_store_rows *rows, size_t most);
void gx_store_rows_end(struct gx_store_rows *rows);
/* The table of a study directory with the timing columns, NULL after a message. */
struct gx_table *gx_store_read(const char *directory, FILE *errors);
/* How many runs the times of a study's cases are medians of, at least; 0: the runs that gave the results were timed. */
long gx_store_read_repeats(const char *directory);
/* The same as gx_hdf5_read_provenance and gx_hdf5_read_history, of the study in a directory. */
char *gx_store_read_provenance(const char *directory, const char *name, FILE *errors);
struct gx_table *gx_store_read_history(const char *directory, const char *id, const char *name, FILE *errors);
/* The spectra that a case of the table kept, NULL after a message; freed by gx_store_free_spectra. table: of gx_store_read. */
struct gx_spectra *gx_store_read_spectra(const char *directory, const struct gx_table *table, size_t row, FILE *errors);
void gx_store_free_spectra(struct gx_spectra *spectra);

#endif
