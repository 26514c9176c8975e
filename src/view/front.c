/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pareto front by one pass over the cases in order of cost. */
#include "front.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "axes.h"
#include "join.h"

struct entry {
  double cost, error;
  size_t row;
};

static int by_cost(const void *left, const void *right)
{
  const struct entry *a = left, *b = right;
  if (a->cost != b->cost) return a->cost < b->cost ? -1 : 1;
  if (a->error != b->error) return a->error < b->error ? -1 : 1;
  return (a->row > b->row) - (a->row < b->row);
}

double gx_front_error(const struct gx_front *front, size_t row)
{
  return gx_value_number(gx_table_get(front->table, row, front->error));
}

double gx_front_cost(const struct gx_front *front, size_t row)
{
  return gx_value_number(gx_table_get(front->table, row, front->cost));
}

/* An easier problem or a shorter time would always be the cheaper one. */
static int check_problem(const struct gx_table *table, FILE *errors)
{
  static const char *const times[] = {"time.start", "time.end", "time.periods", "time.steps"};
  for (size_t c = 0; c < table->columns; c++) {
    const char *name = table->column[c].name;
    bool poses = !strncmp(name, "problem.", 8);
    for (size_t t = 0; t < sizeof times / sizeof *times; t++) poses = poses || !strcmp(name, times[t]);
    if (!poses || !gx_axes_vary(table, c)) continue;
    fprintf(errors, "gridcross: %s varies, and costs compare on one problem alone: choose one by --where %s=VALUE\n", name, name);
    return -1;
  }
  long steps = gx_table_find(table, "time.steps"), dt = gx_table_find(table, "result.dt");
  if (steps < 0 || dt < 0 || !table->rows || gx_table_get(table, 0, (size_t)steps).type == GX_NULL) return 0;
  if (!gx_axes_vary(table, (size_t)dt)) return 0;
  fputs("gridcross: cases of as many steps of different lengths end at different times, and costs compare on one alone: "
        "set time.end in place of time.steps\n",
        errors);
  return -1;
}

/* A column of numbers, or -1 after a message. */
static long find_number(const struct gx_table *table, const char *name, FILE *errors)
{
  long c = gx_join_find(table, name, false, errors);
  if (c < 0 || table->column[c].type != GX_TEXT) return c;
  fprintf(errors, "gridcross: %s is not a number\n", name);
  return -1;
}

double gx_front_share(const struct gx_front *front, size_t row)
{
  long dt = gx_table_find(front->table, "result.dt"), stable = gx_table_find(front->table, "result.stable_dt");
  if (dt < 0 || stable < 0) return NAN;
  return gx_value_number(gx_table_get(front->table, row, (size_t)dt)) /
         gx_value_number(gx_table_get(front->table, row, (size_t)stable));
}

/* Rows that count, or those of steps above the stable one, in order of cost; row: [rows]. entry: [rows] of scratch. */
static size_t sort(struct gx_front *front, bool above, struct entry *entry, size_t *row)
{
  size_t count = 0;
  for (size_t r = 0; r < front->table->rows; r++) {
    struct gx_left_out ignored = {0};
    double error = gx_front_error(front, r), cost = gx_front_cost(front, r);
    if (!gx_left_out_try(above ? &ignored : &front->left_out, front->table, r)) continue;
    if (!above) {
      front->left_out.empty += isnan(error);
      front->untimed += !isnan(error) && !(cost > 0);
    }
    if (isnan(error) || !(cost > 0) || (gx_front_share(front, r) > 1) != above) continue;
    entry[count++] = (struct entry){.cost = cost, .error = error, .row = r};
  }
  qsort(entry, count, sizeof *entry, by_cost);
  for (size_t i = 0; i < count; i++) row[i] = entry[i].row;
  return count;
}

static void find_members(struct gx_front *front)
{
  double best = INFINITY;
  for (size_t i = 0; i < front->cases; i++) {
    double error = gx_front_error(front, front->row[i]);
    if (error >= best) continue;
    best = error;
    front->member[front->members++] = front->row[i];
  }
}

int gx_front_find(struct gx_front *front, const struct gx_table *table, const char *error, const char *cost, FILE *errors)
{
  *front = (struct gx_front){.table = table};
  long e = check_problem(table, errors) ? -1 : find_number(table, error, errors),
       c = e < 0 ? -1 : find_number(table, cost, errors);
  if (c < 0) return -1;
  front->error = (size_t)e;
  front->cost = (size_t)c;
  front->row = calloc(table->rows + 1, sizeof *front->row);
  front->member = calloc(table->rows + 1, sizeof *front->member);
  front->above_row = calloc(table->rows + 1, sizeof *front->above_row);
  struct entry *entry = calloc(table->rows + 1, sizeof *entry);
  if (!front->row || !front->member || !front->above_row || !entry) {
    fputs("gridcross: out of memory\n", errors);
    free(entry);
    return -1;
  }
  front->cases = sort(front, false, entry, front->row);
  front->above = sort(front, true, entry, front->above_row);
  free(entry);
  find_members(front);
  if (front->cases || front->above) return 0;
  if (front->untimed)
    fprintf(errors, "gridcross: no case has %s: is timing.csv still beside study.h5? If not, run again\n", cost);
  else if (front->left_out.empty)
    gx_left_out_suggest(table, error, errors);
  else
    return 0;
  return -1;
}

void gx_front_free(struct gx_front *front)
{
  free(front->row);
  free(front->member);
  free(front->above_row);
}

long gx_front_pick(const struct gx_front *front, double bound)
{
  for (size_t i = 0; i < front->members; i++)
    if (gx_front_error(front, front->member[i]) <= bound) return (long)front->member[i];
  return -1;
}

void gx_front_tell(const struct gx_front *front, FILE *errors)
{
  gx_left_out_tell(&front->left_out, errors);
  if (front->above)
    fprintf(errors, "note: %zu case%s left out: dt is above the stable step\n", front->above,
            front->above == 1 ? " is" : "s are");
  if (front->untimed) fprintf(errors, "note: %zu case%s no cost\n", front->untimed, front->untimed == 1 ? " has" : "s have");
}
