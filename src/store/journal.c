/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writing journals: one write(2) a record, and a thread that flushes them to disk about once a second. */
#include "journal.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#include "../core/checksum.h"

struct gx_journal {
  char *path; /* owned */
  FILE *errors;
  int file;
  off_t size; /* bytes of whole records */
  pthread_mutex_t lock;
  pthread_cond_t closing;
  pthread_t flusher;
  bool flushed_by_thread; /* else nobody but gx_journal_close does */
  bool dirty, closed, empty;
  int broken; /* errno of a flush that failed; 0: none has */
};

static int say(const struct gx_journal *journal, const char *what)
{
  fprintf(journal->errors, "%s: %s\n", journal->path, what);
  return -1;
}

/* What was written to a file that has been removed vanishes with the last process that has it open. */
static int flush(int file)
{
  struct stat status;
  if (fstat(file, &status)) return errno;
  if (status.st_nlink == 0) return ENOENT;
  /* EINVAL: a file system that cannot; nothing more to be done there. */
  return fsync(file) && errno != EINVAL && errno != EROFS ? errno : 0;
}

static void *keep_flushed(void *argument)
{
  struct gx_journal *journal = argument;
  pthread_mutex_lock(&journal->lock);
  while (!journal->closed) {
    struct timespec next;
    clock_gettime(CLOCK_REALTIME, &next);
    next.tv_sec++;
    pthread_cond_timedwait(&journal->closing, &journal->lock, &next);
    if (!journal->dirty) continue;
    journal->dirty = false;
    pthread_mutex_unlock(&journal->lock); /* nobody waits for the disk */
    int failed = flush(journal->file);
    pthread_mutex_lock(&journal->lock);
    if (failed) journal->broken = failed;
  }
  pthread_mutex_unlock(&journal->lock);
  return NULL;
}

/* All of it or nothing. Returns 0 or errno. */
static int write_all(struct gx_journal *journal, struct iovec *part, int parts)
{
  off_t whole = 0;
  for (int i = 0; i < parts; i++) whole += (off_t)part[i].iov_len;
  while (parts) {
    ssize_t written = writev(journal->file, part, parts);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      int failed = errno;
      return ftruncate(journal->file, journal->size) ? errno : failed;
    }
    while (parts && (size_t)written >= part->iov_len) {
      written -= (ssize_t)part->iov_len;
      part++;
      parts--;
    }
    if (!parts) break;
    part->iov_base = (char *)part->iov_base + written;
    part->iov_len -= (size_t)written;
  }
  journal->size += whole;
  return 0;
}

static int write_head(struct gx_journal *journal, const char *identity)
{
  struct gx_journal_head head = {.magic = GX_JOURNAL_MAGIC, .length = strlen(identity)};
  size_t room = (head.length + 7) / 8 * 8;
  char *text = calloc(1, room + 1);
  if (!text) return ENOMEM;
  memcpy(text, identity, head.length);
  head.sum = gx_checksum(gx_checksum(GX_CHECKSUM_START, &head.length, sizeof head.length), text, room);
  struct iovec part[] = {{&head, sizeof head}, {text, room}};
  int failed = write_all(journal, part, 2);
  free(text);
  return failed;
}

static int open_first_free(struct gx_journal *journal, const char *directory, size_t room)
{
  enum { MOST = 1000000 };
  for (int n = 1; n < MOST; n++) {
    snprintf(journal->path, room, "%s/.journal-%d.partial", directory, n);
    int file = open(journal->path, O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
}

struct gx_journal *gx_journal_create(const char *directory, const char *identity, FILE *errors)
{
  struct gx_journal *journal = calloc(1, sizeof *journal);
  size_t room = strlen(directory) + 40;
  char *path = malloc(room);
  if (!journal || !path) {
    fprintf(errors, "%s: out of memory\n", directory);
    free(path);
    free(journal);
    return NULL;
  }
  *journal = (struct gx_journal){.path = path, .errors = errors, .empty = true};
  journal->file = open_first_free(journal, directory, room);
  int failed = journal->file < 0 ? errno : write_head(journal, identity);
  if (failed) {
    say(journal, strerror(failed));
    if (journal->file >= 0) {
      close(journal->file);
      unlink(path);
    }
    free(path);
    free(journal);
    return NULL;
  }
  pthread_mutex_init(&journal->lock, NULL);
  pthread_cond_init(&journal->closing, NULL);
  journal->flushed_by_thread = !pthread_create(&journal->flusher, NULL, keep_flushed, journal);
  return journal;
}

int gx_journal_append(struct gx_journal *journal, size_t index, const struct gx_result *result)
{
  struct gx_journal_body body;
  memset(&body, 0, sizeof body);
  body.result = *result;
  const struct gx_history *history = &result->history;
  const struct gx_spectra *spectra = &result->spectra;
  body.probes = history->samples && history->probe;
  body.budgets = history->samples && history->budget;
  body.result.history.sample = NULL;
  body.result.history.probe = NULL;
  body.result.history.budget = NULL;
  body.result.spectra.time = body.result.spectra.rms = NULL;
  size_t samples = history->samples, lines = spectra->samples;
  uint64_t packed[GX_PACKING_MOST(GX_JOURNAL_BODY)];
  struct gx_journal_record record = {.magic = GX_JOURNAL_RECORD_MAGIC, .index = index, .sum = GX_CHECKSUM_START};
  struct iovec part[] = {
      {&record, sizeof record},
      {packed, 8 * gx_packing_pack(&body, GX_JOURNAL_BODY, packed)},
      {history->sample, samples * sizeof *history->sample},
      {history->probe, body.probes * samples * sizeof *history->probe},
      {history->budget, body.budgets * samples * sizeof *history->budget},
      {spectra->time, lines * sizeof *spectra->time},
      {spectra->rms, lines * GX_QUANTITIES * spectra->bins * sizeof *spectra->rms},
  };
  enum { PARTS = sizeof part / sizeof *part };
  for (int i = 1; i < PARTS; i++) {
    record.length += part[i].iov_len;
    record.sum = gx_checksum(record.sum, part[i].iov_base, part[i].iov_len);
  }
  record.own = gx_checksum(GX_CHECKSUM_START, &record, offsetof(struct gx_journal_record, own));
  pthread_mutex_lock(&journal->lock);
  int failed = journal->broken ? journal->broken : write_all(journal, part, PARTS);
  journal->dirty = true;
  if (!failed) journal->empty = false;
  pthread_mutex_unlock(&journal->lock);
  return failed ? say(journal, strerror(failed)) : 0;
}

int gx_journal_close(struct gx_journal *journal)
{
  if (!journal) return 0;
  if (journal->flushed_by_thread) {
    pthread_mutex_lock(&journal->lock);
    journal->closed = true;
    pthread_cond_signal(&journal->closing);
    pthread_mutex_unlock(&journal->lock);
    pthread_join(journal->flusher, NULL);
  }
  int failed = flush(journal->file);
  if (journal->empty) unlink(journal->path);
  if (!failed) failed = journal->broken;
  if (close(journal->file) && !failed) failed = errno;
  if (failed) say(journal, strerror(failed));
  pthread_cond_destroy(&journal->closing);
  pthread_mutex_destroy(&journal->lock);
  free(journal->path);
  free(journal);
  return failed ? -1 : 0;
}
