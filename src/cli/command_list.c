/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross list: the families of methods and the parameter table. */
#include "command.h"

#include <string.h>

#include <gridcross/basis.h>
#include <gridcross/clock.h>
#include <gridcross/material.h>
#include <gridcross/paper.h>
#include <gridcross/problem.h>
#include <gridcross/space.h>

#include "../core/nearest.h"
#include "../view/sheet.h"
#include "facts.h"
#include "text.h"

enum { INDENT = 4 };

static const struct gx_option option[] = {{0}};

/* Text on lines of the page, indented. */
static void print_text(const char *text)
{
  if (!*text) return;
  printf("%*s", INDENT, "");
  gx_text_print(text, INDENT, INDENT, gx_text_width(), stdout);
}

static void print_method(const char *name, const char *facts, const char *help, const char *source)
{
  gx_text_print(facts, printf("%s%s", name, *facts ? "  " : ""), INDENT, gx_text_width(), stdout);
  print_text(help);
  print_text(source);
}

static void list_spaces(void)
{
  for (const struct gx_space_kind *const *s = gx_space_family; *s; s++)
    if (!(*s)->of_problem) print_method((*s)->name, (*s)->fixed_grid ? "(fixed grid)" : "", (*s)->help, (*s)->source);
}

static void list_bases(void)
{
  for (const struct gx_basis *const *b = gx_basis_family; *b; b++)
    print_method((*b)->name, (*b)->has_degree ? "(method.degree 1...9)" : "", (*b)->help, (*b)->source);
}

static void list_clocks(void)
{
  for (const struct gx_clock *const *c = gx_clock_family; *c; c++) {
    char facts[128], limit[GX_NUMBER_LENGTH];
    snprintf(limit, sizeof limit, "%.4g", (*c)->stability);
    snprintf(facts, sizeof facts, "(order %d, %d stage%s%s, stable for omega dt <= %s)", (*c)->order, (*c)->stages,
             (*c)->stages == 1 ? "" : "s", (*c)->symplectic ? ", symplectic" : "", limit);
    print_method((*c)->name, facts, (*c)->help, (*c)->source);
  }
}

static void list_problems(void)
{
  for (const struct gx_problem *const *p = gx_problem_family; *p; p++) {
    char facts[128];
    const int least = (*p)->min_dim ? (*p)->min_dim : 1, most = (*p)->max_dim;
    if (least < most)
      snprintf(facts, sizeof facts, "(material %s, %d to %d dimensions)", (*p)->material->name, least, most);
    else
      snprintf(facts, sizeof facts, "(material %s, %d dimension%s)", (*p)->material->name, most, most > 1 ? "s" : "");
    print_method((*p)->name, facts, (*p)->help, (*p)->source);
  }
}

static void list_materials(void)
{
  for (const struct gx_material *const *m = gx_material_family; *m; m++) print_method((*m)->name, "", (*m)->help, (*m)->source);
}

static void list_parameters(void)
{
  int width = gx_text_width();
  for (const struct gx_parameter *p = gx_parameters; p < gx_parameters + GX_PARAMETERS; p++) {
    char facts[GX_FACTS_LENGTH];
    gx_facts_text(p, facts);
    printf("%s  ", p->path);
    gx_text_print(facts, gx_sheet_width(p->path) + 2, INDENT, width, stdout);
    print_text(p->help);
    if (p->why) {
      char why[512];
      snprintf(why, sizeof why, "Why: %s", p->why);
      print_text(why);
    }
  }
}

static void list_papers(void)
{
  for (size_t i = 0; i < gx_paper_item_count; i++) {
    char name[GX_PAPER_NAME_LENGTH];
    struct gx_study *study = gx_paper_study(&gx_paper_items[i], stderr);
    gx_paper_name(&gx_paper_items[i], name);
    printf("%s\n", name);
    if (study) print_text(study->title);
    gx_runfile_free(study);
  }
}

static const struct {
  const char *name;
  void (*list)(void);
} topic[] = {{"spaces", list_spaces},       {"bases", list_bases},           {"clocks", list_clocks}, {"problems", list_problems},
             {"materials", list_materials}, {"parameters", list_parameters}, {"papers", list_papers}};

enum { TOPICS = sizeof topic / sizeof *topic };

static int run(const struct gx_options *options)
{
  if (!options->operands) {
    for (int t = 0; t < TOPICS; t++) {
      printf("%s%s\n\n", t ? "\n" : "", topic[t].name);
      topic[t].list();
    }
    return GX_EXIT_DONE;
  }
  struct gx_nearest near = {.word = options->operand[0]};
  for (int t = 0; t < TOPICS; t++) {
    if (!strcmp(options->operand[0], topic[t].name)) {
      topic[t].list();
      return GX_EXIT_DONE;
    }
    gx_nearest_try(&near, topic[t].name);
  }
  fprintf(stderr, "gridcross list: nothing is called '%s'", options->operand[0]);
  if (*near.best) fprintf(stderr, ": did you mean %s?\n", near.best);
  if (!*near.best) fputs("; see gridcross list --help\n", stderr);
  return GX_EXIT_USAGE;
}

static const struct gx_example example[] = {
    {"gridcross list clocks", "order, stages and stability limit of each"},
    {"gridcross list parameters | less", "every parameter, and why its default is what it is"},
    {0},
};

const struct gx_command gx_command_list = {
    .name = "list",
    .operands = "[spaces|bases|clocks|problems|materials|parameters|papers]",
    .least = 0,
    .most = 1,
    .help =
        "List the methods that can be combined, the parameters of run files, or the papers' items; without argument all of them.",
    .option = option,
    .example = example,
    .run = run,
};
