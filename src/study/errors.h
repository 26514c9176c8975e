/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The errors of a run file, gathered in one pass and printed in order of place. */
#ifndef GRIDCROSS_STUDY_ERRORS_H
#define GRIDCROSS_STUDY_ERRORS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct gx_place {
  int set;          /* 0: the run file; i: the i-th --set, from 1 */
  int line, column; /* in the run file, from 1; line 0: the file as a whole */
};

struct gx_error;

/* Starts as {0}. */
struct gx_errors {
  struct gx_error *error; /* owned */
  size_t count, room;
  bool out_of_memory;
};

void gx_errors_add(struct gx_errors *errors, struct gx_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* So many that reading on would help nobody. */
bool gx_errors_full(const struct gx_errors *errors);
/* One line an error. set: the --set strings. */
void gx_errors_print(struct gx_errors *errors, const char *path, const char *const *set, FILE *out);
void gx_errors_free(struct gx_errors *errors);

struct gx_quoted {
  char text[96];
};

/* Text of the file in single quotes, fit for a terminal: shortened, control characters escaped. */
struct gx_quoted gx_errors_quote(const char *text);

#endif
