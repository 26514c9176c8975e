/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clocks: time integrators as data, run on any space by one engine. A clock is rows of primitives, or a splitting (which is
 * rows with a regular pattern), or a Runge–Kutta tableau. */
#ifndef GRIDCROSS_CLOCK_H
#define GRIDCROSS_CLOCK_H

#include <stdbool.h>

#include <gridcross/space.h>

struct gx_row {
  enum gx_primitive primitive;
  double coefficient; /* time span / dt, where the primitive has one */
};

enum { GX_MAX_STAGES = 16 };

/* Drifts and kicks in turn: drift[0], kick[0], drift[1], ..., kick[stages - 1], drift[stages]. F and stress go with the drifts.
 * As a Runge–Kutta–Nyström method: b = kick, c_j = drift[0] + ... + drift[j]. */
struct gx_splitting {
  int stages;
  double drift[GX_MAX_STAGES + 1];
  double kick[GX_MAX_STAGES];
};

struct gx_tableau {
  int stages;
  double a[GX_MAX_STAGES][GX_MAX_STAGES]; /* strictly lower triangular */
  double b[GX_MAX_STAGES];
  double c[GX_MAX_STAGES];
};

struct gx_clock {
  const char *name;
  const char *help;
  const char *source;
  int order;
  int stages; /* acceleration evaluations per step, one that the next step reuses counted once; with plain_rows: by those */
  bool symplectic;
  bool staggered;          /* velocity lives at half steps, starting at -dt/2 */
  bool first_order_defect; /* per-step energy defect by berzins2022 eq. 94, else eq. 88 */
  double stability;        /* largest omega dt on the oscillator */
  /* exactly one of rows, splitting, tableau: */
  const struct gx_row *rows;       /* ended by GX_END */
  const struct gx_row *plain_rows; /* with rows: what they become where weights never change; NULL: the same */
  const struct gx_splitting *splitting;
  const struct gx_tableau *tableau;
};

extern const struct gx_clock *const gx_clock_family[];
const struct gx_clock *gx_clock_find(const char *name);

/* What a step takes where: at positions of time t + time dt the velocity changes by kick dt times the acceleration there, and
 * positions by drift dt times the velocity of the time at which the kicks so far have left it, velocity_time dt after the start. */
struct gx_clock_stage {
  double time, kick, drift, velocity_time;
};
/* The stages of a step in their order, the first at its start; plain: weights never change. stage: [GX_MAX_STAGES + 1]. Returns how
 * many. */
int gx_clock_stages(const struct gx_clock *clock, bool plain, struct gx_clock_stage *stage);

/* Called with the body force and velocity of a stage: its weight (s) in the work integral. */
struct gx_work_observer {
  void *context;
  /* NULL: nobody asks */
  void (*power)(void *context, struct gx_space *space, double weight);
};

struct gx_stepper;

/* NULL when memory runs out. observer may be NULL and is copied; space and clock are borrowed. */
struct gx_stepper *gx_stepper_create(const struct gx_clock *clock, struct gx_space *space,
                                     const struct gx_work_observer *observer);
void gx_stepper_free(struct gx_stepper *stepper);
/* One step from time t. */
enum gx_status gx_stepper_step(struct gx_stepper *stepper, double t, double dt);
/* Acceleration at the current state and time t without advancing; the next step from t reuses it, unless it strains or drifts
 * first. A step whose last acceleration belongs to its end leaves that for the next one, taken at t plus its drifts: the next t
 * may differ from that by round-off. */
enum gx_status gx_stepper_accelerate(struct gx_stepper *stepper, double t);
/* Of the space and its particles, and of what the next step may reuse: between steps, to continue a run bit for bit. Loading makes
 * weights, nodal fields and acceleration anew at the time at which they were made before, and can fail as they can. */
enum gx_status gx_stepper_image(struct gx_stepper *stepper, struct gx_image *image);
/* Whether a step starts with the acceleration at its start, and so reuses one that was asked for there. */
bool gx_stepper_starts_accelerated(const struct gx_stepper *stepper);

#endif
