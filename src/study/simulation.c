/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the resolved parameters of a case to something that runs. */
#include "simulation.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is(const struct gx_case *one, enum gx_parameter_id id, const char *text)
{
  return one->value[id].type == GX_TEXT && !strcmp(one->value[id].text, text);
}

static long integer(const struct gx_case *one, enum gx_parameter_id id, long otherwise)
{
  return one->value[id].type == GX_INTEGER ? one->value[id].integer : otherwise;
}

static double real(const struct gx_case *one, enum gx_parameter_id id, double otherwise)
{
  return one->value[id].type == GX_REAL ? one->value[id].real : otherwise;
}

/* One number a dimension; 0 when the text has ended. */
static void read_vector(const struct gx_case *one, enum gx_parameter_id id, int dim, double *vector)
{
  const char *text = one->value[id].type == GX_TEXT ? one->value[id].text : "";
  for (int d = 0; d < dim; d++) {
    char *rest;
    vector[d] = strtod(text, &rest);
    text = rest;
  }
}

static void read_body(struct gx_body *body, int dim, const struct gx_case *one)
{
  static const char *const shapes[] = {
      [GX_SHAPE_BOX] = "box", [GX_SHAPE_DISK] = "disk", [GX_SHAPE_RING] = "ring", [GX_SHAPE_POINTS] = "points"};
  for (int shape = GX_SHAPE_BOX; shape <= GX_SHAPE_POINTS; shape++)
    if (is(one, GX_BODY_SHAPE, shapes[shape])) body->shape = (enum gx_shape)shape;
  read_vector(one, GX_BODY_CENTRE, dim, body->centre);
  read_vector(one, GX_BODY_SIZE, dim, body->size);
  body->radius = real(one, GX_BODY_RADIUS, 0);
  body->inner_radius = real(one, GX_BODY_INNER_RADIUS, 0);
}

static void read_problem(struct gx_simulation *simulation, const struct gx_case *one)
{
  struct gx_problem_options *options = &simulation->problem_options;
  simulation->problem = gx_problem_find(one->value[GX_PROBLEM_NAME].text);
  options->dim = (int)integer(one, GX_PROBLEM_DIMENSION, 1);
  options->amplitude = real(one, GX_PROBLEM_AMPLITUDE, 0);
  options->mode = (double)integer(one, GX_PROBLEM_MODE, 1);
  options->moduli =
      gx_material_moduli(real(one, GX_PROBLEM_MODULUS, 0), real(one, GX_PROBLEM_POISSON, 0), real(one, GX_PROBLEM_DENSITY, 1));
  options->interpolation_error = real(one, GX_PROBLEM_INTERPOLATION_ERROR, 0);
  options->knot = (int)integer(one, GX_PROBLEM_KNOT, 0);
  options->jump = real(one, GX_PROBLEM_JUMP, 0);
  options->corrected = is(one, GX_PROBLEM_VARIANT, "corrected");
  options->particle_width = real(one, GX_PROBLEM_PARTICLE_WIDTH, 0);
  read_body(&options->body, options->dim, one);
  read_vector(one, GX_PROBLEM_VELOCITY, options->dim, options->velocity);
  options->spin = real(one, GX_PROBLEM_SPIN, 0);
  options->rotation = real(one, GX_PROBLEM_ROTATION, 0);
  options->gravity = real(one, GX_PROBLEM_GRAVITY, 0);
  simulation->points = one->points;
  const struct gx_value *active = &one->value[GX_PROBLEM_ACTIVE];
  read_vector(one, GX_PROBLEM_PHASES, options->dim, options->phase);
  for (int d = 0; d < options->dim; d++) {
    options->active[d] = active->type != GX_TEXT || strchr(active->text, "xyz"[d]);
    options->phase[d] = M_PI * fmod(options->phase[d], 2);
  }
}

static void read_boundary(struct gx_simulation *simulation, const struct gx_case *one)
{
  struct gx_space_options *options = &simulation->space_options;
  options->periodic = is(one, GX_PROBLEM_BOUNDARY, gx_problem_boundary[GX_BOUNDARY_PERIODIC]);
  if (is(one, GX_PROBLEM_BOUNDARY, gx_problem_boundary[GX_BOUNDARY_CLAMPED]))
    options->held[0][0] = (1u << simulation->problem_options.dim) - 1;
  if (!is(one, GX_PROBLEM_BOUNDARY, gx_problem_boundary[GX_BOUNDARY_FIXED])) return;
  for (int d = 0; d < GX_MAX_DIM; d++) options->held[d][0] = options->held[d][1] = 1u << d; /* walls: the body slides along */
}

static void read_method(struct gx_simulation *simulation, const struct gx_case *one)
{
  struct gx_space_options *options = &simulation->space_options;
  const char *own = simulation->problem->space;
  simulation->kind = gx_space_find(own ? own : one->value[GX_METHOD_SPACE].text);
  simulation->clock = gx_clock_find(one->value[GX_METHOD_CLOCK].text);
  simulation->layout = is(one, GX_MESH_LAYOUT, "gauss") ? GX_LAYOUT_GAUSS : GX_LAYOUT_UNIFORM;
  simulation->jumps = is(one, GX_OUTPUT_JUMPS, "yes");
  simulation->per_cell = (int)integer(one, GX_MESH_PARTICLES_PER_CELL, 1);
  for (int d = 0; d < GX_MAX_DIM; d++) options->cells[d] = (int)integer(one, GX_MESH_CELLS, 1);
  read_boundary(simulation, one);
  const struct gx_value *basis = &one->value[GX_METHOD_BASIS];
  options->basis = basis->type == GX_TEXT ? gx_basis_find(basis->text) : NULL;
  options->degree = (int)integer(one, GX_METHOD_DEGREE, 1);
  options->consistent = is(one, GX_METHOD_MASS, "consistent");
  options->reconstructed = is(one, GX_METHOD_QUADRATURE, "reconstructed");
  options->apic = is(one, GX_METHOD_TRANSFER, "apic");
  options->pic = options->apic || is(one, GX_METHOD_TRANSFER, "pic");
  options->flip = real(one, GX_METHOD_FLIP, 1);
  options->particle_motion = is(one, GX_METHOD_POSITION, "particle");
  options->each_step = is(one, GX_METHOD_PROJECTION, "each-step");
  options->stress_rate = is(one, GX_METHOD_STRESS, "rate");
  options->reference = is(one, GX_METHOD_FRAME, "reference");
  options->symmetric = is(one, GX_METHOD_CLOSURE, "symmetric");
  options->papers_divergence = is(one, GX_METHOD_DIVERGENCE, "papers");
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

static enum gx_status refuse(const struct gx_simulation *simulation, struct gx_outcome *outcome)
{
  const struct gx_problem *problem = simulation->problem;
  const struct gx_space_options *options = &simulation->space_options;
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

static enum gx_status settle_steps(struct gx_simulation *simulation, const struct gx_case *one, struct gx_outcome *outcome)
{
  double c = simulation->problem->material->wave_speed(&simulation->problem_options.moduli);
  double h = 1.0 / simulation->space_options.cells[0];
  double period = simulation->problem->cycles / (c * simulation->problem_options.mode);
  simulation->frequency = 1 / period;
  double dt = real(one, GX_TIME_DT, real(one, GX_TIME_CFL, 0) * h / c);
  double start = real(one, GX_TIME_START, 0), counted = (double)integer(one, GX_TIME_STEPS, 0);
  double span = counted > 0 ? counted * dt : real(one, GX_TIME_END, start + real(one, GX_TIME_PERIODS, 0) * period) - start;
  if (!(dt > 0 && isfinite(dt) && span > 0 && isfinite(span)))
    return gx_status_set(outcome, GX_REFUSED, -1, "time step %g s and time to run %g s are not both positive finite numbers", dt,
                         span);
  simulation->steps = counted > 0 ? counted : fmax(1, ceil(span / dt - 1e-9)); /* however short, the time asked for is run */
  if (simulation->steps > 1e15) return gx_status_set(outcome, GX_REFUSED, -1, "%.3g steps would never end", simulation->steps);
  if (fabs(start) * DBL_EPSILON > 1e-3 * dt)
    return gx_status_set(outcome, GX_REFUSED, -1, "steps of %g s vanish in the digits of time.start, %g s: start nearer 0", dt,
                         start);
  simulation->dt = is(one, GX_TIME_LANDING, "exact") ? span / simulation->steps : dt;
  simulation->problem_options.dt = simulation->dt;
  simulation->start = start;
  simulation->end = start + span;
  return GX_OK;
}

/* What is asked for cannot be had of this case. */
static enum gx_status refuse_outputs(const struct gx_simulation *simulation, const struct gx_case *one,
                                     struct gx_outcome *outcome)
{
  const struct gx_problem *problem = simulation->problem;
  bool spectra = integer(one, GX_OUTPUT_SPECTRA, 0), budget = integer(one, GX_OUTPUT_BUDGET, 0);
  const char *of_errors = spectra ? "output.spectra" : budget ? "output.budget" : NULL;
  if (of_errors && (!problem->exact || problem->inside))
    return gx_status_set(outcome, GX_REFUSED, -1, "%s is of errors over the whole domain, and %s %s: leave it out", of_errors,
                         problem->name, problem->exact ? "does not fill it" : "has no exact solution");
  if (integer(one, GX_OUTPUT_FREQUENCY, 0) && !problem->waves)
    return gx_status_set(outcome, GX_REFUSED, -1, "output.frequency is of a standing wave, and %s is none: leave it out",
                         problem->name);
  if (!problem->exact && simulation->start != 0)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "%s has no exact solution to start from at time.start, %g s: its initial state is that of time 0",
                         problem->name, simulation->start);
  double sampled = (double)integer(one, GX_OUTPUT_FREQUENCY, 0) * simulation->dt * simulation->frequency;
  if (sampled > 0.25)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "output.frequency samples once in %.3g periods; sample at least four times a period", sampled);
  if (integer(one, GX_OUTPUT_SPECTRA, 0) && simulation->layout != GX_LAYOUT_UNIFORM)
    return gx_status_set(outcome, GX_REFUSED, -1,
                         "output.spectra needs particles at equal distances, and Gauss points are not: use layout uniform");
  return GX_OK;
}

enum gx_status gx_simulation_plan(struct gx_simulation *simulation, const struct gx_case *one, struct gx_outcome *outcome)
{
  *simulation = (struct gx_simulation){0};
  read_problem(simulation, one);
  read_method(simulation, one);
  GX_TRY(settle_steps(simulation, one, outcome));
  GX_TRY(refuse_outputs(simulation, one, outcome));
  return refuse(simulation, outcome);
}

static bool is_inside(const void *simulation, const double *X)
{
  const struct gx_simulation *of = simulation;
  return of->problem->inside(&of->problem_options, X);
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
  if (simulation->particles->n) return GX_OK;
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
  double cycles = simulation->problem->cycles, first = 0, span = 1 / simulation->frequency, largest = 0;
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
  double *block = malloc(particles->n * (size_t)particles->dim * sizeof(double));
  if (!block) return INFINITY;
  for (int d = 0; d < particles->dim; d++) scratch[d] = block + (size_t)d * particles->n;
  double bound = simulation->problem->exact
                     ? exact_bound(simulation, scratch)
                     : kinetic_of(particles, particles->v) + elastic_of(simulation, block) + loaded_bound(simulation, scratch);
  free(block);
  return bound;
}
