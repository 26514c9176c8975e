/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A quantity of particles at one time, from a case's snapshots. */
#ifndef GRIDCROSS_VIEW_SNAP_H
#define GRIDCROSS_VIEW_SNAP_H

#include <stdbool.h>
#include <stdio.h>

#include <gridcross/measure.h>

/* What `--y` names: displacement, velocity, stress (Cauchy), error, error.velocity, error.stress, each also by component: .x, .xy. Without
 * a component the length of a vector, the root of the sum of squares of a tensor; in 1-D the value with its sign. */
struct gx_snap_field {
  enum gx_quantity quantity;
  bool error;
  int row, column; /* of the component, from 0; row < 0: none */
};

extern const char gx_snap_fields[]; /* for messages and help */

/* Returns 0, or -1 when there is no such field. */
int gx_snap_find(const char *name, struct gx_snap_field *field);

struct gx_snap {
  int dim;
  double time;     /* s, of the snapshot nearest to what was asked for */
  size_t n;        /* particles, in 3-D those of a slice */
  double *x[2];    /* [n] where they are, m; owned, as all below */
  double *value;   /* [n] */
  double *exact_x; /* [n] 1-D, where the exact solution is known and the field is no error: where they should be; else NULL */
  double *exact;   /* [n] and their exact value; else NULL */
  double spacing;  /* mean distance of particles, m */
  double slice;    /* 3-D: z of the slice at the start, m */
};

/* time: s, NaN: the last. Returns 0, or -1 after a message; to be freed in either case. */
int gx_snap_read(struct gx_snap *snap, const char *directory, const char *id, const struct gx_snap_field *field, double time,
                 FILE *errors);
void gx_snap_free(struct gx_snap *snap);

#endif
