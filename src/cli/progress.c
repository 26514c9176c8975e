/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far a run is, and how long it will take. */
#include "progress.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

#include "terminal.h"

static const double renewed = 0.1, tenths_apart = 10, most_apart = 30; /* s between lines */

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* 5 s, 2 min 10 s, 3 h 20 min */
static void put_span(double seconds, char text[32])
{
  if (seconds < 59.5)
    snprintf(text, 32, "%.0f s", seconds);
  else if (seconds < 3600)
    snprintf(text, 32, "%d min %d s", (int)seconds / 60, (int)seconds % 60);
  else
    snprintf(text, 32, "%.0f h %.0f min", floor(seconds / 3600), floor(fmod(seconds, 3600) / 60));
}

void gx_progress_text(const struct gx_progress_line *line, double seconds, size_t done, size_t total, char text[GX_PROGRESS_ROOM])
{
  char left[32];
  double share = total ? (double)done / (double)total : 1;
  put_span(done ? seconds / share - seconds : 0, left);
  int used = snprintf(text, GX_PROGRESS_ROOM, "%s%s%zu of %zu cases, %.0f %%", line->what, *line->what ? ": " : "", done, total,
                      100 * share);
  if (done && done < total) snprintf(text + used, GX_PROGRESS_ROOM - (size_t)used, ", about %s left", left);
}

bool gx_progress_due(const struct gx_progress_line *line, double seconds, size_t done, size_t total)
{
  double since = seconds - (line->shown - line->start);
  return done < total && (since >= most_apart || (since >= tenths_apart && 10 * done / total > line->tenth));
}

void gx_progress_begin(struct gx_progress_line *line, bool quiet, const char *what)
{
  *line = (struct gx_progress_line){.quiet = quiet, .terminal = gx_terminal_is(stderr), .start = now()};
  line->shown = line->start;
  snprintf(line->what, sizeof line->what, "%s", what);
}

void gx_progress_done(void *context, size_t done, size_t total)
{
  struct gx_progress_line *line = context;
  double time = now();
  bool due = line->terminal ? time - line->shown >= renewed : gx_progress_due(line, time - line->start, done, total);
  if (line->quiet || !due) return;
  char text[GX_PROGRESS_ROOM];
  gx_progress_text(line, time - line->start, done, total, text);
  fprintf(stderr, line->terminal ? "\r\033[K%s" : "%s\n", text);
  fflush(stderr);
  line->shown = time;
  line->tenth = total ? 10 * done / total : 10;
}

void gx_progress_end(struct gx_progress_line *line)
{
  if (!line->terminal || line->shown == line->start) return; /* nothing was shown */
  fputs("\r\033[K", stderr);
  fflush(stderr);
}
