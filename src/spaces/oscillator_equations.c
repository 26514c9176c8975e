/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The oscillator's three equations as a space: x is u, sigma is P of one particle. The interpolation error is added to v in
 * every drift and never stored. */
#include <math.h>
#include <stdlib.h>

#include <gridcross/space.h>

struct oscillator {
  struct gx_space space;
  double a;      /* acceleration */
  double opened; /* y of GX_OPEN */
};

static enum gx_status create(const struct gx_space_kind *kind, struct gx_space **out, const struct gx_space_options *options,
                             struct gx_particles *particles, const struct gx_posed *posed, struct gx_outcome *outcome)
{
  (void)options;
  struct oscillator *oscillator = calloc(1, sizeof *oscillator);
  if (!oscillator) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  oscillator->space = (struct gx_space){.kind = kind, .particles = particles, .posed = posed, .outcome = outcome};
  particles->m[0] = 2; /* the kinetic part of H is v^2 */
  posed->problem->material->piola(&posed->options.moduli, 1, 1, particles->F, particles->P);
  particles->F[0][0] = 1;
  *out = &oscillator->space;
  return GX_OK;
}

static void destroy(struct gx_space *space)
{
  free(space);
}

static enum gx_status nothing(struct gx_space *space)
{
  (void)space;
  return GX_OK;
}

static enum gx_status accelerate(struct gx_space *space, double t)
{
  (void)t;
  const struct gx_particles *particles = space->particles;
  double E = space->posed->options.moduli.young, x = particles->u[0][0], sigma = particles->P[0][0];
  ((struct oscillator *)space)->a = -(M_PI * sigma - 2 * M_PI * M_PI * E * x);
  return GX_OK;
}

/* Velocity of drifts. */
static double drift_velocity(const struct gx_space *space)
{
  return space->particles->v[0][0] + space->posed->options.interpolation_error;
}

static void advance(struct gx_space *space, double kick, double strain, double drift)
{
  struct gx_particles *particles = space->particles;
  particles->v[0][0] += kick * ((struct oscillator *)space)->a;
  double velocity = drift_velocity(space);
  particles->P[0][0] += strain * 3 * space->posed->options.moduli.young * M_PI * velocity;
  particles->u[0][0] += drift * velocity;
}

static enum gx_status twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct oscillator *oscillator = (struct oscillator *)space;
  double *x = space->particles->u[0];
  if (primitive == GX_KICK_NODES) space->particles->v[0][0] += span * oscillator->a;
  if (primitive == GX_OPEN) oscillator->opened = x[0] + span * drift_velocity(space);
  if (primitive == GX_CLOSE) x[0] = oscillator->opened + span * drift_velocity(space);
  return GX_OK;
}

static void state(struct gx_space *space, struct gx_state *list)
{
  struct gx_particles *particles = space->particles;
  *list = (struct gx_state){3, {particles->u[0], particles->v[0], particles->P[0]}, {1, 1, 1}};
}

static void rates(struct gx_space *space, double *const *rate)
{
  double velocity = drift_velocity(space);
  rate[0][0] = velocity;
  rate[1][0] = ((struct oscillator *)space)->a;
  rate[2][0] = 3 * space->posed->options.moduli.young * M_PI * velocity;
}

static double kinetic(const struct gx_space *space)
{
  return space->particles->v[0][0] * space->particles->v[0][0];
}

static double potential(const struct gx_space *space)
{
  double E = space->posed->options.moduli.young, x = space->particles->u[0][0], sigma = space->particles->P[0][0];
  return sigma * sigma / (3 * E) - 2 * E * M_PI * M_PI * x * x;
}

static void particle_acceleration(struct gx_space *space, double *const *a)
{
  a[0][0] = ((struct oscillator *)space)->a;
}

const struct gx_space_kind gx_oscillator_equations = {
    .name = "oscillator-equations",
    .help = "the oscillator's own equations",
    .source = "berzins2021 §7",
    .of_problem = true,
    .create = create,
    .free = destroy,
    .weights = nothing,
    .project = nothing,
    .accelerate = accelerate,
    .advance = advance,
    .twofold = twofold,
    .state = state,
    .rates = rates,
    .kinetic = kinetic,
    .potential = potential,
    .particle_acceleration = particle_acceleration,
};
