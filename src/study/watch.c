/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A case is shown to its observer, and left with it. */
#include "watch.h"

#include <math.h>

#include "kept.h"

enum gx_status gx_watch_begin(struct gx_watch *watch, const struct gx_simulation *simulation, const struct gx_case *one,
                              struct gx_measure *measure, const struct gx_observer *observer, struct gx_outcome *outcome)
{
  const struct gx_value *keep = &one->value[GX_OUTPUT_CHECKPOINT];
  const double every = gx_kept_snapshots_every(one);
  const double keep_every = keep->type == GX_INTEGER && observer && observer->keep ? (double)keep->integer : 0;
  if (!observer || (every == 0 && keep_every == 0)) return GX_OK;
  if (every > 0)
    watch->snapshots = gx_snapshot_create(simulation->space, simulation->clock, measure, simulation->space_options.cells);
  if (every > 0 && !watch->snapshots) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for a snapshot");
  watch->watched = observer->begin(observer->context, one);
  if (!watch->watched) return gx_status_set(outcome, GX_CANCELLED, -1, "its observer failed");
  watch->observer = observer;
  watch->every = every;
  watch->keep_every = keep_every;
  return GX_OK;
}

bool gx_watch_is_due(const struct gx_watch *watch, double step, bool last)
{
  return watch->every > 0 && (last || fmod(step, watch->every) == 0);
}

enum gx_status gx_watch_show(struct gx_watch *watch, double step, double time, double dt, struct gx_outcome *outcome)
{
  const struct gx_snapshot *snapshot = gx_snapshot_take(watch->snapshots, step, time, dt);
  if (!watch->observer->show(watch->watched, snapshot)) return GX_OK;
  return gx_status_set(outcome, GX_CANCELLED, -1, "its observer failed");
}

enum gx_status gx_watch_restore(struct gx_watch *watch, const struct gx_checkpoint *checkpoint, bool *loaded,
                                struct gx_outcome *outcome)
{
  const int found = watch->keep_every > 0 ? watch->observer->restore(watch->watched, checkpoint) : 0;
  *loaded = found > 0;
  return found < 0 ? gx_status_set(outcome, GX_CANCELLED, -1, "its checkpoint could not be loaded") : GX_OK;
}

enum gx_status gx_watch_keep(struct gx_watch *watch, const struct gx_checkpoint *checkpoint, struct gx_outcome *outcome)
{
  if (!watch->observer->keep(watch->watched, checkpoint)) return GX_OK;
  return gx_status_set(outcome, GX_CANCELLED, -1, "its observer failed");
}

void gx_watch_end(struct gx_watch *watch, struct gx_outcome *outcome)
{
  if (watch->watched && watch->observer->end(watch->watched, outcome->status != GX_CANCELLED))
    gx_status_set(outcome, GX_CANCELLED, -1, "its observer failed");
  gx_snapshot_free(watch->snapshots);
  *watch = (struct gx_watch){0};
}
