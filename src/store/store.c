/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study directory under way: what is there already, a journal for what comes, and its assembly at the end. */
#include <gridcross/store.h>

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include <gridcross/recorder.h>

#include "../core/checksum.h"
#include "assembly.h"
#include "hdf5_rows.h"
#include "journals.h"

struct gx_store {
  char *directory; /* owned */
  const struct gx_study *study;
  FILE *errors;
  char *whole, *identity; /* owned: of the study, and of this shard of it */
  size_t shard, shards;   /* from 1; 0: undivided */
  bool *skip;             /* [study->count], owned */
  size_t total;           /* cases of this shard */
  atomic_size_t done;     /* of them with a result */
  bool finished;          /* the directory holds the study already */
  int lock;               /* descriptor of the directory, -1: none */
  struct gx_journal *journal;
  struct gx_recorder *recorder; /* of snapshots and checkpoints */
};

static bool is_mine(const struct gx_store *store, size_t index)
{
  return !store->shards || index % store->shards == store->shard - 1;
}

/* Nobody else writes there meanwhile. A file system without locks is taken at its word. */
static int lock_directory(struct gx_store *store)
{
  store->lock = open(store->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (store->lock < 0 || !flock(store->lock, LOCK_EX | LOCK_NB) || errno != EWOULDBLOCK) return 0;
  fprintf(store->errors, "%s: another run is under way there: name another directory with -o\n", store->directory);
  return -1;
}

static int identify(struct gx_store *store)
{
  char shard[64];
  snprintf(shard, sizeof shard, "shard\t%zu/%zu\n", store->shards ? store->shard : 1, store->shards ? store->shards : 1);
  store->whole = gx_provenance_identify(store->study);
  size_t room = store->whole ? strlen(store->whole) + sizeof shard : 0;
  store->identity = store->whole ? malloc(room) : NULL;
  if (!store->identity) return gx_assembly_say(store->errors, NULL);
  snprintf(store->identity, room, "%s%s", store->whole, shard);
  return 0;
}

/* The identity of the study that the directory holds, owned by the caller; NULL after a message. */
static char *identity_there(const struct gx_store *store)
{
  char *path = gx_assembly_path(store->directory, "", gx_assembly_name[GX_ASSEMBLY_STUDY], "");
  const char *const columns[] = {"case"};
  struct gx_hdf5_rows *rows = path ? gx_hdf5_rows_begin(path, 1, columns, store->errors) : NULL;
  const struct gx_provenance *provenance = rows ? gx_hdf5_rows_provenance(rows) : NULL;
  char *identity = NULL, shard[64] = "shard\t1/1\n";
  if (provenance && provenance->identity) {
    snprintf(shard, sizeof shard, "shard\t%zu/%zu\n", provenance->shard, provenance->shards);
    identity = strdup(provenance->identity);
  } else if (provenance) {
    struct gx_provenance_sum cases = {0};
    struct gx_table *table = NULL;
    for (size_t left = gx_hdf5_rows_total(rows); left && (table = gx_hdf5_rows_next(rows, 4096, 0));) {
      for (size_t r = 0; r < table->rows; r++) {
        struct gx_value id = gx_table_get(table, r, 0);
        if (id.type == GX_TEXT) gx_provenance_add(&cases, id.text, strlen(id.text));
      }
      left -= table->rows;
      gx_table_free(table);
    }
    identity = gx_provenance_identity(provenance, &cases, (size_t)gx_store_read_repeats(store->directory));
  }
  gx_hdf5_rows_end(rows);
  free(path);
  char *both = identity ? malloc(strlen(identity) + sizeof shard) : NULL;
  if (both) sprintf(both, "%s%s", identity, shard);
  free(identity);
  return both;
}

/* A case is done when its snapshots are there too: they come before its result, but may have been removed. */
static bool lacks_snapshots(const struct gx_store *store, size_t index)
{
  const struct gx_case *one = &store->study->cases[index];
  return one->value[GX_OUTPUT_SNAPSHOTS].type == GX_INTEGER && !gx_recorder_has(store->directory, one->id);
}

/* Nothing was under way: the study that is there is this one, or --resume was not meant for it. */
static int take_finished(struct gx_store *store)
{
  char *study = gx_assembly_path(store->directory, "", gx_assembly_name[GX_ASSEMBLY_STUDY], "");
  const bool any = study && !access(study, F_OK);
  free(study);
  if (!any) return 0;
  char *there = identity_there(store);
  if (!there) return -1;
  store->finished = gx_provenance_equal(there, store->identity, NULL);
  if (!store->finished) {
    fprintf(store->errors, "%s: holds another study, which --resume does not go on with; they differ in ", store->directory);
    gx_provenance_equal(there, store->identity, store->errors);
    fputs(": name another directory with -o, or leave out --resume to replace it\n", store->errors);
  }
  free(there);
  for (size_t i = 0; i < store->study->count && store->finished; i++) {
    store->done += !store->skip[i];
    store->skip[i] = true;
    if (!is_mine(store, i) || !lacks_snapshots(store, i)) continue;
    store->skip[i] = false; /* for its snapshots alone */
    store->done--;
  }
  return store->finished ? 0 : -1;
}

/* Whether a case of this study was interrupted behind a checkpoint. */
static bool has_checkpoint(const struct gx_store *store)
{
  for (size_t i = 0; i < store->study->count; i++) {
    const struct gx_case *one = &store->study->cases[i];
    if (one->value[GX_OUTPUT_CHECKPOINT].type == GX_INTEGER && gx_recorder_goes_on(store->recorder, one->id)) return true;
  }
  return false;
}

static void mark(void *context, size_t journal, size_t index, uint64_t offset)
{
  struct gx_store *store = context;
  (void)journal, (void)offset;
  if (index >= store->study->count || store->skip[index] || lacks_snapshots(store, index)) return;
  store->skip[index] = true;
  store->done++;
}

static int begin(struct gx_store *store, const struct gx_store_how *how)
{
  store->skip = calloc(store->study->count + 1, sizeof *store->skip);
  store->recorder = gx_recorder_create(store->directory, store->errors);
  if (!store->directory || !store->skip || !store->recorder) return gx_assembly_say(store->errors, NULL);
  if (identify(store)) return -1;
  gx_recorder_keep(store->recorder, store->identity, how->resume, how->quiet);
  for (size_t i = 0; i < store->study->count; i++) {
    store->total += is_mine(store, i);
    store->skip[i] = !is_mine(store, i);
  }
  if (!how->joins) {
    if (gx_store_prepare(store->directory, store->errors) || lock_directory(store)) return -1;
    if (gx_journals_check(store->directory, store->identity, how->resume, store->errors)) return -1;
    if (gx_recorder_refuse(store->directory, how->resume ? store->study : NULL, store->errors)) return -1;
    struct gx_journals *journals = gx_journals_open(store->directory, store->identity, store->errors);
    if (!journals) return -1;
    int failed = gx_journals_scan(journals, mark, store);
    gx_journals_close(journals);
    if (failed || (how->resume && !store->done && !has_checkpoint(store) && take_finished(store))) return -1;
  }
  if (store->finished) return 0;
  store->journal = gx_journal_create(store->directory, store->identity, store->errors);
  return store->journal ? 0 : -1;
}

struct gx_store *gx_store_open(const char *directory, const struct gx_study *study, const struct gx_store_how *how, FILE *errors)
{
  struct gx_store *store = calloc(1, sizeof *store);
  if (!store) {
    gx_assembly_say(errors, NULL);
    return NULL;
  }
  *store = (struct gx_store){.directory = strdup(directory),
                             .study = study,
                             .errors = errors,
                             .shard = how->shard,
                             .shards = how->shards > 1 ? how->shards : 0,
                             .lock = -1};
  if (!begin(store, how)) return store;
  gx_store_close(store);
  return NULL;
}

uint64_t gx_store_number(const struct gx_store *store)
{
  return gx_checksum(GX_CHECKSUM_START, store->identity, strlen(store->identity));
}

static int put(void *context, size_t index, struct gx_result *result)
{
  struct gx_store *store = context;
  if (!store->finished && gx_journal_append(store->journal, index, result)) return -1;
  const struct gx_case *one = &store->study->cases[index];
  if (one->value[GX_OUTPUT_CHECKPOINT].type == GX_INTEGER) gx_recorder_forget(store->recorder, one->id);
  atomic_fetch_add(&store->done, 1);
  return 0;
}

struct gx_sink gx_store_sink(struct gx_store *store)
{
  return (struct gx_sink){.context = store, .done = put};
}

const struct gx_observer *gx_store_observer(const struct gx_store *store)
{
  return gx_recorder_observer(store->recorder);
}

const bool *gx_store_skip(const struct gx_store *store)
{
  return store->skip;
}

void gx_store_count(struct gx_store *store, size_t *done, size_t *total)
{
  *done = atomic_load(&store->done);
  *total = store->total;
}

/* Where the result of each case is. */
struct places {
  size_t count, found;
  struct place {
    uint64_t offset;
    size_t journal; /* index + 1; 0: nowhere */
  } * place;
};

static void note_place(void *context, size_t journal, size_t index, uint64_t offset)
{
  struct places *places = context;
  if (index >= places->count || places->place[index].journal) return;
  places->place[index] = (struct place){.offset = offset, .journal = journal + 1};
  places->found++;
}

static int assemble_from(struct gx_store *store, struct gx_journals *journals, const struct places *places,
                         const struct gx_store_run *run)
{
  struct gx_table *like = gx_study_table_begin(0, true);
  if (!like) return gx_assembly_say(store->errors, NULL);
  struct gx_assembly *assembly = gx_assembly_begin(store->directory, like, store->total, store->study->repeats, store->errors);
  int failed = assembly ? 0 : -1;
  for (size_t i = 0; i < store->study->count && !failed; i++) {
    struct gx_result result;
    if (!is_mine(store, i)) continue;
    failed = gx_journals_result(journals, places->place[i].journal - 1, places->place[i].offset, &result);
    if (failed) continue;
    failed = gx_assembly_put(assembly, &store->study->cases[i], &result);
    gx_case_free(&result);
  }
  struct gx_provenance provenance = gx_provenance_of(store->study);
  if (store->shards) {
    provenance.shard = store->shard;
    provenance.shards = store->shards;
    provenance.cases = store->study->count;
    provenance.identity = store->whole;
  }
  if (assembly && gx_assembly_end(assembly, failed ? NULL : &provenance, run)) failed = -1;
  gx_table_free(like);
  return failed;
}

static int assemble(struct gx_store *store, const struct gx_store_run *run)
{
  struct places places = {.count = store->study->count};
  struct gx_journals *journals = gx_journals_open(store->directory, store->identity, store->errors);
  places.place = calloc(places.count + 1, sizeof *places.place);
  int failed = !journals       ? -1
               : !places.place ? gx_assembly_say(store->errors, NULL)
                               : gx_journals_scan(journals, note_place, &places);
  if (!failed && places.found < store->total) {
    fprintf(store->errors, "%s: holds %zu of %zu cases: run it again with --resume\n", store->directory, places.found,
            store->total);
    failed = -1;
  }
  if (!failed) failed = assemble_from(store, journals, &places, run);
  if (!failed) failed = gx_recorder_tidy(store->directory, store->study, store->errors);
  if (!failed) gx_journals_remove(journals); /* last: as long as there is one, --resume ends the work */
  gx_journals_close(journals);
  free(places.place);
  return failed;
}

/* Of those who joined to make its snapshots anew. */
static int remove_journals(struct gx_store *store)
{
  struct gx_journals *journals = gx_journals_open(store->directory, store->identity, store->errors);
  if (!journals) return -1;
  gx_journals_remove(journals);
  gx_journals_close(journals);
  return 0;
}

int gx_store_finish(struct gx_store *store, const struct gx_store_run *run)
{
  if (store->finished) return remove_journals(store);
  int failed = gx_journal_close(store->journal);
  store->journal = NULL;
  return failed ? failed : assemble(store, run);
}

int gx_store_close(struct gx_store *store)
{
  if (!store) return 0;
  int failed = gx_journal_close(store->journal);
  if (store->lock >= 0) close(store->lock);
  gx_recorder_free(store->recorder);
  free(store->directory);
  free(store->whole);
  free(store->identity);
  free(store->skip);
  free(store);
  return failed;
}

int gx_store_write(const char *directory, const struct gx_study *study, const struct gx_result *results,
                   const struct gx_store_run *run, FILE *errors)
{
  struct gx_table *like = gx_study_table_begin(0, true);
  struct gx_assembly *assembly = like ? gx_assembly_begin(directory, like, study->count, study->repeats, errors) : NULL;
  int failed = assembly ? 0 : like ? -1 : gx_assembly_say(errors, NULL);
  for (size_t i = 0; i < study->count && !failed; i++) failed = gx_assembly_put(assembly, &study->cases[i], &results[i]);
  const struct gx_provenance provenance = gx_provenance_of(study);
  if (assembly && gx_assembly_end(assembly, failed ? NULL : &provenance, run)) failed = -1;
  gx_table_free(like);
  return failed ? failed : gx_recorder_tidy(directory, study, errors);
}

void gx_store_free_spectra(struct gx_spectra *spectra)
{
  if (!spectra) return;
  free(spectra->time);
  free(spectra->rms);
  free(spectra);
}
