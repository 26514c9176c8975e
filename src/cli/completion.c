/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A script of lists, one function each, and a last one that knows where a word stands. */
#include "completion.h"

#include <string.h>

#include <gridcross/paper.h>
#include <gridcross/problem.h>

#include "command.h"

/* What stands where: arguments of options and operands are told apart by the names that help gives them, FILE.yaml, DIR, PATH=VALUE;
 * a|b|c are the words themselves. readline takes words apart at =, where = is in COMP_WORDBREAKS. */
static const char script[] =
    "_gridcross_complete() { # KIND\n"
    "  local word=$cur head= IFS=$'\\n'\n"
    "  case $1 in\n"
    "  PATH=VALUE)\n"
    "    if [[ $cur == *=* ]]; then\n"
    "      [[ $COMP_WORDBREAKS == *=* ]] || head=${cur%%=*}=\n"
    "      COMPREPLY=($(compgen -P \"$head\" -W \"$(_gridcross_values \"${cur%%=*}\")\" -- \"${cur#*=}\"))\n"
    "    else\n"
    "      COMPREPLY=($(compgen -S = -W \"$(_gridcross_paths)\" -- \"$cur\"))\n"
    "      compopt -o nospace 2>/dev/null\n"
    "    fi ;;\n"
    "  PATH) COMPREPLY=($(compgen -W \"$(_gridcross_paths)\" -- \"$cur\")) ;;\n"
    "  COLUMN) COMPREPLY=($(compgen -W \"$(_gridcross_paths; _gridcross_columns)\" -- \"$cur\")) ;;\n"
    "  KIND) COMPREPLY+=($(compgen -W \"$(_gridcross_kinds)\" -- \"$cur\")) ;;\n"
    "  PROBLEM) COMPREPLY=($(compgen -W \"$(_gridcross_problems)\" -- \"$cur\")) ;;\n"
    "  PAPER*) COMPREPLY=($(compgen -W \"$(_gridcross_papers)\" -- \"$cur\")) ;;\n"
    "  DIR*) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -d -- \"$cur\")) ;;\n"
    "  FILE.yaml)\n"
    "    compopt -o filenames 2>/dev/null\n"
    "    COMPREPLY=($(compgen -f -X '!*.@(yaml|yml)' -- \"$cur\") $(compgen -d -- \"$cur\")) ;;\n"
    "  F[IO]*) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -f -- \"$cur\")) ;;\n"
    "  *'|'*) COMPREPLY+=($(compgen -W \"${1//'|'/$'\\n'}\" -- \"$cur\")) ;;\n"
    "  esac\n"
    "}\n"
    "\n"
    "_gridcross() {\n"
    "  local words=() cur prev command kind operand i word glue=\n"
    "  COMPREPLY=()\n"
    "  for ((i = 0; i <= COMP_CWORD; i++)); do # words as the program will see them\n"
    "    word=${COMP_WORDS[i]}\n"
    "    if ((i > 1)) && [[ $glue || $word == =* ]]; then words[-1]+=$word; else words+=(\"$word\"); fi\n"
    "    [[ $word == *= ]] && glue=1 || glue=\n"
    "  done\n"
    "  cur=${words[-1]} prev= command=${words[1]}\n"
    "  if ((${#words[@]} <= 2)); then\n"
    "    COMPREPLY=($(compgen -W \"$(_gridcross_commands)\" -- \"$cur\"))\n"
    "    return\n"
    "  fi\n"
    "  prev=${words[-2]}\n"
    "  if [[ $cur == --*=* ]]; then\n"
    "    prev=${cur%%=*} cur=${cur#*=}\n"
    "  elif [[ $cur == -* ]]; then\n"
    "    COMPREPLY=($(compgen -W \"$(_gridcross_options \"$command\")\" -- \"$cur\"))\n"
    "    return\n"
    "  fi\n"
    "  kind=$(_gridcross_argument \"$command $prev\")\n"
    "  if [[ $kind ]]; then _gridcross_complete \"$kind\"; return; fi\n"
    "  for operand in $(_gridcross_operands \"$command\"); do _gridcross_complete \"$operand\"; done\n"
    "}\n"
    "\n"
    "shopt -q extglob || shopt -s extglob\n"
    "complete -F _gridcross gridcross\n";

/* One word a line: what stands in brackets of usage may be left out, dots say that it may be repeated. */
static void put_operands(const char *operands, FILE *out)
{
  for (const char *c = operands; *c; c++)
    if (*c == ' ')
      putc('\n', out);
    else if (!strchr("[]", *c) && strncmp(c, "...", 3) != 0 && !(c > operands && *c == '.' && !strncmp(c - 1, "..", 2)))
      putc(*c, out);
}

static void open_list(const char *name, FILE *out)
{
  fprintf(out, "_gridcross_%s() {\n  printf '%%s\\n' \\\n", name);
}

static void close_list(FILE *out)
{
  fputs("    ;\n}\n\n", out);
}

static void open_choice(const char *name, FILE *out)
{
  fprintf(out, "_gridcross_%s() {\n  case $1 in\n", name);
}

static void close_choice(FILE *out)
{
  fputs("  esac\n}\n\n", out);
}

static void put_commands(FILE *out)
{
  open_list("commands", out);
  for (const struct gx_command *const *c = gx_command_family; *c; c++) fprintf(out, "    %s \\\n", (*c)->name);
  fputs("    --help --version --completion --manual \\\n", out);
  close_list(out);
  open_choice("options", out);
  for (const struct gx_command *const *c = gx_command_family; *c; c++) {
    fprintf(out, "  %s) printf '%%s\\n' -h --help", (*c)->name);
    for (const struct gx_option *o = (*c)->option; o->name; o++) {
      if (o->letter) fprintf(out, " -%c", o->letter);
      fprintf(out, " --%s", o->name);
    }
    fputs(" ;;\n", out);
  }
  close_choice(out);
}

static void put_arguments(FILE *out)
{
  open_choice("argument", out);
  for (const struct gx_command *const *c = gx_command_family; *c; c++)
    for (const struct gx_option *o = (*c)->option; o->name; o++) {
      if (!o->argument) continue;
      fprintf(out, "  '%s --%s'", (*c)->name, o->name);
      if (o->letter) fprintf(out, " | '%s -%c'", (*c)->name, o->letter);
      fprintf(out, ") echo '%s' ;;\n", o->argument);
    }
  close_choice(out);
  open_choice("operands", out);
  for (const struct gx_command *const *c = gx_command_family; *c; c++) {
    fprintf(out, "  %s) echo '", (*c)->name);
    put_operands((*c)->operands, out);
    fputs("' ;;\n", out);
  }
  close_choice(out);
}

static void put_parameters(FILE *out)
{
  open_list("paths", out);
  for (int id = 0; id < GX_PARAMETERS; id++) fprintf(out, "    %s \\\n", gx_parameters[id].path);
  close_list(out);
  open_choice("values", out);
  for (int id = 0; id < GX_PARAMETERS; id++) {
    const struct gx_parameter *p = &gx_parameters[id];
    if (p->choice) fprintf(out, "  %s) printf '%%s\\n'", p->path);
    for (int i = 0; p->choice && p->choice(i); i++) fprintf(out, " %s", p->choice(i));
    if (p->choice) fputs(" ;;\n", out);
  }
  close_choice(out);
}

static int put_columns(FILE *out)
{
  struct gx_study none = {0};
  struct gx_table *table = gx_study_table(&none, NULL, true);
  if (!table) return -1;
  open_list("columns", out);
  for (size_t c = 0; c < table->columns; c++)
    if (gx_parameter_find(table->column[c].name) < 0) fprintf(out, "    %s \\\n", table->column[c].name);
  close_list(out);
  gx_table_free(table);
  return 0;
}

static void put_names(FILE *out)
{
  open_list("problems", out);
  for (const struct gx_problem *const *p = gx_problem_family; *p; p++) fprintf(out, "    %s \\\n", (*p)->name);
  close_list(out);
  open_list("kinds", out);
  for (const struct gx_plot_kind *const *k = gx_plot_family; *k; k++) fprintf(out, "    %s \\\n", (*k)->name);
  close_list(out);
  open_list("papers", out);
  for (size_t i = 0; i < gx_paper_item_count; i++) {
    char name[GX_PAPER_NAME_LENGTH];
    gx_paper_name(&gx_paper_items[i], name);
    if (!i || strcmp(gx_paper_items[i].paper, gx_paper_items[i - 1].paper) != 0)
      fprintf(out, "    %s \\\n", gx_paper_items[i].paper);
    fprintf(out, "    %s \\\n", name);
  }
  close_list(out);
}

int gx_completion_print(FILE *out)
{
  fputs("# Completion of gridcross by bash, made by gridcross --completion.\n\n", out);
  put_commands(out);
  put_arguments(out);
  put_parameters(out);
  if (put_columns(out)) return -1;
  put_names(out);
  fputs(script, out);
  return 0;
}
