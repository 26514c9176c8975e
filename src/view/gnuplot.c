/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gnuplot 5. Text from outside is quoted with what gnuplot would substitute as octal numbers; folders are named from ./ on, so that none
 * reads as an option. */
#include "gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../core/utf8.h"

/* In double quotes: single ones would be simpler, were it not that gnuplot 5.4 ends '''' after two. */
void gx_gnuplot_quote(const char *text, size_t length, FILE *out)
{
  for (size_t i = 0; i < length; i++) fprintf(out, strchr("\"\\`@", text[i]) ? "\\%03o" : "%c", (unsigned char)text[i]);
}

void gx_gnuplot_part(const char *text, size_t bytes, FILE *out)
{
  const char *begin = text, *end = text + bytes;
  unsigned long point;
  for (int length; text < end; text += length ? length : 1) {
    length = gx_utf8_length(text, &point);
    if (length == 0) {
      putc('?', out);
    } else if ((unsigned char)*text < ' ' || *text == 0x7F) {
      putc(' ', out);
    } else {
      if (*text == '>' && text - begin >= 2 && !strncmp(text - 2, "]]", 2))
        putc(' ', out); /* ]]> may not be in SVG: gnuplot leaves it */
      gx_gnuplot_quote(text, (size_t)length, out);
    }
  }
}

void gx_gnuplot_text(const char *text, FILE *out)
{
  gx_gnuplot_part(text, strlen(text), out);
}

/* The environment in universal time, so that dates in an image have one length. [..., NULL], owned by the caller but for its texts. */
static char **choose_environment(char *zone)
{
  extern char **environ;
  size_t count = 0, kept = 0;
  while (environ[count]) count++;
  char **environment = calloc(count + 2, sizeof *environment);
  for (size_t i = 0; environment && i < count; i++)
    if (strncmp(environ[i], "TZ=", 3) != 0) environment[kept++] = environ[i];
  if (environment) environment[kept] = zone;
  return environment;
}

/* Without a shell. -d: nobody's own settings change the figure. */
static int spawn(char *const *arguments, int *status)
{
  char zone[] = "TZ=UTC0", **environment = choose_environment(zone);
  posix_spawn_file_actions_t actions;
  pid_t child;
  int error = environment ? posix_spawn_file_actions_init(&actions) : ENOMEM;
  if (!error) {
    error = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!error) error = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (!error) error = posix_spawnp(&child, arguments[0], &actions, NULL, arguments, environment);
    posix_spawn_file_actions_destroy(&actions);
  }
  free(environment);
  while (!error && waitpid(child, status, 0) < 0)
    if (errno != EINTR) error = errno;
  return error;
}

/* cd "<folder>", owned by the caller; a leading ~ would be a home. */
static char *change_folder(const char *folder)
{
  char *command = NULL;
  size_t length;
  FILE *out = open_memstream(&command, &length);
  if (!out) return NULL;
  fputs(*folder == '/' ? "cd \"" : "cd \"./", out);
  gx_gnuplot_quote(folder, strlen(folder), out);
  putc('"', out);
  if (!fclose(out)) return command;
  free(command);
  return NULL;
}

int gx_gnuplot_run(const char *folder, const char *script, FILE *errors)
{
  char gnuplot[] = "gnuplot", plain[] = "-d", execute[] = "-e", *change = change_folder(folder), *name = strdup(script);
  char *const arguments[] = {gnuplot, plain, execute, change, name, NULL};
  int status = 0, error = change && name ? spawn(arguments, &status) : ENOMEM;
  free(change);
  free(name);
  if (error == ENOENT)
    fputs("gridcross: gnuplot is not installed: apt-get install gnuplot-nox, then plot again", errors);
  else if (error)
    fprintf(errors, "gridcross: cannot run gnuplot: %s", strerror(error));
  else if (!WIFEXITED(status) || WEXITSTATUS(status))
    fputs("gridcross: gnuplot could not draw the figure", errors);
  else
    return 0;
  return -1;
}

bool gx_gnuplot_is_whole(const char *image)
{
  static const char *const last[] = {"</svg>", "IEND", "%%EOF"}; /* in the last bytes of SVG, PNG and PDF */
  char tail[16] = "";
  FILE *file = fopen(image, "rb");
  size_t length = file && !fseek(file, -(long)sizeof tail, SEEK_END) ? fread(tail, 1, sizeof tail, file) : 0;
  if (file) fclose(file);
  for (size_t i = 0; i < sizeof last / sizeof *last; i++)
    for (size_t at = 0; at + strlen(last[i]) <= length; at++)
      if (!memcmp(tail + at, last[i], strlen(last[i]))) return true;
  return false;
}

int gx_gnuplot_undate(const char *pdf)
{
  static const char entry[] = "/CreationDate (D:";
  const size_t length = strlen(entry);
  FILE *file = fopen(pdf, "r+b");
  if (!file) return -1;
  size_t met = 0;
  int c;
  while (met < length && (c = getc(file)) != EOF) met = c == entry[met] ? met + 1 : c == entry[0];
  if (met == length && !fseek(file, -(long)length, SEEK_CUR)) {
    long start = ftell(file), end = start;
    while ((c = getc(file)) != EOF && c != ')') end++;
    int failed = c == EOF || fseek(file, start, SEEK_SET);
    for (; start <= end && !failed; start++) failed = putc(' ', file) == EOF;
  }
  int failed = ferror(file);
  return fclose(file) || failed ? -1 : 0;
}
