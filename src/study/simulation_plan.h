/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the resolved parameters of a case to a simulation that can be built. */
#ifndef GRIDCROSS_STUDY_SIMULATION_PLAN_H
#define GRIDCROSS_STUDY_SIMULATION_PLAN_H

#include <gridcross/simulation.h>
#include <gridcross/study.h>

/* Reads the options of a case and settles dt and steps. Refuses, with the reason, what cannot run. */
enum gx_status gx_simulation_plan(struct gx_simulation *simulation, const struct gx_case *one, struct gx_outcome *outcome);

#endif
