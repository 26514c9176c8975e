/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress on standard error: one line that is renewed on a terminal; elsewhere a plain line now and then, of long runs alone. */
#ifndef GRIDCROSS_CLI_PROGRESS_H
#define GRIDCROSS_CLI_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

enum { GX_PROGRESS_ROOM = 160 };

struct gx_progress_line {
  bool quiet, terminal;
  double start, shown; /* s: of the beginning, of the last line */
  size_t tenth;        /* of the cases, done when the last line was shown */
  char what[128];      /* before the counts; "": nothing */
};

/* quiet: says nothing at all. what: borrowed no longer than the call. */
void gx_progress_begin(struct gx_progress_line *line, bool quiet, const char *what);
/* A gx_progress.done with such a line as its context. */
void gx_progress_done(void *line, size_t done, size_t total);
/* Leaves the terminal's line empty, so that what follows starts there. */
void gx_progress_end(struct gx_progress_line *line);
/* "12 of 40 cases, 30 %, about 2 min 10 s left", from seconds since the beginning. */
void gx_progress_text(const struct gx_progress_line *line, double seconds, size_t done, size_t total,
                      char text[GX_PROGRESS_ROOM]);
/* Whether a plain line is due, `seconds` after the beginning: another tenth of the cases and 10 s after the last line, or 30 s. */
bool gx_progress_due(const struct gx_progress_line *line, double seconds, size_t done, size_t total);

#endif
