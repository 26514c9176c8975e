/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A snapshot is a head, then an entry and the arrays of each record; those of constant records come with the first snapshot alone. */
#include "snapshot_log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../core/checksum.h"

struct head {
  double step, time, dt, spacing[GX_MAX_DIM];
  uint64_t dim, moving;
  struct {
    uint64_t n, count, shape[GX_MAX_DIM];
  } set[2]; /* particles, vertices */
};

struct entry {
  char name[32];
  int64_t rank, length, mass, time, constant;
  double offset;
};

static int transfer(int file, bool writing, void *bytes, size_t length)
{
  for (char *at = bytes; length;) {
    ssize_t moved = writing ? write(file, at, length) : read(file, at, length);
    if (moved < 0 && errno == EINTR) continue;
    if (moved < 0) return errno;
    if (moved == 0) return ENODATA;
    at += moved;
    length -= (size_t)moved;
  }
  return 0;
}

/* Whether the file begins with so many bytes of that checksum. */
static int check(int file, uint64_t length, uint64_t sum)
{
  enum { BLOCK = 1 << 16 }; /* a multiple of 8, as all lengths here are */
  uint64_t seen = GX_CHECKSUM_START;
  unsigned char *block = malloc(BLOCK);
  int failed = block ? 0 : ENOMEM;
  while (length && !failed) {
    const size_t n = length < BLOCK ? (size_t)length : BLOCK;
    failed = transfer(file, false, block, n);
    if (!failed) seen = gx_checksum(seen, block, n);
    length -= n;
  }
  free(block);
  return failed ? failed : seen == sum ? 0 : ENODATA;
}

int gx_snapshot_log_open(struct gx_snapshot_log *log, const char *path, uint64_t length, uint64_t sum)
{
  *log = (struct gx_snapshot_log){.file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666), .length = length, .sum = sum};
  if (!length) log->sum = GX_CHECKSUM_START;
  int failed = log->file < 0 ? errno : check(log->file, length, log->sum);
  if (!failed && (ftruncate(log->file, (off_t)length) || lseek(log->file, (off_t)length, SEEK_SET) < 0)) failed = errno;
  if (failed) gx_snapshot_log_close(log);
  return failed;
}

static int put(struct gx_snapshot_log *log, const void *bytes, size_t length)
{
  log->sum = gx_checksum(log->sum, bytes, length);
  log->length += length;
  return transfer(log->file, true, (void *)(uintptr_t)bytes, length);
}

static int put_record(struct gx_snapshot_log *log, int dim, size_t n, const struct gx_record *record, bool first)
{
  struct entry entry = {.rank = record->rank,
                        .length = record->length,
                        .mass = record->mass,
                        .time = record->time,
                        .constant = record->constant,
                        .offset = record->offset};
  strncpy(entry.name, record->name, sizeof entry.name - 1);
  int failed = put(log, &entry, sizeof entry);
  for (int k = 0; k < gx_snapshot_components(dim, record->rank) && (first || !record->constant) && !failed; k++)
    failed = put(log, record->value[k], n * sizeof(double));
  return failed;
}

int gx_snapshot_log_put(struct gx_snapshot_log *log, const struct gx_snapshot *snapshot)
{
  const struct gx_record_set *const set[2] = {&snapshot->particles, &snapshot->vertices};
  const bool first = log->length == 0;
  struct head head = {.step = snapshot->step,
                      .time = snapshot->time,
                      .dt = snapshot->dt,
                      .dim = (uint64_t)snapshot->dim,
                      .moving = snapshot->moving};
  memcpy(head.spacing, snapshot->spacing, sizeof head.spacing);
  for (int s = 0; s < 2; s++) {
    head.set[s].n = set[s]->n;
    head.set[s].count = set[s]->n ? (uint64_t)set[s]->count : 0;
    for (int d = 0; d < GX_MAX_DIM; d++) head.set[s].shape[d] = set[s]->shape[d];
  }
  int failed = put(log, &head, sizeof head);
  for (int s = 0; s < 2; s++)
    for (uint64_t r = 0; r < head.set[s].count && !failed; r++)
      failed = put_record(log, snapshot->dim, set[s]->n, &set[s]->record[r], first);
  return failed;
}

int gx_snapshot_log_flush(struct gx_snapshot_log *log)
{
  return fsync(log->file) && errno != EINVAL && errno != EROFS ? errno : 0;
}

/* A snapshot read back, its names and arrays its own. */
struct reading {
  int file;
  uint64_t length; /* of the file, bytes: it cannot hold more numbers */
  bool first;
  struct gx_snapshot snapshot;
  char name[2][GX_SNAPSHOT_RECORDS][sizeof((struct entry *)0)->name];
};

static int read_record(struct reading *reading, int s, struct gx_record_set *set, int r)
{
  struct entry entry;
  struct gx_record *record = &set->record[r];
  int failed = transfer(reading->file, false, &entry, sizeof entry);
  if (failed) return failed;
  if (entry.rank < 0 || entry.rank > 2 || !memchr(entry.name, 0, sizeof entry.name)) return ENODATA;
  memcpy(reading->name[s][r], entry.name, sizeof entry.name);
  record->name = reading->name[s][r];
  record->rank = (int)entry.rank;
  record->length = (int)entry.length;
  record->mass = (int)entry.mass;
  record->time = (int)entry.time;
  record->constant = entry.constant;
  record->offset = entry.offset;
  for (int k = 0; k < gx_snapshot_components(reading->snapshot.dim, record->rank) && !failed; k++) {
    if (!record->value[k]) record->value[k] = calloc(set->n + 1, sizeof(double));
    if (!record->value[k]) return ENOMEM;
    if (reading->first || !record->constant) failed = transfer(reading->file, false, record->value[k], set->n * sizeof(double));
  }
  return failed;
}

/* n points, of which the file can hold a component, in as many places. */
static bool is_shape(const struct gx_record_set *set, uint64_t length)
{
  double places = 1;
  for (int d = 0; d < GX_MAX_DIM; d++) places *= (double)set->shape[d];
  return set->n <= length / sizeof(double) && places == (double)set->n;
}

/* Whether there is what every file of snapshots tells of its points. */
static bool has_vector(const struct gx_record_set *set, const char *name)
{
  const struct gx_record *record = gx_snapshot_record(set, name);
  return record && record->rank == 1;
}

static bool is_sound(const struct gx_snapshot *snapshot)
{
  const struct gx_record_set *particles = &snapshot->particles, *vertices = &snapshot->vertices;
  const struct gx_record *displacement = gx_snapshot_record(vertices, "displacement");
  return has_vector(particles, "position") && has_vector(particles, "velocity") &&
         (!vertices->n || (has_vector(vertices, "velocity") && (!displacement || displacement->rank == 1)));
}

static int read_snapshot(struct reading *reading)
{
  struct gx_snapshot *snapshot = &reading->snapshot;
  struct gx_record_set *set[2] = {&snapshot->particles, &snapshot->vertices};
  struct head head;
  int failed = transfer(reading->file, false, &head, sizeof head);
  if (failed) return failed;
  if (head.dim < 1 || head.dim > GX_MAX_DIM) return ENODATA;
  snapshot->dim = (int)head.dim;
  snapshot->step = head.step;
  snapshot->time = head.time;
  snapshot->dt = head.dt;
  snapshot->moving = head.moving;
  memcpy(snapshot->spacing, head.spacing, sizeof head.spacing);
  for (int s = 0; s < 2; s++) {
    if (head.set[s].count > GX_SNAPSHOT_RECORDS || (!reading->first && head.set[s].n != set[s]->n)) return ENODATA;
    set[s]->n = (size_t)head.set[s].n;
    set[s]->count = (int)head.set[s].count;
    for (int d = 0; d < GX_MAX_DIM; d++) set[s]->shape[d] = (size_t)head.set[s].shape[d];
    if (!is_shape(set[s], reading->length)) return ENODATA;
    for (int r = 0; r < set[s]->count && !failed; r++) failed = read_record(reading, s, set[s], r);
  }
  reading->first = false;
  return failed ? failed : is_sound(snapshot) ? 0 : ENODATA;
}

int gx_snapshot_log_replay(const struct gx_snapshot_log *log, int (*show)(void *context, const struct gx_snapshot *snapshot),
                           void *context)
{
  struct reading *reading = calloc(1, sizeof *reading);
  if (!reading) return ENOMEM;
  reading->file = log->file;
  reading->length = log->length;
  reading->first = true;
  int failed = lseek(log->file, 0, SEEK_SET) < 0 ? errno : 0;
  while (!failed && (uint64_t)lseek(log->file, 0, SEEK_CUR) < log->length) {
    failed = read_snapshot(reading);
    if (!failed) failed = show(context, &reading->snapshot);
  }
  struct gx_record_set *set[2] = {&reading->snapshot.particles, &reading->snapshot.vertices};
  for (int s = 0; s < 2; s++)
    for (int r = 0; r < GX_SNAPSHOT_RECORDS; r++)
      for (int k = 0; k < GX_MAX_TENSOR; k++) free(set[s]->record[r].value[k]);
  free(reading);
  return failed;
}

void gx_snapshot_log_close(struct gx_snapshot_log *log)
{
  if (log->file >= 0) close(log->file);
  *log = (struct gx_snapshot_log){.file = -1};
}
