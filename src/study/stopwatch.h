/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the steps of a run took, without its measures. */
#ifndef GRIDCROSS_STUDY_STOPWATCH_H
#define GRIDCROSS_STUDY_STOPWATCH_H

#include <stdbool.h>

#include <gridcross/image.h>

struct gx_team;

struct gx_stopwatch {
  const struct gx_team *team; /* borrowed; NULL: one thread */
  bool brief;                 /* the steps take less than it may take to read the processor's clock */
  double samples, timed;      /* taken; of those after the first few, whose cost was read from the clock */
  double timed_seconds;       /* that these took */
  double least_seconds;       /* that one of them took */
  double observing;           /* s of the first few samples, and of all else that observes */
  double began;               /* s, when the steps did; earlier for those taken before a checkpoint */
};

/* A sample that is taken. */
struct gx_stopwatch_sample {
  bool timed, first;      /* first: one of the first few */
  double reading, before; /* s */
};

/* Of a run of so many particle-steps. */
struct gx_stopwatch gx_stopwatch_of(const struct gx_team *team, double particle_steps);
/* The steps begin. */
void gx_stopwatch_begin(struct gx_stopwatch *watch);
/* A reading, s; what is observed since then is no step. */
double gx_stopwatch_now(const struct gx_stopwatch *watch);
void gx_stopwatch_observed(struct gx_stopwatch *watch, double since);
/* Just before and after a sample is measured. */
struct gx_stopwatch_sample gx_stopwatch_sample_begin(struct gx_stopwatch *watch);
void gx_stopwatch_sample_end(struct gx_stopwatch *watch, const struct gx_stopwatch_sample *sample);
/* s of the steps so far; NaN: lost in the noise of the measures. */
double gx_stopwatch_seconds(const struct gx_stopwatch *watch);
/* Between steps. */
void gx_stopwatch_image(struct gx_stopwatch *watch, struct gx_image *image);

#endif
