/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strong form on splines through particles: set-up and the primitives. */
#include "collocation.h"

#include <stdlib.h>
#include <string.h>

#include "../core/aligned.h"
#include "../core/kernel.h"
#include "../core/vector.h"
#include "sites.h"

static struct gx_collocation *of(struct gx_space *space)
{
  return (struct gx_collocation *)space;
}

/* Sets every array; returns the number of doubles they take. */
static size_t place_arrays(struct gx_collocation *c, double *block)
{
  const int dim = c->space.particles->dim, tensor = dim * dim;
  size_t used = 0;
#define PLACE(array, count) used += gx_aligned_place(array, count, c->n + 2, block ? block + used : NULL)
  PLACE(c->a, dim);
  PLACE(c->opened, dim);
  if (!c->strained) PLACE(c->rate, tensor);
  if (c->options.stress_rate) PLACE(c->rate_P, tensor);
  if (c->lattice.stress_at_ends) {
    PLACE(c->F, tensor);
    PLACE(c->P, tensor);
  }
#undef PLACE
  return used;
}

static enum gx_status allocate_arrays(struct gx_collocation *c)
{
  struct gx_particles *particles = c->space.particles;
  for (int k = 0; k < particles->dim * particles->dim; k++) {
    c->F[k] = particles->F[k];
    c->P[k] = particles->P[k];
  }
  double *block = gx_aligned_zeros(place_arrays(c, NULL) * sizeof(double), &c->block);
  if (!block) return gx_status_set(c->space.outcome, GX_FAILED, -1, "out of memory");
  place_arrays(c, block);
  return GX_OK;
}

/* P where F is the strain; returns the first particle, or end behind them, that is tangled, or -1. */
static long stress_from_strain(struct gx_collocation *c)
{
  const struct gx_posed *posed = c->space.posed;
  const struct gx_particles *particles = c->space.particles;
  /* stress by rate: only to see whether F still is a deformation */
  if (c->options.stress_rate)
    return posed->problem->material->piola(&posed->options.moduli, particles->dim, c->n, particles->F, c->rate_P);
  const size_t points = c->n + (c->lattice.stress_at_ends ? 2 : 0);
  const long tangled = posed->problem->material->piola(&posed->options.moduli, particles->dim, points, c->F, c->P);
  if (c->lattice.stress_at_ends) memcpy(particles->P[0], c->P[0], c->n * sizeof(double));
  return tangled;
}

static enum gx_status refuse(const struct gx_space_kind *kind, const struct gx_space_options *options,
                             const struct gx_particles *particles, struct gx_outcome *outcome)
{
  const int dim = particles->dim;
  bool closed = !options->periodic && !options->symmetric;
  if (options->degree < 2)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "a spline of degree 1 has no derivative at its own sites: use degree 2 or more");
  if (closed && options->reference && options->stress_rate)
    return gx_status_set(
        outcome, GX_REFUSED, -1,
        "closure papers in the reference frame takes the stress at the ends from F there, and integrates none: use "
        "stress F or closure symmetric");
  if (dim > 1 && !options->reference)
    return gx_status_set(
        outcome, GX_REFUSED, -1,
        "%s in the current frame is for one dimension: particles that move leave the lines of their lattice, and with "
        "them the product of splines; use frame reference",
        kind->name);
  if (dim > 1 && closed)
    return gx_status_set(
        outcome, GX_REFUSED, -1,
        "closure papers is for one dimension: it splines a zero at either end, and along a wall the motion is none; use "
        "closure symmetric");
  if (!particles->lattice[0])
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "%s needs a lattice of particles that fills the domain: its splines run from end to end along lines of "
                         "particles, and know no surface of a body between",
                         kind->name);
  return GX_OK;
}

enum gx_status gx_collocation_create(const struct gx_space_kind *kind, struct gx_space **space,
                                     const struct gx_space_options *options, struct gx_particles *particles,
                                     const struct gx_posed *posed, struct gx_outcome *outcome)
{
  GX_TRY(refuse(kind, options, particles, outcome));
  struct gx_collocation *c = calloc(1, sizeof *c);
  if (!c) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  *space = &c->space;
  c->space = (struct gx_space){
      .kind = kind, .particles = particles, .posed = posed, .outcome = outcome, .through_cells = !options->reference};
  c->options = *options;
  c->n = particles->n;
  c->strained = options->reference && !options->stress_rate;
  GX_TRY(gx_spline_lattice_create(&c->lattice, kind->nodal, options, particles, outcome));
  GX_TRY(allocate_arrays(c));
  posed->problem->material->piola(&posed->options.moduli, particles->dim, c->n, particles->F, particles->P);
  return options->reference ? GX_OK : gx_spline_lattice_place(&c->lattice, particles->X[0], particles->u[0]);
}

void gx_collocation_free(struct gx_space *space)
{
  struct gx_collocation *c = of(space);
  if (!c) return;
  gx_spline_lattice_free(&c->lattice);
  free(c->block);
  free(c);
}

enum gx_status gx_collocation_weights(struct gx_space *space)
{
  struct gx_collocation *c = of(space);
  const struct gx_particles *particles = space->particles;
  return c->options.reference ? GX_OK : gx_spline_lattice_place(&c->lattice, particles->X[0], particles->u[0]);
}

/* Particles carry the velocity; nodes see it only on the way to its derivative. */
enum gx_status gx_collocation_project(struct gx_space *space)
{
  (void)space;
  return GX_OK;
}

GX_CLONES static void add_one(size_t n, double *restrict F)
{
  for (size_t p = 0; p < n; p++) F[p] += 1;
}

/* F at particles (and ends) from u: reference frame. */
static void deformation_gradient(struct gx_collocation *c)
{
  const struct gx_particles *particles = c->space.particles;
  const int dim = particles->dim;
  const size_t targets = c->n + (c->lattice.stress_at_ends ? 2 : 0);
  for (int d = 0; d < dim; d++) {
    gx_spline_lattice_gradient(&c->lattice, d, particles->u[d], c->F + d * dim);
    add_one(targets, c->F[d * dim + d]);
  }
  if (c->lattice.stress_at_ends) memcpy(particles->F[0], c->F[0], c->n * sizeof(double));
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
  if (at < c->n)
    return gx_status_set(c->space.outcome, GX_TANGLED, (long)at, "det F of a particle is %g",
                         gx_particles_jacobian(c->space.particles, at));
  return gx_status_set(c->space.outcome, GX_TANGLED, -1, "det F at the end at %zu is %g", at - c->n, c->F[0][at]);
}

enum gx_status gx_collocation_accelerate(struct gx_space *space, double t)
{
  struct gx_collocation *c = of(space);
  struct gx_particles *particles = space->particles;
  const struct gx_posed *posed = space->posed;
  const int dim = particles->dim;
  const bool by_F = !c->options.reference && !c->options.papers_divergence;
  if (c->strained) deformation_gradient(c);
  const long tangled = stress_from_strain(c);
  if (tangled >= 0) return report_tangled(c, (size_t)tangled);
  for (int d = 0; d < dim; d++) {
    gx_spline_lattice_divergence(&c->lattice, d, c->P + d * dim, c->a[d]);
    scale(c->n, 1 / posed->options.moduli.density, by_F ? particles->F[0] : NULL, c->a[d]);
  }
  if (!posed->problem->body) return GX_OK;
  posed->problem->body(posed, t, particles->b);
  for (int d = 0; d < dim; d++) gx_vector_add(c->n, 1, particles->b[d], c->a[d]);
  return GX_OK;
}

/* rate_F = dF/dt for the particles' present velocity. */
static void rate_of_strain(struct gx_collocation *c, double *const *rate_F)
{
  const struct gx_particles *particles = c->space.particles;
  const int dim = particles->dim;
  for (int d = 0; d < dim; d++) gx_spline_lattice_gradient(&c->lattice, d, particles->v[d], rate_F + d * dim);
  for (size_t p = 0; p < c->n && !c->options.reference; p++) rate_F[0][p] *= particles->F[0][p];
}

static void rate_of_stress(struct gx_collocation *c, double *const *rate_F, double *const *rate_P)
{
  const struct gx_particles *particles = c->space.particles;
  const struct gx_posed *posed = c->space.posed;
  posed->problem->material->piola_rate(&posed->options.moduli, particles->dim, c->n, particles->F, rate_F, rate_P);
}

/* In the reference frame F comes from u and is not integrated. */
static void strain(struct gx_collocation *c, double span)
{
  struct gx_particles *particles = c->space.particles;
  const int tensor = particles->dim * particles->dim;
  if (c->strained) return;
  if (c->options.reference) gx_collocation_settle(&c->space);
  rate_of_strain(c, c->rate);
  if (c->options.stress_rate) rate_of_stress(c, c->rate, c->rate_P);
  for (int k = 0; k < tensor && c->options.stress_rate; k++) gx_vector_add(c->n, span, c->rate_P[k], particles->P[k]);
  for (int k = 0; k < tensor && !c->options.reference; k++) gx_vector_add(c->n, span, c->rate[k], particles->F[k]);
}

void gx_collocation_advance(struct gx_space *space, double kick, double strained, double drift)
{
  struct gx_collocation *c = of(space);
  struct gx_particles *particles = space->particles;
  for (int d = 0; d < particles->dim && kick != 0; d++) gx_vector_add(c->n, kick, c->a[d], particles->v[d]);
  if (strained != 0) strain(c, strained);
  for (int d = 0; d < particles->dim && drift != 0; d++) gx_vector_add(c->n, drift, particles->v[d], particles->u[d]);
}

enum gx_status gx_collocation_twofold(struct gx_space *space, enum gx_primitive primitive, double span)
{
  struct gx_collocation *c = of(space);
  struct gx_particles *particles = space->particles;
  for (int d = 0; d < particles->dim; d++) {
    double *u = particles->u[d], *v = particles->v[d], *opened = c->opened[d];
    if (primitive == GX_KICK_NODES) gx_vector_add(c->n, span, c->a[d], v);
    for (size_t p = 0; p < c->n && primitive == GX_OPEN; p++) opened[p] = u[p] + span * v[p];
    for (size_t p = 0; p < c->n && primitive == GX_CLOSE; p++) u[p] = opened[p] + span * v[p];
  }
  return GX_OK;
}

static void append(struct gx_state *state, int count, double *const *array, size_t length)
{
  for (int i = 0; i < count; i++) {
    state->array[state->count] = array[i];
    state->length[state->count++] = length;
  }
}

void gx_collocation_state(struct gx_space *space, struct gx_state *state)
{
  const struct gx_collocation *c = of(space);
  struct gx_particles *particles = space->particles;
  const int dim = particles->dim;
  state->count = 0;
  append(state, dim, particles->u, c->n);
  append(state, dim, particles->v, c->n);
  if (!c->options.reference) append(state, dim * dim, particles->F, c->n);
  if (c->options.stress_rate) append(state, dim * dim, particles->P, c->n);
}

void gx_collocation_rates(struct gx_space *space, double *const *rate)
{
  struct gx_collocation *c = of(space);
  const int dim = space->particles->dim;
  for (int d = 0; d < dim; d++) {
    memcpy(rate[d], space->particles->v[d], c->n * sizeof(double));
    memcpy(rate[dim + d], c->a[d], c->n * sizeof(double));
  }
  if (c->strained) return;
  if (c->options.reference) gx_collocation_settle(space);
  rate += 2 * dim;
  double *const *rate_F = c->options.reference ? c->rate : rate;
  if (!c->options.reference) rate += dim * dim;
  rate_of_strain(c, rate_F);
  if (c->options.stress_rate) rate_of_stress(c, rate_F, rate);
}

double gx_collocation_kinetic(const struct gx_space *space)
{
  const struct gx_particles *particles = space->particles;
  double twice = 0;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) twice += particles->m[p] * particles->v[d][p] * particles->v[d][p];
  return 0.5 * twice;
}

void gx_collocation_settle(struct gx_space *space)
{
  struct gx_collocation *c = of(space);
  if (c->options.reference) deformation_gradient(c);
}

void gx_collocation_particle_acceleration(struct gx_space *space, double *const *a)
{
  const struct gx_collocation *c = of(space);
  for (int d = 0; d < space->particles->dim; d++) memcpy(a[d], c->a[d], c->n * sizeof(double));
}
