/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splines through particles: set-up, derivative of the motion, divergence of the stress, and the primitives on them. */
#include "collocation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/kernel.h"
#include "../core/vector.h"

static struct gx_collocation *of(struct gx_space *space)
{
  return (struct gx_collocation *)space;
}

/* Sites that a spline refuses, in terms of particles. */
static enum gx_status misplaced(const struct gx_collocation *c, const struct gx_spline_error *error)
{
  const double *x = c->x + 1;
  struct gx_outcome *outcome = c->space.outcome;
  for (size_t p = 0; p < c->n; p++)
    if (!isfinite(x[p])) return gx_status_set(outcome, GX_UNSTABLE, (long)p, "a particle is at %g", x[p]);
  for (size_t p = 0; p < c->n && !c->options.periodic; p++)
    if (c->closed ? !(x[p] > 0 && x[p] < 1) : !(x[p] >= 0 && x[p] <= 1))
      return gx_status_set(outcome, GX_LEFT_DOMAIN, (long)p, "a particle is at %.6g, past the fixed end at %d", x[p], x[p] > 0.5);
  for (size_t p = 1; p < c->n; p++)
    if (!(x[p] > x[p - 1]))
      return gx_status_set(outcome, GX_TANGLED, (long)p, "a particle at %.17g has met or passed its neighbour at %.17g", x[p],
                           x[p - 1]);
  if (c->options.periodic && error->status == GX_SPLINE_OUTSIDE)
    return gx_status_set(outcome, GX_TANGLED, (long)c->n - 1,
                         "a particle at %.17g has met or passed the first one's image at %.17g", x[c->n - 1], x[0] + 1);
  return gx_status_set(outcome, GX_REFUSED, -1, "%s", error->message);
}

static enum gx_status report(const struct gx_collocation *c, const struct gx_spline_error *error)
{
  if (error->status == GX_SPLINE_NOT_INCREASING || error->status == GX_SPLINE_OUTSIDE) return misplaced(c, error);
  enum gx_status status = error->status == GX_SPLINE_MEMORY     ? GX_FAILED
                          : error->status == GX_SPLINE_SINGULAR ? GX_SINGULAR
                                                                : GX_REFUSED;
  return gx_status_set(c->space.outcome, status, -1, "%s", error->message);
}

#define SPLINE(c, call)                                                                                                          \
  do {                                                                                                                           \
    struct gx_spline_error error = {.site = -1};                                                                                 \
    if (call) return report(c, &error);                                                                                          \
  } while (0)

static enum gx_status allocate_arrays(struct gx_collocation *c)
{
  size_t n = c->n + 2, nodes = c->nodes + 1, functions = n + nodes + 4 * GX_SPLINE_MAX_DEGREE + 4;
  c->block = calloc(10 * n + 2 * nodes + functions, sizeof(double));
  if (!c->block) return gx_status_set(c->space.outcome, GX_FAILED, -1, "out of memory");
  double *at = c->block;
  double **particle_arrays[] = {&c->x, &c->ends_last, &c->value, &c->slope, &c->F, &c->P, &c->a, &c->opened, &c->rate};
  for (size_t i = 0; i < sizeof particle_arrays / sizeof *particle_arrays; i++, at += n) *particle_arrays[i] = at;
  c->at_node = at;
  c->nodal_value = at + nodes;
  c->coefficient = at + 2 * nodes;
  return GX_OK;
}

static enum gx_status create_splines(struct gx_collocation *c)
{
  int degree = c->options.degree;
  enum gx_spline_ends odd = c->options.periodic ? GX_SPLINE_PERIODIC : c->closed ? GX_SPLINE_OPEN : GX_SPLINE_ODD;
  enum gx_spline_ends even = c->options.periodic ? GX_SPLINE_PERIODIC : c->closed ? GX_SPLINE_OPEN : GX_SPLINE_EVEN;
  size_t ends = c->stress_at_ends ? 2 : 0, targets = c->n + ends, least = (size_t)degree + 1;
  if (c->n + ends < least)
    return gx_status_set(c->space.outcome, GX_REFUSED, -1, "splines of degree %d need %zu particles or more, and there are %zu",
                         degree, least - ends, c->n);
  if (c->nodal && c->nodes < least)
    return gx_status_set(c->space.outcome, GX_REFUSED, -1, "splines of degree %d need %zu nodes or more, and there are %zu",
                         degree, least, c->nodes);
  SPLINE(c, gx_spline_interpolant_create(&c->motion, odd, degree, c->n + (c->closed ? 2 : 0), &error));
  SPLINE(c, gx_spline_interpolant_create(&c->stress, even, degree, c->n + ends, &error));
  if (!c->nodal) {
    SPLINE(c, gx_spline_points_create(&c->motion_points, degree, 2, targets, &error));
    SPLINE(c, gx_spline_points_create(&c->stress_points, degree, 2, c->n, &error));
    return GX_OK;
  }
  SPLINE(c, gx_spline_interpolant_create(&c->node, odd, degree, c->nodes, &error));
  SPLINE(c, gx_spline_points_create(&c->motion_points, degree, 1, c->nodes, &error));
  SPLINE(c, gx_spline_points_create(&c->stress_points, degree, 2, c->nodes, &error));
  SPLINE(c, gx_spline_points_create(&c->node_points, degree, 3, targets, &error));
  for (size_t i = 0; i < c->nodes; i++) c->at_node[i] = (double)i / c->options.cells[0];
  SPLINE(c, gx_spline_interpolant_set_sites(c->node, c->at_node, 0, 1, &error));
  return GX_OK;
}

/* Places all splines for particles at X + u; u NULL: at X. */
static enum gx_status place(struct gx_collocation *c, const double *u)
{
  const double *X = c->space.particles->X[0];
  size_t n = c->n;
  for (size_t p = 0; p < n; p++) c->ends_last[p] = c->x[p + 1] = u ? X[p] + u[p] : X[p];
  c->x[0] = c->ends_last[n] = 0;
  c->x[n + 1] = c->ends_last[n + 1] = 1;
  SPLINE(c, gx_spline_interpolant_set_sites(c->motion, c->closed ? c->x : c->x + 1, 0, 1, &error));
  SPLINE(c, gx_spline_interpolant_set_sites(c->stress, c->stress_at_ends ? c->x : c->x + 1, 0, 1, &error));
  gx_spline_points_set(c->motion_points, c->motion->knots, c->nodal ? c->at_node : c->ends_last);
  gx_spline_points_set(c->stress_points, c->stress->knots, c->nodal ? c->at_node : c->ends_last);
  if (c->nodal) gx_spline_points_set(c->node_points, c->node->knots, c->ends_last);
  return GX_OK;
}

/* A fixed end neither moves nor accelerates. */
static void hold_end_nodes(struct gx_collocation *c)
{
  if (!c->options.periodic) c->nodal_value[0] = c->nodal_value[c->nodes - 1] = 0;
}

/* slope <- derivative at the particles (and ends, where the stress is wanted there) of the spline through the motion's values. */
static void derive(struct gx_collocation *c, const double *motion)
{
  memcpy(c->value + 1, motion, c->n * sizeof(double));
  c->value[0] = c->value[c->n + 1] = 0;
  gx_spline_interpolant_solve(c->motion, c->closed ? c->value : c->value + 1, c->coefficient);
  if (!c->nodal) {
    gx_spline_points_evaluate(c->motion_points, 1, c->coefficient, c->slope);
    return;
  }
  gx_spline_points_evaluate(c->motion_points, 0, c->coefficient, c->nodal_value);
  hold_end_nodes(c);
  gx_spline_interpolant_solve(c->node, c->nodal_value, c->coefficient);
  gx_spline_points_evaluate(c->node_points, 1, c->coefficient, c->slope);
}

/* a <- derivative at the particles of the spline through the stress; stress: [n], with both ends behind where they are sites. */
static void diverge(struct gx_collocation *c, const double *stress)
{
  memcpy(c->value + 1, stress, c->n * sizeof(double));
  if (c->stress_at_ends) {
    c->value[0] = stress[c->n];
    c->value[c->n + 1] = stress[c->n + 1];
  }
  gx_spline_interpolant_solve(c->stress, c->stress_at_ends ? c->value : c->value + 1, c->coefficient);
  if (!c->nodal) {
    gx_spline_points_evaluate(c->stress_points, 1, c->coefficient, c->a);
    return;
  }
  gx_spline_points_evaluate(c->stress_points, 1, c->coefficient, c->nodal_value);
  hold_end_nodes(c);
  gx_spline_interpolant_solve(c->node, c->nodal_value, c->coefficient);
  gx_spline_points_evaluate(c->node_points, 0, c->coefficient, c->slope); /* scratch: its points may include the ends */
  memcpy(c->a, c->slope, c->n * sizeof(double));
}

/* F at particles (and ends) from u: reference frame. */
static void deformation_gradient(struct gx_collocation *c)
{
  derive(c, c->space.particles->u[0]);
  size_t targets = c->n + (c->stress_at_ends ? 2 : 0);
  for (size_t p = 0; p < targets; p++) c->F[p] = 1 + c->slope[p];
}

static long stress_from(struct gx_collocation *c, size_t points, double *F, double *P)
{
  const struct gx_posed *posed = c->space.posed;
  return posed->problem->material->piola(&posed->options.moduli, 1, points, &F, &P);
}

enum gx_status gx_collocation_create(const struct gx_space_kind *kind, struct gx_space **space,
                                     const struct gx_space_options *options, struct gx_particles *particles,
                                     const struct gx_posed *posed, struct gx_outcome *outcome)
{
  if (particles->dim > 1) return gx_status_set(outcome, GX_REFUSED, -1, "%s is for one dimension", kind->name);
  if (options->degree < 2)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "a spline of degree 1 has no derivative at its own sites: use degree 2 or more");
  bool closed = !options->periodic && !options->symmetric;
  if (closed && options->reference && options->stress_rate)
    return gx_status_set(
        outcome, GX_REFUSED, -1,
        "closure papers in the reference frame takes the stress at the ends from F there, and integrates none: use "
        "stress F or closure symmetric");
  struct gx_collocation *c = calloc(1, sizeof *c);
  if (!c) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  *space = &c->space;
  c->space = (struct gx_space){
      .kind = kind, .particles = particles, .posed = posed, .outcome = outcome, .through_cells = !options->reference};
  c->options = *options;
  c->n = particles->n;
  c->nodal = kind->nodal;
  c->nodes = (size_t)options->cells[0] + !options->periodic;
  c->closed = closed;
  c->stress_at_ends = closed && options->reference;
  GX_TRY(allocate_arrays(c));
  GX_TRY(create_splines(c));
  stress_from(c, c->n, particles->F[0], particles->P[0]);
  return place(c, options->reference ? NULL : particles->u[0]);
}

void gx_collocation_free(struct gx_space *space)
{
  struct gx_collocation *c = of(space);
  if (!c) return;
  gx_spline_interpolant_free(c->motion);
  gx_spline_interpolant_free(c->stress);
  gx_spline_interpolant_free(c->node);
  gx_spline_points_free(c->motion_points);
  gx_spline_points_free(c->stress_points);
  gx_spline_points_free(c->node_points);
  free(c->block);
  free(c);
}

enum gx_status gx_collocation_weights(struct gx_space *space)
{
  struct gx_collocation *c = of(space);
  return c->options.reference ? GX_OK : place(c, space->particles->u[0]);
}

/* Particles carry the velocity; nodes see it only on the way to its derivative. */
enum gx_status gx_collocation_project(struct gx_space *space)
{
  (void)space;
  return GX_OK;
}

/* a <- factor a, or factor F a */
GX_CLONES static void scale(size_t n, double factor, const double *restrict F, double *restrict a)
{
  if (F)
    for (size_t p = 0; p < n; p++) a[p] *= factor * F[p];
  else
    for (size_t p = 0; p < n; p++) a[p] *= factor;
}

/* at: a particle, or an end behind them */
static enum gx_status report_tangled(const struct gx_collocation *c, size_t at)
{
  const double *F = c->options.reference && !c->options.stress_rate ? c->F : c->space.particles->F[0];
  if (at < c->n) return gx_status_set(c->space.outcome, GX_TANGLED, (long)at, "det F of a particle is %g", F[at]);
  return gx_status_set(c->space.outcome, GX_TANGLED, -1, "det F at the end at %zu is %g", at - c->n, F[at]);
}

enum gx_status gx_collocation_accelerate(struct gx_space *space, double t)
{
  struct gx_collocation *c = of(space);
  struct gx_particles *particles = space->particles;
  const struct gx_posed *posed = space->posed;
  const double density = posed->options.moduli.density;
  double *F = particles->F[0], *P = particles->P[0];
  long tangled = -1;
  if (c->options.reference && !c->options.stress_rate) {
    deformation_gradient(c);
    memcpy(F, c->F, c->n * sizeof(double));
    tangled = stress_from(c, c->n + (c->stress_at_ends ? 2 : 0), c->F, c->stress_at_ends ? c->P : P);
    if (c->stress_at_ends) memcpy(P, c->P, c->n * sizeof(double));
  } else if (!c->options.stress_rate) {
    tangled = stress_from(c, c->n, F, P);
  }
  if (tangled >= 0) return report_tangled(c, (size_t)tangled);
  diverge(c, c->stress_at_ends ? c->P : P);
  scale(c->n, 1 / density, !c->options.reference && !c->options.papers_divergence ? F : NULL, c->a);
  if (!posed->problem->body) return GX_OK;
  posed->problem->body(posed, t, particles->b);
  gx_vector_add(c->n, 1, particles->b[0], c->a);
  return GX_OK;
}

/* rate_F = dF/dt for the particles' present velocity. */
static void rate_of_strain(struct gx_collocation *c, double *rate_F)
{
  const double *F = c->space.particles->F[0];
  derive(c, c->space.particles->v[0]);
  for (size_t p = 0; p < c->n; p++) rate_F[p] = c->options.reference ? c->slope[p] : c->slope[p] * F[p];
}

static void rate_of_stress(struct gx_collocation *c, double *rate_F, double *rate_P)
{
  const struct gx_posed *posed = c->space.posed;
  posed->problem->material->piola_rate(&posed->options.moduli, 1, c->n, c->space.particles->F, &rate_F, &rate_P);
}

/* In the reference frame F comes from u and is not integrated. */
static void strain(struct gx_collocation *c, double span)
{
  struct gx_particles *particles = c->space.particles;
  if (c->options.reference && !c->options.stress_rate) return;
  if (c->options.reference) gx_collocation_settle(&c->space);
  rate_of_strain(c, c->rate);
  if (c->options.stress_rate) {
    rate_of_stress(c, c->rate, c->value);
    gx_vector_add(c->n, span, c->value, particles->P[0]);
  }
  if (!c->options.reference) gx_vector_add(c->n, span, c->rate, particles->F[0]);
}

void gx_collocation_advance(struct gx_space *space, double kick, double strained, double drift)
{
  struct gx_collocation *c = of(space);
  struct gx_particles *particles = space->particles;
  if (kick != 0) gx_vector_add(c->n, kick, c->a, particles->v[0]);
  if (strained != 0) strain(c, strained);
  if (drift != 0) gx_vector_add(c->n, drift, particles->v[0], particles->u[0]);
}

enum gx_status gx_collocation_twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct gx_collocation *c = of(space);
  double *u = space->particles->u[0], *v = space->particles->v[0];
  if (primitive == GX_WEIGHTS_FROZEN) return gx_collocation_weights(space);
  if (primitive == GX_KICK_NODES) gx_vector_add(c->n, span, c->a, v);
  if (primitive == GX_STRAIN_BACK) strain(c, span);
  for (size_t p = 0; p < c->n && primitive == GX_OPEN; p++) c->opened[p] = u[p] + span * v[p];
  for (size_t p = 0; p < c->n && primitive == GX_CLOSE; p++) u[p] = c->opened[p] + span * v[p];
  return GX_OK;
}

void gx_collocation_state(struct gx_space *space, struct gx_state *state)
{
  const struct gx_collocation *c = of(space);
  struct gx_particles *particles = space->particles;
  *state = (struct gx_state){2, {particles->u[0], particles->v[0]}, {c->n, c->n}};
  double *more[] = {c->options.reference ? NULL : particles->F[0], c->options.stress_rate ? particles->P[0] : NULL};
  for (int i = 0; i < 2; i++) {
    if (!more[i]) continue;
    state->array[state->count] = more[i];
    state->length[state->count++] = c->n;
  }
}

void gx_collocation_rates(struct gx_space *space, double *const *rate)
{
  struct gx_collocation *c = of(space);
  memcpy(rate[0], space->particles->v[0], c->n * sizeof(double));
  memcpy(rate[1], c->a, c->n * sizeof(double));
  if (c->options.reference && !c->options.stress_rate) return;
  if (c->options.reference) gx_collocation_settle(space);
  double *const *next = rate + 2;
  double *rate_F = c->options.reference ? c->rate : *next++;
  rate_of_strain(c, rate_F);
  if (c->options.stress_rate) rate_of_stress(c, rate_F, *next);
}

double gx_collocation_kinetic(const struct gx_space *space)
{
  const struct gx_particles *particles = space->particles;
  double twice = 0;
  for (size_t p = 0; p < particles->n; p++) twice += particles->m[p] * particles->v[0][p] * particles->v[0][p];
  return 0.5 * twice;
}

void gx_collocation_settle(struct gx_space *space)
{
  struct gx_collocation *c = of(space);
  if (!c->options.reference) return;
  deformation_gradient(c);
  memcpy(space->particles->F[0], c->F, c->n * sizeof(double));
}

void gx_collocation_particle_acceleration(struct gx_space *space, double *const *a)
{
  const struct gx_collocation *c = of(space);
  memcpy(a[0], c->a, c->n * sizeof(double));
}
