/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A case made ready to run: particles, posed problem, space, clock, and the steps to take. */
#ifndef GRIDCROSS_STUDY_SIMULATION_H
#define GRIDCROSS_STUDY_SIMULATION_H

#include <gridcross/clock.h>
#include <gridcross/study.h>

struct gx_simulation {
  struct gx_problem_options problem_options;
  struct gx_space_options space_options;
  const struct gx_problem *problem;
  const struct gx_space_kind *kind;
  const struct gx_clock *clock;
  enum gx_layout layout;
  int per_cell;
  bool jumps;            /* output.jumps */
  double start, end, dt; /* s */
  double steps;
  double frequency; /* of the exact solution, 1/s */
  bool built;       /* the three below exist */
  struct gx_particles *particles;
  struct gx_posed *posed;
  struct gx_space *space;
};

/* Reads the options of a case and settles dt and steps. Refuses, with the reason, what cannot run. */
enum gx_status gx_simulation_plan(struct gx_simulation *simulation, const struct gx_case *one, struct gx_outcome *outcome);
/* Allocates and sets the initial state. simulation is freed by gx_simulation_free in any case. */
enum gx_status gx_simulation_build(struct gx_simulation *simulation, struct gx_outcome *outcome);
void gx_simulation_free(struct gx_simulation *simulation);
/* Whether the problem itself keeps linear, and angular, momentum: no body force, nothing held, and for angular momentum no
 * periodic images that pull at the body's ends. */
void gx_simulation_conserves(const struct gx_simulation *simulation, bool *linear, bool *angular);
/* Largest kinetic energy of the exact solution over a period, or up to the end where there is none, sampled, J. */
double gx_simulation_kinetic_bound(const struct gx_simulation *simulation);

#endif
