/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program: finds the command and runs it. Results go to standard output, everything else to standard error. */
#include <errno.h>
#include <string.h>

#include <gridcross/build.h>
#include <gridcross/status.h>

#include "../core/nearest.h"
#include "command.h"
#include "completion.h"
#include "manual.h"
#include "ranks.h"
#include "text.h"

static void print_help(FILE *out)
{
  int width = gx_text_width();
  fputs("usage: gridcross COMMAND [OPTION]... [ARGUMENT]...\n\n"
        "Compare material point methods on equal terms.\n\n",
        out);
  for (const struct gx_command *const *c = gx_command_family; *c; c++)
    gx_text_print((*c)->help, fprintf(out, "  %-10s", (*c)->name), 12, width, out);
  fputs("\n"
        "  gridcross COMMAND --help    options of a command, and examples\n"
        "  gridcross --version         version, compiler and libraries\n"
        "  gridcross --completion      for bash: source <(gridcross --completion)\n"
        "  gridcross --manual [1|5]    the page of the program or of run files, for scdoc\n"
        "\n"
        "to begin:\n"
        "  gridcross init bar-neo-hookean > my.yaml    a run file to edit\n"
        "  gridcross run my.yaml                       its cases, into my.study\n"
        "  gridcross compare my.study                  side by side\n",
        out);
}

static void print_version(void)
{
  printf("gridcross %s (revision %s)\n"
         "compiler %s, flags %s\n"
         "GSL %s, FFTW %s, HDF5 %s, libyaml %s, %s\n",
         gx_build.version, gx_build.git_revision, gx_build.compiler, gx_build.flags, gx_build.gsl, gx_build.fftw, gx_build.hdf5,
         gx_build.yaml, gx_ranks_version());
}

static const struct gx_command *find_command(const char *name)
{
  struct gx_nearest near = {.word = name + strspn(name, "-")};
  for (const struct gx_command *const *c = gx_command_family; *c; c++) {
    if (!strcmp(name, (*c)->name)) return *c;
    gx_nearest_try(&near, (*c)->name);
  }
  static const char *const other[] = {"help", "version", "completion", "manual"};
  bool option = false;
  for (size_t i = 0; i < sizeof other / sizeof *other; i++) gx_nearest_try(&near, other[i]);
  for (size_t i = 0; i < sizeof other / sizeof *other; i++) option = option || !strcmp(near.best, other[i]);
  fprintf(stderr, "gridcross: no %s '%s'", *name == '-' ? "option" : "command", name);
  if (*near.best) fprintf(stderr, ": did you mean %s%s?", option ? "--" : "", near.best);
  fputs(*near.best ? "\n" : "; see gridcross --help\n", stderr);
  return NULL;
}

static int run_command(int argc, char **argv)
{
  if (argc < 2) {
    print_help(stderr);
    return GX_EXIT_USAGE;
  }
  if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h")) {
    print_help(stdout);
    return GX_EXIT_DONE;
  }
  if (!strcmp(argv[1], "--version")) {
    print_version();
    return GX_EXIT_DONE;
  }
  if (!strcmp(argv[1], "--completion")) return gx_completion_print(stdout) ? gx_command_no_memory() : GX_EXIT_DONE;
  if (!strcmp(argv[1], "--manual")) {
    bool reference = argc > 2 && !strcmp(argv[2], "5");
    if (argc > 2 && !reference && strcmp(argv[2], "1") != 0) {
      fprintf(stderr, "gridcross: --manual takes 1, the program, or 5, run files, not '%s'\n", argv[2]);
      return GX_EXIT_USAGE;
    }
    return (reference ? gx_manual_reference : gx_manual_program)(stdout) ? gx_command_no_memory() : GX_EXIT_DONE;
  }
  bool help = !strcmp(argv[1], "help") && argc == 3;
  const struct gx_command *command = find_command(argv[help ? 2 : 1]);
  if (!command) return GX_EXIT_USAGE;
  if (help) {
    gx_options_help(command, gx_text_width(), stdout);
    return GX_EXIT_DONE;
  }
  struct gx_options options;
  int code = gx_options_parse(&options, command, argc, argv, stderr);
  if (options.help)
    gx_options_help(command, gx_text_width(), stdout);
  else if (!code)
    code = command->run(&options);
  gx_options_free(&options);
  return code;
}

int main(int argc, char **argv)
{
  gx_status_quiet_gsl();
  int code = run_command(argc, argv);
  /* A full disk or a closed pipe shows only when the last bytes leave. */
  if (fflush(stdout) || ferror(stdout)) {
    fprintf(stderr, "gridcross: cannot write to standard output: %s\n", strerror(errno));
    if (code == GX_EXIT_DONE) code = GX_EXIT_FAILED;
  }
  return code;
}
