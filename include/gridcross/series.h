/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading the snapshots of a case back, from a study directory that gx_recorder wrote into. SI units. */
#ifndef GRIDCROSS_SERIES_H
#define GRIDCROSS_SERIES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include <gridcross/particles.h>

enum gx_series_set { GX_SERIES_PARTICLES, GX_SERIES_VERTICES, GX_SERIES_SETS };

/* The start, every n-th step and the last: as far as the case came. */
struct gx_series {
  int dim;
  size_t count; /* snapshots */
  double *step; /* [count] number of steps taken, ascending */
  double *time; /* [count] s */
  double dt;    /* s */
  size_t particles;
  size_t vertices[GX_MAX_DIM]; /* of the grid, per direction, first fastest; zeros: no grid. The domain is [0, 1] in each. */
  bool moving;                 /* vertices move by their displacement */
  struct gx_series_file *file; /* open */
};

/* Those of a case; NULL after a message, also where it has none. Freed by gx_series_close. */
struct gx_series *gx_series_open(const char *directory, const char *id, FILE *errors);
void gx_series_close(struct gx_series *series);

/* A component of a record of snapshot i, owned by the caller: [particles], or [product of vertices]; NULL after a message.
 * Records are those of gx_snapshot (<gridcross/snapshot.h>): of particles "position", "displacement", "velocity", "cauchy_stress",
 * "displacement_error" (where known) ...; of vertices "velocity", "density" .... Components of vectors 0, 1, 2, of tensors row-major,
 * of scalars 0. */
double *gx_series_read(const struct gx_series *series, size_t i, enum gx_series_set set, const char *record, int component,
                       FILE *errors);
/* Whether the snapshots have that record. */
bool gx_series_has(const struct gx_series *series, enum gx_series_set set, const char *record);
/* s: the time at which a record of snapshot i holds, less that of the snapshot: velocities of staggered clocks are half a step behind.
 * 0: no such record. */
double gx_series_offset(const struct gx_series *series, size_t i, enum gx_series_set set, const char *record);

#endif
