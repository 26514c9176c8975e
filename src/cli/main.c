/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program: finds the command and runs it. Results go to standard output, everything else to standard error. */
#include <errno.h>
#include <string.h>

#include <gridcross/build.h>
#include <gridcross/status.h>

#include "../core/nearest.h"
#include "command.h"

static const struct gx_command *const commands[] = {&gx_command_run,
                                                    &gx_command_check,
                                                    &gx_command_init,
                                                    &gx_command_compare,
                                                    &gx_command_plot,
                                                    &gx_command_spectrum,
                                                    &gx_command_balance,
                                                    &gx_command_advise,
                                                    &gx_command_paper,
                                                    &gx_command_list,
                                                    NULL};

static void print_help(FILE *out)
{
  fputs("usage: gridcross COMMAND [OPTION]... [ARGUMENT]...\n\n"
        "Compare material point methods on equal terms.\n\n",
        out);
  for (const struct gx_command *const *c = commands; *c; c++) fprintf(out, "  %-10s%s\n", (*c)->name, (*c)->help);
  fputs("\n"
        "  gridcross COMMAND --help    options of a command\n"
        "  gridcross --version         version and libraries\n",
        out);
}

static void print_version(void)
{
  printf("gridcross %s (revision %s)\n"
         "compiler %s\n"
         "GSL %s, FFTW %s, HDF5 %s, libyaml %s\n",
         gx_build.version, gx_build.git_revision, gx_build.compiler, gx_build.gsl, gx_build.fftw, gx_build.hdf5, gx_build.yaml);
}

static const struct gx_command *find_command(const char *name)
{
  struct gx_nearest near = {.word = name + strspn(name, "-")};
  for (const struct gx_command *const *c = commands; *c; c++) {
    if (!strcmp(name, (*c)->name)) return *c;
    gx_nearest_try(&near, (*c)->name);
  }
  gx_nearest_try(&near, "help");
  gx_nearest_try(&near, "version");
  bool option = *near.best && (!strcmp(near.best, "help") || !strcmp(near.best, "version"));
  fprintf(stderr, "gridcross: no command '%s'", name);
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
  const struct gx_command *command = find_command(argv[1]);
  if (!command) return GX_EXIT_USAGE;
  struct gx_options options;
  int code = gx_options_parse(&options, command, argc, argv, stderr);
  if (options.help)
    gx_options_help(command, stdout);
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
