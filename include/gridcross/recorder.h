/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the snapshots and checkpoints of cases in a study directory:
 *   case-<id>.h5         openPMD 1.1, base layout: /data/<step>/particles/material_points, /data/<step>/meshes (where there is a grid)
 *   case-<id>.xmf        the particles, and
 *   case-<id>-grid.xmf   the grid, for ParaView
 * Each is written under a hidden name, .<name>.partial, and renamed when its case ends, the .h5 last: where it is, it is whole. Equal
 * cases give equal bytes.
 *   .case-<id>.checkpoint          the state of a case under way, and
 *   .case-<id>.snapshots.partial   its snapshots so far, in the place of the above
 * Both are of a case with output.checkpoint, and are removed once its result is kept. Functions that return int give 0, or -1 after a message to `errors`. */
#ifndef GRIDCROSS_RECORDER_H
#define GRIDCROSS_RECORDER_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/study.h>

struct gx_recorder;

/* directory: exists; errors: for what goes wrong later. Both are borrowed. NULL when memory runs out. */
struct gx_recorder *gx_recorder_create(const char *directory, FILE *errors);
void gx_recorder_free(struct gx_recorder *recorder);
/* For gx_study_means, as long as the recorder lives. */
const struct gx_observer *gx_recorder_observer(const struct gx_recorder *recorder);

/* From now on checkpoints are kept, with the text of an identity, which is borrowed. resume: a case goes on with one of that identity.
 * quiet: no notes of that. Before the observer is used. */
void gx_recorder_keep(struct gx_recorder *recorder, const char *identity, bool resume, bool quiet);
/* Whether a case has a checkpoint of that identity. */
bool gx_recorder_goes_on(const struct gx_recorder *recorder, const char *id);
/* The case has a result: its checkpoint is removed, if there is one. */
void gx_recorder_forget(const struct gx_recorder *recorder, const char *id);
/* -1 after a message where checkpoints stand in the way of a run that would not go on with them: those of other cases than the study's.
 * study: NULL: it goes on with none. */
int gx_recorder_refuse(const char *directory, const struct gx_study *study, FILE *errors);

/* Whether the snapshots of a case are there. */
bool gx_recorder_has(const char *directory, const char *id);
/* Whether that is the name of a file of ours, whole or partial. */
bool gx_recorder_owns(const char *name);
/* Copies those of a case from one directory to another. */
int gx_recorder_copy(const char *from, const char *to, const char *id, FILE *errors);
/* Removes partial files, and the snapshots of cases that are not of the study; once no case of it is under way. */
int gx_recorder_tidy(const char *directory, const struct gx_study *study, FILE *errors);

#endif
