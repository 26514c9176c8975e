/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of expectations: products of columns of a study. */
#ifndef GRIDCROSS_PAPERS_EXPRESSION_H
#define GRIDCROSS_PAPERS_EXPRESSION_H

#include <gridcross/status.h>
#include <gridcross/table.h>

struct gx_expression {
  long row;                       /* of the study: the case of the only column; -1: none, or several */
  struct gx_value value;          /* GX_NULL: a case has no such result; texts borrowed from the study */
  char reason[GX_REASON_LENGTH];  /* "" when well-formed */
  char because[GX_REASON_LENGTH]; /* how a case without the result ended, "" when all ended ok */
};

/* Text as in struct gx_paper_row. */
struct gx_expression gx_expression_value(const char *text, const struct gx_table *study);

#endif
