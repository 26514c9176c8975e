/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The candidate that a misspelt word most likely means. */
#ifndef GRIDCROSS_CORE_NEAREST_H
#define GRIDCROSS_CORE_NEAREST_H

enum { GX_NEAREST_LENGTH = 49 };

/* Starts as {.word = ...}. */
struct gx_nearest {
  const char *word;
  char best[GX_NEAREST_LENGTH]; /* "": no candidate is near */
  int distance;                 /* edits from word to best */
};

/* Takes candidate as best if it is near, and nearer than the best so far. */
void gx_nearest_try(struct gx_nearest *nearest, const char *candidate);

#endif
