/* SPDX-License-Identifier: GPL-3.0-or-later */
/* YAML text as a tree of scalars, lists and mappings with their places. Aliases are refused, never expanded. */
#ifndef GRIDCROSS_STUDY_YAML_H
#define GRIDCROSS_STUDY_YAML_H

#include <stdbool.h>
#include <stddef.h>

#include "../core/arena.h"
#include "errors.h"

enum gx_yaml_kind {
  GX_YAML_SCALAR,
  GX_YAML_LIST,
  GX_YAML_MAPPING,
  GX_YAML_REFUSED /* an error has been reported for it: say no more */
};

struct gx_yaml {
  enum gx_yaml_kind kind;
  bool plain; /* scalar without quotes */
  struct gx_place place;
  const char *text;            /* of a scalar */
  size_t count;                /* entries of a list; keys and values of a mapping */
  const struct gx_yaml *first; /* entry; in a mapping keys and values alternate */
  const struct gx_yaml *next;
};

/* Parses one document. set: where the text comes from, as in gx_place. NULL: empty, or not YAML, which has been reported;
 * check errors->count. */
const struct gx_yaml *gx_yaml_read(struct gx_arena *arena, struct gx_errors *errors, const char *text, size_t length, int set);

/* A scalar that stands for "nothing given": `key:` */
bool gx_yaml_is_empty(const struct gx_yaml *node);

#endif
