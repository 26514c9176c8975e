/* SPDX-License-Identifier: GPL-3.0-or-later */
/* output.snapshots and output.checkpoint: what a case shows and leaves with its observer. */
#ifndef GRIDCROSS_STUDY_WATCH_H
#define GRIDCROSS_STUDY_WATCH_H

#include <gridcross/simulation.h>
#include <gridcross/study.h>

/* Starts as {0}: nobody watches. */
struct gx_watch {
  const struct gx_observer *observer; /* borrowed */
  void *watched;                      /* what it gave */
  struct gx_snapshot_maker *snapshots;
  double every;      /* steps; 0: nothing is shown */
  double keep_every; /* steps; 0: nothing is kept */
};

/* measure: of the simulation, from which snapshots are taken. observer: NULL: nobody. */
enum gx_status gx_watch_begin(struct gx_watch *watch, const struct gx_simulation *simulation, const struct gx_case *one,
                              struct gx_measure *measure, const struct gx_observer *observer, struct gx_outcome *outcome);
/* Whether the state after a step is shown. */
bool gx_watch_is_due(const struct gx_watch *watch, double step, bool last);
/* Shows it, once the measure has taken a sample there. */
enum gx_status gx_watch_show(struct gx_watch *watch, double step, double time, double dt, struct gx_outcome *outcome);
/* Loads what was kept of an equal case, if anything was: loaded. */
enum gx_status gx_watch_restore(struct gx_watch *watch, const struct gx_checkpoint *checkpoint, bool *loaded,
                                struct gx_outcome *outcome);
/* Keeps the state after a step, of a watch with keep_every. */
enum gx_status gx_watch_keep(struct gx_watch *watch, const struct gx_checkpoint *checkpoint, struct gx_outcome *outcome);
/* The case ends with this outcome. */
void gx_watch_end(struct gx_watch *watch, struct gx_outcome *outcome);

#endif
