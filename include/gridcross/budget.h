/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error budget: one step taken from the exact state, its errors in velocity and displacement split into terms that add up to them,
 * and the one-step errors that the papers state. It observes: a step of its own is taken beside the run.
 *
 * At its stages (gx_clock_stages) a step adds kick dt S a_i to the velocity of a particle and drift dt S v_i to its displacement.
 * Between S a_i and the exact change stand idealised accelerations, each from the exact state at the stage's time:
 *   a_p                          exact, at the particle
 *   a_i = M^-1 int rho a N dx    the best the grid can hold: consistent mass, integrals by Gauss points of the cells
 *   the same with lumped mass    where method.mass is lumped
 *   a_i = M^-1 sum m_p a_p S_ip  integrals by particles
 *   a_i = M^-1 f, exact stress   forces of the stress instead of m_p a_p, by particles
 *   a_i = M^-1 f                 forces as the method has them: on the moving mesh F comes from projected displacements
 * and velocities, exact and then the first three of these. The terms are differences of neighbours: time (dt sum kick a_p less the
 * exact change), interpolation, lumping, projection, quadrature, gradient. What is left of the step's error is the rest: stages
 * that are not exact, PIC, and, of displacement, what errors of acceleration add within the step. Terms are signed and add up
 * particle by particle; what is reported is their root mean square over particles. */
#ifndef GRIDCROSS_BUDGET_H
#define GRIDCROSS_BUDGET_H

#include <gridcross/clock.h>
#include <gridcross/space.h>

enum gx_budget_entry {
  /* of the change of velocity in one step, m/s */
  GX_BUDGET_VELOCITY_STEP, /* its error */
  GX_BUDGET_VELOCITY_SUM,  /* sum of the terms, without the rest */
  GX_BUDGET_VELOCITY_TIME,
  GX_BUDGET_VELOCITY_INTERPOLATION,
  GX_BUDGET_VELOCITY_LUMPING,
  GX_BUDGET_VELOCITY_PROJECTION,
  GX_BUDGET_VELOCITY_QUADRATURE,
  GX_BUDGET_VELOCITY_GRADIENT,
  GX_BUDGET_VELOCITY_REST,
  /* of the change of displacement in one step, m */
  GX_BUDGET_DISPLACEMENT_STEP,
  GX_BUDGET_DISPLACEMENT_SUM,
  GX_BUDGET_DISPLACEMENT_TIME,
  GX_BUDGET_DISPLACEMENT_INTERPOLATION,
  GX_BUDGET_DISPLACEMENT_LUMPING,
  GX_BUDGET_DISPLACEMENT_PROJECTION,
  GX_BUDGET_DISPLACEMENT_REST,
  /* jump error of steffen2010 eqs 83-86, of particles that cross a cell edge; what a step that stopped there would differ by is none
   * of the differences above, m */
  GX_BUDGET_DISPLACEMENT_JUMP,
  /* largest magnitudes over the particles at the start of the step, berzins2022 eqs 62-64; nodal velocities are the best that
   * the grid can hold */
  GX_BUDGET_INF_ACCELERATION, /* a_p - sum S_ip a_i, m/s^2 */
  GX_BUDGET_INF_VELOCITY,     /* v_p - sum S_ip v_i, m/s */
  GX_BUDGET_INF_GRADIENT,     /* grad v_p - sum D_ip v_i, 1/s */
  /* L2 norms over the grid's own coordinate, steffen2010 §6.4: of acceleration fields at the start of the step, m/s^2 */
  GX_BUDGET_L2_PROJECTED, /* integrals by particles of the exact acceleration, the paper's "calculated" acceleration (eq. 133) */
  GX_BUDGET_L2_FORCE,     /* of forces with exact stress */
  GX_BUDGET_L2_METHOD,    /* of forces as the method has them */
  /* and of the step with the projected acceleration, m/s, at points that move with the material */
  GX_BUDGET_L2_VELOCITY,  /* projected velocity and its change against the exact velocity after the step */
  GX_BUDGET_L2_INCREMENT, /* the change alone (eq. 122) */
  GX_BUDGET_L2_TIME,      /* the change by exact accelerations */
  GX_BUDGET_ENTRIES
};

struct gx_budget_column {
  const char *name; /* "velocity.step", "displacement.time", "inf.velocity", "l2.projected" */
  const char *unit;
};
extern const struct gx_budget_column gx_budget_columns[GX_BUDGET_ENTRIES];

/* NaN: not measured, or the step failed. */
struct gx_budget_values {
  double time; /* at the end of the step, s */
  double value[GX_BUDGET_ENTRIES];
};

struct gx_budget;

/* For cases like that of `space`, which is borrowed, with its particles as they were laid out. Refused for spaces without a grid. */
enum gx_status gx_budget_create(struct gx_budget **budget, const struct gx_space *space, const struct gx_space_options *options,
                                const struct gx_clock *clock, struct gx_outcome *outcome);
void gx_budget_free(struct gx_budget *budget);
/* Jump errors too: only for clocks that move particles once a step, through a fixed grid and by its velocity. */
void gx_budget_jumps(struct gx_budget *budget);
/* The step from t to t + dt. Fails, with GX_FAILED, for want of memory alone. */
enum gx_status gx_budget_take(struct gx_budget *budget, double t, double dt, struct gx_budget_values *values);
/* Over the steps taken so far: root mean squares, of inf.* the largest. */
struct gx_budget_values gx_budget_mean(const struct gx_budget *budget);
/* Of the steps taken so far. */
void gx_budget_image(struct gx_budget *budget, struct gx_image *image);
/* The largest term of velocity (GX_BUDGET_VELOCITY_STEP) or displacement (GX_BUDGET_DISPLACEMENT_STEP), GX_BUDGET_ENTRIES when there
 * is none; next: the one after it. */
enum gx_budget_entry gx_budget_dominant(const struct gx_budget_values *values, enum gx_budget_entry of,
                                        enum gx_budget_entry *next);

#endif
