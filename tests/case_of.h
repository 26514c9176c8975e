/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cases written as text, without a run file: case_of("mesh.cells=16", "method.space=moving-mesh"). What is not named has its
 * default; problem.name is bar-neo-hookean. */
#ifndef GRIDCROSS_TESTS_CASE_OF_H
#define GRIDCROSS_TESTS_CASE_OF_H

#include <stdlib.h>
#include <string.h>

#include <gridcross/study.h>

#include "check.h"

/* One value from its text, which is borrowed; an empty text makes it null. */
static inline void case_set(struct gx_case *one, enum gx_parameter_id id, const char *text)
{
  struct gx_value *value = &one->value[id];
  value->type = *text ? gx_parameters[id].type : GX_NULL;
  if (value->type == GX_INTEGER) value->integer = atol(text);
  if (value->type == GX_REAL) value->real = atof(text);
  if (value->type == GX_TEXT) value->text = text;
}

static inline void case_set_integer(struct gx_case *one, enum gx_parameter_id id, long integer)
{
  one->value[id] = (struct gx_value){.type = GX_INTEGER, .integer = integer};
}

static inline void case_set_real(struct gx_case *one, enum gx_parameter_id id, double real)
{
  one->value[id] = (struct gx_value){.type = GX_REAL, .real = real};
}

/* Whether a space transfers between particles and a grid. */
static inline bool case_on_grid(const struct gx_space_kind *space)
{
  return !space->collocation && !space->of_problem;
}

/* A case before defaults are filled in. */
static inline struct gx_case case_begin(const char *const *set)
{
  struct gx_case one = {0};
  case_set(&one, GX_PROBLEM_NAME, "bar-neo-hookean");
  for (; *set; set++) {
    const char *equals = strchr(*set, '=');
    char path[64];
    snprintf(path, sizeof path, "%.*s", (int)(equals - *set), *set);
    int id = gx_parameter_find(path);
    if (id < 0)
      fail_msg("no parameter %s", path);
    else
      case_set(&one, (enum gx_parameter_id)id, equals + 1);
  }
  return one;
}

static inline struct gx_case case_from(const char *const *set)
{
  struct gx_case one = case_begin(set);
  gx_parameter_resolve(one.value);
  return one;
}

#define case_of(...)    case_from((const char *const[]){__VA_ARGS__, NULL})
#define case_draft(...) case_begin((const char *const[]){__VA_ARGS__, NULL})

/* Runs the case and frees what it keeps; fails unless it ended well. */
static inline struct gx_result case_result(const struct gx_case *one)
{
  struct gx_result result = gx_case_run(one);
  gx_case_free(&result);
  CHECK(result.outcome.status == GX_OK, "%s %s", gx_status_name(result.outcome.status), result.outcome.reason);
  return result;
}

#endif
