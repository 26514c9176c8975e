/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joining shards: case k of a study is row k div n of shard k mod n + 1. */
#include <gridcross/store.h>

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <gridcross/recorder.h>

#include "assembly.h"
#include "journals.h"
#include "seal.h"
#include "store_rows.h"

enum { MOST_SHARDS = 1000000 };                             /* as many as a study may have cases */
enum { FEW = 8, BUFFERED = 16384, LEAST = 16, MOST = 512 }; /* shards that stay open; rows in memory, of all shards and of one */

struct shard {
  const char *directory; /* NULL: missing */
  struct gx_store_rows *rows;
  bool keeps[GX_HDF5_KEPT];
  struct gx_table *part; /* owned: rows under way */
  size_t next;           /* of them */
};

struct merge {
  FILE *errors;
  char *identity; /* owned: of all */
  size_t shards, cases;
  struct shard *shard; /* [shards], owned */
  size_t room;         /* rows of a part */
};

/* Cases k < cases with k mod shards = index. */
static size_t rows_of(const struct merge *merge, size_t index)
{
  return merge->cases > index ? (merge->cases - index + merge->shards - 1) / merge->shards : 0;
}

/* Whether both directories hold the same bytes of results. */
static bool are_equal(const char *a, const char *b)
{
  char *path[2] = {gx_assembly_path(a, "", gx_assembly_name[GX_ASSEMBLY_STUDY], ""),
                   gx_assembly_path(b, "", gx_assembly_name[GX_ASSEMBLY_STUDY], "")};
  FILE *in[2] = {path[0] ? fopen(path[0], "rb") : NULL, path[1] ? fopen(path[1], "rb") : NULL};
  bool equal = in[0] && in[1];
  static const size_t room = 4096;
  for (bool more = equal; more;) {
    char block[2][4096];
    const size_t got = fread(block[0], 1, room, in[0]);
    equal = fread(block[1], 1, room, in[1]) == got && !memcmp(block[0], block[1], got);
    more = equal && got;
  }
  for (int i = 0; i < 2; i++) {
    if (in[i]) fclose(in[i]);
    free(path[i]);
  }
  return equal;
}

/* Of the first directory: what all others must be, too. */
static int settle(struct merge *merge, const char *directory, const struct gx_provenance *provenance)
{
  if (provenance->shards > MOST_SHARDS || provenance->cases < provenance->shards) {
    fprintf(merge->errors, "%s: its provenance is damaged\n", directory);
    return -1;
  }
  merge->identity = strdup(provenance->identity);
  merge->shard = calloc(provenance->shards, sizeof *merge->shard);
  if (!merge->identity || !merge->shard) return gx_assembly_say(merge->errors, NULL);
  merge->shards = provenance->shards;
  merge->cases = provenance->cases;
  return 0;
}

static int check_shard(struct merge *merge, const char *first, const char *directory, const struct gx_provenance *provenance,
                       size_t rows)
{
  FILE *errors = merge->errors;
  if (!provenance->identity) {
    fprintf(errors, "%s: holds a whole study, not a shard of one\n", directory);
    return -1;
  }
  if (!merge->shard && settle(merge, directory, provenance)) return -1;
  if (!gx_provenance_equal(provenance->identity, merge->identity, NULL) || provenance->cases != merge->cases) {
    fprintf(errors, "%s: is a shard of another study than %s; they differ in ", directory, first);
    gx_provenance_equal(provenance->identity, merge->identity, errors);
    putc('\n', errors);
    return -1;
  }
  if (provenance->shards != merge->shards) {
    fprintf(errors, "%s: is one of %zu shards, %s one of %zu\n", directory, provenance->shards, first, merge->shards);
    return -1;
  }
  if (rows == rows_of(merge, provenance->shard - 1)) return 0;
  fprintf(errors, "%s: its table is damaged" GX_SEAL_REMEDY "\n", directory);
  return -1;
}

/* Other than a study, what an interrupted run has left. */
static int check_finished(const char *directory, FILE *errors)
{
  char *path = gx_assembly_path(directory, "", gx_assembly_name[GX_ASSEMBLY_STUDY], "");
  struct stat status;
  const bool missing = path && stat(path, &status) != 0 && !stat(directory, &status);
  free(path);
  if (!missing) return 0;
  fprintf(errors, "%s: holds no finished study: run that shard again with --resume\n", directory);
  return -1;
}

static int add_shard(struct merge *merge, const char *first, const char *directory)
{
  struct gx_store_rows *rows =
      check_finished(directory, merge->errors) ? NULL : gx_store_rows_begin(directory, 0, NULL, merge->errors);
  const struct gx_provenance *provenance = rows ? gx_hdf5_rows_provenance(gx_store_rows_hdf5(rows)) : NULL;
  int failed = provenance ? check_shard(merge, first, directory, provenance, gx_store_rows_total(rows)) : -1;
  struct shard *shard = failed ? NULL : &merge->shard[provenance->shard - 1];
  if (shard && shard->directory) {
    if (!are_equal(shard->directory, directory)) {
      fprintf(merge->errors, "%s: is shard %zu as %s is, and its results differ: name one of them\n", directory,
              provenance->shard, shard->directory);
      failed = -1;
    }
    shard = NULL; /* once is enough */
  }
  if (shard) {
    *shard = (struct shard){.directory = directory, .rows = rows};
    for (int k = 0; k < GX_HDF5_KEPT; k++) shard->keeps[k] = gx_hdf5_rows_keeps(gx_store_rows_hdf5(rows), (enum gx_hdf5_kept)k);
    gx_store_rows_pause(rows);
  } else {
    gx_store_rows_end(rows);
  }
  return failed;
}

static int check_complete(const struct merge *merge)
{
  size_t missing = 0;
  for (size_t i = 0; i < merge->shards; i++) {
    if (merge->shard[i].directory) continue;
    if (!missing++)
      fprintf(merge->errors, "gridcross merge: missing of %zu shards: %zu", merge->shards, i + 1);
    else
      fprintf(merge->errors, ", %zu", i + 1);
  }
  if (missing) putc('\n', merge->errors);
  return missing ? -1 : 0;
}

static bool are_alike(const struct gx_table *a, const struct gx_table *b)
{
  bool alike = a->columns == b->columns;
  for (size_t c = 0; c < a->columns && alike; c++)
    alike = a->column[c].type == b->column[c].type && !strcmp(a->column[c].name, b->column[c].name);
  return alike;
}

/* The row of a case that comes next in its shard. */
static int fetch(struct merge *merge, struct shard *shard)
{
  if (shard->part && shard->next < shard->part->rows) return 0;
  gx_table_free(shard->part);
  shard->next = 0;
  shard->part = gx_store_rows_next(shard->rows, merge->room);
  if (merge->shards > FEW) gx_store_rows_pause(shard->rows);
  if (!shard->part) return -1;
  const struct shard *first = &merge->shard[0]; /* whose columns the table has */
  const bool sound = shard->part->rows && shard->part->columns > 2 && (!first->part || are_alike(first->part, shard->part));
  if (!sound) fprintf(merge->errors, "%s: its table is damaged" GX_SEAL_REMEDY "\n", shard->directory);
  return sound ? 0 : -1;
}

static int put_case(struct merge *merge, struct gx_assembly **assembly, const char *directory, size_t k)
{
  struct shard *shard = &merge->shard[k % merge->shards];
  if (fetch(merge, shard)) return -1;
  if (!*assembly) {
    long repeats = gx_store_read_repeats(shard->directory);
    *assembly = gx_assembly_begin(directory, shard->part, merge->cases, (size_t)repeats, merge->errors);
    if (!*assembly) return -1;
  }
  const struct gx_value id = gx_table_get(shard->part, shard->next, 0);
  if (id.type != GX_TEXT) {
    fprintf(merge->errors, "%s: its table is damaged" GX_SEAL_REMEDY "\n", shard->directory);
    return -1;
  }
  struct gx_table *kept[GX_HDF5_KEPT] = {NULL};
  int failed = 0;
  for (int w = 0; w < GX_HDF5_KEPT && !failed; w++) {
    struct gx_hdf5_rows *file = shard->keeps[w] ? gx_store_rows_hdf5(shard->rows) : NULL;
    if (shard->keeps[w] && !file) failed = -1;
    if (file) kept[w] = gx_hdf5_rows_kept(file, (enum gx_hdf5_kept)w, id.text, &failed);
  }
  if (merge->shards > FEW) gx_store_rows_pause(shard->rows);
  if (!failed && gx_recorder_has(shard->directory, id.text))
    failed = gx_recorder_copy(shard->directory, directory, id.text, merge->errors);
  if (!failed)
    failed = gx_assembly_put_row(*assembly, shard->part, shard->next++, kept[GX_HDF5_HISTORIES], kept[GX_HDF5_SPECTRA]);
  for (int w = 0; w < GX_HDF5_KEPT; w++) gx_table_free(kept[w]);
  return failed;
}

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int write_all(struct merge *merge, const char *directory, const char *command)
{
  const double start = now();
  struct gx_assembly *assembly = NULL;
  int failed = 0;
  for (size_t k = 0; k < merge->cases && !failed; k++) failed = put_case(merge, &assembly, directory, k);
  struct gx_hdf5_rows *file = failed ? NULL : gx_store_rows_hdf5(merge->shard[0].rows);
  const struct gx_provenance *stored = file ? gx_hdf5_rows_provenance(file) : NULL;
  struct gx_provenance provenance = stored ? *stored : (struct gx_provenance){0};
  provenance.identity = NULL; /* whole again */
  const struct gx_store_run run = {.command = command, .seconds = now() - start};
  if (assembly && gx_assembly_end(assembly, stored ? &provenance : NULL, &run)) failed = -1;
  return failed || !stored ? -1 : 0;
}

static bool are_one(const char *a, const char *b)
{
  struct stat one, other;
  return !stat(a, &one) && !stat(b, &other) && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

int gx_store_merge(size_t shards, const char *const *shard, const char *directory, const char *command, FILE *errors)
{
  struct merge merge = {.errors = errors};
  int failed = 0;
  for (size_t i = 0; i < shards; i++) { /* all of them, so that all errors are told at once */
    if (are_one(shard[i], directory)) {
      fprintf(errors, "%s: is a shard: name another directory with -o\n", directory);
      failed = -1;
    } else if (add_shard(&merge, shard[0], shard[i])) {
      failed = -1;
    }
  }
  if (!failed) failed = check_complete(&merge);
  if (!failed)
    failed = gx_store_prepare(directory, errors) || gx_journals_check(directory, merge.identity, false, errors) ? -1 : 0;
  merge.room = merge.shards ? BUFFERED / merge.shards : 0;
  if (merge.room < LEAST) merge.room = LEAST;
  if (merge.room > MOST) merge.room = MOST;
  if (!failed) failed = write_all(&merge, directory, command);
  for (size_t i = 0; i < merge.shards; i++) {
    gx_table_free(merge.shard[i].part);
    gx_store_rows_end(merge.shard[i].rows);
  }
  free(merge.shard);
  free(merge.identity);
  return failed;
}
