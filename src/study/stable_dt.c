/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Projecting particle velocities to nodes multiplies a mode by lambda in [0, 1]; with K its stiffness, rates see the frequency
 * sqrt(lambda K). But a clock of kicks drifts with the kick it has just given to the nodes, which is not projected: a step has trace
 * 2 - dt^2 K and determinant 1 - dt^2 K (1 - lambda), and is stable for dt^2 K (2 - lambda) < 4. Taken here: lambda = 0, which is safe,
 * and K as if nodal velocities were carried; with linear elements, whose highest frequency has lambda = 1/3, that is 9 % too small. */
#include "stable_dt.h"

#include <math.h>

#include "simulation_plan.h"
#include "stability.h"

/* What a step of a splitting drifts with kicks that no projection has seen, over dt^2 a. Beside the projected motion it damps where
 * it is positive; where it is negative (rkn3, pefrl) modes that projection weakens grow at any step. */
static double unprojected_drift(const struct gx_splitting *splitting)
{
  double sum = 0;
  for (int j = 0; j < splitting->stages; j++) sum += splitting->kick[j] * splitting->drift[j + 1];
  return sum;
}

/* Few steps of many particles cost less than the power iteration, whose answer they do not need. Nor do runs that ask for fewer steps than
 * the iteration takes at least; a budget costs as much as tens of steps. */
static bool is_worth_an_estimate(const struct gx_simulation *simulation, const struct gx_case *one, bool running)
{
  const double blink = 1e7; /* particle evaluations: tenths of a second */
  double lattice = pow((double)simulation->space_options.cells[0] * simulation->per_cell, simulation->problem_options.dim);
  double particles = simulation->points ? (double)simulation->points->n : lattice;
  bool few_wanted = one->value[GX_TIME_STEPS].type == GX_INTEGER && simulation->steps < GX_STABILITY_LEAST;
  bool short_run = few_wanted && one->value[GX_OUTPUT_BUDGET].type != GX_INTEGER;
  if (running && short_run) return false;
  return simulation->steps >= GX_STABILITY_EVALUATIONS || particles * GX_STABILITY_EVALUATIONS <= blink;
}

double gx_stable_dt(const struct gx_case *one, bool running, struct gx_team *team)
{
  struct gx_simulation simulation;
  struct gx_outcome outcome;
  double dt = NAN;
  bool planned = gx_simulation_plan(&simulation, one, &outcome) == GX_OK;
  simulation.space_options.team = team;
  if (planned && simulation.problem->material->piola &&
      is_worth_an_estimate(&simulation, one, running)) { /* without stress nothing vibrates */
    bool projected = simulation.space_options.each_step && !simulation.clock->tableau;
    if (projected) simulation.space_options.each_step = false;
    if (projected && simulation.clock->splitting && unprojected_drift(simulation.clock->splitting) < 0)
      dt = 0;
    else if (gx_simulation_build(&simulation, &outcome) == GX_OK)
      dt = simulation.clock->stability / gx_stability_frequency(simulation.space) * (projected ? M_SQRT1_2 : 1);
  }
  gx_simulation_free(&simulation);
  return dt;
}
