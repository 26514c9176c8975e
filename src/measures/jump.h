/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time-stepping jump errors of steffen2010 §5.2.2: what a step that crosses a cell edge in one goes astray from one that stops there. */
#ifndef GRIDCROSS_MEASURES_JUMP_H
#define GRIDCROSS_MEASURES_JUMP_H

#include <gridcross/space.h>

struct gx_jump {
  const struct gx_space *space; /* borrowed */
  const int *cells;             /* per direction, borrowed */
  double *before[GX_MAX_DIM];   /* [n] displacement at the last end of step, m */
  double *sum[GX_MAX_DIM];      /* [n] jumps of each particle so far, m */
  double step;                  /* m: the largest of the last step, along the direction crossed, with its sign; 0: no crossing */
  double last, estimate;        /* m: the same of the last step with a crossing, and its estimate; NaN: no crossing so far */
  double *block;
};

/* The space's particles are where the first step will start; its kind must have a field. NULL when memory runs out. */
struct gx_jump *gx_jump_create(const struct gx_space *space, const int *cells);
void gx_jump_free(struct gx_jump *jump);
void gx_jump_image(struct gx_jump *jump, struct gx_image *image);
/* After a step of dt that moved particles once, by the field that the nodes still hold. */
void gx_jump_step(struct gx_jump *jump, double dt);

#endif
