/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error-cost front of a report, and why each case is on it. */
#include <stdlib.h>

#include "reason.h"
#include "report_page.h"

int gx_report_front_write(const struct gx_report_page *page, struct gx_report_json *json)
{
  const struct gx_front *front = &page->front;
  int failed = 0;
  gx_report_json_open(json, "front", '{');
  if (front->members) {
    gx_report_json_text(json, "error", page->table->column[front->error].name);
    gx_report_json_text(json, "cost", page->table->column[front->cost].name);
  }
  gx_report_json_text(json, "note", page->front_note);
  gx_report_json_open(json, "counts", '['); /* the others are of no stable step, or did not end well */
  for (size_t i = 0; i < front->cases; i++)
    if (page->index[front->row[i]] >= 0) gx_report_json_integer(json, NULL, page->index[front->row[i]]);
  gx_report_json_close(json, ']');
  gx_report_json_open(json, "members", '[');
  for (size_t m = 0; m < front->members && !failed; m++) {
    size_t row = front->member[m];
    char *why = gx_reason_text(front, page->axes, page->axis, row, gx_front_error(front, row));
    gx_report_json_open(json, NULL, '{');
    gx_report_json_integer(json, "case", page->index[row]);
    gx_report_json_text(json, "why", why);
    gx_report_json_close(json, '}');
    failed = !why;
    free(why);
  }
  gx_report_json_close(json, ']');
  gx_report_json_close(json, '}');
  return failed ? -1 : 0;
}
