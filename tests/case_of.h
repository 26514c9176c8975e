/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cases written as text, without a run file: case_of("mesh.cells=16", "method.space=moving-mesh"). What is not named has the
 * default of DESIGN.md, save that `projection` and `boundary` follow the space and the problem. */
#ifndef GRIDCROSS_TESTS_CASE_OF_H
#define GRIDCROSS_TESTS_CASE_OF_H

#include <stdlib.h>
#include <string.h>

#include <gridcross/clock.h>
#include <gridcross/study.h>

#include "check.h"

static inline const char *case_path(int id)
{
  static const char *const paths[GX_PARAMETERS] = {
      [GX_PROBLEM_NAME] = "problem.name",
      [GX_PROBLEM_DIMENSION] = "problem.dimension",
      [GX_PROBLEM_AMPLITUDE] = "problem.amplitude",
      [GX_PROBLEM_MODULUS] = "problem.modulus",
      [GX_PROBLEM_DENSITY] = "problem.density",
      [GX_PROBLEM_POISSON] = "problem.poisson",
      [GX_PROBLEM_BOUNDARY] = "problem.boundary",
      [GX_PROBLEM_MODE] = "problem.mode",
      [GX_PROBLEM_ACTIVE] = "problem.active",
      [GX_PROBLEM_PHASES] = "problem.phases",
      [GX_MESH_CELLS] = "mesh.cells",
      [GX_MESH_PARTICLES_PER_CELL] = "mesh.particles_per_cell",
      [GX_MESH_LAYOUT] = "mesh.layout",
      [GX_METHOD_SPACE] = "method.space",
      [GX_METHOD_BASIS] = "method.basis",
      [GX_METHOD_DEGREE] = "method.degree",
      [GX_METHOD_MASS] = "method.mass",
      [GX_METHOD_TRANSFER] = "method.transfer",
      [GX_METHOD_FLIP] = "method.flip",
      [GX_METHOD_CLOCK] = "method.clock",
      [GX_METHOD_POSITION] = "method.position",
      [GX_METHOD_PROJECTION] = "method.projection",
      [GX_METHOD_STRESS] = "method.stress",
      [GX_TIME_DT] = "time.dt",
      [GX_TIME_CFL] = "time.cfl",
      [GX_TIME_END] = "time.end",
      [GX_TIME_PERIODS] = "time.periods",
      [GX_TIME_LANDING] = "time.landing",
      [GX_TIME_ACCUMULATE] = "time.accumulate",
      [GX_OUTPUT_MEASURES] = "output.measures",
      [GX_OUTPUT_HISTORIES] = "output.histories",
  };
  return paths[id];
}

static inline enum gx_type case_type(int id)
{
  switch (id) {
  case GX_PROBLEM_DIMENSION:
  case GX_PROBLEM_MODE:
  case GX_MESH_CELLS:
  case GX_MESH_PARTICLES_PER_CELL:
  case GX_METHOD_DEGREE:
  case GX_OUTPUT_HISTORIES:
    return GX_INTEGER;
  case GX_PROBLEM_AMPLITUDE:
  case GX_PROBLEM_MODULUS:
  case GX_PROBLEM_DENSITY:
  case GX_PROBLEM_POISSON:
  case GX_METHOD_FLIP:
  case GX_TIME_DT:
  case GX_TIME_CFL:
  case GX_TIME_END:
  case GX_TIME_PERIODS:
    return GX_REAL;
  default:
    return GX_TEXT;
  }
}

/* An empty text makes the value null. The text is borrowed. */
static inline void case_set(struct gx_case *one, enum gx_parameter_id id, const char *text)
{
  struct gx_value *value = &one->value[id];
  value->type = *text ? case_type((int)id) : GX_NULL;
  if (value->type == GX_INTEGER) value->integer = atol(text);
  if (value->type == GX_REAL) value->real = atof(text);
  if (value->type == GX_TEXT) value->text = text;
  if (id == GX_TIME_DT && *text) one->value[GX_TIME_CFL].type = GX_NULL;
  if (id == GX_TIME_END && *text) one->value[GX_TIME_PERIODS].type = GX_NULL;
}

static inline void case_set_integer(struct gx_case *one, enum gx_parameter_id id, long integer)
{
  one->value[id] = (struct gx_value){.type = GX_INTEGER, .integer = integer};
}

static inline void case_set_real(struct gx_case *one, enum gx_parameter_id id, double real)
{
  one->value[id] = (struct gx_value){.type = GX_REAL, .real = real};
}

static inline void case_apply(struct gx_case *one, const char *const *set)
{
  for (; *set; set++) {
    const char *equals = strchr(*set, '=');
    int id = 0;
    while (id < GX_PARAMETERS &&
           (strlen(case_path(id)) != (size_t)(equals - *set) || strncmp(case_path(id), *set, (size_t)(equals - *set))))
      id++;
    if (id == GX_PARAMETERS) {
      fail_msg("no parameter for %s", *set);
      return;
    }
    case_set(one, (enum gx_parameter_id)id, equals + 1);
  }
}

/* Fills what depends on the problem and the space, where it was not set. */
static inline void case_resolve(struct gx_case *one)
{
  if (one->value[GX_PROBLEM_BOUNDARY].type == GX_NULL)
    case_set(one, GX_PROBLEM_BOUNDARY, gx_problem_find(one->value[GX_PROBLEM_NAME].text)->periodic ? "periodic" : "fixed");
  if (one->value[GX_METHOD_PROJECTION].type == GX_NULL)
    case_set(one, GX_METHOD_PROJECTION, gx_space_find(one->value[GX_METHOD_SPACE].text)->fixed_grid ? "each-step" : "once");
}

static inline struct gx_case case_from(const char *const *set)
{
  static const char *const standard[] = {
      "problem.name=bar-neo-hookean",
      "problem.dimension=1",
      "problem.amplitude=0.05",
      "problem.modulus=1e4",
      "problem.density=1",
      "problem.poisson=0",
      "problem.mode=1",
      "mesh.cells=32",
      "mesh.particles_per_cell=4",
      "mesh.layout=uniform",
      "method.space=standard",
      "method.basis=bspline",
      "method.degree=2",
      "method.mass=lumped",
      "method.transfer=flip",
      "method.flip=1",
      "method.clock=central-difference",
      "method.position=nodal",
      "method.stress=F",
      "time.cfl=0.4",
      "time.periods=1",
      "time.landing=exact",
      "time.accumulate=product",
      "output.measures=all",
      "output.histories=0",
      NULL,
  };
  struct gx_case one = {0};
  case_apply(&one, standard);
  case_apply(&one, set);
  case_resolve(&one);
  return one;
}

#define case_of(...) case_from((const char *const[]){__VA_ARGS__, NULL})

/* Runs the case and frees what it keeps; fails unless it ended well. */
static inline struct gx_result case_result(const struct gx_case *one)
{
  struct gx_result result = gx_case_run(one);
  gx_case_free(&result);
  CHECK(result.outcome.status == GX_OK, "%s %s", gx_status_name(result.outcome.status), result.outcome.reason);
  return result;
}

#endif
