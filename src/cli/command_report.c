/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross report: studies as one page of HTML. */
#include "command.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <gridcross/report.h>

static const struct gx_option option[] = {
    {'o', "output", "FILE.html", "the page; default: report.html"},
    GX_COMMAND_WHERE,
    {0},
};

/* Directories of studies, owned. */
struct places {
  size_t count;
  char **directory;
};

static int add_place(struct places *places, const char *directory, const char *name)
{
  char **grown = realloc(places->directory, (places->count + 1) * sizeof *grown);
  if (!grown) return gx_command_no_memory();
  places->directory = grown;
  size_t room = strlen(directory) + strlen(name) + 2;
  char *path = malloc(room);
  if (!path) return gx_command_no_memory();
  snprintf(path, room, *name ? "%s/%s" : "%s%s", directory, name);
  places->directory[places->count++] = path;
  return GX_EXIT_DONE;
}

static bool is_study(const char *directory, const char *name)
{
  struct stat status;
  size_t room = strlen(directory) + strlen(name) + sizeof "//study.h5";
  char *path = malloc(room);
  if (path) snprintf(path, room, "%s/%s/study.h5", directory, name);
  bool found = path && !stat(path, &status);
  free(path);
  return found;
}

static int by_name(const struct dirent **a, const struct dirent **b)
{
  return strcmp((*a)->d_name, (*b)->d_name);
}

/* A study, or every study in a directory that is none, as `gridcross paper -o DIR` leaves them. */
static int add_places(struct places *places, const char *directory)
{
  struct dirent **entry = NULL;
  int count = is_study(directory, ".") ? 0 : scandir(directory, &entry, NULL, by_name), code = GX_EXIT_DONE;
  size_t before = places->count;
  for (int i = 0; i < count; i++) {
    const char *name = entry[i]->d_name;
    if (!code && *name != '.' && is_study(directory, name)) code = add_place(places, directory, name);
    free(entry[i]);
  }
  free(entry);
  return code || places->count > before ? code : add_place(places, directory, "");
}

static int write_report(const struct gx_options *options, const char *output)
{
  struct gx_command_studies studies;
  int code = gx_command_studies_read(&studies, options, options->operands);
  const struct gx_report report = {
      .studies = studies.count,
      .table = (const struct gx_table *const *)studies.table,
      .name = (const char *const *)studies.name,
      .directory = options->operand,
  };
  if (!code && gx_report_write(&report, output, stderr)) code = GX_EXIT_USAGE;
  if (!code) fprintf(stderr, "report: %s\n", output);
  gx_command_studies_free(&studies);
  return code;
}

static int run(const struct gx_options *options)
{
  const char *given = gx_options_value(options, "output");
  struct places places = {0};
  int code = GX_EXIT_DONE;
  if (given && !*given) {
    fputs("gridcross report: -o names no file\n", stderr);
    return GX_EXIT_USAGE;
  }
  for (size_t o = 0; o < options->operands && !code; o++) code = add_places(&places, options->operand[o]);
  struct gx_options all = *options; /* with every study as an operand */
  all.operand = calloc(places.count + 1, sizeof *all.operand);
  all.operands = places.count;
  for (size_t i = 0; all.operand && i < places.count; i++) all.operand[i] = places.directory[i];
  if (!code) code = all.operand ? write_report(&all, given ? given : "report.html") : gx_command_no_memory();
  for (size_t i = 0; i < places.count; i++) free(places.directory[i]);
  free(places.directory);
  free(all.operand);
  return code;
}

static const struct gx_example example[] = {
    {"gridcross report quickstart.study", "report.html, for any browser"},
    {"gridcross report a.study b.study --where mesh.cells=64 -o ab.html", "two studies side by side, some of their cases"},
    {"gridcross paper steffen2010 -o items && gridcross report items -o steffen2010.html", "a paper beside ours"},
    {0},
};

const struct gx_command gx_command_report = {
    .name = "report",
    .operands = "DIR...",
    .least = 1,
    .most = -1,
    .help = "Write studies, or those within directories, as one page of HTML that loads nothing: tables that sort, figures that "
            "zoom, "
            "particles crossing cells (of output.snapshots), energies (output.histories), spectra, error budget, run files, "
            "provenance; papers beside the print.",
    .option = option,
    .example = example,
    .run = run,
};
