/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parsing a command line by a command's table, and help from the same table. */
#include "options.h"

#include <stdlib.h>
#include <string.h>

#include "../core/nearest.h"
#include "text.h"

const struct gx_option gx_options_help_option = {'h', "help", NULL, "print this and end"};

static const struct gx_option *find_letter(const struct gx_command *command, char letter)
{
  if (letter == gx_options_help_option.letter) return &gx_options_help_option;
  for (const struct gx_option *o = command->option; o->name; o++)
    if (o->letter && o->letter == letter) return o;
  return NULL;
}

static const struct gx_option *find_name(const struct gx_command *command, const char *name, size_t length)
{
  if (strlen(gx_options_help_option.name) == length && !strncmp(gx_options_help_option.name, name, length))
    return &gx_options_help_option;
  for (const struct gx_option *o = command->option; o->name; o++)
    if (strlen(o->name) == length && !strncmp(o->name, name, length)) return o;
  return NULL;
}

static int usage_error(const struct gx_command *command, FILE *errors, const char *problem, const char *what)
{
  fprintf(errors, "gridcross %s: %s%s; see gridcross %s --help\n", command->name, problem, what, command->name);
  return GX_EXIT_USAGE;
}

static int unknown(const struct gx_command *command, const char *word, FILE *errors)
{
  struct gx_nearest near = {.word = word + strspn(word, "-")};
  for (const struct gx_option *o = command->option; o->name; o++) gx_nearest_try(&near, o->name);
  fprintf(errors, "gridcross %s: no option %s", command->name, word);
  if (*near.best) fprintf(errors, ": did you mean --%s?", near.best);
  fprintf(errors, "%s see gridcross %s --help\n", *near.best ? "" : ";", command->name);
  return GX_EXIT_USAGE;
}

static void give(struct gx_options *options, const struct gx_option *option, const char *value)
{
  if (option == &gx_options_help_option)
    options->help = true;
  else
    options->given[options->count++] = (struct gx_given){.option = option, .value = value};
}

/* --name, --name=value, --name value */
static int parse_long(struct gx_options *options, int *at, FILE *errors)
{
  const char *word = options->argv[*at], *name = word + 2, *equals = strchr(name, '=');
  const struct gx_option *option = find_name(options->command, name, equals ? (size_t)(equals - name) : strlen(name));
  if (!option) return unknown(options->command, word, errors);
  if (!option->argument && equals) return usage_error(options->command, errors, "an argument is not taken by ", word);
  const char *value = equals ? equals + 1 : "";
  if (option->argument && !equals) {
    if (*at + 1 >= options->argc) return usage_error(options->command, errors, "an argument is missing after ", word);
    value = options->argv[++*at];
  }
  give(options, option, value);
  return 0;
}

/* -q, -j4, -j 4, and several flags in one word */
static int parse_letters(struct gx_options *options, int *at, FILE *errors)
{
  const char *word = options->argv[*at];
  for (const char *c = word + 1; *c; c++) {
    const struct gx_option *option = find_letter(options->command, *c);
    if (!option) return unknown(options->command, word, errors);
    if (option->argument) {
      if (!c[1] && *at + 1 >= options->argc) return usage_error(options->command, errors, "an argument is missing after ", word);
      give(options, option, c[1] ? c + 1 : options->argv[++*at]);
      return 0;
    }
    give(options, option, "");
  }
  return 0;
}

int gx_options_parse(struct gx_options *options, const struct gx_command *command, int argc, char **argv, FILE *errors)
{
  *options = (struct gx_options){.command = command, .argc = argc, .argv = argv};
  options->operand = calloc((size_t)argc + 1, sizeof *options->operand);
  size_t letters = 0; /* one word may hold many flags */
  for (int i = 2; i < argc; i++) letters += strlen(argv[i]) + 1;
  options->given = calloc(letters + 1, sizeof *options->given);
  if (!options->operand || !options->given) {
    fputs("gridcross: out of memory\n", errors);
    return GX_EXIT_FAILED;
  }
  bool only_operands = false;
  for (int i = 2; i < argc; i++) {
    int failed = 0;
    if (only_operands || argv[i][0] != '-' || !argv[i][1])
      options->operand[options->operands++] = argv[i];
    else if (!strcmp(argv[i], "--"))
      only_operands = true;
    else if (argv[i][1] == '-')
      failed = parse_long(options, &i, errors);
    else
      failed = parse_letters(options, &i, errors);
    if (options->help) return 0;
    if (failed) return failed;
  }
  for (size_t i = 0; i < options->operands; i++)
    if (!*options->operand[i]) return usage_error(command, errors, "an argument is empty", "");
  if (options->operands < (size_t)command->least) return usage_error(command, errors, "missing ", command->operands);
  if (command->most >= 0 && options->operands > (size_t)command->most)
    return usage_error(command, errors, "too many arguments, from ", options->operand[command->most]);
  return 0;
}

void gx_options_free(struct gx_options *options)
{
  free(options->operand);
  free(options->given);
}

const char *gx_options_value(const struct gx_options *options, const char *name)
{
  for (size_t i = options->count; i-- > 0;)
    if (!strcmp(options->given[i].option->name, name)) return options->given[i].value;
  return NULL;
}

size_t gx_options_values(const struct gx_options *options, const char *name, const char **value)
{
  size_t count = 0;
  for (size_t i = 0; i < options->count; i++)
    if (!strcmp(options->given[i].option->name, name)) value[count++] = options->given[i].value;
  return count;
}

static void print_option(const struct gx_option *option, int width, FILE *out)
{
  enum { LEFT = 26 };
  char left[64];
  snprintf(left, sizeof left, "%s%.1s%s--%s%s%s", option->letter ? "-" : " ", option->letter ? &option->letter : " ",
           option->letter ? ", " : "  ", option->name, option->argument ? " " : "", option->argument ? option->argument : "");
  int at = fprintf(out, "  %-*s", LEFT, left);
  if (at > LEFT + 2) at = fprintf(out, "\n%*s", LEFT + 2, "") - 1;
  fputs("  ", out);
  gx_text_print(option->help, at + 2, at + 2, width, out);
}

void gx_options_help(const struct gx_command *command, int width, FILE *out)
{
  bool any = command->option->name;
  fprintf(out, "usage: gridcross %s%s%s%s\n\n", command->name, any ? " [OPTION]..." : "", *command->operands ? " " : "",
          command->operands);
  gx_text_print(command->help, 0, 0, width, out);
  putc('\n', out);
  for (const struct gx_option *o = command->option; o->name; o++) print_option(o, width, out);
  print_option(&gx_options_help_option, width, out);
  if (command->more) {
    putc('\n', out);
    command->more(width, out);
  }
  if (!command->example) return;
  fputs("\nexamples:\n", out);
  for (const struct gx_example *e = command->example; e->line; e++) {
    fprintf(out, "  %s\n", e->line);
    fputs("      ", out);
    gx_text_print(e->what, 6, 6, width, out);
  }
}

static char *quote(char *to, const char *word)
{
  bool plain = *word && !word[strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%")];
  if (!plain) *to++ = '\'';
  for (; *word; word++) {
    if (*word == '\'') to += sprintf(to, "'\\'");
    *to++ = *word;
  }
  if (!plain) *to++ = '\'';
  return to;
}

char *gx_options_line(const struct gx_options *options)
{
  size_t room = 1;
  for (int i = 0; i < options->argc; i++) room += 4 * strlen(options->argv[i]) + 3;
  char *line = malloc(room), *to = line;
  if (!line) return NULL;
  for (int i = 0; i < options->argc; i++) {
    if (i) *to++ = ' ';
    to = quote(to, options->argv[i]);
  }
  *to = '\0';
  return line;
}
