/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of tables as HDF5 takes them: double, int64_t or const char *, 8 bytes each. */
#ifndef GRIDCROSS_STORE_ENTRY_H
#define GRIDCROSS_STORE_ENTRY_H

#include <math.h>
#include <stdint.h>

#include <gridcross/value.h>

union gx_entry {
  double real;
  int64_t integer;
  const char *text;
};
_Static_assert(sizeof(union gx_entry) == sizeof(double) && sizeof(union gx_entry) == sizeof(const char *), "entries are packed");

static const int64_t gx_entry_null = INT64_MIN; /* integer; of reals NaN is null, of texts NULL */

static inline union gx_entry gx_entry_from(enum gx_type type, struct gx_value value)
{
  if (type == GX_REAL) {
    double real = value.type == GX_INTEGER ? (double)value.integer : value.real;
    return (union gx_entry){.real = value.type == GX_NULL ? NAN : real};
  }
  if (type == GX_INTEGER) return (union gx_entry){.integer = value.type == GX_NULL ? gx_entry_null : value.integer};
  return (union gx_entry){.text = value.type == GX_NULL ? NULL : value.text};
}

static inline struct gx_value gx_entry_value(enum gx_type type, union gx_entry entry)
{
  if (type == GX_REAL && !isnan(entry.real)) return (struct gx_value){.type = GX_REAL, .real = entry.real};
  if (type == GX_INTEGER && entry.integer != gx_entry_null)
    return (struct gx_value){.type = GX_INTEGER, .integer = (long)entry.integer};
  if (type == GX_TEXT && entry.text) return (struct gx_value){.type = GX_TEXT, .text = entry.text};
  return (struct gx_value){.type = GX_NULL};
}

#endif
