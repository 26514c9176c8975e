/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Advice in its three forms: for people, as a table, as a run file. */
#include <gridcross/advise.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "axes.h"
#include "front.h"
#include "join.h"
#include "reason.h"
#include "recipe.h"
#include "sheet.h"

enum { PAGE = 100 };

/* What each form is made of. */
struct ground {
  const struct gx_advice *advice;
  struct gx_table *table; /* the studies joined; owned */
  struct gx_front front;
  size_t axes, *axis; /* columns of table, owned */
};

static int no_memory(FILE *errors)
{
  fputs("gridcross: out of memory\n", errors);
  return -1;
}

static void ground_free(struct ground *ground)
{
  gx_front_free(&ground->front);
  gx_table_free(ground->table);
  free(ground->axis);
}

static int ground_find(struct ground *ground, const struct gx_advice *advice, FILE *errors)
{
  *ground = (struct ground){.advice = advice};
  if (gx_join_check(advice->studies, advice->name, errors)) return -1;
  ground->table = gx_join_tables(advice->studies, advice->table, advice->name);
  ground->axis = ground->table ? calloc(ground->table->columns + 1, sizeof *ground->axis) : NULL;
  long axes = ground->axis ? gx_axes_find(ground->table, 0, ground->axis) : -1;
  if (axes < 0) return no_memory(errors);
  ground->axes = (size_t)axes;
  const char *value = advice->value ? advice->value : "result.displacement.max.rms";
  if (gx_table_find(ground->table, value) >= 0 && !gx_sheet_error_like(value)) {
    fprintf(errors, "gridcross: %s is not an error: name a --value such as result.velocity.final.rms\n", value);
    return -1;
  }
  if (gx_front_find(&ground->front, ground->table, value, "result.seconds", errors)) return -1;
  gx_front_tell(&ground->front, errors);
  return 0;
}

/* The most accurate case of all. */
static size_t nearest(const struct gx_front *front)
{
  return front->member[front->members - 1];
}

static const char *id_of(const struct ground *ground, size_t row)
{
  long c = gx_table_find(ground->table, "case");
  struct gx_value id = c < 0 ? (struct gx_value){0} : gx_table_get(ground->table, row, (size_t)c);
  return id.type == GX_TEXT ? id.text : "-";
}

/* For forms that hold only what meets an error. */
static void tell_unmet(const struct ground *ground, FILE *errors)
{
  const struct gx_front *front = &ground->front;
  for (size_t b = 0; b < ground->advice->bounds; b++)
    if (front->members && gx_front_pick(front, ground->advice->bound[b]) < 0)
      fprintf(errors, "note: no case has an error of at most %g; the nearest, case %s, has %.3g\n", ground->advice->bound[b],
              id_of(ground, nearest(front)), gx_front_error(front, nearest(front)));
}

/* To two digits, as timings deserve. */
static struct gx_value rounded(double number)
{
  char text[GX_NUMBER_LENGTH];
  snprintf(text, sizeof text, "%.1e", number);
  return gx_value_from(strtod(text, NULL));
}

/* Column `to` of a table of the front's members: column `from` of the studies. */
static int copy_members(struct gx_table *table, size_t to, const struct ground *ground, size_t from)
{
  const struct gx_column *column = &ground->table->column[from];
  int failed = gx_table_column_like(table, to, column);
  for (size_t i = 0; i < ground->front.members && !failed; i++)
    failed = gx_table_set(table, i, to, gx_table_get(ground->table, ground->front.member[i], from));
  return failed;
}

/* Column `to`: how many times as much the cheapest case of one space costs that errs no more than the member. result.*: the
 * names under which people's tables shorten numbers. */
static int put_factors(struct gx_table *table, size_t to, const struct ground *ground, size_t column, size_t sample)
{
  struct gx_value space = gx_table_get(ground->table, sample, column);
  char name[160];
  snprintf(name, sizeof name, "result.%s", space.type == GX_TEXT ? space.text : "-");
  int failed = gx_table_column(table, to, name, "x", GX_REAL);
  for (size_t i = 0; i < ground->front.members && !failed; i++) {
    size_t row = ground->front.member[i];
    double least, bound = gx_front_error(&ground->front, row);
    failed = gx_table_set(table, i, to, rounded(gx_reason_cost(&ground->front, row, column, space, bound, &least)));
  }
  return failed;
}

/* Axes, error, cost, dt over the stable step, and the factors of spaces where there are several. */
static struct gx_table *front_sheet(const struct ground *ground)
{
  const struct gx_front *front = &ground->front;
  size_t *sample = calloc(ground->table->rows + 1, sizeof *sample), at = 0;
  long space = gx_table_find(ground->table, "method.space");
  long spaces = sample && space >= 0 ? gx_axes_values(ground->table, (size_t)space, sample) : 0;
  if (spaces == 1) spaces = 0;
  struct gx_table *table = spaces < 0 ? NULL : gx_table_create(ground->axes + 3 + (size_t)spaces, front->members);
  int failed = !sample || !table;
  for (; at < ground->axes && !failed; at++) failed = copy_members(table, at, ground, ground->axis[at]);
  if (!failed) failed = copy_members(table, at++, ground, front->error) || copy_members(table, at++, ground, front->cost);
  if (!failed) failed = gx_table_column(table, at, "result.dt/stable", "", GX_REAL);
  for (size_t i = 0; i < front->members && !failed; i++)
    failed = gx_table_set(table, i, at, rounded(gx_front_share(front, front->member[i])));
  for (long s = 0; s < spaces && !failed; s++) failed = put_factors(table, at + 1 + (size_t)s, ground, (size_t)space, sample[s]);
  free(sample);
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

/* Lines of a text as items of a list, broken after commas where they are longer than a page. */
static void print_items(const char *text, FILE *out)
{
  for (const char *end; (end = strchr(text, '\n')); text = end + 1) {
    const char *lead = "  - ";
    while (end - text > PAGE) {
      const char *stop = text + PAGE;
      while (stop > text + 2 && strncmp(stop - 2, ", ", 2) != 0) stop--;
      if (stop == text + 2) break;
      fprintf(out, "%s%.*s\n", lead, (int)(stop - text) - 1, text);
      text = stop;
      lead = "    ";
    }
    fprintf(out, "%s%.*s\n", lead, (int)(end - text), text);
  }
}

static int print_pick(const struct ground *ground, double bound, FILE *out)
{
  const struct gx_front *front = &ground->front;
  char number[GX_NUMBER_LENGTH], error[GX_NUMBER_LENGTH], seconds[GX_NUMBER_LENGTH];
  fprintf(out, "\nerror at most %s: ", gx_sheet_text("", gx_value_from(bound), number));
  if (!front->members) {
    fputs("no case\n", out);
    return 0;
  }
  long pick = gx_front_pick(front, bound);
  size_t row = pick < 0 ? nearest(front) : (size_t)pick;
  const struct gx_table *table = ground->table;
  fprintf(out, "%scase %s, error %s, %s s\n", pick < 0 ? "no case; the nearest is " : "", id_of(ground, row),
          gx_sheet_text(table->column[front->error].name, gx_table_get(table, row, front->error), error),
          gx_sheet_text("result.seconds", gx_table_get(table, row, front->cost), seconds));
  gx_recipe_write(table, row, "  ", "  ", out);
  char *why = gx_reason_text(front, ground->axes, ground->axis, row, fmax(bound, gx_front_error(front, row)));
  if (why) print_items(why, out);
  free(why);
  return why ? 0 : -1;
}

int gx_advise_print(const struct gx_advice *advice, const struct gx_page *page, FILE *out, FILE *errors)
{
  struct ground ground;
  int failed = ground_find(&ground, advice, errors);
  struct gx_table *sheet = failed ? NULL : front_sheet(&ground);
  if (!failed && !sheet) failed = no_memory(errors);
  if (!failed) {
    fprintf(out, "front: %zu of %zu cases%s\n", ground.front.members, ground.table->rows,
            sheet->columns > ground.axes + 3 ? "; x: times its cost, the cheapest case of each space with no greater error" : "");
    if (ground.front.members) failed = putc('\n', out) == EOF || gx_sheet_print(sheet, page, out);
    for (size_t b = 0; b < advice->bounds && !failed; b++) failed = print_pick(&ground, advice->bound[b], out);
    if (failed) no_memory(errors);
  }
  gx_table_free(sheet);
  ground_free(&ground);
  return failed;
}

/* The errors that a member is the cheapest case for; null: none. */
static int put_picked(struct gx_table *table, size_t i, size_t column, const struct ground *ground)
{
  char *text = NULL, number[GX_NUMBER_LENGTH];
  size_t length, count = 0;
  FILE *out = open_memstream(&text, &length);
  if (!out) return -1;
  for (size_t b = 0; b < ground->advice->bounds; b++) {
    if (gx_front_pick(&ground->front, ground->advice->bound[b]) != (long)ground->front.member[i]) continue;
    fprintf(out, "%s%s", count++ ? " " : "", gx_sheet_text("", gx_value_from(ground->advice->bound[b]), number));
  }
  int failed = ferror(out) | fclose(out);
  if (!failed && count) failed = gx_table_set(table, i, column, (struct gx_value){.type = GX_TEXT, .text = text});
  free(text);
  return failed ? -1 : 0;
}

static int put_why(struct gx_table *table, size_t i, size_t column, const struct ground *ground)
{
  size_t row = ground->front.member[i];
  double bound = gx_front_error(&ground->front, row);
  for (size_t b = 0; b < ground->advice->bounds; b++)
    if (gx_front_pick(&ground->front, ground->advice->bound[b]) == (long)row) bound = fmax(bound, ground->advice->bound[b]);
  char *why = gx_reason_text(&ground->front, ground->axes, ground->axis, row, bound);
  int failed = why ? gx_table_set(table, i, column, (struct gx_value){.type = GX_TEXT, .text = why}) : -1;
  free(why);
  return failed;
}

static int put_recipe(struct gx_table *table, size_t i, size_t column, const struct ground *ground)
{
  char *text = NULL;
  size_t length;
  FILE *out = open_memstream(&text, &length);
  if (!out) return -1;
  gx_recipe_write(ground->table, ground->front.member[i], "", "", out);
  int failed = ferror(out) | fclose(out);
  if (!failed) failed = gx_table_set(table, i, column, (struct gx_value){.type = GX_TEXT, .text = text});
  free(text);
  return failed ? -1 : 0;
}

static int fill_table(struct gx_table *table, const struct ground *ground)
{
  static const char *const results[] = {"result.dt", "result.stable_dt"};
  static const struct {
    const char *name;
    int (*put)(struct gx_table *table, size_t i, size_t column, const struct ground *ground);
  } texts[] = {{"pick", put_picked}, {"why", put_why}, {"run_file", put_recipe}};
  const struct gx_table *from = ground->table;
  long id = gx_table_find(from, "case");
  size_t at = 0;
  int failed = id < 0 ? gx_table_column(table, at++, "case", "", GX_TEXT) : copy_members(table, at++, ground, (size_t)id);
  for (size_t a = 0; a < ground->axes && !failed; a++) failed = copy_members(table, at++, ground, ground->axis[a]);
  if (!failed)
    failed = copy_members(table, at++, ground, ground->front.error) || copy_members(table, at++, ground, ground->front.cost);
  for (size_t i = 0; i < sizeof results / sizeof *results && !failed; i++, at++) {
    long c = gx_table_find(from, results[i]);
    failed = c < 0 ? gx_table_column(table, at, results[i], "s", GX_REAL) : copy_members(table, at, ground, (size_t)c);
  }
  for (size_t t = 0; t < sizeof texts / sizeof *texts && !failed; t++, at++) {
    failed = gx_table_column(table, at, texts[t].name, "", GX_TEXT);
    for (size_t i = 0; i < ground->front.members && !failed; i++) failed = texts[t].put(table, i, at, ground);
  }
  return failed;
}

struct gx_table *gx_advise_table(const struct gx_advice *advice, FILE *errors)
{
  struct ground ground;
  struct gx_table *table = NULL;
  if (!ground_find(&ground, advice, errors)) {
    tell_unmet(&ground, errors);
    table = gx_table_create(ground.axes + 8, ground.front.members);
    if (!table || fill_table(table, &ground)) {
      no_memory(errors);
      gx_table_free(table);
      table = NULL;
    }
  }
  ground_free(&ground);
  return table;
}

int gx_advise_write(const struct gx_advice *advice, FILE *out, FILE *errors)
{
  struct ground ground;
  int failed = ground_find(&ground, advice, errors);
  const struct gx_front *front = &ground.front;
  bool any = false;
  if (!failed) tell_unmet(&ground, errors);
  for (size_t i = 0; i < front->members && !failed; i++) {
    bool picked = !advice->bounds;
    for (size_t b = 0; b < advice->bounds; b++)
      picked = picked || gx_front_pick(front, advice->bound[b]) == (long)front->member[i];
    if (!picked) continue;
    if (!any) fputs("cases:\n", out);
    gx_recipe_write(ground.table, front->member[i], "  - ", "    ", out);
    any = true;
  }
  ground_free(&ground);
  return failed;
}
