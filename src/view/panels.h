/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures from snapshots: the cases that have some, and panels for them. */
#ifndef GRIDCROSS_VIEW_PANELS_H
#define GRIDCROSS_VIEW_PANELS_H

#include "sketch.h"

enum { GX_PANELS_MOST = 12 };

/* A case to be drawn. */
struct gx_panels_case {
  const char *directory, *id;   /* borrowed */
  size_t row;                   /* of the pivot's table */
  size_t line_column, line_row; /* of the pivot */
};

/* Cases that have snapshots, at most `most` of them; others are counted as left out. cases: owned by the caller. Returns how many, -1
 * after a message. */
long gx_panels_choose(struct gx_sketch *sketch, size_t most, struct gx_panels_case **cases, FILE *errors);
/* Label of a case, and how it ended where that is not well; owned by the caller, NULL when memory runs out. */
char *gx_panels_title(const struct gx_sketch *sketch, const struct gx_panels_case *one);

#endif
