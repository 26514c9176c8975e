/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parameter table, and completing a case by it. */
#include <gridcross/parameter.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <gridcross/basis.h>
#include <gridcross/problem.h>

#include "errors.h"
#include "number.h"
#include "rules.h"

#define RANGE(from, to) .least = from, .most = to
#define POSITIVE        RANGE(0, INFINITY), .above_least = true
#define PHYSICAL        RANGE(1e-100, 1e100) /* its squares in errors and energies neither overflow nor vanish */

const struct gx_parameter gx_parameters[GX_PARAMETERS] = {
#include "parameter_problem.h"
    [GX_MESH_CELLS] = {.path = "mesh.cells",
                       .type = GX_INTEGER,
                       .unit = "",
                       RANGE(1, 1e7),
                       .standard = "32",
                       .applies = gx_rules_is_continuum,
                       .help = "cells in each direction",
                       .why = "fine enough for the asymptotic range, coarse enough for a quick answer"},
    [GX_MESH_PARTICLES_PER_CELL] = {.path = "mesh.particles_per_cell",
                                    .type = GX_INTEGER,
                                    .unit = "",
                                    RANGE(1, 1000),
                                    .standard = "4",
                                    .applies = gx_rules_lattice_applies,
                                    .help = "particles per cell in each direction",
                                    .why = "quadrature errors then stay below those of the grid at moderate resolution"},
    [GX_MESH_LAYOUT] = {.path = "mesh.layout",
                        .type = GX_TEXT,
                        .unit = "",
                        .choice = gx_rules_layout_choice,
                        .standard = "uniform",
                        .applies = gx_rules_lattice_applies,
                        .help = "where particles start in a cell: equal parts, or Gauss points with Gauss weights as volumes",
                        .why = "as nearly all published computations"},
    [GX_METHOD_SPACE] = {.path = "method.space",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = gx_rules_space_choice,
                         .standard = "standard",
                         .applies = gx_rules_is_continuum,
                         .help = "discretisation in space",
                         .why = "the method that the others are compared with"},
    [GX_METHOD_BASIS] = {.path = "method.basis",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = gx_rules_basis_choice,
                         .standard = "bspline",
                         .applies = gx_rules_is_galerkin,
                         .help = "basis functions of the grid",
                         .why = "smooth across cells, so that crossings cost little"},
    [GX_METHOD_DEGREE] = {.path = "method.degree",
                          .type = GX_INTEGER,
                          .unit = "",
                          RANGE(1, GX_MAX_DEGREE),
                          .resolve = gx_rules_degree_default,
                          .applies = gx_rules_degree_applies,
                          .help = "polynomial degree: of bspline and the other bases that have one, and of the spline spaces",
                          .why = "2: the lowest with a continuous gradient; 5 for the spline spaces, as in the papers"},
    [GX_METHOD_MASS] = {.path = "method.mass",
                        .type = GX_TEXT,
                        .unit = "",
                        .choice = gx_rules_mass_choice,
                        .standard = "lumped",
                        .applies = gx_rules_is_galerkin,
                        .help = "mass matrix: row sums, or the full matrix solved each step",
                        .why = "cheap, and the literature's; consistent is needed for order above 2"},
    [GX_METHOD_QUADRATURE] = {.path = "method.quadrature",
                              .type = GX_TEXT,
                              .unit = "",
                              .choice = gx_rules_quadrature_choice,
                              .standard = "particles",
                              .applies = gx_rules_is_galerkin,
                              .help =
                                  "integrals of mass, momentum and force: sums over particles, or Gauss points of the cells at "
                                  "fields reconstructed from the particles (Tielen et al. 2017, Wobbes et al. 2019)",
                              .why = "what MPM is; reconstructed keeps the order where particles cross cells"},
    [GX_METHOD_TRANSFER] =
        {.path = "method.transfer",
         .type = GX_TEXT,
         .unit = "",
         .choice = gx_rules_transfer_choice,
         .standard = "flip",
         .applies = gx_rules_particles_move,
         .help = "particle velocity from the grid: by increments, interpolated, or interpolated with its affine part; not in "
                 "moving-mesh with projection once",
         .why = "as in the papers: pic damps, apic less"},
    [GX_METHOD_FLIP] = {.path = "method.flip",
                        .type = GX_REAL,
                        .unit = "",
                        RANGE(0, 1),
                        .standard = "1",
                        .applies = gx_rules_flip_applies,
                        .help = "share of flip in a blend of flip and pic; transfer flip only",
                        .why = "pure flip: no damping"},
    [GX_METHOD_CLOCK] = {.path = "method.clock",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = gx_rules_clock_choice,
                         .standard = "central-difference",
                         .help = "time integrator",
                         .why = "second order at one acceleration a step"},
    [GX_METHOD_POSITION] =
        {.path = "method.position",
         .type = GX_TEXT,
         .unit = "",
         .choice = gx_rules_position_choice,
         .standard = "nodal",
         .applies = gx_rules_particles_move,
         .help = "velocity that moves particles: the grid's, or their own; not in moving-mesh with projection once",
         .why = "the grid's is single-valued: particles cannot pass one another"},
    [GX_METHOD_PROJECTION] = {.path = "method.projection",
                              .type = GX_TEXT,
                              .unit = "",
                              .choice = gx_rules_projection_choice,
                              .resolve = gx_rules_projection_default,
                              .applies = gx_rules_is_galerkin,
                              .help = "nodal velocity projected from particles each step, or once at the start",
                              .why = "by space: each-step on a fixed grid, once on a grid that moves along"},
    [GX_METHOD_STRESS] = {.path = "method.stress",
                          .type = GX_TEXT,
                          .unit = "",
                          .choice = gx_rules_stress_choice,
                          .standard = "F",
                          .applies = gx_rules_is_continuum,
                          .help = "stress from the deformation gradient F, or integrated from its rate",
                          .why = "no drift away from the material law"},
    [GX_METHOD_FRAME] = {.path = "method.frame",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = gx_rules_frame_choice,
                         .standard = "reference",
                         .applies = gx_rules_is_collocation,
                         .help = "sites of the splines: particles where they are now (current) or where they were undeformed "
                                 "(reference); spline spaces",
                         .why = "reference: nothing crosses, and the order is kept; the papers' is current"},
    [GX_METHOD_CLOSURE] = {.path = "method.closure",
                           .type = GX_TEXT,
                           .unit = "",
                           .choice = gx_rules_closure_choice,
                           .applies = gx_rules_closure_applies,
                           .resolve = gx_rules_closure_default,
                           .help = "fixed ends: zeros of u and v there (papers), or mirror images of all fields (symmetric); "
                                   "spline spaces between fixed ends",
                           .why = "symmetric is stable at every degree; papers in the current frame, to compare"},
    [GX_METHOD_DIVERGENCE] = {.path = "method.divergence",
                              .type = GX_TEXT,
                              .unit = "",
                              .choice = gx_rules_divergence_choice,
                              .standard = "exact",
                              .applies = gx_rules_divergence_applies,
                              .help = "acceleration F/rho0 dsigma/dx, or without the factor F; current frame",
                              .why = "exact: berzins2021 leaves the factor out"},
    [GX_TIME_DT] = {.path = "time.dt",
                    .type = GX_REAL,
                    .unit = "s",
                    POSITIVE,
                    .resolve = gx_rules_dt_default,
                    .help = "time step; excludes time.cfl",
                    .why = "none: time.cfl sets the step; 1e-3 for problems without cells"},
    [GX_TIME_CFL] =
        {.path = "time.cfl",
         .type = GX_REAL,
         .unit = "",
         POSITIVE,
         .standard = "0.4",
         .applies = gx_rules_cfl_applies,
         .help = "time step as dt c/h, with wave speed c and cell width h; smaller for splines through several particles a "
                 "cell; excludes time.dt",
         .why = "below the limit of most methods here"},
    [GX_TIME_START] = {.path = "time.start",
                       .type = GX_REAL,
                       .unit = "s",
                       RANGE(-INFINITY, INFINITY),
                       .standard = "0",
                       .help = "time at which the run starts, from the exact state",
                       .why = "0: the state that the problem is posed with"},
    [GX_TIME_END] = {.path = "time.end",
                     .type = GX_REAL,
                     .unit = "s",
                     RANGE(-INFINITY, INFINITY),
                     .resolve = gx_rules_end_default,
                     .help = "end time, after time.start; excludes time.periods and time.steps",
                     .why = "none: time.periods sets the end; by problem where there is no period"},
    [GX_TIME_PERIODS] = {.path = "time.periods",
                         .type = GX_REAL,
                         .unit = "",
                         POSITIVE,
                         .standard = "1",
                         .applies = gx_rules_periods_applies,
                         .help = "time from start to end in periods of the exact solution; excludes time.end and time.steps",
                         .why = "every state of the motion is met once"},
    [GX_TIME_STEPS] = {.path = "time.steps",
                       .type = GX_INTEGER,
                       .unit = "",
                       RANGE(1, 1e15),
                       .help = "number of steps of the length asked for; excludes time.end and time.periods",
                       .why = "none: time.periods sets the end"},
    [GX_TIME_LANDING] = {.path = "time.landing",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = gx_rules_landing_choice,
                         .standard = "exact",
                         .applies = gx_rules_landing_applies,
                         .help = "shorten the step so that whole steps meet the end, or keep it and stop at or past the end",
                         .why = "errors of different steps are then taken at the same time"},
    [GX_TIME_ACCUMULATE] = {.path = "time.accumulate",
                            .type = GX_TEXT,
                            .unit = "",
                            .choice = gx_rules_accumulate_choice,
                            .standard = "product",
                            .help = "time of step n: start + n dt, or a running sum, plain or compensated",
                            .why = "rounding does not build up"},
    [GX_OUTPUT_MEASURES] = {.path = "output.measures",
                            .type = GX_TEXT,
                            .unit = "",
                            .choice = gx_rules_measures_choice,
                            .standard = "all",
                            .help = "final errors, also their maxima over the steps, or energies besides",
                            .why = "nothing is missing; final is the fastest"},
    [GX_OUTPUT_HISTORIES] = {.path = "output.histories",
                             .type = GX_INTEGER,
                             .unit = "steps",
                             RANGE(0, 1e9),
                             .standard = "0",
                             .help = "keep a sample of every measure each so many steps; 0: none",
                             .why = "a table needs none"},
    [GX_OUTPUT_SNAPSHOTS] = {.path = "output.snapshots",
                             .type = GX_INTEGER,
                             .unit = "steps",
                             RANGE(1, 1e9),
                             .applies = gx_rules_is_continuum,
                             .help = "write particles and grid each so many steps, at the start and at the end: case-<id>.h5 in "
                                     "openPMD 1.1, and .xmf beside it for ParaView",
                             .why = "none: a file of every case"},
    [GX_OUTPUT_CHECKPOINT] =
        {.path = "output.checkpoint",
         .type = GX_INTEGER,
         .unit = "steps",
         RANGE(1, 1e9),
         .help = "keep the state of a case under way each so many steps, and on Ctrl-C, from which run --resume goes "
                 "on to the same bits; removed when the case is done",
         .why = "none: it takes a write of all particles"},
    [GX_OUTPUT_PROBE] = {.path = "output.probe",
                         .type = GX_TEXT,
                         .unit = "m",
                         .well_formed = gx_rules_place_well_formed,
                         .help = "reference coordinates, one number from 0 to 1 a dimension, such as 0.3 or 0.3 0.7; the nearest "
                                 "particle is followed in histories",
                         .why = "none: norms are over all particles"},
    [GX_OUTPUT_JUMPS] = {.path = "output.jumps",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = gx_rules_switch_choice,
                         .applies = gx_rules_jumps_apply,
                         .help =
                             "measure what each step across a cell edge goes astray from one that stops there; where particles "
                             "move through cells",
                         .why = "none: it takes a pass over the particles each step"},
    [GX_OUTPUT_SPECTRA] = {.path = "output.spectra",
                           .type = GX_INTEGER,
                           .unit = "steps",
                           RANGE(0, 1e9),
                           .standard = "0",
                           .applies = gx_rules_is_continuum,
                           .help = "keep the errors' spectra in X each so many steps, for uniform particles; 0: none",
                           .why = "a table needs none"},
    [GX_OUTPUT_FREQUENCY] = {.path = "output.frequency",
                             .type = GX_INTEGER,
                             .unit = "steps",
                             RANGE(0, 1e9),
                             .standard = "0",
                             .applies = gx_rules_is_continuum,
                             .help = "sample the driven mode each so many steps and fit its frequency; 0: no",
                             .why = "it takes a projection of every sample"},
    [GX_OUTPUT_REFERENCE] = {.path = "output.reference",
                             .type = GX_INTEGER,
                             .unit = "",
                             .least = 0,
                             .most = 4096,
                             .standard = "0",
                             .help = "run also with dt divided by this, and compare final states: the clock's error alone; 0: no",
                             .why = "it multiplies the cost"},
    [GX_OUTPUT_BUDGET] = {.path = "output.budget",
                          .type = GX_INTEGER,
                          .unit = "steps",
                          RANGE(1, 1e9),
                          .applies = gx_rules_is_galerkin,
                          .help =
                              "split the error of a step from the exact state into its terms each so many steps, and keep the "
                              "history; spaces with a grid",
                          .why = "none: a step of the budget costs as much as tens of others"},
};

int gx_parameter_find(const char *path)
{
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (!strcmp(gx_parameters[id].path, path)) return id;
  return -1;
}

static struct gx_value value_from(const struct gx_parameter *parameter, const char *text)
{
  struct gx_value value = {.type = parameter->type};
  if (parameter->type == GX_TEXT)
    value.text = text;
  else if (parameter->type == GX_INTEGER)
    gx_number_integer(text, &value.integer);
  else
    gx_number_real(text, &value.real);
  return value;
}

struct gx_value gx_parameter_default(enum gx_parameter_id id)
{
  const struct gx_parameter *parameter = &gx_parameters[id];
  return parameter->standard ? value_from(parameter, parameter->standard) : (struct gx_value){.type = GX_NULL};
}

void gx_parameter_own(struct gx_value *value)
{
  const char *const *own = gx_problem_find(value[GX_PROBLEM_NAME].text)->standard;
  for (; own && *own; own++) {
    char path[64];
    size_t length = strcspn(*own, "=");
    snprintf(path, sizeof path, "%.*s", (int)length, *own);
    int id = gx_parameter_find(path);
    if (id >= 0 && value[id].type == GX_NULL) value[id] = value_from(&gx_parameters[id], *own + length + 1);
  }
}

void gx_parameter_resolve(struct gx_value *value)
{
  gx_parameter_own(value);
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (value[id].type == GX_NULL)
      value[id] = gx_parameters[id].resolve ? gx_parameters[id].resolve(value) : gx_parameter_default(id);
  /* Only now: whether a parameter applies may depend on a later one. */
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (gx_parameters[id].applies && !gx_parameters[id].applies(value)) value[id] = (struct gx_value){.type = GX_NULL};
}

/* "periodic, fixed" */
static void list_boundaries(const struct gx_problem *problem, char list[64])
{
  list[0] = '\0';
  for (int b = 0; b < GX_BOUNDARIES; b++) {
    size_t used = strlen(list);
    if (problem->boundaries >> b & 1) snprintf(list + used, 64 - used, "%s%s", used ? ", " : "", gx_problem_boundary[b]);
  }
}

static bool boundary_fits(const struct gx_problem *problem, const char *text, char objection[GX_OBJECTION_LENGTH])
{
  char list[64];
  for (int b = 0; b < GX_BOUNDARIES; b++)
    if (problem->boundaries >> b & 1 && !strcmp(text, gx_problem_boundary[b])) return true;
  list_boundaries(problem, list);
  snprintf(objection, GX_OBJECTION_LENGTH, "%s is not posed with '%s'; choose from %s", problem->name, text, list);
  return false;
}

static bool dimension_fits(const struct gx_problem *problem, long dimension, char objection[GX_OBJECTION_LENGTH])
{
  bool low = dimension < problem->min_dim;
  int limit = low ? problem->min_dim : problem->max_dim;
  if (!low && dimension <= limit) return true;
  snprintf(objection, GX_OBJECTION_LENGTH, "%s has at %s %d dimension%s, not %ld", problem->name, low ? "least" : "most", limit,
           limit == 1 ? "" : "s", dimension);
  return false;
}

bool gx_parameter_fits(enum gx_parameter_id id, const struct gx_value *value, char objection[GX_OBJECTION_LENGTH])
{
  const struct gx_parameter *parameter = &gx_parameters[id];
  const struct gx_problem *problem = gx_problem_find(value[GX_PROBLEM_NAME].text);
  if (id == GX_TIME_END && value[id].type == GX_REAL && !(value[id].real > value[GX_TIME_START].real)) {
    snprintf(objection, GX_OBJECTION_LENGTH, "%.15g is not after time.start, %.15g", value[id].real, value[GX_TIME_START].real);
    return false;
  }
  if (id == GX_BODY_FILE && value[id].type == GX_TEXT && !gx_rules_is_file_name(value[id].text)) {
    snprintf(objection, GX_OBJECTION_LENGTH, "%s names no file; give the name of a CSV or HDF5 file",
             gx_errors_quote(value[id].text).text);
    return false;
  }
  if (id == GX_BODY_SHAPE && gx_rules_file_applies(value) && value[GX_BODY_FILE].type == GX_NULL) {
    snprintf(objection, GX_OBJECTION_LENGTH, "points are read from body.file; name a CSV or HDF5 file there");
    return false;
  }
  if (id == GX_PROBLEM_DIMENSION) return dimension_fits(problem, value[id].integer, objection);
  if (id == GX_PROBLEM_BOUNDARY && value[id].type == GX_TEXT) return boundary_fits(problem, value[id].text, objection);
  if (!parameter->well_formed || value[id].type == GX_NULL || parameter->well_formed(value[id].text, value)) return true;
  snprintf(objection, GX_OBJECTION_LENGTH, "%s does not suit dimension %ld; it gives the %s",
           gx_errors_quote(value[id].text).text, value[GX_PROBLEM_DIMENSION].integer, parameter->help);
  return false;
}
