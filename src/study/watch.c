/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A case is shown to its observer. */
#include "watch.h"

#include <math.h>

#include "kept.h"

enum gx_status gx_watch_begin(struct gx_watch *watch, const struct gx_simulation *simulation, const struct gx_case *one,
                              const struct gx_measure *measure, const struct gx_observer *observer, struct gx_outcome *outcome)
{
  const double every = gx_kept_snapshots_every(one);
  if (!observer || every == 0) return GX_OK;
  watch->snapshots = gx_snapshot_create(simulation->space, simulation->clock, measure, simulation->space_options.cells);
  if (!watch->snapshots) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for a snapshot");
  watch->watched = observer->begin(observer->context, one);
  if (!watch->watched) return gx_status_set(outcome, GX_CANCELLED, -1, "its observer failed");
  watch->observer = observer;
  watch->every = every;
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

void gx_watch_end(struct gx_watch *watch, struct gx_outcome *outcome)
{
  if (watch->watched && watch->observer->end(watch->watched, outcome->status != GX_CANCELLED))
    gx_status_set(outcome, GX_CANCELLED, -1, "its observer failed");
  gx_snapshot_free(watch->snapshots);
  *watch = (struct gx_watch){0};
}
