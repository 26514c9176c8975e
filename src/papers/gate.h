/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gates: how close a recomputed value must come, and to what. */
#ifndef GRIDCROSS_PAPERS_GATE_H
#define GRIDCROSS_PAPERS_GATE_H

#include <stdbool.h>

struct gx_gate {
  enum gx_gate_kind { GX_GATE_SHOW, GX_GATE_RELATIVE, GX_GATE_FACTOR, GX_GATE_RANGE } kind;
  double tolerance;   /* relative deviation, or factor >= 1 */
  bool own_target;    /* `of` was given: target is a figure of its own */
  double target;      /* NaN until known */
  double least, most; /* of a range */
};

/* Text as in struct gx_paper_row. Returns 0, or -1 when it is ill-formed. */
int gx_gate_read(struct gx_gate *gate, const char *text);
/* Whether the value meets the gate; true for GX_GATE_SHOW. */
bool gx_gate_met(const struct gx_gate *gate, double value);

#endif
