/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables as CSV, JSON and HDF5, and the study directory that holds them:
 *   study.h5    /table, /histories/<case id>, /spectra/<case id>, /provenance; equal runs give equal bytes
 *   table.csv   the same table
 *   timing.csv  case, seconds, ns_per_particle_step, repeats
 *   run.json    host, date, command, seconds
 * Functions that return int give 0, or -1 after a message to `errors`. */
#ifndef GRIDCROSS_STORE_H
#define GRIDCROSS_STORE_H

#include <stdio.h>

#include <gridcross/study.h>
#include <gridcross/table.h>

/* RFC 4180 with \n line ends. Null is empty; numbers read back bit for bit. The stream's own error flag tells of failure. */
void gx_csv_write(const struct gx_table *table, FILE *out);

/* An array of flat objects; null and numbers that JSON cannot hold are null. */
void gx_json_write(const struct gx_table *table, FILE *out);
/* One row as an object. */
void gx_json_write_object(const struct gx_table *table, size_t row, FILE *out);

/* Writes table, histories, spectra and provenance to a new file at path. In a dataset NaN, the attribute `null` of an integer column,
 * and the null string stand for null. */
int gx_hdf5_write(const char *path, const struct gx_study *study, const struct gx_result *results, const struct gx_table *table,
                  FILE *errors);
/* /table of a file that gx_hdf5_write wrote, NULL after a message. */
struct gx_table *gx_hdf5_read(const char *path, FILE *errors);
/* The study's title, owned by the caller; NULL after a message. */
char *gx_hdf5_read_title(const char *path, FILE *errors);
/* Columns time and `name` ("displacement.rms", "energy.kinetic", ...) of a case's history; NULL after a message. */
struct gx_table *gx_hdf5_read_history(const char *path, const char *id, const char *name, FILE *errors);

/* A case's spectra as gx_study_table_spectra gives them; NULL after a message. */
struct gx_table *gx_hdf5_read_spectra(const char *path, const char *id, FILE *errors);

/* For gx_runfile_read. */
extern const struct gx_array_reader gx_hdf5_arrays;

/* Makes the directory where needed, and checks that a study may be written there: it is empty or holds a study, and is
 * writable. */
int gx_store_prepare(const char *directory, FILE *errors);

struct gx_store_run {
  const char *command; /* borrowed: the command line */
  double seconds;      /* wall time */
};

/* Replaces the study in a prepared directory; a kill leaves the old study or the new one. */
int gx_store_write(const char *directory, const struct gx_study *study, const struct gx_result *results,
                   const struct gx_store_run *run, FILE *errors);
/* The table of a study directory with the timing columns, NULL after a message. */
struct gx_table *gx_store_read(const char *directory, FILE *errors);
/* How many runs the times of a study's cases are medians of, at least; 0: the runs that gave the results were timed. */
long gx_store_read_repeats(const char *directory);
/* The same as gx_hdf5_read_title and gx_hdf5_read_history, of the study in a directory. */
char *gx_store_read_title(const char *directory, FILE *errors);
struct gx_table *gx_store_read_history(const char *directory, const char *id, const char *name, FILE *errors);
/* The spectra that a case of the table kept, NULL after a message; freed by gx_store_free_spectra. table: of gx_store_read. */
struct gx_spectra *gx_store_read_spectra(const char *directory, const struct gx_table *table, size_t row, FILE *errors);
void gx_store_free_spectra(struct gx_spectra *spectra);

#endif
