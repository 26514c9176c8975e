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
  double frequency;               /* of the exact solution, 1/s */
  const struct gx_points *points; /* that the body is made of, borrowed; NULL: it is filled */
  struct gx_particles *particles;
  struct gx_posed *posed;
  struct gx_space *space;
};

/* Reads the options of a case and settles dt and steps. Refuses, with the reason, what cannot run. */
enum gx_status gx_simulation_plan(struct gx_simulation *simulation, const struct gx_case *one, struct gx_outcome *outcome);
/* Allocates and sets the initial state, by the three steps below. simulation is freed by gx_simulation_free in any case. */
enum gx_status gx_simulation_build(struct gx_simulation *simulation, struct gx_outcome *outcome);
/* Particles at rest. */
enum gx_status gx_simulation_lay_out(struct gx_simulation *simulation, struct gx_outcome *outcome);
/* The problem posed at the particles, and their initial state. */
enum gx_status gx_simulation_pose(struct gx_simulation *simulation, struct gx_outcome *outcome);
/* The space. Without exact solution a staggered clock's velocity starts half a kick back: as after a kick by -dt/2. */
enum gx_status gx_simulation_open(struct gx_simulation *simulation, struct gx_outcome *outcome);
void gx_simulation_free(struct gx_simulation *simulation);
/* Whether the problem itself keeps linear, and angular, momentum: no body force, nothing held, and for angular momentum no periodic
 * image of the body within reach of a basis function, however the body of the start turns. Of a simulation that was built. */
void gx_simulation_conserves(const struct gx_simulation *simulation, bool *linear, bool *angular);
/* Largest kinetic energy of the exact solution over a period, or up to the end where there is none, sampled. Without exact
 * solution: the energy at the start, kinetic and elastic, and what the body force, sampled likewise, can add to it: its work over
 * the length of the domain between ends, what it gives a free body in the time to run where the domain is periodic. J */
double gx_simulation_kinetic_bound(const struct gx_simulation *simulation);

#endif
