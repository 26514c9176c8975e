/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The summary of a stored study. */
#include "summary.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/store.h>

#include "../view/axes.h"
#include "../view/sheet.h"
#include "command.h"

enum { PART = 512, MOST = 2000, TOLD = 10 }; /* rows that are looked at at once; that a table for people has; warnings */

static const char *const shown[] = {"result.status",       "result.displacement.max.rms",
                                    "result.restitution",  "result.crossings",
                                    "result.energy.drift", "result.dt",
                                    "result.stable_dt",    "result.ns_per_particle_step",
                                    "result.time",         "result.particle",
                                    "result.reason"};
enum { SHOWN = sizeof shown / sizeof *shown };

static int print_all(const struct gx_options *options, const char *directory)
{
  const bool json = gx_options_value(options, "json"), timing = !gx_options_value(options, "no-timing");
  struct gx_store_rows *rows = gx_store_rows_begin(directory, 0, NULL, stderr);
  if (!rows) return GX_EXIT_FAILED;
  const size_t total = gx_store_rows_total(rows);
  int code = GX_EXIT_DONE;
  for (size_t done = 0; (done < total || !done) && !code; done += PART) {
    struct gx_table *part = gx_store_rows_next(rows, PART);
    const size_t columns = part ? part->columns - (timing ? 0 : 2) : 0;
    if (!part) {
      code = GX_EXIT_FAILED;
    } else if (json) {
      gx_json_write_rows(part, columns, !done, stdout);
    } else {
      if (!done) gx_csv_write_head(part, columns, stdout);
      gx_csv_write_rows(part, columns, part->rows, stdout);
    }
    gx_table_free(part);
  }
  if (json && !code) gx_json_write_end(stdout);
  gx_store_rows_end(rows);
  return code;
}

/* Of 10^5 cases most values are the same to the bit. */
static bool differ(struct gx_value a, struct gx_value b)
{
  return (a.type != b.type || a.integer != b.integer) && gx_value_compare(a, b);
}

static void find_varied(const struct gx_study *study, bool varied[GX_PARAMETERS])
{
  memset(varied, 0, GX_PARAMETERS * sizeof *varied);
  for (size_t i = 1; i < study->count; i++)
    for (int id = 0; id < GX_PARAMETERS; id++)
      if (!varied[id]) varied[id] = differ(study->cases[0].value[id], study->cases[i].value[id]);
}

static bool has_budgets(const struct gx_study *study)
{
  for (size_t i = 0; i < study->count; i++)
    if (study->cases[i].value[GX_OUTPUT_BUDGET].type != GX_NULL) return true;
  return false;
}

static const char *budget_column(int entry, char name[80])
{
  snprintf(name, 80, "result.budget.%s", gx_budget_columns[entry].name);
  return name;
}

/* The columns that are looked at here, of the first rows. total: rows that there are. NULL after a message. */
static struct gx_table *read_brief(const struct gx_study *study, const char *directory, size_t *total)
{
  static const char *const case_column = "case";
  const char *name[GX_PARAMETERS + SHOWN + GX_BUDGET_ENTRIES + 1];
  char budget[GX_BUDGET_ENTRIES][80];
  bool varied[GX_PARAMETERS];
  size_t names = 0;
  name[names++] = case_column;
  find_varied(study, varied);
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (varied[id]) name[names++] = gx_parameters[id].path;
  for (int i = 0; i < SHOWN; i++) name[names++] = shown[i];
  const bool budgets = has_budgets(study);
  for (int i = 0; i < GX_BUDGET_ENTRIES && budgets; i++) name[names++] = budget_column(i, budget[i]);
  struct gx_store_rows *rows = gx_store_rows_begin(directory, names, name, stderr);
  struct gx_table *table = rows ? gx_store_rows_next(rows, MOST) : NULL;
  *total = rows ? gx_store_rows_total(rows) : 0;
  gx_store_rows_end(rows);
  return table;
}

/* Time and particle matter where a case did not end well, restitution where there is one, timing where it was asked for. */
static bool is_shown(const struct gx_table *table, const char *name, bool timing)
{
  if (!strcmp(name, "result.ns_per_particle_step")) return timing;
  if (strcmp(name, "result.time") != 0 && strcmp(name, "result.restitution") != 0) return true;
  long c = gx_table_find(table, strcmp(name, "result.time") ? name : "result.reason");
  for (size_t row = 0; row < table->rows; row++)
    if (gx_table_get(table, row, (size_t)c).type != GX_NULL) return true;
  return false;
}

/* What varies and what matters most. */
static struct gx_table *choose(const struct gx_table *table, bool timing)
{
  size_t *column = calloc(table->columns + SHOWN, sizeof *column);
  long count = column ? gx_axes_find(table, 0, column) : -1;
  for (size_t i = 0; i < SHOWN && count >= 0; i++) {
    long c = gx_table_find(table, shown[i]);
    if (c >= 0 && is_shown(table, shown[i], timing)) column[count++] = (size_t)c;
  }
  struct gx_table *sheet = count < 0 ? NULL : gx_table_create((size_t)count, table->rows);
  int failed = !sheet;
  for (long c = 0; c < count && !failed; c++) failed = gx_table_copy(sheet, (size_t)c, table, column[c]);
  free(column);
  if (!failed) return sheet;
  gx_table_free(sheet);
  return NULL;
}

static struct gx_value value_at(const struct gx_table *table, size_t row, const char *name)
{
  long column = gx_table_find(table, name);
  return column < 0 ? (struct gx_value){.type = GX_NULL} : gx_table_get(table, row, (size_t)column);
}

static const char *text_at(const struct gx_table *table, size_t row, const char *name)
{
  struct gx_value value = value_at(table, row, name);
  return value.type == GX_TEXT ? value.text : "";
}

/* "quadrature dominates, 10.9 times the next, time" */
static void print_dominant(const struct gx_budget_values *budget, enum gx_budget_entry of, const char *what, const char *gap)
{
  enum gx_budget_entry next, largest = gx_budget_dominant(budget, of, &next);
  if (largest == GX_BUDGET_ENTRIES) return;
  printf("%sin %s %s dominates", gap, what, gx_sheet_leaf(gx_budget_columns[largest].name));
  if (next == GX_BUDGET_ENTRIES) return;
  printf(", %.3g times the next, %s", budget->value[largest] / budget->value[next], gx_sheet_leaf(gx_budget_columns[next].name));
}

/* One line a case: which term of the error of a step dominates, and by how much. */
static void print_budgets(const struct gx_study *study, const struct gx_table *table)
{
  for (size_t r = 0; r < table->rows; r++) {
    struct gx_budget_values budget = {0};
    enum gx_budget_entry next;
    char name[80], text[GX_NUMBER_LENGTH];
    for (int i = 0; i < GX_BUDGET_ENTRIES; i++) budget.value[i] = gx_value_number(value_at(table, r, budget_column(i, name)));
    if (gx_budget_dominant(&budget, GX_BUDGET_VELOCITY_STEP, &next) == GX_BUDGET_ENTRIES) continue;
    printf("error of a step");
    for (size_t a = 0; a < study->axes; a++) {
      const char *path = gx_parameters[study->axis[a]].path;
      printf(", %s %s", gx_sheet_leaf(path), gx_sheet_text(path, value_at(table, r, path), text));
    }
    print_dominant(&budget, GX_BUDGET_VELOCITY_STEP, "velocity", ": ");
    print_dominant(&budget, GX_BUDGET_DISPLACEMENT_STEP, "displacement", "; ");
    putchar('\n');
  }
}

/* What is said of all cases. */
struct tally {
  size_t failed, above; /* above the largest stable step */
};

/* tell: says which they are, of those above the first ten. */
static void look_at(const struct gx_table *part, bool tell, bool quiet, struct tally *tally)
{
  const size_t status = (size_t)gx_table_find(part, "result.status"), dt = (size_t)gx_table_find(part, "result.dt"),
               stable = (size_t)gx_table_find(part, "result.stable_dt");
  for (size_t r = 0; r < part->rows; r++) {
    const struct gx_value ended = gx_table_get(part, r, status);
    const double step = gx_value_number(gx_table_get(part, r, dt)), largest = gx_value_number(gx_table_get(part, r, stable));
    if (ended.type == GX_TEXT && !strcmp(ended.text, gx_status_name(GX_FAILED))) {
      tally->failed++;
      if (tell)
        fprintf(stderr, "gridcross run: case %s failed: %s\n", text_at(part, r, "case"), text_at(part, r, "result.reason"));
    }
    if (!(step > largest) || quiet || tally->above++ >= TOLD || !tell) continue;
    if (largest == 0)
      fprintf(stderr, "warning: case %s: no time step is stable for this clock with projection each-step; use projection once\n",
              text_at(part, r, "case"));
    else
      fprintf(stderr, "warning: case %s: dt = %.4g s is above the largest stable step, about %.4g s\n", text_at(part, r, "case"),
              step, largest);
  }
}

/* Returns 0, or -1 after a message. */
static int look_through(const char *directory, bool tell, bool quiet, struct tally *tally)
{
  static const char *const column[] = {"result.status", "result.dt", "result.stable_dt", "case", "result.reason"};
  struct gx_store_rows *rows = gx_store_rows_begin(directory, tell ? 5 : 3, column, stderr);
  const size_t total = rows ? gx_store_rows_total(rows) : 0;
  struct gx_table *part = NULL;
  *tally = (struct tally){0};
  for (size_t done = 0; done < total && (part = gx_store_rows_next(rows, PART)); done += PART) {
    look_at(part, tell, quiet, tally);
    gx_table_free(part);
  }
  gx_store_rows_end(rows);
  return rows && (part || !total) ? 0 : -1;
}

/* What must not be missed of any case; which those are is read where there are some. Returns an exit code. */
static int look_at_all(const char *directory, bool quiet)
{
  struct tally tally;
  if (look_through(directory, false, quiet, &tally)) return GX_EXIT_FAILED;
  if ((tally.failed || tally.above) && look_through(directory, true, quiet, &tally)) return GX_EXIT_FAILED;
  if (tally.above > TOLD) fprintf(stderr, "warning: and %zu cases more\n", tally.above - TOLD);
  return tally.failed ? GX_EXIT_FAILED : GX_EXIT_DONE;
}

static int print_sheet(const struct gx_options *options, const struct gx_study *study, const struct gx_table *table)
{
  struct gx_table *sheet = choose(table, !gx_options_value(options, "no-timing"));
  int failed = !sheet || gx_command_print(sheet);
  gx_table_free(sheet);
  if (failed) return gx_command_no_memory();
  if (has_budgets(study)) print_budgets(study, table);
  return GX_EXIT_DONE;
}

static int print_brief(const struct gx_options *options, const struct gx_study *study, const char *directory)
{
  size_t total;
  struct gx_table *table = read_brief(study, directory, &total);
  int code = table ? print_sheet(options, study, table) : GX_EXIT_FAILED;
  if (!code && total > table->rows) printf("and %zu cases more, in %s/table.csv\n", total - table->rows, directory);
  gx_table_free(table);
  return code;
}

int gx_summary_print(const struct gx_options *options, const struct gx_study *study, const char *directory)
{
  const bool all = gx_options_value(options, "csv") || gx_options_value(options, "json");
  const int code = all ? print_all(options, directory) : print_brief(options, study, directory);
  const int worst = look_at_all(directory, gx_options_value(options, "quiet"));
  return code ? code : worst;
}
