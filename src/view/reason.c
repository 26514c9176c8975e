/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares a case with the cheapest of every other choice, with those that differ from it in one, and with other steps. */
#include "reason.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "axes.h"
#include "sheet.h"

static bool equal(const struct gx_table *table, size_t a, size_t b, size_t column)
{
  return !gx_value_compare(gx_table_get(table, a, column), gx_table_get(table, b, column));
}

static const char *text_of(const struct gx_table *table, size_t row, size_t column, char buffer[GX_NUMBER_LENGTH])
{
  return gx_sheet_text(table->column[column].name, gx_table_get(table, row, column), buffer);
}

static double number(const struct gx_table *table, size_t row, const char *name)
{
  long c = gx_table_find(table, name);
  return c < 0 ? NAN : gx_value_number(gx_table_get(table, row, (size_t)c));
}

double gx_reason_cost(const struct gx_front *front, size_t row, size_t column, struct gx_value value, double bound, double *least)
{
  double cost = NAN, best = INFINITY;
  for (size_t i = front->cases; i-- > 0;) {
    if (gx_value_compare(gx_table_get(front->table, front->row[i], column), value)) continue;
    double error = gx_front_error(front, front->row[i]);
    best = fmin(best, error);
    if (error <= bound) cost = gx_front_cost(front, front->row[i]) / gx_front_cost(front, row);
  }
  *least = best;
  return cost;
}

static void put_factor(double factor, FILE *out)
{
  fprintf(out, factor < 0.995 ? "(%.2fx)" : factor < 9.95 ? "(%.1fx)" : "(%.0fx)", factor);
}

/* The value of a sample row, and what the cheapest case with it costs, or how near it comes. */
static void put_other(const struct gx_front *front, size_t column, size_t row, size_t sample, double bound, FILE *out)
{
  const struct gx_table *table = front->table;
  char value[GX_NUMBER_LENGTH], error[GX_NUMBER_LENGTH];
  double least, cost = gx_reason_cost(front, row, column, gx_table_get(table, sample, column), bound, &least);
  struct gx_value at_best = {.type = GX_REAL, .real = least};
  fprintf(out, "%s ", text_of(table, sample, column, value));
  if (!isnan(cost))
    put_factor(cost, out);
  else if (least < INFINITY)
    fprintf(out, "(%s at best)", gx_sheet_text(table->column[front->error].name, at_best, error));
  else
    fputs("(none)", out);
}

/* Every other value of an axis, of numbers the nearest. scratch: [table->rows]. Returns 0, or -1 when memory runs out. */
static int put_others(const struct gx_front *front, size_t column, size_t row, double bound, size_t *scratch, FILE *out)
{
  enum { NEAREST = 8 };
  const struct gx_table *table = front->table;
  long distinct = gx_axes_values(table, column, scratch), own = 0;
  bool said = false, number = table->column[column].type != GX_TEXT;
  if (distinct < 0) return -1;
  while (own < distinct && !equal(table, scratch[own], row, column)) own++;
  if (gx_table_get(table, row, column).type == GX_NULL) return 0;
  for (long i = 0; i < distinct; i++) {
    if (i == own || gx_table_get(table, scratch[i], column).type == GX_NULL || (number && labs(i - own) > NEAREST)) continue;
    if (said)
      fputs(", ", out);
    else
      fprintf(out, "cheapest with another %s: ", table->column[column].name);
    put_other(front, column, row, scratch[i], bound, out);
    said = true;
  }
  if (said) putc('\n', out);
  return 0;
}

/* The one axis in which two rows differ, or -1: none or several. */
static long single_difference(const struct gx_table *table, size_t axes, const size_t *axis, size_t a, size_t b)
{
  long only = -1;
  for (size_t i = 0; i < axes; i++) {
    if (equal(table, a, b, axis[i])) continue;
    if (only >= 0) return -1;
    only = (long)axis[i];
  }
  return only;
}

static void put_change(const struct gx_front *front, size_t axes, const size_t *axis, size_t row, size_t other, FILE *out)
{
  const struct gx_table *table = front->table;
  char buffer[GX_NUMBER_LENGTH];
  for (size_t i = 0; i < axes; i++)
    if (!equal(table, row, other, axis[i]))
      fprintf(out, "%s %s, ", table->column[axis[i]].name, text_of(table, other, axis[i], buffer));
  fprintf(out, "error %s ", text_of(table, other, front->error, buffer));
  put_factor(gx_front_cost(front, other) / gx_front_cost(front, row), out);
}

/* Of the cheaper cases the most accurate, and of those that differ from this one in a single axis the most accurate each. */
static void put_cheaper(const struct gx_front *front, size_t axes, const size_t *axis, size_t row, FILE *out)
{
  long before = -1;
  for (size_t i = 0; i < front->members && front->member[i] != row; i++) before = (long)front->member[i];
  if (before < 0) return;
  fputs("next cheaper on the front: ", out);
  put_change(front, axes, axis, row, (size_t)before, out);
  putc('\n', out);
  for (size_t a = 0; a < axes; a++) {
    long best = -1;
    for (size_t i = 0; i < front->cases && front->row[i] != row; i++) {
      if (single_difference(front->table, axes, axis, row, front->row[i]) != (long)axis[a]) continue;
      if (best < 0 || gx_front_error(front, front->row[i]) < gx_front_error(front, (size_t)best)) best = (long)front->row[i];
    }
    if (best < 0 || best == before) continue;
    fputs("cheaper by one change: ", out);
    put_change(front, axes, axis, row, (size_t)best, out);
    putc('\n', out);
  }
}

/* The case that differs in the step alone, by as little as possible; finer or coarser. -1: none ended ok. */
static long other_step(const struct gx_front *front, size_t axes, const size_t *axis, size_t row, bool finer)
{
  long best = -1, of_dt = gx_table_find(front->table, "time.dt"), of_cfl = gx_table_find(front->table, "time.cfl");
  double dt = number(front->table, row, "result.dt"), best_dt = NAN;
  for (size_t i = 0; i < front->cases; i++) {
    long axis_of = single_difference(front->table, axes, axis, row, front->row[i]);
    double other = number(front->table, front->row[i], "result.dt");
    if (axis_of < 0 || (axis_of != of_dt && axis_of != of_cfl) || (finer ? !(other < dt) : !(other > dt))) continue;
    if (best >= 0 && (finer ? other <= best_dt : other >= best_dt)) continue;
    best = (long)front->row[i];
    best_dt = other;
  }
  return best;
}

/* Whether the error is that of space or of the step: by the next finer step, or by a coarser one that does no harm. */
static void put_limit(const struct gx_front *front, size_t axes, const size_t *axis, size_t row, FILE *out)
{
  const struct gx_table *table = front->table;
  long other = other_step(front, axes, axis, row, true);
  bool finer = other >= 0;
  if (!finer) other = other_step(front, axes, axis, row, false);
  if (other < 0) return;
  double ratio = gx_front_error(front, (size_t)other) / gx_front_error(front, row);
  if (!finer && !(ratio < 1.1)) return;
  long only = single_difference(table, axes, axis, row, (size_t)other);
  char buffer[GX_NUMBER_LENGTH], error[GX_NUMBER_LENGTH];
  fprintf(out, "%s: %s with %s %s\n",
          finer && ratio < 0.5   ? "the step limits the error"
          : finer && ratio < 0.9 ? "the step has a part in the error"
                                 : "the step does not limit the error",
          text_of(table, (size_t)other, front->error, error), table->column[only].name,
          text_of(table, (size_t)other, (size_t)only, buffer));
}

/* The share of the stable step, and what a step above it would save. */
static void put_stability(const struct gx_front *front, size_t axes, const size_t *axis, size_t row, double bound, FILE *out)
{
  double share = gx_front_share(front, row);
  if (isnan(share)) return;
  fprintf(out, "dt is %.2g of the stable step", share);
  for (size_t i = 0; i < front->above; i++) {
    size_t other = front->above_row[i];
    if (gx_front_error(front, other) > bound) continue;
    if (gx_front_cost(front, other) >= gx_front_cost(front, row)) break;
    fputs("; above it: ", out);
    put_change(front, axes, axis, row, other, out);
    break;
  }
  putc('\n', out);
}

char *gx_reason_text(const struct gx_front *front, size_t axes, const size_t *axis, size_t row, double bound)
{
  char *text = NULL;
  size_t length, *scratch = calloc(front->table->rows + 1, sizeof *scratch);
  FILE *out = scratch ? open_memstream(&text, &length) : NULL;
  int failed = !out;
  for (size_t a = 0; a < axes && !failed; a++) failed = put_others(front, axis[a], row, bound, scratch, out);
  free(scratch);
  if (!failed) {
    put_cheaper(front, axes, axis, row, out);
    put_stability(front, axes, axis, row, bound, out);
    put_limit(front, axes, axis, row, out);
  }
  if (out && (ferror(out) | fclose(out))) failed = -1;
  if (!failed) return text;
  free(text);
  return NULL;
}
