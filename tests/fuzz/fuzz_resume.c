/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --resume in the directory of an interrupted run: a journal, a checkpoint, the log of snapshots, snapshots. The first byte says which
 * file is damaged, the second whether the checksums that it has, or that others have of it, are made right. */
#include <dirent.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/store.h>

#include "core/checksum.h"
#include "fuzz.h"
#include "store/checkpoint.h"
#include "store/journal.h"

enum { MOST_FILES = 16, KEEP = 5 }; /* the run is interrupted at so many checkpoints, in its second case */

/* Of a checkpoint, behind its magic. */
struct checkpoint_head {
  char magic[8];
  struct gx_checkpoint_mark mark;
  uint64_t identity, length, sum, own;
};

static struct {
  struct gx_study *study;
  size_t files;
  char name[MOST_FILES][FUZZ_PATH];
  uint8_t *bytes[MOST_FILES]; /* good ones */
  size_t size[MOST_FILES];
  size_t checkpoint; /* of the files */
} whole;

static const struct gx_observer *original;
static atomic_bool cancel;
static int kept;

static int keep(void *watched, const struct gx_checkpoint *checkpoint)
{
  if (++kept == KEEP) cancel = true;
  return original->keep(watched, checkpoint);
}

static bool ends_in(const char *name, const char *ending)
{
  const size_t length = strlen(name), n = strlen(ending);
  return length >= n && !strcmp(name + length - n, ending);
}

static void begin(void)
{
  static const char text[] = "problem: {name: bar-neo-hookean}\n"
                             "mesh: {cells: 4, particles_per_cell: 2}\n"
                             "method: {degree: [1, 2]}\n"
                             "time: {steps: 4}\n"
                             "output: {histories: 1, spectra: 1, snapshots: 1, budget: 1, probe: '0.5', checkpoint: 1}\n";
  fuzz_directory();
  whole.study = gx_runfile_parse("under-way.yaml", text, stderr);
  struct gx_store *store = whole.study ? gx_store_open(fuzz_path("study"), whole.study, &(struct gx_store_how){0}, stderr) : NULL;
  if (!store) abort();
  original = gx_store_observer(store);
  struct gx_observer observer = *original;
  observer.keep = keep;
  struct gx_study_means means = {.threads = 1, .sink = gx_store_sink(store), .observer = &observer, .cancel = &cancel};
  if (!gx_study_run(whole.study, &means) || gx_store_close(store)) abort();
  DIR *stream = opendir(fuzz_path("study"));
  for (struct dirent *entry; stream && (entry = readdir(stream));) {
    if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..") || whole.files == MOST_FILES) continue;
    const size_t i = whole.files++;
    snprintf(whole.name[i], sizeof whole.name[i], "study/%.100s", entry->d_name);
    whole.bytes[i] = fuzz_read(whole.name[i], &whole.size[i]);
  }
  if (stream) closedir(stream);
  for (size_t i = 1; i < whole.files; i++) /* in the order of their names */
    for (size_t k = i; k > 0 && strcmp(whole.name[k - 1], whole.name[k]) > 0; k--) {
      char name[FUZZ_PATH];
      uint8_t *bytes = whole.bytes[k];
      const size_t size = whole.size[k];
      memcpy(name, whole.name[k], sizeof name);
      memcpy(whole.name[k], whole.name[k - 1], sizeof name);
      memcpy(whole.name[k - 1], name, sizeof name);
      whole.bytes[k] = whole.bytes[k - 1];
      whole.bytes[k - 1] = bytes;
      whole.size[k] = whole.size[k - 1];
      whole.size[k - 1] = size;
    }
  whole.checkpoint = MOST_FILES;
  for (size_t i = 0; i < whole.files; i++)
    if (ends_in(whole.name[i], ".checkpoint")) whole.checkpoint = i;
  if (whole.checkpoint == MOST_FILES) abort(); /* nothing was under way */
}

static void seal_checkpoint(uint8_t *bytes, size_t size)
{
  struct checkpoint_head head;
  if (size < sizeof head) return;
  memcpy(&head, bytes, sizeof head);
  const uint64_t behind = size - sizeof head, identity = (head.identity + 7) / 8 * 8;
  head.length = behind > identity ? behind - identity : 0;
  head.sum = gx_checksum(GX_CHECKSUM_START, bytes + sizeof head, (size_t)behind);
  head.own = gx_checksum(GX_CHECKSUM_START, &head, offsetof(struct checkpoint_head, own));
  memcpy(bytes, &head, sizeof head);
}

/* The checkpoint says what its log is. */
static void seal_log(const uint8_t *bytes, size_t size)
{
  struct checkpoint_head head;
  uint8_t *checkpoint = whole.bytes[whole.checkpoint];
  const size_t length = size / 8 * 8, own = whole.size[whole.checkpoint];
  uint8_t *copy = malloc(own + 1);
  if (!copy) abort();
  memcpy(copy, checkpoint, own);
  memcpy(&head, copy, sizeof head);
  head.mark.log = length;
  head.mark.log_sum = gx_checksum(GX_CHECKSUM_START, bytes, length);
  memcpy(copy, &head, sizeof head);
  seal_checkpoint(copy, own);
  fuzz_write(whole.name[whole.checkpoint], copy, own);
  free(copy);
}

/* All records that a journal then has, by their lengths. */
static void seal_journal(uint8_t *bytes, size_t size)
{
  struct gx_journal_head head;
  struct gx_journal_record record;
  if (size < sizeof head) return;
  memcpy(&head, bytes, sizeof head);
  for (uint64_t at = sizeof head + (head.length + 7) / 8 * 8; at < size && size - at >= sizeof record;
       at += sizeof record + record.length) {
    memcpy(&record, bytes + at, sizeof record);
    if (record.length > size - at - sizeof record) return;
    record.sum = gx_checksum(GX_CHECKSUM_START, bytes + at + sizeof record, (size_t)record.length);
    record.own = gx_checksum(GX_CHECKSUM_START, &record, offsetof(struct gx_journal_record, own));
    memcpy(bytes + at, &record, sizeof record);
  }
}

static void seal(size_t i)
{
  size_t size;
  uint8_t *bytes = fuzz_read(whole.name[i], &size);
  if (ends_in(whole.name[i], ".checkpoint")) seal_checkpoint(bytes, size);
  if (ends_in(whole.name[i], ".snapshots.partial")) seal_log(bytes, size);
  if (strstr(whole.name[i], ".journal-")) seal_journal(bytes, size);
  fuzz_write(whole.name[i], bytes, size);
  free(bytes);
}

static void go_on(void)
{
  const struct gx_store_how how = {.resume = true, .quiet = true};
  struct gx_store *store = gx_store_open(fuzz_path("study"), whole.study, &how, fuzz_quiet());
  if (!store) return;
  struct gx_study_means means = {
      .threads = 1, .sink = gx_store_sink(store), .observer = gx_store_observer(store), .skip = gx_store_skip(store)};
  if (!gx_study_run(whole.study, &means)) gx_store_finish(store, &(struct gx_store_run){.command = "fuzz"});
  gx_store_close(store);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  if (!whole.study) begin();
  if (size < 2) return 0;
  const size_t damaged = data[0] % whole.files;
  fuzz_clear("study");
  fuzz_make("study");
  for (size_t i = 0; i < whole.files; i++)
    if (i != damaged) fuzz_write(whole.name[i], whole.bytes[i], whole.size[i]);
  fuzz_damage(whole.name[damaged], whole.bytes[damaged], whole.size[damaged], data + 2, size - 2);
  if (data[1] % 2) seal(damaged);
  go_on();
  return 0;
}
