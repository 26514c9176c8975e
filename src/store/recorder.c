/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of snapshots and checkpoints: their names, and how they come and go. The snapshots of a case that keeps checkpoints are logged
 * while it is under way, and made into their files at its end. */
#include <gridcross/recorder.h>

#include <dirent.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "checkpoint.h"
#include "openpmd.h"
#include "snapshot_log.h"
#include "xdmf.h"

enum { XMF, GRID, H5, FILES, CHECKPOINT = FILES, LOG, ALL, NAME = 64 };

static const char *const endings[ALL] = {
    [XMF] = ".xmf", [GRID] = "-grid.xmf", [H5] = ".h5", [CHECKPOINT] = ".checkpoint", [LOG] = ".snapshots"};
static const char *const partial = ".partial";

struct gx_recorder {
  const char *directory;
  FILE *errors;
  pthread_mutex_t lock; /* HDF5 is not thread-safe */
  struct gx_observer observer;
  const char *identity; /* of checkpoints; NULL: they are not kept */
  bool resume, quiet;
};

/* A case under way. */
struct recording {
  struct gx_recorder *recorder;
  char id[GX_ID_LENGTH];
  struct gx_openpmd *file; /* NULL: closed, or it could not be made */
  FILE *xdmf[GX_XDMF_KINDS];
  struct gx_snapshot_log log; /* in their place; file -1: none */
  char *checkpoint;           /* path, owned; NULL: none is asked for */
  char *identity;             /* of it, owned */
  bool found;                 /* it is there */
  bool failed;
};

static int say(FILE *errors, const char *path)
{
  fprintf(errors, "%s: %s\n", path ? path : "snapshots", !path ? "out of memory" : errno ? strerror(errno) : "HDF5 failed");
  return -1;
}

/* DIRECTORY/case-<id><ending>, or its hidden name; owned by the caller */
static char *path_of(const char *directory, const char *id, int file, bool hidden)
{
  size_t room = strlen(directory) + strlen(id) + 40;
  char *path = malloc(room);
  if (path) snprintf(path, room, "%s/%scase-%s%s%s", directory, hidden ? "." : "", id, endings[file], hidden ? partial : "");
  return path;
}

static void begin_files(struct recording *recording)
{
  struct gx_recorder *recorder = recording->recorder;
  for (int f = 0; f < FILES && !recording->failed; f++) {
    char *path = path_of(recorder->directory, recording->id, f, true);
    errno = 0;
    if (f == H5) {
      pthread_mutex_lock(&recorder->lock);
      recording->file = path ? gx_openpmd_create(path, recording->id) : NULL;
      pthread_mutex_unlock(&recorder->lock);
      recording->failed = !recording->file;
    } else {
      recording->xdmf[f] = path ? fopen(path, "wb") : NULL;
      recording->failed = !recording->xdmf[f];
      if (recording->xdmf[f]) gx_xdmf_begin(recording->xdmf[f]);
    }
    if (recording->failed) say(recorder->errors, path);
    free(path);
  }
}

static void remove_files(const struct recording *recording)
{
  for (int f = 0; f < FILES; f++) {
    char *path = path_of(recording->recorder->directory, recording->id, f, true);
    if (path) unlink(path);
    free(path);
  }
}

/* Closes what is open. -1 with the first errno that was told; 0: HDF5's own. */
static int close_files(struct recording *recording)
{
  struct gx_recorder *recorder = recording->recorder;
  int reason = 0;
  for (int f = XMF; f <= GRID; f++) {
    if (!recording->xdmf[f]) continue;
    gx_xdmf_end(recording->xdmf[f]);
    bool failed = fflush(recording->xdmf[f]) || ferror(recording->xdmf[f]);
    if (failed && !reason) reason = errno;
    if (fclose(recording->xdmf[f]) && !failed) {
      failed = true;
      reason = errno;
    }
    recording->failed |= failed;
    recording->xdmf[f] = NULL;
  }
  pthread_mutex_lock(&recorder->lock);
  if (recording->file && gx_openpmd_close(recording->file)) recording->failed = true;
  pthread_mutex_unlock(&recorder->lock);
  recording->file = NULL;
  if (reason) errno = reason;
  return recording->failed ? -1 : 0;
}

/* DIRECTORY/.case-<id>.checkpoint, which has no partial about it; owned by the caller */
static char *checkpoint_path(const char *directory, const char *id)
{
  char *path = path_of(directory, id, CHECKPOINT, true);
  if (path) path[strlen(path) - strlen(partial)] = '\0';
  return path;
}

static void open_log(struct recording *recording, const struct gx_checkpoint_mark *mark, const char **reason)
{
  const struct gx_recorder *recorder = recording->recorder;
  char *path = path_of(recorder->directory, recording->id, LOG, true);
  if (path && !*reason && gx_snapshot_log_open(&recording->log, path, mark->log, mark->log_sum))
    *reason = "has lost its snapshots";
  errno = path && *reason ? gx_snapshot_log_open(&recording->log, path, 0, 0) : 0;
  if (recording->log.file < 0) {
    say(recorder->errors, path);
    recording->failed = true;
  }
  free(path);
}

/* What a checkpoint of a case is told by, owned by the caller. */
static char *identity_of(const struct gx_recorder *recorder, const char *id)
{
  const size_t room = strlen(recorder->identity) + strlen(id) + 8;
  char *identity = malloc(room);
  if (identity) snprintf(identity, room, "%scase\t%s\n", recorder->identity, id);
  return identity;
}

/* Looks for a checkpoint to go on with. */
static void begin_checkpoint(struct recording *recording, bool shows)
{
  const struct gx_recorder *recorder = recording->recorder;
  struct gx_checkpoint_mark mark = {0};
  recording->checkpoint = checkpoint_path(recorder->directory, recording->id);
  recording->identity = identity_of(recorder, recording->id);
  if (!recording->checkpoint || !recording->identity) {
    say(recorder->errors, NULL);
    recording->failed = true;
    return;
  }
  const char *reason = recorder->resume ? gx_checkpoint_look(recording->checkpoint, recording->identity, &mark) : "";
  if (shows) open_log(recording, &mark, &reason);
  recording->found = !reason;
  if (recorder->quiet || (reason && !*reason)) return;
  if (reason)
    fprintf(recorder->errors, "note: %s: %s: the case begins anew\n", recording->checkpoint, reason);
  else
    fprintf(recorder->errors, "note: case %s goes on from step %.0f\n", recording->id, mark.step);
}

static void release(struct recording *recording)
{
  gx_snapshot_log_close(&recording->log);
  free(recording->checkpoint);
  free(recording->identity);
  free(recording);
}

static void *begin(void *context, const struct gx_case *one)
{
  struct recording *recording = calloc(1, sizeof *recording);
  struct gx_recorder *recorder = context;
  if (!recording) {
    say(recorder->errors, NULL);
    return NULL;
  }
  *recording = (struct recording){.recorder = recorder, .log.file = -1};
  memcpy(recording->id, one->id, sizeof recording->id);
  if (recorder->identity && one->value[GX_OUTPUT_CHECKPOINT].type == GX_INTEGER)
    begin_checkpoint(recording, one->value[GX_OUTPUT_SNAPSHOTS].type == GX_INTEGER);
  else
    begin_files(recording);
  if (!recording->failed) return recording;
  close_files(recording);
  remove_files(recording);
  release(recording);
  return NULL;
}

static int restore(void *watched, const struct gx_checkpoint *checkpoint)
{
  const struct recording *recording = watched;
  if (!recording->found) return 0;
  if (!gx_checkpoint_load(recording->checkpoint, checkpoint)) return 1;
  fprintf(recording->recorder->errors, "%s: does not fit its case: remove it to begin the case anew\n", recording->checkpoint);
  return -1;
}

static int keep(void *watched, const struct gx_checkpoint *checkpoint)
{
  struct recording *recording = watched;
  const struct gx_recorder *recorder = recording->recorder;
  const struct gx_checkpoint_mark mark = {checkpoint->step, recording->log.length, recording->log.sum};
  char *hidden = path_of(recorder->directory, recording->id, CHECKPOINT, true);
  int failed = hidden ? 0 : ENOMEM;
  if (!failed && recording->log.file >= 0) failed = gx_snapshot_log_flush(&recording->log);
  if (!failed) failed = gx_checkpoint_write(recording->checkpoint, hidden, recording->identity, &mark, checkpoint);
  free(hidden);
  errno = failed;
  return failed ? say(recorder->errors, recording->checkpoint) : 0;
}

static int put_files(void *watched, const struct gx_snapshot *snapshot)
{
  struct recording *recording = watched;
  struct gx_recorder *recorder = recording->recorder;
  char name[NAME];
  snprintf(name, sizeof name, "case-%s%s", recording->id, endings[H5]);
  if (!snapshot->vertices.n && recording->xdmf[GRID]) { /* there is no grid to describe */
    char *path = path_of(recorder->directory, recording->id, GRID, true);
    fclose(recording->xdmf[GRID]);
    recording->xdmf[GRID] = NULL;
    if (path) unlink(path);
    free(path);
  }
  gx_xdmf_put(recording->xdmf[XMF], name, GX_XDMF_PARTICLES, snapshot);
  if (recording->xdmf[GRID]) gx_xdmf_put(recording->xdmf[GRID], name, GX_XDMF_VERTICES, snapshot);
  errno = 0;
  pthread_mutex_lock(&recorder->lock);
  recording->failed |= gx_openpmd_put(recording->file, snapshot) != 0;
  pthread_mutex_unlock(&recorder->lock);
  if (!recording->failed) return 0;
  char *path = path_of(recorder->directory, recording->id, H5, false);
  say(recorder->errors, path);
  free(path);
  return -1;
}

static int show(void *watched, const struct gx_snapshot *snapshot)
{
  struct recording *recording = watched;
  if (recording->log.file < 0) return put_files(watched, snapshot);
  errno = gx_snapshot_log_put(&recording->log, snapshot);
  if (!errno) return 0;
  recording->failed = true;
  char *path = path_of(recording->recorder->directory, recording->id, LOG, true);
  say(recording->recorder->errors, path);
  free(path);
  return -1;
}

/* The files of the snapshots that were logged. */
static void replay(struct recording *recording)
{
  begin_files(recording);
  if (recording->failed) return;
  errno = gx_snapshot_log_replay(&recording->log, put_files, recording);
  if (!errno || recording->failed) return; /* it was said */
  recording->failed = true;
  char *path = path_of(recording->recorder->directory, recording->id, LOG, true);
  say(recording->recorder->errors, path);
  free(path);
}

/* The hidden file takes its name; one that is not there need not. */
static int publish(const char *directory, const char *id, int file, FILE *errors)
{
  char *from = path_of(directory, id, file, true), *to = path_of(directory, id, file, false);
  int failed = 0;
  errno = 0;
  if (!from || !to)
    failed = say(errors, NULL);
  else if (rename(from, to) && (file != GRID || errno != ENOENT))
    failed = say(errors, to);
  free(from);
  free(to);
  return failed;
}

static int end(void *watched, bool whole)
{
  struct recording *recording = watched;
  const struct gx_recorder *recorder = recording->recorder;
  const bool logged = recording->log.file >= 0, shown = logged || recording->file;
  if (logged && whole && !recording->failed) replay(recording);
  bool said = recording->failed;
  errno = 0;
  int failed = close_files(recording);
  if (failed && !said) {
    char *path = path_of(recorder->directory, recording->id, H5, false);
    say(recorder->errors, path);
    free(path);
  }
  for (int f = 0; f < FILES && shown && whole && !failed; f++)
    failed = publish(recorder->directory, recording->id, f, recorder->errors);
  if (!whole || failed) remove_files(recording);
  release(recording);
  return failed;
}

struct gx_recorder *gx_recorder_create(const char *directory, FILE *errors)
{
  struct gx_recorder *recorder = calloc(1, sizeof *recorder);
  if (!recorder) return NULL;
  recorder->directory = directory;
  recorder->errors = errors;
  recorder->observer = (struct gx_observer){.context = recorder, .begin = begin, .show = show, .end = end};
  pthread_mutex_init(&recorder->lock, NULL);
  return recorder;
}

void gx_recorder_free(struct gx_recorder *recorder)
{
  if (!recorder) return;
  pthread_mutex_destroy(&recorder->lock);
  free(recorder);
}

const struct gx_observer *gx_recorder_observer(const struct gx_recorder *recorder)
{
  return &recorder->observer;
}

void gx_recorder_keep(struct gx_recorder *recorder, const char *identity, bool resume, bool quiet)
{
  recorder->identity = identity;
  recorder->resume = resume;
  recorder->quiet = quiet;
  recorder->observer.restore = restore;
  recorder->observer.keep = keep;
}

void gx_recorder_forget(const struct gx_recorder *recorder, const char *id)
{
  char *path[] = {checkpoint_path(recorder->directory, id), path_of(recorder->directory, id, LOG, true)};
  for (int i = 0; i < 2; i++) {
    if (path[i]) unlink(path[i]);
    free(path[i]);
  }
}

bool gx_recorder_goes_on(const struct gx_recorder *recorder, const char *id)
{
  struct gx_checkpoint_mark mark;
  char *path = checkpoint_path(recorder->directory, id), *identity = identity_of(recorder, id);
  const bool found = path && identity && !gx_checkpoint_look(path, identity, &mark);
  free(path);
  free(identity);
  return found;
}

bool gx_recorder_has(const char *directory, const char *id)
{
  char *path = path_of(directory, id, H5, false);
  bool is_there = path && !access(path, F_OK);
  free(path);
  return is_there;
}

/* The id in a name of ours; hidden: it is that of a case under way. */
static bool split_name(const char *name, char id[GX_ID_LENGTH], bool *hidden)
{
  *hidden = *name == '.';
  name += *hidden;
  if (strncmp(name, "case-", 5) || strspn(name + 5, "0123456789abcdef") != GX_ID_LENGTH - 1) return false;
  memcpy(id, name + 5, GX_ID_LENGTH - 1);
  id[GX_ID_LENGTH - 1] = '\0';
  const char *rest = name + 5 + GX_ID_LENGTH - 1;
  for (int f = 0; f < (*hidden ? ALL : FILES); f++) {
    size_t length = strlen(endings[f]);
    if (!strncmp(rest, endings[f], length) && !strcmp(rest + length, *hidden ? partial : "")) return true;
  }
  if (*hidden && !strcmp(rest, endings[CHECKPOINT])) return true;
  return false;
}

bool gx_recorder_owns(const char *name)
{
  char id[GX_ID_LENGTH];
  bool hidden;
  return split_name(name, id, &hidden);
}

static bool has_case(const struct gx_study *study, const char *id)
{
  for (size_t i = 0; i < study->count; i++)
    if (!strcmp(study->cases[i].id, id)) return true;
  return false;
}

int gx_recorder_refuse(const char *directory, const struct gx_study *study, FILE *errors)
{
  DIR *stream = opendir(directory);
  int failed = stream ? 0 : say(errors, directory);
  for (struct dirent *entry; !failed && (entry = readdir(stream));) {
    const size_t length = strlen(entry->d_name), ending = strlen(endings[CHECKPOINT]);
    char id[GX_ID_LENGTH];
    bool hidden;
    if (!split_name(entry->d_name, id, &hidden) || strcmp(entry->d_name + length - ending, endings[CHECKPOINT])) continue;
    if (study && has_case(study, id)) continue;
    fprintf(errors, "%s: holds the checkpoint of a case that %s, name another directory with -o, or remove %s/%s\n", directory,
            study ? "is not of this study: go on with it by its own run file" : "was interrupted: add --resume to go on with it",
            directory, entry->d_name);
    failed = -1;
  }
  if (stream) closedir(stream);
  return failed;
}

static int copy_file(const char *from, const char *to, FILE *errors)
{
  char piece[1 << 16];
  FILE *in = fopen(from, "rb"), *out = in ? fopen(to, "wb") : NULL;
  int failed = !in ? say(errors, from) : !out ? say(errors, to) : 0;
  for (size_t n; !failed && (n = fread(piece, 1, sizeof piece, in)) > 0;)
    if (fwrite(piece, 1, n, out) != n) failed = say(errors, to);
  if (!failed && ferror(in)) failed = say(errors, from);
  if (in) fclose(in);
  if (out && fclose(out) && !failed) failed = say(errors, to);
  return failed;
}

int gx_recorder_copy(const char *from, const char *to, const char *id, FILE *errors)
{
  int failed = 0;
  for (int f = 0; f < FILES && !failed; f++) {
    char *source = path_of(from, id, f, false), *hidden = path_of(to, id, f, true);
    if (!source || !hidden)
      failed = say(errors, NULL);
    else if (f != GRID || !access(source, F_OK))
      failed = copy_file(source, hidden, errors);
    if (!failed) failed = publish(to, id, f, errors);
    if (failed && hidden) unlink(hidden);
    free(source);
    free(hidden);
  }
  return failed;
}

static int compare_ids(const void *a, const void *b)
{
  return strcmp(*(const char *const *)a, *(const char *const *)b);
}

int gx_recorder_tidy(const char *directory, const struct gx_study *study, FILE *errors)
{
  const char **ids = malloc((study->count + 1) * sizeof *ids);
  DIR *stream = ids ? opendir(directory) : NULL;
  int failed = stream ? 0 : say(errors, ids ? directory : NULL);
  size_t count = 0;
  for (size_t i = 0; i < study->count && ids; i++)
    if (study->cases[i].value[GX_OUTPUT_SNAPSHOTS].type == GX_INTEGER) ids[count++] = study->cases[i].id;
  if (ids) qsort(ids, count, sizeof *ids, compare_ids);
  for (struct dirent *entry; !failed && (entry = readdir(stream));) {
    char id[GX_ID_LENGTH];
    const char *key = id;
    bool hidden;
    if (!split_name(entry->d_name, id, &hidden)) continue;
    if (!hidden && bsearch(&key, ids, count, sizeof *ids, compare_ids)) continue;
    if (unlinkat(dirfd(stream), entry->d_name, 0)) failed = say(errors, entry->d_name);
  }
  if (stream) closedir(stream);
  free(ids);
  return failed;
}
