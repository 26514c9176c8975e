/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The model problems of steffen2010 §5 as a space: one particle at x in a fixed velocity v(x), with an external acceleration a_e(x)
 * and the external velocity v_e that it adds up to. Weights evaluate v(x), a kick advances v_e, a drift moves by v(x) + v_e, so
 * that euler-stress-last is eq. 75 and eqs 89-92. As on a fixed grid, a drift keeps the v(x) of the last weights. */
#include <math.h>
#include <stdlib.h>

#include <gridcross/space.h>

#include "../problems/jump_model.h"
#include "../problems/quadrature_model.h"

struct carrier {
  struct gx_space space;
  double field;    /* v(x) of the last weights, m/s */
  double external; /* v_e, m/s */
  double a;        /* a_e, m/s^2 */
  double opened;   /* y of GX_OPEN, m */
};

static double position(const struct gx_space *space)
{
  return space->particles->X[0][0] + space->particles->u[0][0];
}

static enum gx_status create(const struct gx_space_kind *kind, struct gx_space **out, const struct gx_space_options *options,
                             struct gx_particles *particles, const struct gx_posed *posed, struct gx_outcome *outcome)
{
  (void)options;
  struct carrier *carrier = calloc(1, sizeof *carrier);
  if (!carrier) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  carrier->space = (struct gx_space){.kind = kind,
                                     .particles = particles,
                                     .posed = posed,
                                     .outcome = outcome,
                                     .through_cells = true,
                                     .edge = gx_jump_model_knots,
                                     .edges = GX_JUMP_MODEL_KNOTS};
  particles->X[0][0] = gx_jump_model_start(posed);
  *out = &carrier->space;
  return GX_OK;
}

static void destroy(struct gx_space *space)
{
  free(space);
}

static enum gx_status weights(struct gx_space *space)
{
  double x = position(space);
  if (!isfinite(x)) return gx_status_set(space->outcome, GX_UNSTABLE, 0, "the position of a particle is %g", x);
  ((struct carrier *)space)->field = gx_jump_model_velocity(x);
  return GX_OK;
}

static enum gx_status nothing(struct gx_space *space)
{
  (void)space;
  return GX_OK;
}

static enum gx_status accelerate(struct gx_space *space, double t)
{
  (void)t;
  ((struct carrier *)space)->a = gx_quadrature_model_acceleration(&space->posed->options, position(space));
  return GX_OK;
}

static void advance(struct gx_space *space, double kick, double strain, double drift)
{
  (void)strain;
  struct carrier *carrier = (struct carrier *)space;
  carrier->external += kick * carrier->a;
  space->particles->u[0][0] += drift * (carrier->field + carrier->external);
}

static enum gx_status twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct carrier *carrier = (struct carrier *)space;
  double *u = space->particles->u[0];
  if (primitive == GX_WEIGHTS_FROZEN) return weights(space);
  if (primitive == GX_KICK_NODES) carrier->external += span * carrier->a;
  if (primitive == GX_OPEN) carrier->opened = u[0] + span * (carrier->field + carrier->external);
  if (primitive == GX_CLOSE) u[0] = carrier->opened + span * (carrier->field + carrier->external);
  return GX_OK;
}

static void state(struct gx_space *space, struct gx_state *list)
{
  *list = (struct gx_state){2, {space->particles->u[0], &((struct carrier *)space)->external}, {1, 1}};
}

static void rates(struct gx_space *space, double *const *rate)
{
  const struct carrier *carrier = (struct carrier *)space;
  rate[0][0] = carrier->field + carrier->external;
  rate[1][0] = carrier->a;
}

static void image(struct gx_space *space, struct gx_image *image)
{
  GX_IMAGE(image, ((struct carrier *)space)->external);
}

static double velocity(const struct gx_space *space)
{
  return gx_jump_model_velocity(position(space)) + ((const struct carrier *)space)->external;
}

static double kinetic(const struct gx_space *space)
{
  return 0.5 * space->particles->m[0] * velocity(space) * velocity(space);
}

static void settle(struct gx_space *space)
{
  space->particles->v[0][0] = velocity(space);
}

static void particle_acceleration(struct gx_space *space, double *const *a)
{
  a[0][0] = ((struct carrier *)space)->a;
}

static void field(const struct gx_space *space, enum gx_field which, size_t n, double *const *point, double *const *value)
{
  const struct carrier *carrier = (const struct carrier *)space;
  for (size_t i = 0; i < n; i++)
    value[0][i] = which == GX_FIELD_VELOCITY ? gx_jump_model_velocity(point[0][i]) + carrier->external : carrier->a;
}

const struct gx_space_kind gx_velocity_field = {
    .name = "velocity-field",
    .help = "a particle in a fixed velocity field",
    .source = "steffen2010 §5",
    .fixed_grid = true,
    .of_problem = true,
    .create = create,
    .free = destroy,
    .weights = weights,
    .project = nothing,
    .accelerate = accelerate,
    .advance = advance,
    .twofold = twofold,
    .state = state,
    .rates = rates,
    .image = image,
    .kinetic = kinetic,
    .settle = settle,
    .particle_acceleration = particle_acceleration,
    .field = field,
};
