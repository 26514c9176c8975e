/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A case taken apart: particles in any order and state that a test gives, stepped by its clock, the end state read back. */
#ifndef GRIDCROSS_TESTS_RIG_H
#define GRIDCROSS_TESTS_RIG_H

#include "case_of.h"
#include "study/simulation_plan.h"

struct rig {
  struct gx_simulation simulation;
  struct gx_stepper *stepper;
  struct gx_outcome outcome;
  double steps;
};

/* Sets X, half_length, V0, m in another order: particle p becomes the former order[p]. */
static inline void rig_reorder(struct gx_particles *particles, const size_t *order)
{
  double *copy = malloc(particles->n * sizeof(double));
  double *arrays[2 * GX_MAX_DIM + 2] = {particles->V0, particles->m};
  int count = 2;
  for (int d = 0; d < particles->dim; d++) {
    arrays[count++] = particles->X[d];
    arrays[count++] = particles->half_length[d];
  }
  for (int k = 0; k < count; k++) {
    memcpy(copy, arrays[k], particles->n * sizeof(double));
    for (size_t p = 0; p < particles->n; p++) arrays[k][p] = copy[order[p]];
  }
  memset(particles->lattice, 0, sizeof particles->lattice);
  free(copy);
}

/* Builds the case with particles in the given order (NULL: as created) and the exact initial state, which `alter` (NULL: nobody)
 * may then change. Returns false when the case was refused. */
static inline bool rig_build(struct rig *rig, const struct gx_case *one, const size_t *order,
                             void (*alter)(struct gx_particles *particles, void *context), void *context)
{
  *rig = (struct rig){.outcome = {.status = GX_OK, .particle = -1}};
  struct gx_simulation *simulation = &rig->simulation;
  if (gx_simulation_plan(simulation, one, &rig->outcome)) return false;
  enum gx_status status = gx_simulation_lay_out(simulation, &rig->outcome);
  if (order) rig_reorder(simulation->particles, order);
  if (status == GX_OK) status = gx_simulation_pose(simulation, &rig->outcome);
  if (alter) alter(simulation->particles, context);
  if (status == GX_OK) status = gx_simulation_open(simulation, &rig->outcome);
  CHECK(status == GX_OK, "%s", rig->outcome.reason);
  rig->stepper = gx_stepper_create(simulation->clock, simulation->space, NULL);
  return true;
}

/* Takes `steps` steps (negative: all of the case) and brings the particles up to date. */
static inline void rig_run(struct rig *rig, double steps)
{
  struct gx_simulation *simulation = &rig->simulation;
  if (steps < 0) steps = simulation->steps;
  for (double k = 0; k < steps; k++, rig->steps++) {
    enum gx_status status = gx_stepper_step(rig->stepper, simulation->start + rig->steps * simulation->dt, simulation->dt);
    CHECK(status == GX_OK, "%s", rig->outcome.reason);
  }
  if (simulation->kind->settle) simulation->kind->settle(simulation->space);
}

static inline void rig_free(struct rig *rig)
{
  gx_stepper_free(rig->stepper);
  gx_simulation_free(&rig->simulation);
}

#endif
