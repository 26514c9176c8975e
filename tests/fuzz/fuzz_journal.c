/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Journals. The first byte says whether the rest is a file, or what follows the head of a record whose checksums are right. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/checksum.h"
#include "fuzz.h"
#include "store/journal.h"

static int file;

static void take(void *context, size_t index, uint64_t offset)
{
  struct gx_result result;
  (void)context, (void)index;
  if (gx_journal_scan_result(file, NULL, offset, &result)) return;
  struct gx_table *table = gx_study_table_history(&result);
  gx_table_free(table);
  gx_case_free(&result);
}

static void write_record(const uint8_t *data, size_t size)
{
  const size_t room = size / 8 * 8;
  struct gx_journal_record record = {
      .magic = GX_JOURNAL_RECORD_MAGIC, .length = room, .sum = gx_checksum(GX_CHECKSUM_START, data, room)};
  record.own = gx_checksum(GX_CHECKSUM_START, &record, offsetof(struct gx_journal_record, own));
  uint8_t *bytes = malloc(sizeof record + room);
  if (!bytes) abort();
  memcpy(bytes, &record, sizeof record);
  memcpy(bytes + sizeof record, data, room);
  fuzz_write("journal", bytes, sizeof record + room);
  free(bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  if (size && *data % 2)
    write_record(data + 1, size - 1);
  else
    fuzz_write("journal", data + (size > 0), size - (size > 0));
  file = open(fuzz_path("journal"), O_RDONLY);
  if (file < 0) abort();
  free(gx_journal_scan_identity(file));
  gx_journal_scan(file, take, NULL);
  close(file);
  return 0;
}
