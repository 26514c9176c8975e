/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parameter table, and what a case's parameters depend on. */
#include <gridcross/parameter.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <gridcross/basis.h>
#include <gridcross/clock.h>
#include <gridcross/problem.h>
#include <gridcross/space.h>

#include "errors.h"
#include "number.h"

static const struct gx_value null = {.type = GX_NULL};

static struct gx_value text_value(const char *text)
{
  return (struct gx_value){.type = GX_TEXT, .text = text};
}

static bool is_text(struct gx_value value, const char *text)
{
  return value.type == GX_TEXT && !strcmp(value.text, text);
}

/* Choices */

#define FAMILY_CHOICE(function, family)                                                                                          \
  static const char *function(int i)                                                                                             \
  {                                                                                                                              \
    return family[i] ? family[i]->name : NULL;                                                                                   \
  }
FAMILY_CHOICE(problem_choice, gx_problem_family)
FAMILY_CHOICE(basis_choice, gx_basis_family)
FAMILY_CHOICE(clock_choice, gx_clock_family)

/* Spaces that belong to one problem are no choice. */
static const char *space_choice(int i)
{
  for (const struct gx_space_kind *const *kind = gx_space_family; *kind; kind++)
    if (!(*kind)->of_problem && i-- == 0) return (*kind)->name;
  return NULL;
}

#define CHOICE(function, ...)                                                                                                    \
  static const char *function(int i)                                                                                             \
  {                                                                                                                              \
    static const char *const texts[] = {__VA_ARGS__, NULL};                                                                      \
    return texts[i];                                                                                                             \
  }
CHOICE(boundary_choice, "periodic", "fixed")
CHOICE(layout_choice, "uniform", "gauss")
CHOICE(mass_choice, "lumped", "consistent")
CHOICE(transfer_choice, "flip", "pic")
CHOICE(position_choice, "nodal", "particle")
CHOICE(projection_choice, "each-step", "once")
CHOICE(stress_choice, "F", "rate")
CHOICE(landing_choice, "exact", "past")
CHOICE(accumulate_choice, "product", "sum", "compensated")
CHOICE(measures_choice, "final", "max", "all")

/* Where parameters apply */

static const struct gx_problem *problem_of(const struct gx_value *value)
{
  return gx_problem_find(value[GX_PROBLEM_NAME].text);
}

static bool is_continuum(const struct gx_value *value)
{
  return !problem_of(value)->space;
}

static const struct gx_space_kind *space_of(const struct gx_value *value)
{
  return value[GX_METHOD_SPACE].type == GX_TEXT ? gx_space_find(value[GX_METHOD_SPACE].text) : NULL;
}

static bool interpolation_error_applies(const struct gx_value *value)
{
  return !is_continuum(value);
}

static bool poisson_applies(const struct gx_value *value)
{
  return problem_of(value)->has_poisson;
}

static bool mode_applies(const struct gx_value *value)
{
  return problem_of(value)->has_mode;
}

static bool directions_apply(const struct gx_value *value)
{
  return problem_of(value)->has_directions;
}

static bool degree_applies(const struct gx_value *value)
{
  return value[GX_METHOD_BASIS].type == GX_TEXT && gx_basis_find(value[GX_METHOD_BASIS].text)->has_degree;
}

/* Particles that only sample the nodal field carry no velocity of their own. */
static bool particles_move(const struct gx_value *value)
{
  const struct gx_space_kind *space = space_of(value);
  return space && (space->fixed_grid || !is_text(value[GX_METHOD_PROJECTION], "once"));
}

static bool flip_applies(const struct gx_value *value)
{
  return particles_move(value) && is_text(value[GX_METHOD_TRANSFER], "flip");
}

static bool cfl_applies(const struct gx_value *value)
{
  return value[GX_TIME_DT].type == GX_NULL && is_continuum(value);
}

static bool periods_applies(const struct gx_value *value)
{
  return value[GX_TIME_END].type == GX_NULL;
}

/* Defaults that depend on other parameters */

static struct gx_value boundary_default(const struct gx_value *value)
{
  return text_value(problem_of(value)->periodic ? "periodic" : "fixed");
}

static struct gx_value active_default(const struct gx_value *value)
{
  static const char *const all[] = {"x", "xy", "xyz"};
  return text_value(all[value[GX_PROBLEM_DIMENSION].integer - 1]);
}

static struct gx_value phases_default(const struct gx_value *value)
{
  static const char *const zeros[] = {"0", "0 0", "0 0 0"};
  return text_value(zeros[value[GX_PROBLEM_DIMENSION].integer - 1]);
}

/* Without cells there is no CFL number. */
static struct gx_value dt_default(const struct gx_value *value)
{
  return is_continuum(value) ? null : (struct gx_value){.type = GX_REAL, .real = 1e-3};
}

static struct gx_value projection_default(const struct gx_value *value)
{
  return text_value(space_of(value)->fixed_grid ? "each-step" : "once");
}

/* Free texts */

static bool active_well_formed(const char *text, const struct gx_value *value)
{
  char last = 'x' - 1, end = (char)('x' + value[GX_PROBLEM_DIMENSION].integer);
  const char *s = text;
  for (; *s > last && *s < end; s++) last = *s;
  return *text && !*s;
}

static bool phases_well_formed(const char *text, const struct gx_value *value)
{
  long numbers = 0;
  while (*(text += strspn(text, " "))) {
    char word[64];
    double ignored;
    size_t length = strcspn(text, " ");
    if (length >= sizeof word) return false;
    memcpy(word, text, length);
    word[length] = '\0';
    if (gx_number_real(word, &ignored)) return false;
    text += length;
    numbers++;
  }
  return numbers == value[GX_PROBLEM_DIMENSION].integer;
}

#define RANGE(from, to) .least = from, .most = to
#define POSITIVE        RANGE(0, INFINITY), .above_least = true
#define PHYSICAL        RANGE(1e-100, 1e100) /* its squares in errors and energies neither overflow nor vanish */

const struct gx_parameter gx_parameters[GX_PARAMETERS] = {
    [GX_PROBLEM_NAME] = {.path = "problem.name",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = problem_choice,
                         .help = "what is solved: material, body force, exact solution",
                         .why = "required: no problem suits every question"},
    [GX_PROBLEM_DIMENSION] = {.path = "problem.dimension",
                              .type = GX_INTEGER,
                              .unit = "",
                              RANGE(1, 3),
                              .standard = "1",
                              .help = "number of space dimensions",
                              .why = "the cheapest, and the one that most papers print"},
    [GX_PROBLEM_AMPLITUDE] = {.path = "problem.amplitude",
                              .type = GX_REAL,
                              .unit = "m",
                              RANGE(0, INFINITY),
                              .standard = "0.05",
                              .applies = is_continuum,
                              .help = "amplitude A of the displacement; the domain has length 1",
                              .why = "large enough that particles cross cells; used throughout the literature"},
    [GX_PROBLEM_MODULUS] = {.path = "problem.modulus",
                            .type = GX_REAL,
                            .unit = "Pa",
                            PHYSICAL,
                            .standard = "1e4",
                            .help = "Young's modulus E",
                            .why = "with density 1 a wave crosses the domain in 0.01 s"},
    [GX_PROBLEM_DENSITY] = {.path = "problem.density",
                            .type = GX_REAL,
                            .unit = "kg/m^dim",
                            PHYSICAL,
                            .standard = "1",
                            .applies = is_continuum,
                            .help = "density of the undeformed body",
                            .why = "it only scales time"},
    [GX_PROBLEM_POISSON] = {.path = "problem.poisson",
                            .type = GX_REAL,
                            .unit = "",
                            RANGE(-1, 0.5),
                            .above_least = true,
                            .below_most = true,
                            .standard = "0",
                            .applies = poisson_applies,
                            .help = "Poisson's ratio; problems whose solution admits one",
                            .why = "0 decouples the directions"},
    [GX_PROBLEM_BOUNDARY] = {.path = "problem.boundary",
                             .type = GX_TEXT,
                             .unit = "",
                             .choice = boundary_choice,
                             .resolve = boundary_default,
                             .applies = is_continuum,
                             .help = "ends of the domain: periodic, or fixed at zero displacement",
                             .why = "by problem: as the paper that poses it"},
    [GX_PROBLEM_MODE] = {.path = "problem.mode",
                         .type = GX_INTEGER,
                         .unit = "",
                         RANGE(1, 1e6),
                         .standard = "1",
                         .applies = mode_applies,
                         .help = "wavenumber m of sin(2 pi m X); standing-wave problems",
                         .why = "the longest wave is resolved best"},
    [GX_PROBLEM_ACTIVE] = {.path = "problem.active",
                           .type = GX_TEXT,
                           .unit = "",
                           .applies = directions_apply,
                           .resolve = active_default,
                           .well_formed = active_well_formed,
                           .help =
                               "directions that move, in order and within the dimension, such as x or xy; axis-aligned problems",
                           .why = "all directions of the dimension"},
    [GX_PROBLEM_PHASES] = {.path = "problem.phases",
                           .type = GX_TEXT,
                           .unit = "pi",
                           .applies = directions_apply,
                           .resolve = phases_default,
                           .well_formed = phases_well_formed,
                           .help = "phase of each direction in multiples of pi, one number a dimension, such as 0 0.5; "
                                   "axis-aligned problems",
                           .why = "zeros: all directions move in step"},
    [GX_PROBLEM_INTERPOLATION_ERROR] = {.path = "problem.interpolation_error",
                                        .type = GX_REAL,
                                        .unit = "m/s",
                                        RANGE(-INFINITY, INFINITY),
                                        .standard = "0",
                                        .applies = interpolation_error_applies,
                                        .help = "error added to the velocity in every drift, never stored; oscillator",
                                        .why = "0: the clock's own error"},
    [GX_MESH_CELLS] = {.path = "mesh.cells",
                       .type = GX_INTEGER,
                       .unit = "",
                       RANGE(1, 1e7),
                       .standard = "32",
                       .applies = is_continuum,
                       .help = "cells in each direction",
                       .why = "fine enough for the asymptotic range, coarse enough for a quick answer"},
    [GX_MESH_PARTICLES_PER_CELL] = {.path = "mesh.particles_per_cell",
                                    .type = GX_INTEGER,
                                    .unit = "",
                                    RANGE(1, 1000),
                                    .standard = "4",
                                    .applies = is_continuum,
                                    .help = "particles per cell in each direction",
                                    .why = "quadrature errors then stay below those of the grid at moderate resolution"},
    [GX_MESH_LAYOUT] = {.path = "mesh.layout",
                        .type = GX_TEXT,
                        .unit = "",
                        .choice = layout_choice,
                        .standard = "uniform",
                        .applies = is_continuum,
                        .help = "where particles start in a cell: equal parts, or Gauss points with Gauss weights as volumes",
                        .why = "as nearly all published computations"},
    [GX_METHOD_SPACE] = {.path = "method.space",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = space_choice,
                         .standard = "standard",
                         .applies = is_continuum,
                         .help = "discretisation in space",
                         .why = "the method that the others are compared with"},
    [GX_METHOD_BASIS] = {.path = "method.basis",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = basis_choice,
                         .standard = "bspline",
                         .applies = is_continuum,
                         .help = "basis functions of the grid",
                         .why = "smooth across cells, so that crossings cost little"},
    [GX_METHOD_DEGREE] = {.path = "method.degree",
                          .type = GX_INTEGER,
                          .unit = "",
                          RANGE(1, GX_MAX_DEGREE),
                          .standard = "2",
                          .applies = degree_applies,
                          .help = "polynomial degree of the basis; bases that have one, such as bspline",
                          .why = "the lowest with a continuous gradient"},
    [GX_METHOD_MASS] = {.path = "method.mass",
                        .type = GX_TEXT,
                        .unit = "",
                        .choice = mass_choice,
                        .standard = "lumped",
                        .applies = is_continuum,
                        .help = "mass matrix: row sums, or the full matrix solved each step",
                        .why = "cheap, and the literature's; consistent is needed for order above 2"},
    [GX_METHOD_TRANSFER] =
        {.path = "method.transfer",
         .type = GX_TEXT,
         .unit = "",
         .choice = transfer_choice,
         .standard = "flip",
         .applies = particles_move,
         .help = "particle velocity from the grid: by increments, or interpolated; not in moving-mesh with projection once",
         .why = "as in the papers: pic damps"},
    [GX_METHOD_FLIP] = {.path = "method.flip",
                        .type = GX_REAL,
                        .unit = "",
                        RANGE(0, 1),
                        .standard = "1",
                        .applies = flip_applies,
                        .help = "share of flip in a blend of flip and pic; transfer flip only",
                        .why = "pure flip: no damping"},
    [GX_METHOD_CLOCK] = {.path = "method.clock",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = clock_choice,
                         .standard = "central-difference",
                         .help = "time integrator",
                         .why = "second order at one acceleration a step"},
    [GX_METHOD_POSITION] =
        {.path = "method.position",
         .type = GX_TEXT,
         .unit = "",
         .choice = position_choice,
         .standard = "nodal",
         .applies = particles_move,
         .help = "velocity that moves particles: the grid's, or their own; not in moving-mesh with projection once",
         .why = "the grid's is single-valued: particles cannot pass one another"},
    [GX_METHOD_PROJECTION] = {.path = "method.projection",
                              .type = GX_TEXT,
                              .unit = "",
                              .choice = projection_choice,
                              .resolve = projection_default,
                              .applies = is_continuum,
                              .help = "nodal velocity projected from particles each step, or once at the start",
                              .why = "by space: each-step on a fixed grid, once on a grid that moves along"},
    [GX_METHOD_STRESS] = {.path = "method.stress",
                          .type = GX_TEXT,
                          .unit = "",
                          .choice = stress_choice,
                          .standard = "F",
                          .applies = is_continuum,
                          .help = "stress from the deformation gradient F, or integrated from its rate",
                          .why = "no drift away from the material law"},
    [GX_TIME_DT] = {.path = "time.dt",
                    .type = GX_REAL,
                    .unit = "s",
                    POSITIVE,
                    .resolve = dt_default,
                    .help = "time step; excludes time.cfl",
                    .why = "none: time.cfl sets the step; 1e-3 for problems without cells"},
    [GX_TIME_CFL] = {.path = "time.cfl",
                     .type = GX_REAL,
                     .unit = "",
                     POSITIVE,
                     .standard = "0.4",
                     .applies = cfl_applies,
                     .help = "time step as dt c/h, with wave speed c and cell width h; excludes time.dt",
                     .why = "below the limit of most methods here"},
    [GX_TIME_END] = {.path = "time.end",
                     .type = GX_REAL,
                     .unit = "s",
                     POSITIVE,
                     .help = "end time; excludes time.periods",
                     .why = "none: time.periods sets the end"},
    [GX_TIME_PERIODS] = {.path = "time.periods",
                         .type = GX_REAL,
                         .unit = "",
                         POSITIVE,
                         .standard = "1",
                         .applies = periods_applies,
                         .help = "end time in periods of the exact solution; excludes time.end",
                         .why = "every state of the motion is met once"},
    [GX_TIME_LANDING] = {.path = "time.landing",
                         .type = GX_TEXT,
                         .unit = "",
                         .choice = landing_choice,
                         .standard = "exact",
                         .help = "shorten the step so that whole steps meet the end, or keep it and stop at or past the end",
                         .why = "errors of different steps are then taken at the same time"},
    [GX_TIME_ACCUMULATE] = {.path = "time.accumulate",
                            .type = GX_TEXT,
                            .unit = "",
                            .choice = accumulate_choice,
                            .standard = "product",
                            .help = "time of step n: n dt, or a running sum, plain or compensated",
                            .why = "rounding does not build up"},
    [GX_OUTPUT_MEASURES] = {.path = "output.measures",
                            .type = GX_TEXT,
                            .unit = "",
                            .choice = measures_choice,
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
    [GX_OUTPUT_REFERENCE] = {.path = "output.reference",
                             .type = GX_INTEGER,
                             .unit = "",
                             .least = 0,
                             .most = 4096,
                             .standard = "0",
                             .help = "run also with dt divided by this, and compare final states: the clock's error alone; 0: no",
                             .why = "it multiplies the cost"},
};

int gx_parameter_find(const char *path)
{
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (!strcmp(gx_parameters[id].path, path)) return id;
  return -1;
}

struct gx_value gx_parameter_default(enum gx_parameter_id id)
{
  const struct gx_parameter *parameter = &gx_parameters[id];
  struct gx_value value = {.type = parameter->type};
  if (!parameter->standard) return null;
  if (parameter->type == GX_TEXT)
    value.text = parameter->standard;
  else if (parameter->type == GX_INTEGER)
    gx_number_integer(parameter->standard, &value.integer);
  else
    gx_number_real(parameter->standard, &value.real);
  return value;
}

void gx_parameter_resolve(struct gx_value *value)
{
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (value[id].type == GX_NULL)
      value[id] = gx_parameters[id].resolve ? gx_parameters[id].resolve(value) : gx_parameter_default(id);
  /* Only now: whether a parameter applies may depend on a later one. */
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (gx_parameters[id].applies && !gx_parameters[id].applies(value)) value[id] = null;
}

bool gx_parameter_fits(enum gx_parameter_id id, const struct gx_value *value, char objection[GX_OBJECTION_LENGTH])
{
  const struct gx_parameter *parameter = &gx_parameters[id];
  if (id == GX_PROBLEM_DIMENSION) {
    const struct gx_problem *problem = problem_of(value);
    if (value[id].integer <= problem->max_dim) return true;
    snprintf(objection, GX_OBJECTION_LENGTH, "%s has at most %d dimension%s, not %ld", problem->name, problem->max_dim,
             problem->max_dim == 1 ? "" : "s", value[id].integer);
    return false;
  }
  if (!parameter->well_formed || value[id].type == GX_NULL || parameter->well_formed(value[id].text, value)) return true;
  snprintf(objection, GX_OBJECTION_LENGTH, "%s does not suit dimension %ld; it gives the %s",
           gx_errors_quote(value[id].text).text, value[GX_PROBLEM_DIMENSION].integer, parameter->help);
  return false;
}
