/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the manual: what a table says stands there, the rest is said here. */
#include "manual.h"

#include <string.h>

#include <gridcross/build.h>

#include "command.h"
#include "facts.h"

/* Text with everything escaped that scdoc would take for itself. */
static void put(const char *text, FILE *out)
{
  for (; *text; text++) {
    if (strchr("\\*_`#~[|]", *text)) putc('\\', out);
    putc(*text, out);
  }
}

static void put_option(const struct gx_option *option, FILE *out)
{
  if (option->letter) fprintf(out, "*-%c*, ", option->letter);
  fprintf(out, "*--%s*", option->name);
  if (option->argument) {
    fputs(" _", out);
    put(option->argument, out);
    putc('_', out);
  }
  fputs("\n\t", out);
  put(option->help, out);
  fputs("\n\n", out);
}

static void put_command(const struct gx_command *command, FILE *out)
{
  fprintf(out, "## %s\n\n*gridcross %s*", command->name, command->name);
  if (command->option->name) fputs(" \\[OPTION\\]...", out);
  if (*command->operands) putc(' ', out);
  put(command->operands, out);
  fputs("\n\n", out);
  put(command->help, out);
  fputs("\n\n", out);
  for (const struct gx_option *o = command->option; o->name; o++) put_option(o, out);
  if (command->more) {
    fputs("```\n", out);
    command->more(72, out);
    fputs("```\n\n", out);
  }
  for (const struct gx_example *e = command->example; e && e->line; e++) {
    put(e->what, out);
    fprintf(out, ":\n\n```\n%s\n```\n\n", e->line);
  }
}

int gx_manual_program(FILE *out)
{
  fprintf(out, "gridcross(1) \"gridcross %s\"\n\n", gx_build.version);
  fputs("# NAME\n\ngridcross - compares material point methods on equal terms\n\n"
        "# SYNOPSIS\n\n*gridcross* _COMMAND_ \\[_OPTION_\\]... \\[_ARGUMENT_\\]...\n\n"
        "# DESCRIPTION\n\n"
        "A run file, see *gridcross*(5), names problem, mesh, method and time; every scalar in it may be a list, and lists "
        "multiply. "
        "*gridcross run* runs the cases into a study, a directory, and the other commands show and compare studies.\n\n"
        "Results go to standard output, everything else to standard error. A method that fails, by a particle that leaves or a "
        "mesh "
        "that tangles, is a result with a status; the other cases go on.\n\n"
        "# COMMANDS\n\n",
        out);
  for (const struct gx_command *const *c = gx_command_family; *c; c++) put_command(*c, out);
  put_option(&gx_options_help_option, out);
  fputs("# EXIT STATUS\n\n"
        "*0*\n\tdone; a method that fails is a result\n\n"
        "*1*\n\tan internal failure of a case, or a gate of *paper* missed\n\n"
        "*2*\n\tan error of usage, or in a run file\n\n"
        "# ENVIRONMENT\n\n"
        "*NO\\_COLOR*\n\twhere it is set and not empty, nothing is bold on a terminal: marks are asterisks, as in a file\n\n"
        "*TERM*\n\t_dumb_: the same, and progress in plain lines\n\n"
        "*COLUMNS*\n\twidth of a terminal that does not tell its own\n\n"
        "# FILES\n\n"
        "_DIR/table.csv_\n\tone row a case: parameters and results, as in *gridcross*(5)\n\n"
        "_DIR/study.h5_\n\tthe same, histories, the run file, and what made it\n\n"
        "_DIR/timing.csv_, _DIR/run.json_\n\twhat differs between equal runs: seconds, host, command, date\n\n"
        "# SEE ALSO\n\n*gridcross*(5), *gnuplot*(1)\n",
        out);
  return 0;
}

static void put_parameter(const struct gx_parameter *p, FILE *out)
{
  char facts[GX_FACTS_LENGTH];
  putc('*', out);
  put(p->path, out);
  fputs("* ", out);
  put(gx_facts_text(p, facts), out);
  fputs("\n\t", out);
  put(p->help, out);
  if (p->why) {
    fputs(". Default: ", out);
    put(p->why, out);
  }
  fputs("\n\n", out);
}

static void put_parameters(FILE *out)
{
  const char *section = "";
  for (const struct gx_parameter *p = gx_parameters; p < gx_parameters + GX_PARAMETERS; p++) {
    size_t length = strcspn(p->path, ".");
    if (strncmp(section, p->path, length + 1) != 0) fprintf(out, "## %.*s\n\n", (int)length, p->path);
    section = p->path;
    put_parameter(p, out);
  }
}

static int put_columns(FILE *out)
{
  struct gx_study none = {0};
  struct gx_table *table = gx_study_table(&none, NULL, true);
  if (!table) return -1;
  for (size_t c = 0; c < table->columns; c++) {
    const struct gx_column *column = &table->column[c];
    if (gx_parameter_find(column->name) >= 0) continue;
    fputs(c ? "++\n*" : "*", out);
    put(column->name, out);
    putc('*', out);
    if (*column->unit) fputs(", ", out);
    put(column->unit, out);
  }
  putc('\n', out);
  gx_table_free(table);
  return 0;
}

int gx_manual_reference(FILE *out)
{
  fprintf(out, "gridcross(5) \"gridcross %s\"\n\n", gx_build.version);
  fputs("# NAME\n\ngridcross - run files and tables\n\n"
        "# RUN FILES\n\n"
        "A run file is YAML, of sections that hold parameters:\n\n"
        "```\n"
        "title: Standard against moving mesh\n"
        "problem: {name: bar-neo-hookean, amplitude: 0.05}\n"
        "mesh:    {cells: [16, 32, 64], particles_per_cell: 4}\n"
        "method:  {space: [standard, moving-mesh], degree: [1, 2, 3]}\n"
        "time:    {cfl: 0.4, periods: 1}\n"
        "```\n\n"
        "_\\[a, b, c\\]_\n\ta list in place of a value is an axis; axes multiply, in the order of the file\n\n"
        "_{geom: \\[first, last, n\\]}_, _{lin: \\[first, last, n\\]}_\n\tn values in geometric or arithmetic progression\n\n"
        "_zip: \\[PATH, PATH\\]_\n\taxes of equal length that advance together\n\n"
        "_cases: \\[{PATH: VALUE, ...}, ...\\]_\n\tthe entries alone are run, each the rest of the file with these values "
        "replaced\n\n"
        "A parameter that does not apply to a case is null there; one that applies to no case is an error. Every error of a file "
        "is "
        "reported in one pass as _file:line:column: message_. *gridcross init* _PROBLEM_ writes a file with every parameter that "
        "applies, and *gridcross check* _FILE_ says what it expands to.\n\n"
        "# PARAMETERS\n\n",
        out);
  put_parameters(out);
  fputs("# TABLE\n\n"
        "One row a case, in _DIR/table.csv_ and by *--csv* and *--json*: its parameters by their paths, and the columns below. "
        "What is "
        "undefined is empty in CSV and null in JSON. The last two are in _DIR/timing.csv_ instead, and on standard output.\n\n",
        out);
  if (put_columns(out)) return -1;
  fputs("\n# SEE ALSO\n\n*gridcross*(1)\n", out);
  return 0;
}
