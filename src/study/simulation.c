/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulations: what they must name, what has no meaning, how they are built. */
#include <gridcross/simulation.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../core/large.h"

#include <gridcross/parameter.h>

struct gx_simulation gx_simulation_begin(const struct gx_problem *problem, const struct gx_space_kind *kind,
                                         const struct gx_clock *clock)
{
  const double young = gx_parameter_default(GX_PROBLEM_MODULUS).real, density = gx_parameter_default(GX_PROBLEM_DENSITY).real;
  const int cells = (int)gx_parameter_default(GX_MESH_CELLS).integer;
  struct gx_simulation simulation = {
      .problem = problem,
      .kind = kind,
      .clock = clock,
      .problem_options = {.dim = problem->min_dim ? problem->min_dim : 1,
                          .amplitude = gx_parameter_default(GX_PROBLEM_AMPLITUDE).real,
                          .mode = 1,
                          .moduli = gx_material_moduli(young, 0, density),
                          .active = {true, true, true}},
      .space_options = {.cells = {cells, cells, cells},
                        .basis = kind->collocation ? NULL : gx_basis_find("bspline"),
                        .degree = kind->collocation ? 5 : 2,
                        .flip = 1,
                        .each_step = kind->fixed_grid,
                        .reference = true,
                        .symmetric = true},
      .per_cell = (int)gx_parameter_default(GX_MESH_PARTICLES_PER_CELL).integer,
  };
  gx_simulation_bound(&simulation, problem->boundary);
  return simulation;
}

void gx_simulation_bound(struct gx_simulation *simulation, enum gx_boundary boundary)
{
  struct gx_space_options *options = &simulation->space_options;
  memset(options->held, 0, sizeof options->held);
  options->periodic = boundary == GX_BOUNDARY_PERIODIC;
  if (boundary == GX_BOUNDARY_CLAMPED) options->held[0][0] = (1u << simulation->problem_options.dim) - 1;
  if (boundary != GX_BOUNDARY_FIXED) return;
  for (int d = 0; d < GX_MAX_DIM; d++) options->held[d][0] = options->held[d][1] = 1u << d; /* walls: the body slides along */
}

/* What cannot be of a run file, whose parameters have ranges and defaults. */
static const char *missing(const struct gx_simulation *simulation)
{
  const struct gx_problem *problem = simulation->problem;
  const struct gx_space_options *options = &simulation->space_options;
  if (!problem || !simulation->kind || !simulation->clock) return "a problem, a space and a clock";
  if (!problem->material || !problem->material->wave_speed) return "a material with a wave speed";
  if (!problem->exact && !problem->initial) return "an exact solution or an initial state";
  if (simulation->problem_options.dim < 1 || simulation->problem_options.dim > GX_MAX_DIM) return "1, 2 or 3 dimensions";
  if (!(simulation->problem_options.moduli.density > 0)) return "a density";
  if (!(simulation->dt > 0 && isfinite(simulation->dt) && simulation->steps >= 0)) return "a time step and a number of steps";
  for (int d = 0; d < simulation->problem_options.dim; d++)
    if (options->cells[d] < 1 || (simulation->per_cell < 1 && !simulation->points)) return "cells and particles in them";
  if (simulation->kind->collocation || simulation->kind->of_problem) return NULL;
  if (!options->basis) return "a basis";
  if (options->basis->has_degree && (options->degree < 1 || options->degree > GX_MAX_DEGREE)) return "a degree from 1 to 9";
  return NULL;
}

/* Whether a step takes nodal velocity, which belongs to its first weights, to particles by those of another position. */
static bool mixes_weights(const struct gx_clock *clock)
{
  for (const struct gx_row *row = clock->rows; row && row->primitive != GX_END; row++)
    if (row->primitive == GX_MASS) return true;
  return false;
}

/* Whether a step moves particles once, at its end: by a field that is still there to look at. */
static bool drifts_once(const struct gx_clock *clock)
{
  const struct gx_row *row = clock->rows;
  while (row && row->primitive > GX_END && row->primitive < GX_DRIFT) row++;
  return row && row[0].primitive == GX_DRIFT && row[0].coefficient == 1 && row[1].primitive == GX_END;
}

static enum gx_status refuse_jumps(const struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  char clocks[128] = "";
  if (simulation->space_options.particle_motion)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "output.jumps compares two ways through the grid's velocity, and position: particle takes neither");
  if (drifts_once(simulation->clock)) return GX_OK;
  for (const struct gx_clock *const *clock = gx_clock_family; *clock; clock++)
    if (drifts_once(*clock)) {
      size_t used = strlen(clocks);
      snprintf(clocks + used, sizeof clocks - used, "%s%s", used ? ", " : "", (*clock)->name);
    }
  return gx_status_set(outcome, GX_REFUSED, -1, "output.jumps needs a clock that moves particles once a step: %s", clocks);
}

/* Whether every end is periodic or a wall. */
static bool ends_are_waves(const struct gx_space_options *options)
{
  return options->periodic || (options->held[0][0] & options->held[0][1] & 1);
}

enum gx_status gx_simulation_check(const struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  const char *needs = missing(simulation);
  if (needs) return gx_status_set(outcome, GX_REFUSED, -1, "a simulation needs %s", needs);
  const struct gx_problem *problem = simulation->problem;
  const struct gx_space_options *options = &simulation->space_options;
  const int dim = simulation->problem_options.dim;
  if (dim < problem->min_dim || dim > problem->max_dim)
    return gx_status_set(outcome, GX_REFUSED, -1, "%s has %d to %d dimensions, not %d", problem->name,
                         problem->min_dim ? problem->min_dim : 1, problem->max_dim, dim);
  const char *grid_velocity = options->apic ? "APIC" : "PIC";
  if (simulation->jumps) GX_TRY(refuse_jumps(simulation, outcome));
  if (problem->space) return GX_OK;
  if (problem->check) GX_TRY(problem->check(&simulation->problem_options, outcome));
  if (problem->meets && !simulation->kind->fixed_grid)
    return gx_status_set(outcome, GX_REFUSED, -1, "%s: %s; use space standard", simulation->kind->name, problem->meets);
  if (simulation->kind->collocation && (problem->inside || !ends_are_waves(options)))
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "%s is for bodies from end to end of a domain that is periodic or fixed: use standard or moving-mesh",
                         simulation->kind->name);
  if (options->basis && options->basis->deforms && !simulation->kind->fixed_grid)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "%s has no meaning in the reference configuration, where domains keep their width: use ugimp",
                         options->basis->name);
  if (simulation->clock->tableau && (options->pic || options->flip < 1))
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "%s advances rates, and %s is not one: use transfer flip with flip 1, or a clock of kicks",
                         simulation->clock->name, grid_velocity);
  if (simulation->kind->fixed_grid && mixes_weights(simulation->clock) && (options->pic || options->flip < 1))
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "%s with %s would not keep momentum: its nodal velocity and its last weights are of two positions; use "
                         "transfer flip with flip 1",
                         grid_velocity, simulation->clock->name);
  if (simulation->kind->fixed_grid && !options->each_step && !options->apic && (options->pic || options->flip < 1))
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "PIC with projection once would not keep momentum on a fixed grid: the velocity that its nodes carry is "
                         "of earlier weights; use projection each-step, or transfer flip with flip 1");
  if (options->apic && options->reconstructed)
    return gx_status_set(
        outcome, GX_REFUSED, -1,
        "APIC's affine momenta are sums over particles, which quadrature reconstructed does not take: use transfer "
        "flip or pic, or quadrature particles");
  if (options->apic && options->consistent)
    return gx_status_set(
        outcome, GX_REFUSED, -1,
        "APIC with consistent mass grows at every transfer: the affine part puts back what row sums smooth away, "
        "and this matrix does not; use mass lumped, or transfer flip");
  if (options->apic && !options->each_step)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "APIC with projection once: the grid never takes velocity from particles; use projection each-step");
  return GX_OK;
}

static bool is_inside(const void *simulation, const double *X)
{
  const struct gx_simulation *of = simulation;
  return of->problem->inside(&of->problem_options, X);
}

/* Listed particles may be of any size, and GIMP's functions are those of domains within a cell. Where domains deform, each step looks. */
static enum gx_status refuse_domains(const struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  const struct gx_basis *basis = simulation->space_options.basis;
  const struct gx_particles *particles = simulation->particles;
  if (!simulation->points || !basis || !basis->has_domain || basis->deforms) return GX_OK;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) {
      const double width = 2 * particles->half_length[d][p] * simulation->space_options.cells[d];
      if (width > 1 + 1e-12)
        return gx_status_set(
            outcome, GX_REFUSED, (long)p,
            "the domain of a particle is %.4g cells wide; %s needs 0 to 1: use fewer cells, smaller particles, or "
            "another basis",
            width, basis->name);
    }
  return GX_OK;
}

enum gx_status gx_simulation_lay_out(struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  const struct gx_problem_options *options = &simulation->problem_options;
  const int *cells = simulation->space_options.cells;
  simulation->particles =
      simulation->points ? gx_particles_list(simulation->points, options->moduli.density)
                         : gx_particles_fill(options->dim, cells, simulation->per_cell, simulation->layout,
                                             options->moduli.density, simulation->problem->inside ? is_inside : NULL, simulation);
  if (!simulation->particles)
    return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the particles of %d cells a direction: use fewer", cells[0]);
  if (simulation->particles->n) return refuse_domains(simulation, outcome);
  return gx_status_set(outcome, GX_REFUSED, -1,
                       "no particle is inside the body: use more than %d cells, more than %d particles a cell, or a larger body",
                       cells[0], simulation->per_cell);
}

enum gx_status gx_simulation_pose(struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  const struct gx_particles *particles = simulation->particles;
  simulation->posed = gx_problem_pose(simulation->problem, &simulation->problem_options, particles->n, particles->X);
  if (!simulation->posed) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the problem");
  double behind = simulation->clock->staggered ? 0.5 * simulation->dt : 0;
  gx_problem_begin(simulation->posed, simulation->start, simulation->start - behind, particles->u, particles->v, particles->F);
  return GX_OK;
}

enum gx_status gx_simulation_open(struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  const struct gx_space_kind *kind = simulation->kind;
  GX_TRY(kind->create(kind, &simulation->space, &simulation->space_options, simulation->particles, simulation->posed, outcome));
  if (simulation->problem->exact || !simulation->clock->staggered) return GX_OK;
  GX_TRY(kind->accelerate(simulation->space, 0));
  kind->advance(simulation->space, -0.5 * simulation->dt, 0, 0);
  return GX_OK;
}

enum gx_status gx_simulation_build(struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  GX_TRY(gx_simulation_lay_out(simulation, outcome));
  GX_TRY(gx_simulation_pose(simulation, outcome));
  return gx_simulation_open(simulation, outcome);
}

void gx_simulation_free(struct gx_simulation *simulation)
{
  if (simulation->space) simulation->kind->free(simulation->space);
  gx_problem_free(simulation->posed);
  gx_particles_free(simulation->particles);
}

double gx_simulation_frequency(const struct gx_simulation *simulation)
{
  const struct gx_problem_options *options = &simulation->problem_options;
  return 1 / (simulation->problem->cycles / (simulation->problem->material->wave_speed(&options->moduli) * options->mode));
}

/* Whether nothing of a body on a periodic grid meets functions that its images meet, however it turns: by its diagonal. */
static bool stands_apart(const struct gx_simulation *simulation)
{
  const struct gx_space_options *options = &simulation->space_options;
  const struct gx_particles *particles = simulation->particles;
  int support = options->basis && options->basis->has_degree ? options->degree + 1 : 3;
  double square = 0, h = 0;
  for (int d = 0; d < particles->dim; d++) {
    double low = INFINITY, high = -INFINITY;
    for (size_t p = 0; p < particles->n; p++) {
      double x = particles->X[d][p] + particles->u[d][p];
      low = fmin(low, x);
      high = fmax(high, x);
    }
    square += (high - low) * (high - low);
    h = fmax(h, 1.0 / options->cells[d]);
  }
  return sqrt(square) + support * h <= 1;
}

void gx_simulation_conserves(const struct gx_simulation *simulation, bool *linear, bool *angular)
{
  const struct gx_space_options *options = &simulation->space_options;
  *linear = !simulation->problem->body && !simulation->problem->space;
  for (int d = 0; d < GX_MAX_DIM; d++)
    if (!options->periodic && (options->held[d][0] || options->held[d][1])) *linear = false;
  *angular = *linear && simulation->problem_options.dim > 1 && (!options->periodic || stands_apart(simulation));
}

enum { SAMPLES = 8 }; /* a standing wave peaks at quarters of its period, what has no period at the end */

static double kinetic_of(const struct gx_particles *particles, double *const *v)
{
  double kinetic = 0;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) kinetic += 0.5 * particles->m[p] * v[d][p] * v[d][p];
  return kinetic;
}

static double exact_bound(const struct gx_simulation *simulation, double *const *v)
{
  double cycles = simulation->problem->cycles, first = 0, span = 1 / gx_simulation_frequency(simulation), largest = 0;
  if (cycles == 0) {
    first = simulation->start;
    span = simulation->end - first;
  }
  for (int i = 0; i <= SAMPLES; i++) {
    simulation->problem->exact(simulation->posed, first + span * i / SAMPLES, NULL, v, NULL, NULL);
    largest = fmax(largest, kinetic_of(simulation->particles, v));
  }
  return largest;
}

/* What the body force can add; b: scratch. */
static double loaded_bound(const struct gx_simulation *simulation, double *const *b)
{
  const struct gx_particles *particles = simulation->particles;
  double span = simulation->end - simulation->start, largest = 0;
  for (int i = 0; i <= SAMPLES && simulation->problem->body; i++) {
    double energy = 0;
    simulation->problem->body(simulation->posed, simulation->start + span * i / SAMPLES, b);
    for (int d = 0; d < particles->dim; d++)
      for (size_t p = 0; p < particles->n; p++) {
        double speed = b[d][p] * span;
        energy += particles->m[p] * (simulation->space_options.periodic ? 0.5 * speed * speed : fabs(b[d][p]));
      }
    largest = fmax(largest, energy);
  }
  return largest;
}

static double elastic_of(const struct gx_simulation *simulation, double *W)
{
  const struct gx_particles *particles = simulation->particles;
  double sum = 0;
  if (!simulation->problem->material->energy) return 0;
  simulation->problem->material->energy(&simulation->problem_options.moduli, particles->dim, particles->n, particles->F, W);
  for (size_t p = 0; p < particles->n; p++) sum += particles->V0[p] * W[p];
  return sum;
}

double gx_simulation_kinetic_bound(const struct gx_simulation *simulation)
{
  const struct gx_particles *particles = simulation->particles;
  double *scratch[GX_MAX_DIM] = {NULL};
  double *block = gx_large_zeros(particles->n * (size_t)particles->dim * sizeof(double));
  if (!block) return INFINITY;
  for (int d = 0; d < particles->dim; d++) scratch[d] = block + (size_t)d * particles->n;
  double bound = simulation->problem->exact
                     ? exact_bound(simulation, scratch)
                     : kinetic_of(particles, particles->v) + elastic_of(simulation, block) + loaded_bound(simulation, scratch);
  free(block);
  return bound;
}
