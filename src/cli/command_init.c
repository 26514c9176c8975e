/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross init: a commented run file to start from, out of the parameter table. */
#include "command.h"

#include <gridcross/problem.h>
#include <gridcross/starter.h>

#include "../core/nearest.h"

static const struct gx_option option[] = {{0}};

static int run(const struct gx_options *options)
{
  const char *name = options->operands ? options->operand[0] : gx_problem_family[0]->name;
  const struct gx_problem *problem = gx_problem_find(name);
  if (problem) {
    gx_starter_write(stdout, problem);
    return GX_EXIT_DONE;
  }
  struct gx_nearest near = {.word = name};
  for (int i = 0; gx_problem_family[i]; i++) gx_nearest_try(&near, gx_problem_family[i]->name);
  fprintf(stderr, "gridcross init: no problem '%s'", name);
  if (*near.best) fprintf(stderr, ": did you mean %s?", near.best);
  fputs(*near.best ? "\n" : "; see gridcross list problems\n", stderr);
  return GX_EXIT_USAGE;
}

static const struct gx_example example[] = {
    {"gridcross init > my.yaml", "the neo-Hookean bar: every parameter with its meaning, at its default"},
    {"gridcross init cantilever > beam.yaml", "the same of another problem"},
    {0},
};

const struct gx_command gx_command_init = {
    .name = "init",
    .operands = "[PROBLEM]",
    .least = 0,
    .most = 1,
    .help = "Print a commented run file to start from.",
    .option = option,
    .example = example,
    .run = run,
};
