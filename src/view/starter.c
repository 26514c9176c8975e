/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Starter run files, written from the parameter table so that they name what there is. */
#include <gridcross/starter.h>

#include <math.h>
#include <string.h>

#include <gridcross/parameter.h>

static void write_range(FILE *out, const struct gx_parameter *parameter)
{
  if (parameter->least == -INFINITY) return; /* any number */
  if (parameter->most < INFINITY)
    fprintf(out, "; %.15g to %.15g%s", parameter->least, parameter->most,
            parameter->above_least && parameter->below_most ? ", both excluded" : "");
  else if (parameter->above_least)
    fprintf(out, "; above %.15g", parameter->least);
  else
    fprintf(out, "; %.15g or more", parameter->least);
}

static void write_comment(FILE *out, const struct gx_parameter *parameter)
{
  fprintf(out, "  # %s", parameter->help);
  if (*parameter->unit) fprintf(out, " [%s]", parameter->unit);
  for (int i = 0; parameter->choice && parameter->choice(i); i++) fprintf(out, "%s%s", i ? ", " : ": ", parameter->choice(i));
  if (parameter->type != GX_TEXT) write_range(out, parameter);
  fputc('\n', out);
}

/* What another value may change or rule out is commented out, so that the file stays valid when that value is edited. */
static bool follows(const struct gx_parameter *parameter)
{
  bool method = !strncmp(parameter->path, "method.", strlen("method."));
  return parameter->resolve || (method && parameter->applies);
}

static void write_value(FILE *out, const struct gx_parameter *parameter, const struct gx_value *value)
{
  const char *key = strchr(parameter->path, '.') + 1;
  const char *indent = follows(parameter) ? "  # " : "  ";
  switch (value->type) {
  case GX_NULL:
    fprintf(out, "  # %s:\n", key);
    break;
  case GX_INTEGER:
    fprintf(out, "%s%s: %ld\n", indent, key, value->integer);
    break;
  case GX_REAL:
    fprintf(out, "%s%s: %.15g\n", indent, key, value->real);
    break;
  case GX_TEXT:
    fprintf(out, "%s%s: %s\n", indent, key, value->text);
    break;
  }
}

/* The default of a choice of method that only other spaces have, or the current frame alone, so that a reader learns of it. */
static struct gx_value default_elsewhere(const struct gx_problem *problem, int id)
{
  const struct gx_parameter *space = &gx_parameters[GX_METHOD_SPACE];
  const bool method = !strncmp(gx_parameters[id].path, "method.", strlen("method."));
  for (int i = 0; method && !problem->space && space->choice(i); i++)
    for (int current = 0; current < 2; current++) {
      struct gx_value value[GX_PARAMETERS] = {[GX_PROBLEM_NAME] = {.type = GX_TEXT, .text = problem->name},
                                              [GX_METHOD_SPACE] = {.type = GX_TEXT, .text = space->choice(i)}};
      if (current) value[GX_METHOD_FRAME] = (struct gx_value){.type = GX_TEXT, .text = "current"};
      gx_parameter_resolve(value);
      if (value[id].type != GX_NULL) return value[id];
    }
  return (struct gx_value){0};
}

int gx_starter_write(FILE *out, const struct gx_problem *problem)
{
  struct gx_value value[GX_PARAMETERS] = {[GX_PROBLEM_NAME] = {.type = GX_TEXT, .text = problem->name}};
  gx_parameter_resolve(value);
  fprintf(out, "# A run file of gridcross. %s: %s\n", problem->name, problem->help);
  fputs("# Any value may be a list, [16, 32, 64], or a range, {geom: [16, 128, 4]} or {lin: [0, 1, 5]}; lists multiply.\n"
        "# 'zip: [mesh.cells, time.dt]' lets lists advance together; 'cases:' lists changes to this base, run instead of it.\n"
        "# Values are the defaults; only problem.name is needed. Those commented out follow from others, or do not apply with "
        "every method.\n",
        out);
  fprintf(out, "title: %s\n", problem->name);
  const char *section = "";
  for (int id = 0; id < GX_PARAMETERS; id++) {
    const struct gx_parameter *parameter = &gx_parameters[id];
    size_t length = strcspn(parameter->path, ".");
    if (value[id].type == GX_NULL && parameter->applies && !parameter->applies(value)) {
      value[id] = default_elsewhere(problem, id);
      if (value[id].type == GX_NULL) continue;
    }
    if (strncmp(section, parameter->path, length + 1)) fprintf(out, "\n%.*s:\n", (int)length, parameter->path);
    section = parameter->path;
    write_comment(out, parameter);
    write_value(out, parameter, &value[id]);
  }
  return ferror(out) ? -1 : 0;
}
