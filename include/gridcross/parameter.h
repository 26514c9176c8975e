/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parameter table: it drives run files, --set, messages, `list`, `init`, and the columns of results. No parameter exists
 * outside it. */
#ifndef GRIDCROSS_PARAMETER_H
#define GRIDCROSS_PARAMETER_H

#include <stdbool.h>

#include <gridcross/value.h>

enum gx_parameter_id {
  GX_PROBLEM_NAME,
  GX_PROBLEM_DIMENSION,
  GX_PROBLEM_AMPLITUDE,
  GX_PROBLEM_MODULUS,
  GX_PROBLEM_DENSITY,
  GX_PROBLEM_POISSON,
  GX_PROBLEM_BOUNDARY,
  GX_PROBLEM_MODE,
  GX_PROBLEM_ACTIVE,
  GX_PROBLEM_PHASES,
  GX_PROBLEM_INTERPOLATION_ERROR,
  GX_PROBLEM_KNOT,
  GX_PROBLEM_JUMP,
  GX_PROBLEM_VARIANT,
  GX_PROBLEM_PARTICLE_WIDTH,
  GX_PROBLEM_VELOCITY,
  GX_PROBLEM_SPIN,
  GX_PROBLEM_ROTATION,
  GX_PROBLEM_GRAVITY,
  GX_BODY_FILE,
  GX_BODY_SHAPE,
  GX_BODY_CENTRE,
  GX_BODY_SIZE,
  GX_BODY_RADIUS,
  GX_BODY_INNER_RADIUS,
  GX_MESH_CELLS,
  GX_MESH_PARTICLES_PER_CELL,
  GX_MESH_LAYOUT,
  GX_METHOD_SPACE,
  GX_METHOD_BASIS,
  GX_METHOD_DEGREE,
  GX_METHOD_MASS,
  GX_METHOD_QUADRATURE,
  GX_METHOD_TRANSFER,
  GX_METHOD_FLIP,
  GX_METHOD_CLOCK,
  GX_METHOD_POSITION,
  GX_METHOD_PROJECTION,
  GX_METHOD_STRESS,
  GX_METHOD_FRAME,
  GX_METHOD_CLOSURE,
  GX_METHOD_DIVERGENCE,
  GX_TIME_DT,
  GX_TIME_CFL,
  GX_TIME_START,
  GX_TIME_END,
  GX_TIME_PERIODS,
  GX_TIME_STEPS,
  GX_TIME_LANDING,
  GX_TIME_ACCUMULATE,
  GX_OUTPUT_MEASURES,
  GX_OUTPUT_HISTORIES,
  GX_OUTPUT_SNAPSHOTS,
  GX_OUTPUT_CHECKPOINT,
  GX_OUTPUT_PROBE,
  GX_OUTPUT_JUMPS,
  GX_OUTPUT_SPECTRA,
  GX_OUTPUT_FREQUENCY,
  GX_OUTPUT_REFERENCE,
  GX_OUTPUT_BUDGET,
  GX_PARAMETERS
};

struct gx_parameter {
  const char *path;
  enum gx_type type;                             /* GX_INTEGER, GX_REAL or GX_TEXT */
  const char *unit;                              /* "" when none */
  double least, most;                            /* admissible range of numbers, ends included */
  bool above_least, below_most;                  /* least, most themselves are excluded */
  const char *standard;                          /* default as a run file would write it; NULL: none, or set by resolve */
  const char *(*choice)(int i);                  /* admissible texts, NULL after the last; NULL: free text */
  const char *help;                              /* what it is */
  const char *why;                               /* why the default is what it is */
  bool (*applies)(const struct gx_value *value); /* in a case with these values; NULL: always */
  struct gx_value (*resolve)(const struct gx_value *value); /* a default that depends on earlier parameters; NULL: standard */
  bool (*well_formed)(const char *text, const struct gx_value *value); /* free text; NULL: any */
};

extern const struct gx_parameter gx_parameters[GX_PARAMETERS];

/* -1: no such path */
int gx_parameter_find(const char *path);

/* The default that the table gives; null when there is none or it depends on other parameters. */
struct gx_value gx_parameter_default(enum gx_parameter_id id);

/* Fills null values with the defaults that the problem has of its own (gx_problem.standard). value: as below. */
void gx_parameter_own(struct gx_value *value);

/* Completes a case: fills null values with defaults, the problem's own first, then nulls what does not apply.
 * value: [GX_PARAMETERS]; problem.name must be that of a problem, the others null or within range. */
void gx_parameter_resolve(struct gx_value *value);

enum { GX_OBJECTION_LENGTH = 256 };

/* Whether value[id] of a resolved case fits the values it depends on; if not, objection says why. */
bool gx_parameter_fits(enum gx_parameter_id id, const struct gx_value *value, char objection[GX_OBJECTION_LENGTH]);

#endif
