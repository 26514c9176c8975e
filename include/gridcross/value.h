/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scalar of a run file or a table, and the table that studies, writers and readers share. */
#ifndef GRIDCROSS_VALUE_H
#define GRIDCROSS_VALUE_H

#include <stddef.h>

enum gx_type { GX_NULL, GX_INTEGER, GX_REAL, GX_TEXT };

struct gx_value {
  enum gx_type type; /* GX_NULL: undefined, or does not apply */
  union {
    long integer;
    double real;
    const char *text; /* borrowed */
  };
};

#endif
