/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Settings: what a run file says, parameter by parameter, before cases are made of it. */
#ifndef GRIDCROSS_STUDY_SETTING_H
#define GRIDCROSS_STUDY_SETTING_H

#include <gridcross/study.h>

#include "yaml.h"

/* One admissible value of a parameter. */
struct gx_item {
  struct gx_value value;
  struct gx_place place;
  bool refused; /* reported as unfit for the case it stands in */
};

/* What one key gives to a parameter. */
struct gx_setting {
  enum gx_parameter_id id;
  struct gx_place place; /* of the key */
  bool listed;           /* written as a list or range, not as a scalar */
  bool bad;              /* some of its values were reported and left out */
  size_t count;
  struct gx_item *item; /* [count] */
  struct gx_setting *next;
};

/* The settings of the file itself, or of one entry of `cases`: at most one a parameter. */
struct gx_layer {
  struct gx_place place;
  struct gx_setting *first, **tail;
  struct gx_layer *next;
};

struct gx_settings {
  struct gx_arena arena;
  struct gx_errors *errors;
  struct gx_study *study; /* takes title and texts */
  struct gx_layer base;
  struct gx_layer *cases; /* NULL: the base is the only case */
  struct gx_layer **cases_tail;
  int zip[GX_PARAMETERS];                    /* 1 + the first parameter of the zip that the parameter belongs to, 0: none */
  enum gx_parameter_id order[GX_PARAMETERS]; /* parameters as first named */
  size_t ordered;
  bool named[GX_PARAMETERS];
  bool varied[GX_PARAMETERS]; /* named or cleared by a case, or a list */
  size_t ranged;              /* values of all ranges together */
  bool uncertain;             /* an error hides what other parameters depend on: do not judge those */
  bool incomplete;            /* an error hides some of several such values */
  bool name_excused;          /* problem.name may be behind a key that was reported as misspelt */
};

/* Reads the value of one key into a new setting; NULL when memory runs out. */
struct gx_setting *gx_setting_read(struct gx_settings *settings, enum gx_parameter_id id, struct gx_place key,
                                   const struct gx_yaml *value);

/* Setting of the parameter in the layer, or NULL. */
struct gx_setting *gx_setting_find(const struct gx_layer *layer, enum gx_parameter_id id);

/* The i-th parameter that excludes this one (time.dt and time.cfl), -1 after the last. */
int gx_setting_rival(enum gx_parameter_id id, int i);

#endif
