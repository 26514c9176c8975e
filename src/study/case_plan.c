/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planning one case. */
#include <gridcross/study.h>

#include <math.h>

#include "kept.h"
#include "simulation_plan.h"
#include "stability.h"
#include "stable_dt.h"

struct gx_plan gx_case_plan(const struct gx_case *one)
{
  struct gx_plan plan = {.outcome = {.status = GX_OK, .particle = -1}, .stable_dt = NAN, .growth = NAN};
  struct gx_simulation simulation;
  if (gx_simulation_plan(&simulation, one, &plan.outcome) == GX_OK && gx_simulation_build(&simulation, &plan.outcome) == GX_OK &&
      gx_kept_refuse(&simulation, one, &plan.outcome) == GX_OK) {
    plan.particles = (double)simulation.particles->n;
    plan.stable_dt = gx_stable_dt(one, false, NULL);
    if (!simulation.space->through_cells)
      plan.growth = gx_stability_growth(simulation.space); /* else it sees the flow's own stretching */
  }
  plan.dt = simulation.dt;
  plan.end = simulation.end;
  plan.steps = simulation.steps;
  gx_simulation_free(&simulation);
  return plan;
}
