/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands as tables of options: one table drives parsing, messages and help. */
#ifndef GRIDCROSS_CLI_OPTIONS_H
#define GRIDCROSS_CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { GX_EXIT_DONE = 0, GX_EXIT_FAILED = 1, GX_EXIT_USAGE = 2 };

struct gx_option {
  char letter;          /* 0: none */
  const char *name;     /* without dashes */
  const char *argument; /* NULL: a flag */
  const char *help;
};

struct gx_options;

struct gx_example {
  const char *line; /* for a shell */
  const char *what; /* it does */
};

struct gx_command {
  const char *name;
  const char *operands; /* as usage prints them */
  int least, most;      /* operands; most < 0: any number */
  const char *help;
  const struct gx_example *example;   /* ended by {0} */
  const struct gx_option *option;     /* ended by {0} */
  void (*more)(int width, FILE *out); /* what help says beyond them, in lines of so many characters; NULL: nothing */
  int (*run)(const struct gx_options *options);
};

struct gx_given {
  const struct gx_option *option;
  const char *value; /* borrowed; "" for a flag */
};

struct gx_options {
  const struct gx_command *command;
  int argc;
  char **argv; /* borrowed: the whole command line */
  size_t operands;
  const char **operand; /* owned */
  size_t count;
  struct gx_given *given; /* owned */
  bool help;              /* -h or --help: nothing else was looked at */
};

/* Parses argv from argv[2]. Returns 0, or an exit code after a message to `errors`. */
int gx_options_parse(struct gx_options *options, const struct gx_command *command, int argc, char **argv, FILE *errors);
void gx_options_free(struct gx_options *options);
/* Value of the last such option; NULL: not given. */
const char *gx_options_value(const struct gx_options *options, const char *name);
/* Values of every such option. value: [options->count]. Returns how many. */
size_t gx_options_values(const struct gx_options *options, const char *name, const char **value);
/* Usage, operands, options and examples of a command, in lines of so many characters. */
void gx_options_help(const struct gx_command *command, int width, FILE *out);
/* -h, --help: every command has it. */
extern const struct gx_option gx_options_help_option;
/* The command line as a shell would take it; owned by the caller, NULL when memory runs out. */
char *gx_options_line(const struct gx_options *options);

#endif
