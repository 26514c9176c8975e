/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A simulation put together from structs, the library's or one's own: problem, material, basis, space, clock.
 *
 *   gx_status_quiet_gsl();
 *   struct gx_simulation simulation = gx_simulation_begin(&problem, gx_space_find("standard"), gx_clock_find("rk4"));
 *   simulation.space_options.basis = &basis;
 *   simulation.dt = ..., simulation.steps = ...;
 *   gx_simulation_check, gx_simulation_build: particles in their initial state, and the space on them
 *   gx_measure_create, gx_stepper_create on simulation.space; then gx_stepper_step and gx_measure_take in turn
 *   ... and the frees in the reverse order, gx_simulation_free last.
 *
 * runs/library/bar.c is a whole program. */
#ifndef GRIDCROSS_SIMULATION_H
#define GRIDCROSS_SIMULATION_H

#include <gridcross/clock.h>

struct gx_simulation {
  /* what to simulate, set by the caller; all pointers borrowed */
  const struct gx_problem *problem; /* with its material */
  const struct gx_space_kind *kind;
  const struct gx_clock *clock;
  struct gx_problem_options problem_options;
  struct gx_space_options space_options;
  enum gx_layout layout;
  int per_cell;                   /* particles a cell and direction */
  bool jumps;                     /* gx_measure_jumps will be called */
  double start, end, dt;          /* s; end: of the run, start + steps dt or a little less */
  double steps;                   /* to take */
  const struct gx_points *points; /* that the body is made of; NULL: it is filled */
  /* what that becomes, owned */
  struct gx_particles *particles;
  struct gx_posed *posed;
  struct gx_space *space;
};

/* The options that a run file has which names these alone: dimension, moduli and mesh of the parameter table, quadratic B-splines,
 * lumped mass, FLIP, the space's own projection, the problem's own ends. dt and steps stay 0. */
struct gx_simulation gx_simulation_begin(const struct gx_problem *problem, const struct gx_space_kind *kind,
                                         const struct gx_clock *clock);
/* The ends of the domain, as a space takes them; problem_options.dim is set. */
void gx_simulation_bound(struct gx_simulation *simulation, enum gx_boundary boundary);
/* Refuses, with the reason, what is incomplete or has no meaning together. */
enum gx_status gx_simulation_check(const struct gx_simulation *simulation, struct gx_outcome *outcome);
/* Allocates and sets the initial state, by the three steps below, of what was checked. outcome is kept: the space tells there what
 * fails in a step. To be freed by gx_simulation_free in any case. */
enum gx_status gx_simulation_build(struct gx_simulation *simulation, struct gx_outcome *outcome);
/* Particles at rest. */
enum gx_status gx_simulation_lay_out(struct gx_simulation *simulation, struct gx_outcome *outcome);
/* The problem posed at the particles, and their initial state. */
enum gx_status gx_simulation_pose(struct gx_simulation *simulation, struct gx_outcome *outcome);
/* The space. Without exact solution a staggered clock's velocity starts half a kick back: as after a kick by -dt/2. */
enum gx_status gx_simulation_open(struct gx_simulation *simulation, struct gx_outcome *outcome);
void gx_simulation_free(struct gx_simulation *simulation);

/* Of the exact solution, 1/s; INFINITY: the problem has no period. */
double gx_simulation_frequency(const struct gx_simulation *simulation);
/* Whether the problem itself keeps linear, and angular, momentum: no body force, nothing held, and for angular momentum no periodic
 * image of the body within reach of a basis function, however the body of the start turns. Of a simulation that was built. */
void gx_simulation_conserves(const struct gx_simulation *simulation, bool *linear, bool *angular);
/* Largest kinetic energy of the exact solution over a period, or up to the end where there is none, sampled. Without exact
 * solution: the energy at the start, kinetic and elastic, and what the body force, sampled likewise, can add to it: its work over
 * the length of the domain between ends, what it gives a free body in the time to run where the domain is periodic. J */
double gx_simulation_kinetic_bound(const struct gx_simulation *simulation);

#endif
