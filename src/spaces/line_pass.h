/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The passes of a line over its particles and nodes, compiled for several widths of vectors; equal bits. */
#ifndef GRIDCROSS_SPACES_LINE_PASS_H
#define GRIDCROSS_SPACES_LINE_PASS_H

#include <stdbool.h>
#include <stddef.h>

#include <gridcross/basis.h>

enum {
  GX_LINE_BLOCK = 8,  /* particles that follow each other and are taken together */
  GX_LINE_LANES = 8,  /* blocks from distant parts of the bar that are scattered in turn */
  GX_LINE_RECORD = 4, /* doubles a node: mass, momentum, force, and one for alignment */
  GX_LINE_WINDOW = 16 /* nodes that a block looks up at once; so many may be read past the last */
};

/* Arrays of n particles may be read, and those of `motion` written, up to the end of their last block. */
struct gx_line_fields {
  size_t n, stored;
  int support;
  const struct gx_axis *axis;
  const struct gx_basis *basis;
  int *first;                             /* [n] lowest function met */
  double *S, *D;                          /* [support][n] */
  const double *X, *half_length;          /* [n] */
  double *half;                           /* [n] half lengths that follow F; NULL: they do not */
  const double *m, *V0, *P, *b;           /* [n]; b NULL: no body force */
  double *u, *v, *F;                      /* [n] */
  double *record;                         /* [stored + WINDOW][RECORD], zero but within a pass */
  double *scratch;                        /* records of a block of every lane: [LANES][support][BLOCK][RECORD] */
  double *mass, *velocity, *acceleration; /* nodes */
  double trace;                           /* of mesh.h */
};

/* What is scattered. */
enum gx_line_part { GX_LINE_MOTION = 1, GX_LINE_FORCE = 2, GX_LINE_ALL = 3 };

struct gx_line_step {
  double kick, strain, drift; /* s */
  double flip;                /* 1: velocities by increments alone */
};

struct gx_line_passes {
  /* Weights at X + u. Returns false where a particle is not within [low, high] or its domain is too wide: then weights mean nothing. */
  bool (*weigh)(const struct gx_line_fields *fields, double low, double high);
  /* Adds mass, momentum m v and force -V0 P F D + m b S of the particles to the records, those of MOTION, of FORCE, or both. */
  void (*scatter)(const struct gx_line_fields *fields, enum gx_line_part part);
  /* Records to mass, velocity and acceleration, by the same parts; leaves them zero. */
  void (*divide)(const struct gx_line_fields *fields, enum gx_line_part part);
  /* v <- flip (v + kick S a) + (1 - flip) S v_i, F <- F + strain (D v_i) F, u <- u + drift S v_i; all of them, strain alone or what is
   * not strain: spans that are 0 choose. */
  void (*advance)(const struct gx_line_fields *fields, const struct gx_line_step *step);
  /* value = S field_i. value: [n] */
  void (*gather)(const struct gx_line_fields *fields, const double *field, double *value);
};

extern const struct gx_line_passes gx_line_narrow_passes, gx_line_wide_passes;
bool gx_line_wide_supported(void);

#endif
