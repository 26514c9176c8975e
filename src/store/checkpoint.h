/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of checkpoints: a head, the identity of what they belong to, padded to 8 bytes, and the image of a run. They are written under
 * another name, flushed to disk and renamed: a kill at any instant leaves the old one or the new one. */
#ifndef GRIDCROSS_STORE_CHECKPOINT_H
#define GRIDCROSS_STORE_CHECKPOINT_H

#include <stdint.h>
#include <stdio.h>

#include <gridcross/study.h>

/* What a checkpoint knows besides the run. */
struct gx_checkpoint_mark {
  double step;
  uint64_t log, log_sum; /* bytes of the snapshots so far, and their checksum */
};

/* Replaces the checkpoint at a path by way of the hidden one. identity: text. Returns 0 or errno. */
int gx_checkpoint_write(const char *path, const char *hidden, const char *identity, const struct gx_checkpoint_mark *mark,
                        const struct gx_checkpoint *run);
/* Looks at the whole file. NULL where it can be loaded; else why not, "" where there is none. */
const char *gx_checkpoint_look(const char *path, const char *identity, struct gx_checkpoint_mark *mark);
/* Loads what was looked at. Returns 0, or -1: the run is neither old nor new. */
int gx_checkpoint_load(const char *path, const struct gx_checkpoint *run);

#endif
