/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross plot: figures of studies. */
#include "command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <gridcross/plot.h>
#include <gridcross/store.h>

#include "../core/nearest.h"
#include "../study/number.h"
#include "text.h"

static const struct gx_option option[] = {
    {'o', "output", "FIGURE", "the figure, ending in .svg, .png or .pdf; FIGURE.gp and FIGURE.csv stay beside it"},
    {0, "x", "COLUMN", "lines: parameter or result across; default: mesh.cells where it varies, else time.dt, time.cfl, ..."},
    {0, "y", "COLUMN", "what is drawn; each kind says below what there is, its default first"},
    {0, "by", "PATH",
     "one line a value, shown by its colour; as often as wanted; the other axes follow in the legend, but with --front"},
    {0, "time", "SECONDS", "field: of the snapshot nearest to this time; default: the last"},
    {0, "front", NULL, "lines: error against cost of every case, result.seconds or --x, and the front of the cheapest"},
    GX_COMMAND_WHERE,
    {0},
};

/* The kinds, for people. */
static void print_kinds(int width, FILE *out)
{
  enum { INDENT = 12 };
  fputs("kinds, the first where none is named:\n", out);
  for (const struct gx_plot_kind *const *k = gx_plot_family; *k; k++) {
    gx_text_print((*k)->help, fprintf(out, "  %-10s", (*k)->name), INDENT, width, out);
    if ((*k)->y) gx_text_print((*k)->y, fprintf(out, "%*s--y ", INDENT, ""), INDENT + 4, width, out);
    fprintf(out, "%*s%s\n", INDENT, "", (*k)->example);
  }
  putc('\n', out);
  gx_text_print(
      "Without gnuplot the figure is missing and the exit code 1, but FIGURE.gp and FIGURE.csv are written: gnuplot FIGURE.gp "
      "draws it elsewhere. Cases that failed are left out and counted in the figure; xt and field show them as far as they came.",
      0, 0, width, out);
}

/* A last operand that is no place at all was meant as a kind. */
static int check_kind(const char *name)
{
  struct stat status;
  struct gx_nearest near = {.word = name};
  if (!stat(name, &status) || strchr(name, '/')) return GX_EXIT_DONE;
  for (const struct gx_plot_kind *const *k = gx_plot_family; *k; k++) gx_nearest_try(&near, (*k)->name);
  fprintf(stderr, "gridcross plot: '%s' is neither a study nor a kind", name);
  if (*near.best) {
    fprintf(stderr, ": did you mean %s?\n", near.best);
    return GX_EXIT_USAGE;
  }
  fputs("; kinds are", stderr);
  for (const struct gx_plot_kind *const *k = gx_plot_family; *k; k++)
    fprintf(stderr, "%s %s", k == gx_plot_family ? "" : k[1] ? "," : " and", (*k)->name);
  putc('\n', stderr);
  return GX_EXIT_USAGE;
}

/* Whether the kind can do what the options ask for. */
static int check_options(const struct gx_options *options, const struct gx_plot_kind *kind)
{
  const char *time = gx_options_value(options, "time");
  if (!gx_options_value(options, "output"))
    fputs("gridcross plot: name the figure: -o FIGURE.svg, FIGURE.png or FIGURE.pdf\n", stderr);
  else if (kind->across && gx_options_value(options, "x"))
    fprintf(stderr, "gridcross plot: the kind %s is drawn against %s: leave out --x\n", kind->name, kind->across);
  else if (!kind->y && gx_options_value(options, "y"))
    fprintf(stderr, "gridcross plot: the kind %s draws one thing alone: leave out --y\n", kind->name);
  else if (!kind->at_time && time)
    fprintf(stderr, "gridcross plot: the kind %s is of no one time: leave out --time\n", kind->name);
  else if (time && gx_number_real(time, &(double){0}))
    fprintf(stderr, "gridcross plot: --time takes seconds, not '%s'\n", time);
  else if (!kind->front && gx_options_value(options, "front"))
    fprintf(stderr, "gridcross plot: the kind %s has no front: leave out %s or --front\n", kind->name, kind->name);
  else
    return GX_EXIT_DONE;
  return GX_EXIT_USAGE;
}

static int plot(const struct gx_options *options, const struct gx_plot_kind *kind, const struct gx_command_studies *studies,
                const char **by, size_t points, const struct gx_plot_point *point)
{
  char *title = studies->count == 1 ? gx_store_read_provenance(options->operand[0], "title", stderr) : NULL;
  if (studies->count == 1 && !title) return GX_EXIT_USAGE;
  double time = NAN;
  if (gx_options_value(options, "time")) gx_number_real(gx_options_value(options, "time"), &time);
  const struct gx_plot figure = {
      .studies = studies->count,
      .table = (const struct gx_table *const *)studies->table,
      .name = (const char *const *)studies->name,
      .directory = options->operand,
      .title = title ? title : "",
      .x = gx_options_value(options, "x"),
      .y = gx_options_value(options, "y"),
      .bys = gx_options_values(options, "by", by),
      .by = by,
      .points = points,
      .point = point,
      .time = time,
      .output = gx_options_value(options, "output"),
  };
  enum gx_plot_status status = (gx_options_value(options, "front") ? kind->front : kind->draw)(&figure, stderr);
  free(title);
  return status == GX_PLOT_DONE ? GX_EXIT_DONE : status == GX_PLOT_FAILED ? GX_EXIT_FAILED : GX_EXIT_USAGE;
}

int gx_command_plot_figure(const struct gx_options *options, size_t points, const struct gx_plot_point *point)
{
  const char *last = options->operand[options->operands - 1];
  const struct gx_plot_kind *kind =
      options->operands > 1 ? gx_plot_find(last) : NULL; /* a study of that name is written ./lines */
  if (check_options(options, kind ? kind : gx_plot_family[0])) return GX_EXIT_USAGE;
  if (options->operands > 1 && !kind && check_kind(last)) return GX_EXIT_USAGE;
  struct gx_command_studies studies;
  int code = gx_command_studies_read(&studies, options, options->operands - !!kind);
  const char **by = calloc(options->count + 1, sizeof *by);
  if (!by)
    code = gx_command_no_memory();
  else if (!code)
    code = plot(options, kind ? kind : gx_plot_family[0], &studies, by, points, point);
  gx_command_studies_free(&studies);
  free(by);
  return code;
}

static int run(const struct gx_options *options)
{
  return gx_command_plot_figure(options, 0, NULL);
}

static const struct gx_example example[] = {
    {"gridcross plot quickstart.study -o error.svg", "error against cells, both logarithmic"},
    {"gridcross plot quickstart.study --y result.energy.drift --by method.space -o drift.pdf", "one colour a space"},
    {"gridcross plot choice.study --front -o front.svg", "error against cost, and which cases are cheapest"},
    {"gridcross plot quickstart.study xt --where mesh.cells=16 -o xt.svg", "paths of particles over the edges of cells"},
    {0},
};

const struct gx_command gx_command_plot = {
    .name = "plot",
    .operands = "DIR... [KIND]",
    .least = 1,
    .most = -1,
    .help = "Draw a figure of studies by gnuplot: errors and other results as lines, histories, particles, errors by wavenumber.",
    .option = option,
    .more = print_kinds,
    .example = example,
    .run = run,
};
