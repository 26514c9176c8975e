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

enum { GX_NUMBER_LENGTH = 32 };

/* The shortest of 15 to 17 significant digits that reads back bit for bit. */
void gx_value_real(double value, char text[GX_NUMBER_LENGTH]);
void gx_value_integer(long value, char text[GX_NUMBER_LENGTH]);
/* A number as double; NaN: null or text. */
double gx_value_number(struct gx_value value);
/* A number as value; null where it is not finite. */
struct gx_value gx_value_from(double number);
/* Order of two values: null, numbers ascending, texts by bytes. 0: equal. */
int gx_value_compare(struct gx_value a, struct gx_value b);

#endif
