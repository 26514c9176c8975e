/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A system may take longer to say how much processor time was used than a sample takes, or all steps of a brief run, and slows down what
 * comes after. Those are timed by the clock on the wall, unless threads share their work. */
#include "stopwatch.h"

#include <math.h>
#include <time.h>

#include "../core/team.h"

enum { BRIEF = 1000 /* particle-steps: microseconds, in slow spaces tens of them */, FIRST_SAMPLES = 16 };

static double read_clock(clockid_t clock)
{
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

struct gx_stopwatch gx_stopwatch_of(const struct gx_team *team, double particle_steps)
{
  return (struct gx_stopwatch){.team = team, .brief = !team && particle_steps < BRIEF};
}

/* Of processor time that this thread and its team have worked: other cases, other programs and waiting for each other do not
 * count. */
double gx_stopwatch_now(const struct gx_stopwatch *watch)
{
  return watch->brief ? read_clock(CLOCK_MONOTONIC) : read_clock(CLOCK_THREAD_CPUTIME_ID) + gx_team_seconds(watch->team);
}

void gx_stopwatch_begin(struct gx_stopwatch *watch)
{
  watch->began = gx_stopwatch_now(watch);
}

void gx_stopwatch_observed(struct gx_stopwatch *watch, double since)
{
  watch->observing += gx_stopwatch_now(watch) - since;
}

static double sample_clock(const struct gx_stopwatch *watch, bool first)
{
  return first || watch->team ? gx_stopwatch_now(watch) : read_clock(CLOCK_MONOTONIC);
}

/* After the first samples, which also pay for memory that is touched for the first time, the clock is read at some only. */
struct gx_stopwatch_sample gx_stopwatch_sample_begin(struct gx_stopwatch *watch)
{
  struct gx_stopwatch_sample sample = {.first = watch->samples < FIRST_SAMPLES};
  sample.timed = sample.first || fmod(watch->samples, FIRST_SAMPLES) == 0;
  watch->samples++;
  if (sample.timed && !sample.first) sample.reading = sample_clock(watch, false);
  if (sample.timed) sample.before = sample_clock(watch, sample.first);
  return sample;
}

/* One that took several times the least has been interrupted; one that took no time, between the two readings before it. */
void gx_stopwatch_sample_end(struct gx_stopwatch *watch, const struct gx_stopwatch_sample *sample)
{
  if (!sample->timed) return;
  const double spent = sample_clock(watch, sample->first) - sample->before;
  const double seconds = sample->first ? spent : spent - (sample->before - sample->reading);
  if (sample->first) watch->observing += seconds;
  if (sample->first || !(seconds > 0)) return;
  if (watch->timed == 0 || seconds < watch->least_seconds) watch->least_seconds = seconds;
  if (seconds > 4 * watch->least_seconds) return;
  watch->timed_seconds += seconds;
  watch->timed++;
}

double gx_stopwatch_seconds(const struct gx_stopwatch *watch)
{
  const double estimated = watch->timed > 0 ? watch->timed_seconds * (watch->samples - FIRST_SAMPLES) / watch->timed : 0;
  const double spent = gx_stopwatch_now(watch) - watch->began - (watch->observing + estimated);
  return spent > 0 ? spent : NAN;
}

void gx_stopwatch_image(struct gx_stopwatch *watch, struct gx_image *image)
{
  double spent = gx_stopwatch_now(watch) - watch->began;
  GX_IMAGE(image, watch->samples);
  GX_IMAGE(image, watch->timed);
  GX_IMAGE(image, watch->timed_seconds);
  GX_IMAGE(image, watch->least_seconds);
  GX_IMAGE(image, watch->observing);
  GX_IMAGE(image, spent);
  if (image->loading) watch->began = gx_stopwatch_now(watch) - spent;
}
