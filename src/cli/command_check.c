/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gridcross check: what a run file expands to, without running it. */
#include "command.h"

#include <math.h>
#include <stdlib.h>

#include "../view/axes.h"
#include "../view/sheet.h"

static const struct gx_option option[] = {GX_COMMAND_SET, {0}};

struct totals {
  size_t refused, failed, above;
  double steps, particle_steps;
};

static struct gx_value count(double number)
{
  return number >= 0 && number < 9e18 ? (struct gx_value){.type = GX_INTEGER, .integer = (long)number} : (struct gx_value){0};
}

static struct gx_value real(double number)
{
  return isnan(number) ? (struct gx_value){0} : (struct gx_value){.type = GX_REAL, .real = number};
}

/* The last five columns of a row. */
static int put_plan(struct gx_table *table, size_t row, const struct gx_plan *plan, struct totals *totals)
{
  char note[GX_REASON_LENGTH + 32] = "";
  bool refused = plan->outcome.status != GX_OK, above = !refused && plan->dt > plan->stable_dt;
  bool grows = !refused && plan->growth * plan->dt * plan->steps > 5; /* by a factor of 150 */
  if (refused)
    snprintf(note, sizeof note, "%s: %s", gx_status_name(plan->outcome.status), plan->outcome.reason);
  else if (plan->stable_dt == 0)
    snprintf(note, sizeof note, "no dt is stable: this clock drifts against kicks not yet projected; use projection once");
  else if (above)
    snprintf(note, sizeof note, "dt is above the stable dt");
  else if (grows)
    snprintf(note, sizeof note, "unstable at any dt: the space itself grows by up to exp(%.3g t)", plan->growth);
  totals->refused += plan->outcome.status == GX_REFUSED;
  totals->failed += refused && plan->outcome.status != GX_REFUSED;
  totals->above += above;
  if (!refused) {
    totals->steps += plan->steps;
    totals->particle_steps += plan->steps * plan->particles;
  }
  const struct gx_value value[] = {
      count(refused ? NAN : plan->particles),
      real(refused ? NAN : plan->dt),
      count(refused ? NAN : plan->steps),
      real(refused ? NAN : plan->stable_dt),
      *note ? (struct gx_value){.type = GX_TEXT, .text = note} : (struct gx_value){0},
  };
  size_t width = sizeof value / sizeof *value;
  int failed = 0;
  for (size_t i = 0; i < width && !failed; i++) failed = gx_table_set(table, row, table->columns - width + i, value[i]);
  return failed;
}

/* result.*: the names under which people's tables shorten numbers. */
static const struct {
  const char *name, *unit;
  enum gx_type type;
} plan_column[] = {{"particles", "", GX_INTEGER},
                   {"result.dt", "s", GX_REAL},
                   {"result.steps", "", GX_INTEGER},
                   {"result.stable_dt", "s", GX_REAL},
                   {"note", "", GX_TEXT}};

enum { PLAN_COLUMNS = sizeof plan_column / sizeof *plan_column };

static struct gx_table *plan_table(const struct gx_study *study, struct totals *totals)
{
  struct gx_result *none = calloc(study->count + 1, sizeof *none);
  struct gx_table *full = none ? gx_study_table(study, none, false) : NULL, *table = NULL;
  size_t *column = full ? calloc(full->columns + 1, sizeof *column) : NULL;
  long axes = column ? gx_axes_find(full, 0, column) : -1;
  int failed = axes < 0 || !(table = gx_table_create((size_t)axes + 1 + PLAN_COLUMNS, study->count));
  if (!failed) failed = gx_table_copy(table, 0, full, 0);
  for (long c = 0; c < axes && !failed; c++) failed = gx_table_copy(table, (size_t)c + 1, full, column[c]);
  for (size_t c = 0; c < PLAN_COLUMNS && !failed; c++)
    failed = gx_table_column(table, (size_t)axes + 1 + c, plan_column[c].name, plan_column[c].unit, plan_column[c].type);
  for (size_t i = 0; i < study->count && !failed; i++) {
    struct gx_plan plan = gx_case_plan(&study->cases[i]);
    failed = put_plan(table, i, &plan, totals);
  }
  free(column);
  free(none);
  gx_table_free(full);
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

static void print_totals(const struct gx_study *study, const struct totals *totals)
{
  printf("\n%zu case%s", study->count, study->count == 1 ? "" : "s");
  if (study->duplicates) printf(" (%zu equal to others dropped)", study->duplicates);
  if (totals->refused) printf(", %zu refused", totals->refused);
  if (totals->failed) printf(", %zu that cannot start", totals->failed);
  if (totals->above) printf(", %zu with dt above the stable dt", totals->above);
  printf(", %.0f steps, %.3g particle steps\n", totals->steps, totals->particle_steps);
}

static int run(const struct gx_options *options)
{
  struct gx_study *study = gx_command_read(options);
  if (!study) return GX_EXIT_USAGE;
  struct totals totals = {0};
  struct gx_table *table = plan_table(study, &totals);
  int failed = !table || gx_command_print(table);
  if (!failed) print_totals(study, &totals);
  gx_table_free(table);
  gx_runfile_free(study);
  return failed ? gx_command_no_memory() : GX_EXIT_DONE;
}

static const struct gx_example example[] = {
    {"gridcross check my.yaml", "the cases, their steps, and the stable step of each"},
    {"gridcross init bar-linear | gridcross check -", "a run file from standard input"},
    {0},
};

const struct gx_command gx_command_check = {
    .name = "check",
    .operands = "FILE.yaml",
    .least = 1,
    .most = 1,
    .help = "Check a run file (-: standard input) and print its cases with time step, steps and stable time step; run nothing.",
    .option = option,
    .example = example,
    .run = run,
};
