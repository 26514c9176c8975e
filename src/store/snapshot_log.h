/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The snapshots of a case under way as plain numbers in a file that only grows. An HDF5 file that is cut short cannot be gone on with
 * to the same bytes; this can be cut back to what a checkpoint knew, and is made into HDF5 once all snapshots are there. */
#ifndef GRIDCROSS_STORE_SNAPSHOT_LOG_H
#define GRIDCROSS_STORE_SNAPSHOT_LOG_H

#include <stdint.h>

#include <gridcross/snapshot.h>

struct gx_snapshot_log {
  int file;             /* descriptor */
  uint64_t length, sum; /* bytes so far, and their checksum */
};

/* Opens the file, or makes it, and cuts it to a length, of this checksum; length 0: to begin with. Returns 0 or errno: ENODATA where
 * the file does not begin with that. */
int gx_snapshot_log_open(struct gx_snapshot_log *log, const char *path, uint64_t length, uint64_t sum);
/* Both return 0 or errno. */
int gx_snapshot_log_put(struct gx_snapshot_log *log, const struct gx_snapshot *snapshot);
int gx_snapshot_log_flush(struct gx_snapshot_log *log);
/* Shows all snapshots again, in their order. Returns 0, errno, or what `show` returned. */
int gx_snapshot_log_replay(const struct gx_snapshot_log *log, int (*show)(void *context, const struct gx_snapshot *snapshot),
                           void *context);
void gx_snapshot_log_close(struct gx_snapshot_log *log);

#endif
