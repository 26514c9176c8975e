/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The errors of a run file, gathered in one pass and printed in order of place. */
#include "errors.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 1000, MESSAGE = 512 };

struct gx_error {
  struct gx_place place;
  size_t order;
  char message[MESSAGE];
};

void gx_errors_add(struct gx_errors *errors, struct gx_place place, const char *format, ...)
{
  if (gx_errors_full(errors)) return;
  if (errors->count == errors->room) {
    size_t room = errors->room ? 2 * errors->room : 8;
    struct gx_error *more = realloc(errors->error, room * sizeof *more);
    if (!more) {
      errors->out_of_memory = true;
      return;
    }
    errors->error = more;
    errors->room = room;
  }
  struct gx_error *error = &errors->error[errors->count];
  *error = (struct gx_error){.place = place, .order = errors->count};
  errors->count++;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(error->message, sizeof error->message, format, arguments);
  va_end(arguments);
}

bool gx_errors_full(const struct gx_errors *errors)
{
  return errors->count >= MOST || errors->out_of_memory;
}

static int compare(const void *left, const void *right)
{
  const struct gx_error *a = left, *b = right;
  if (a->place.set != b->place.set) return a->place.set < b->place.set ? -1 : 1;
  if (a->place.line != b->place.line) return a->place.line < b->place.line ? -1 : 1;
  if (a->place.column != b->place.column) return a->place.column < b->place.column ? -1 : 1;
  return a->order < b->order ? -1 : 1;
}

/* One line, whatever the argument holds. */
static void print_set(FILE *out, const char *set, const char *message)
{
  fputs("--set ", out);
  for (; *set; set++) fputc((unsigned char)*set < 0x20 || *set == 0x7F ? ' ' : *set, out);
  fprintf(out, ": %s\n", message);
}

void gx_errors_print(struct gx_errors *errors, const char *path, const char *const *set, FILE *out)
{
  if (errors->count) qsort(errors->error, errors->count, sizeof *errors->error, compare);
  for (size_t i = 0; i < errors->count; i++) {
    const struct gx_error *error = &errors->error[i];
    if (error->place.set)
      print_set(out, set[error->place.set - 1], error->message);
    else if (error->place.line)
      fprintf(out, "%s:%d:%d: %s\n", path, error->place.line, error->place.column, error->message);
    else
      fprintf(out, "%s: %s\n", path, error->message);
  }
  if (errors->out_of_memory)
    fprintf(out, "%s: out of memory\n", path);
  else if (gx_errors_full(errors))
    fprintf(out, "%s: too many errors; the rest of the file was not read\n", path);
}

void gx_errors_free(struct gx_errors *errors)
{
  free(errors->error);
  *errors = (struct gx_errors){0};
}

struct gx_quoted gx_errors_quote(const char *text)
{
  enum { SHOWN = 60 };
  struct gx_quoted quoted;
  size_t length = 0;
  quoted.text[length++] = '\'';
  for (size_t i = 0; text[i]; i++) {
    unsigned char c = (unsigned char)text[i];
    bool starts_character = (c & 0xC0) != 0x80; /* UTF-8 */
    if ((starts_character && length >= SHOWN) || length >= SHOWN + 4) {
      length += (size_t)sprintf(quoted.text + length, "...");
      break;
    }
    if (c < 0x20 || c == 0x7F)
      length += (size_t)sprintf(quoted.text + length, "\\x%02x", (unsigned)c);
    else
      quoted.text[length++] = (char)c;
  }
  quoted.text[length++] = '\'';
  quoted.text[length] = '\0';
  return quoted;
}
