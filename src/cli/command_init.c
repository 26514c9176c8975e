/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross init: a commented run file to start from, out of the parameter table. */
#include "command.h"

#include <string.h>

#include <gridcross/problem.h>

#include "../study/nearest.h"
#include "../view/sheet.h"

static const struct gx_option option[] = {{0}};

static const char *value_text(struct gx_value value, char buffer[GX_NUMBER_LENGTH])
{
  return value.type == GX_NULL ? "" : gx_sheet_text("", value, buffer);
}

/* Defaults that follow from other parameters, and alternatives that are not set, stand as comments. */
static void print_parameter(const struct gx_parameter *parameter, struct gx_value value)
{
  char line[128], buffer[GX_NUMBER_LENGTH];
  bool set = value.type != GX_NULL && !parameter->resolve;
  snprintf(line, sizeof line, "  %s%s: %s", set ? "" : "# ", gx_sheet_leaf(parameter->path), value_text(value, buffer));
  printf("%-34s  # ", line);
  if (*parameter->unit) printf("%s; ", parameter->unit);
  fputs(parameter->help, stdout);
  const char *gap = ": ";
  for (int i = 0; parameter->choice && parameter->choice(i); i++, gap = ", ") printf("%s%s", gap, parameter->choice(i));
  putchar('\n');
}

static void print_starter(const struct gx_problem *problem)
{
  struct gx_value value[GX_PARAMETERS] = {0};
  value[GX_PROBLEM_NAME] = (struct gx_value){.type = GX_TEXT, .text = problem->name};
  gx_parameter_resolve(value);
  printf("# A study of %s: %s.\n"
         "# Any value may be a list; lists multiply. {geom: [first, last, n]} and {lin: [...]} are lists too.\n"
         "#   gridcross check FILE.yaml    the cases, with their time steps\n"
         "#   gridcross run FILE.yaml      run them\n\n"
         "title: %s\n",
         problem->name, problem->help, problem->name);
  const char *section = "";
  size_t length = 0;
  for (int p = 0; p < GX_PARAMETERS; p++) {
    const char *path = gx_parameters[p].path;
    bool applies = !gx_parameters[p].applies || gx_parameters[p].applies(value);
    if (!applies) continue;
    if (strcspn(path, ".") != length || strncmp(path, section, length) != 0) {
      section = path;
      length = strcspn(path, ".");
      printf("\n%.*s:\n", (int)length, section);
    }
    print_parameter(&gx_parameters[p], value[p]);
  }
}

static int run(const struct gx_options *options)
{
  const char *name = options->operands ? options->operand[0] : gx_problem_family[0]->name;
  const struct gx_problem *problem = gx_problem_find(name);
  if (problem) {
    print_starter(problem);
    return GX_EXIT_DONE;
  }
  struct gx_nearest near = {.word = name};
  for (int i = 0; gx_problem_family[i]; i++) gx_nearest_try(&near, gx_problem_family[i]->name);
  fprintf(stderr, "gridcross init: no problem '%s'", name);
  if (near.best) fprintf(stderr, ": did you mean %s?", near.best);
  fputs(near.best ? "\n" : "; see gridcross list problems\n", stderr);
  return GX_EXIT_USAGE;
}

const struct gx_command gx_command_init = {
    .name = "init",
    .operands = "[PROBLEM]",
    .least = 0,
    .most = 1,
    .help = "Print a commented run file to start from.",
    .option = option,
    .run = run,
};
