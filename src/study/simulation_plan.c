/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the resolved parameters of a case to something that runs. */
#include "simulation_plan.h"

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
  for (int b = 0; b < GX_BOUNDARIES; b++)
    if (is(one, GX_PROBLEM_BOUNDARY, gx_problem_boundary[b])) gx_simulation_bound(simulation, (enum gx_boundary)b);
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

static enum gx_status settle_steps(struct gx_simulation *simulation, const struct gx_case *one, struct gx_outcome *outcome)
{
  double c = simulation->problem->material->wave_speed(&simulation->problem_options.moduli);
  double h = 1.0 / simulation->space_options.cells[0];
  double period = simulation->problem->cycles / (c * simulation->problem_options.mode);
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
  double sampled = (double)integer(one, GX_OUTPUT_FREQUENCY, 0) * simulation->dt * gx_simulation_frequency(simulation);
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
  return gx_simulation_check(simulation, outcome);
}
