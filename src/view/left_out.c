/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts cases by how they ended. */
#include "left_out.h"

#include <string.h>

bool gx_left_out_try(struct gx_left_out *left_out, const struct gx_table *table, size_t row)
{
  long c = gx_table_find(table, "result.status");
  if (c < 0) return true;
  struct gx_value status = gx_table_get(table, row, (size_t)c);
  if (status.type != GX_TEXT || !strcmp(status.text, gx_status_name(GX_OK))) return true;
  for (int s = 0; s < GX_STATUSES; s++) left_out->ended[s] += !strcmp(status.text, gx_status_name(s));
  return false;
}

void gx_left_out_tell(const struct gx_left_out *left_out, FILE *errors)
{
  size_t count = 0;
  const char *gap = "";
  for (int s = 0; s < GX_STATUSES; s++) count += left_out->ended[s];
  if (count) fprintf(errors, "note: %zu case%s left out: ", count, count == 1 ? " is" : "s are");
  for (int s = 0; s < GX_STATUSES; s++) {
    if (!left_out->ended[s]) continue;
    fprintf(errors, "%s%zu %s", gap, left_out->ended[s], gx_status_name(s));
    gap = ", ";
  }
  if (count) putc('\n', errors);
  if (left_out->empty)
    fprintf(errors, "note: %zu case%s no value there\n", left_out->empty, left_out->empty == 1 ? " has" : "s have");
}
