/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading journals, of which nothing is believed but what its checksum proves. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../core/checksum.h"
#include "journal.h"

enum { WINDOW = 1 << 16, MOST_IDENTITY = 1 << 20 };

/* A piece of the file that is in memory. */
struct window {
  int file;
  uint64_t size; /* of the file, bytes */
  uint64_t start;
  size_t length;
  bool failed;
  unsigned char byte[WINDOW];
};

static int measure(int file, uint64_t *size)
{
  struct stat status;
  if (fstat(file, &status) || status.st_size < 0) return -1;
  *size = (uint64_t)status.st_size;
  return 0;
}

/* So many bytes, at most WINDOW, or NULL where the file ends before, or cannot be read. */
static const unsigned char *look(struct window *window, uint64_t offset, size_t length)
{
  if (offset > window->size || window->size - offset < length) return NULL;
  if (offset < window->start || offset + length > window->start + window->length) {
    window->length = window->size - offset < WINDOW ? (size_t)(window->size - offset) : WINDOW;
    window->start = offset;
    if (gx_pages_read(NULL, window->file, offset, window->byte, window->length)) {
      window->failed = true;
      window->length = 0;
      return NULL;
    }
  }
  return window->byte + (offset - window->start);
}

/* Whether a record's head is there. */
static bool read_record(struct window *window, uint64_t offset, struct gx_journal_record *record)
{
  const unsigned char *bytes = look(window, offset, sizeof *record);
  if (!bytes) return false;
  memcpy(record, bytes, sizeof *record);
  return record->magic == GX_JOURNAL_RECORD_MAGIC &&
         record->own == gx_checksum(GX_CHECKSUM_START, record, offsetof(struct gx_journal_record, own)) &&
         record->length % 8 == 0;
}

static bool is_whole(struct window *window, uint64_t offset, const struct gx_journal_record *record)
{
  uint64_t at = offset + sizeof *record, sum = GX_CHECKSUM_START;
  if (window->size - at < record->length) return false;
  for (uint64_t left = record->length; left;) {
    size_t length = left < WINDOW ? (size_t)left : WINDOW;
    const unsigned char *bytes = look(window, at, length);
    if (!bytes) return false;
    sum = gx_checksum(sum, bytes, length);
    at += length;
    left -= length;
  }
  return sum == record->sum;
}

/* Where another record may begin at or after the offset. */
static uint64_t next_magic(struct window *window, uint64_t offset)
{
  const uint64_t magic = GX_JOURNAL_RECORD_MAGIC;
  const unsigned char *bytes;
  while ((bytes = look(window, offset, sizeof magic)) && memcmp(bytes, &magic, sizeof magic) != 0) offset++;
  return bytes ? offset : window->size;
}

/* A damaged record is looked through for others, since bytes may be missing from it. Heads can be forged of which each claims all that
 * follows; what is left of `budget` bounds what is read in vain. */
static uint64_t pass_damaged(struct window *window, uint64_t offset, const struct gx_journal_record *record, uint64_t *budget)
{
  const uint64_t length = sizeof *record + record->length;
  if (record->length > window->size - offset - sizeof *record) return next_magic(window, offset + 1); /* nothing was read */
  if (length > *budget) return offset + length;
  *budget -= length;
  return next_magic(window, offset + 1);
}

int gx_journal_scan(int file, void (*found)(void *context, size_t index, uint64_t offset), void *context)
{
  struct window *window = calloc(1, sizeof *window);
  if (!window) return -1;
  window->file = file;
  int failed = measure(file, &window->size);
  uint64_t budget = 4 * window->size;
  for (uint64_t offset = 0; !failed && offset < window->size;) {
    struct gx_journal_record record;
    if (!read_record(window, offset, &record)) {
      offset = next_magic(window, offset + 1);
    } else if (is_whole(window, offset, &record)) {
      found(context, record.index, offset);
      offset += sizeof record + record.length;
    } else {
      offset = pass_damaged(window, offset, &record, &budget);
    }
    failed = window->failed ? -1 : 0;
  }
  free(window);
  return failed;
}

char *gx_journal_scan_identity(int file)
{
  struct gx_journal_head head;
  uint64_t size;
  if (measure(file, &size) || gx_pages_read(NULL, file, 0, &head, sizeof head) || head.magic != GX_JOURNAL_MAGIC ||
      head.length > MOST_IDENTITY)
    return NULL;
  size_t room = (size_t)(head.length + 7) / 8 * 8;
  char *text = calloc(1, room + 1);
  if (text && !gx_pages_read(NULL, file, sizeof head, text, room) && strlen(text) == head.length &&
      head.sum == gx_checksum(gx_checksum(GX_CHECKSUM_START, &head.length, sizeof head.length), text, room))
    return text;
  free(text);
  return NULL;
}

/* Takes an array out of what follows; NULL when it is too short or memory runs out. */
static void *take(const char **at, size_t *left, uint64_t count, size_t size)
{
  if (count > *left / size) return NULL;
  size_t length = (size_t)count * size;
  void *array = malloc(length + 1);
  if (!array) return NULL;
  memcpy(array, *at, length);
  *at += length;
  *left -= length;
  return array;
}

static bool is_sound(const struct gx_journal_body *body)
{
  const struct gx_result *result = &body->result;
  unsigned char jumps;
  int status;
  memcpy(&jumps, &result->history.jumps, 1);
  memcpy(&status, &result->outcome.status, sizeof status);
  return jumps <= 1 && status >= 0 && status < GX_CANCELLED && memchr(result->outcome.reason, 0, GX_REASON_LENGTH) &&
         result->history.dim >= 0 && result->history.dim <= GX_MAX_DIM && body->probes <= 1 && body->budgets <= 1 &&
         result->spectra.bins <= SIZE_MAX / 64 && !result->history.sample && !result->history.probe && !result->history.budget &&
         !result->spectra.time && !result->spectra.rms;
}

/* What follows a record's head as a result. */
static int unpack(const uint64_t *words, size_t count, struct gx_result *result)
{
  struct gx_journal_body body;
  const size_t packed = gx_packing_unpack(words, count, &body, GX_JOURNAL_BODY);
  if (!packed || !is_sound(&body)) return -1;
  const char *at = (const char *)(words + packed);
  size_t left = 8 * (count - packed), samples = body.result.history.samples, lines = body.result.spectra.samples;
  *result = body.result;
  struct gx_history *history = &result->history;
  struct gx_spectra *spectra = &result->spectra;
  bool whole = !samples || ((history->sample = take(&at, &left, samples, sizeof *history->sample)) &&
                            (!body.probes || (history->probe = take(&at, &left, samples, sizeof *history->probe))) &&
                            (!body.budgets || (history->budget = take(&at, &left, samples, sizeof *history->budget))));
  size_t each = GX_QUANTITIES * spectra->bins * sizeof *spectra->rms;
  whole = whole && (!lines || (each && (spectra->time = take(&at, &left, lines, sizeof *spectra->time)) &&
                               (spectra->rms = take(&at, &left, lines, each))));
  if (whole && !left) return 0;
  gx_case_free(result);
  return -1;
}

/* Most records have neither history nor spectra, and need no memory. */
int gx_journal_scan_result(int file, struct gx_pages *pages, uint64_t offset, struct gx_result *result)
{
  struct gx_journal_record record;
  uint64_t few[GX_PACKING_MOST(GX_JOURNAL_BODY)], size, *words = few;
  if (gx_pages_read(pages, file, offset, &record, sizeof record) ||
      record.own != gx_checksum(GX_CHECKSUM_START, &record, offsetof(struct gx_journal_record, own)) || record.length % 8)
    return -1;
  if (record.length > sizeof few && (measure(file, &size) || record.length > size || !(words = malloc((size_t)record.length))))
    return -1;
  int failed = gx_pages_read(pages, file, offset + sizeof record, words, (size_t)record.length) ||
               gx_checksum(GX_CHECKSUM_START, words, (size_t)record.length) != record.sum ||
               unpack(words, (size_t)record.length / 8, result);
  if (words != few) free(words);
  return failed ? -1 : 0;
}
