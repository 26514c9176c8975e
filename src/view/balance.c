/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits of the one-step errors of a study, method by method, and what steffen2010 §7 concludes from them. */
#include <gridcross/balance.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_fit.h>

#include "axes.h"
#include "sheet.h"

int gx_balance_prepare(struct gx_study *study, const char *name, FILE *errors)
{
  int failed = 0;
  for (size_t i = 0; i < study->count && !failed; i++) {
    struct gx_value *value = study->cases[i].value;
    if (!gx_parameters[GX_OUTPUT_BUDGET].applies(value)) {
      fprintf(errors, "%s: %s has no grid, and so no errors of a grid to balance; choose a method.space that has one\n", name,
              value[GX_METHOD_SPACE].type == GX_TEXT ? value[GX_METHOD_SPACE].text : value[GX_PROBLEM_NAME].text);
      failed = -1;
    } else if (value[GX_TIME_DT].type == GX_NULL) {
      fprintf(errors, "%s: time.cfl ties the step to the mesh; give time.dt, a list of three or more\n", name);
      failed = -1;
    }
    const struct gx_value one = {.type = GX_INTEGER, .integer = 1}, none = {.type = GX_INTEGER};
    value[GX_TIME_END] = value[GX_TIME_PERIODS] = value[GX_TIME_LANDING] = (struct gx_value){0};
    value[GX_TIME_STEPS] = value[GX_OUTPUT_BUDGET] = one;
    value[GX_OUTPUT_HISTORIES] = value[GX_OUTPUT_REFERENCE] = none;
    value[GX_OUTPUT_MEASURES] = (struct gx_value){.type = GX_TEXT, .text = "final"};
  }
  return failed;
}

/* Positive values over an argument, ascending, each once. */
struct curve {
  size_t count;
  double *x, *y; /* [rows], owned by the fit */
};

/* One method: its rows, and what is fitted to them. */
struct fit {
  const struct gx_table *table;
  const size_t *group; /* [rows] method of each row */
  size_t method;
  struct curve space, time, step; /* over cells, dt, dt */
  double cells;                   /* the finest mesh */
  double c1, space_order, space_order_error, c2, time_order;
  double p, q; /* whole orders */
  double predicted, measured, stable, ratio, quadrature;
  bool hats; /* weights of degree 1 */
};

static double number(const struct gx_table *table, size_t row, const char *column)
{
  long c = gx_table_find(table, column);
  return c < 0 ? NAN : gx_value_number(gx_table_get(table, row, (size_t)c));
}

static void insert(struct curve *curve, double x, double y)
{
  size_t i = 0;
  while (i < curve->count && curve->x[i] < x) i++;
  if (!(y > 0 && isfinite(y)) || (i < curve->count && curve->x[i] == x)) return;
  memmove(curve->x + i + 1, curve->x + i, (curve->count - i) * sizeof *curve->x);
  memmove(curve->y + i + 1, curve->y + i, (curve->count - i) * sizeof *curve->y);
  curve->x[i] = x;
  curve->y[i] = y;
  curve->count++;
}

static bool is_of(const struct fit *fit, size_t row)
{
  return fit->group[row] == fit->method;
}

static void collect(struct fit *fit)
{
  const struct gx_table *table = fit->table;
  fit->cells = 0;
  for (size_t r = 0; r < table->rows; r++)
    if (is_of(fit, r)) fit->cells = fmax(fit->cells, number(table, r, "mesh.cells"));
  for (size_t r = 0; r < table->rows; r++) {
    if (!is_of(fit, r)) continue;
    double cells = number(table, r, "mesh.cells"), dt = number(table, r, "time.dt");
    insert(&fit->space, cells, number(table, r, "result.budget.l2.projected"));
    insert(&fit->time, dt, number(table, r, "result.budget.l2.time"));
    if (cells == fit->cells) insert(&fit->step, dt, number(table, r, "result.budget.l2.increment"));
  }
}

/* Slope of log y over log x between neighbours i and i + 1. */
static double local_order(const struct curve *curve, size_t i)
{
  return log(curve->y[i + 1] / curve->y[i]) / log(curve->x[i + 1] / curve->x[i]);
}

/* Slope of the least-squares line through the logarithms of `count` points from the first on; error: its standard error. */
static double fitted_order(const struct curve *curve, size_t first, size_t count, double *error)
{
  double *log_x = calloc(2 * count, sizeof *log_x), *log_y = log_x + count, c0, slope = NAN, cov00, cov01, cov11, square;
  *error = NAN;
  if (!log_x) return NAN;
  for (size_t i = 0; i < count; i++) {
    log_x[i] = log(curve->x[first + i]);
    log_y[i] = log(curve->y[first + i]);
  }
  gsl_fit_linear(log_x, 1, log_y, 1, count, &c0, &slope, &cov00, &cov01, &cov11, &square);
  if (count > 2) *error = sqrt(cov11);
  free(log_x);
  return slope;
}

static void fit_space(struct fit *fit)
{
  const struct curve *space = &fit->space;
  size_t used = space->count - 1; /* the finest mesh is left for the prediction */
  fit->space_order = -fitted_order(space, 0, used, &fit->space_order_error);
  fit->p = round(fit->space_order);
  if (fit->p >= 1) fit->c1 = space->y[used - 1] * pow(space->x[used - 1], fit->p);
}

static void fit_time(struct fit *fit)
{
  const struct curve *time = &fit->time;
  double ignored;
  size_t first = 0;
  fit->q = round(local_order(time, time->count - 2));
  while (first + 2 < time->count && fabs(local_order(time, first) - fit->q) > 0.05) first++;
  fit->time_order = fitted_order(time, first, time->count - first, &ignored);
  fit->c2 = time->y[first] / pow(time->x[first], fit->q);
}

/* Where the asymptotes at the two ends of the measured curve meet. */
static double meeting(const struct curve *step, double q)
{
  const double near = 0.1;
  size_t last = step->count - 1;
  if (step->count < 3 || fabs(local_order(step, 0) - 1) > near || fabs(local_order(step, last - 1) - q) > near) return NAN;
  return pow(step->y[0] / step->x[0] / (step->y[last] / pow(step->x[last], q)), 1 / (q - 1));
}

/* Of the row at the finest mesh and least step. */
static void weigh_quadrature(struct fit *fit)
{
  const struct gx_table *table = fit->table;
  static const char *const others[] = {"interpolation", "lumping", "projection", "gradient"};
  for (size_t r = 0; r < table->rows; r++) {
    if (!is_of(fit, r) || number(table, r, "mesh.cells") != fit->cells) continue;
    fit->stable = fmax(fit->stable, number(table, r, "result.stable_dt"));
    if (number(table, r, "time.dt") != fit->step.x[0]) continue;
    double square = 0;
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
      char name[64];
      snprintf(name, sizeof name, "result.budget.velocity.%s", others[k]);
      square += pow(number(table, r, name), 2);
    }
    fit->quadrature = number(table, r, "result.budget.velocity.quadrature") / sqrt(square);
    long basis = gx_table_find(table, "method.basis");
    fit->hats = !strcmp(gx_table_get(table, r, (size_t)basis).text, "linear") || number(table, r, "method.degree") == 1;
  }
}

static void balance(struct fit *fit)
{
  fit_space(fit);
  fit_time(fit);
  fit->stable = NAN;
  weigh_quadrature(fit);
  if (fit->q < 2) return;
  double acceleration = fit->space.y[fit->space.count - 1];
  if (fit->p >= 1) fit->predicted = pow(fit->c1 / fit->c2 / pow(fit->cells, fit->p), 1 / (fit->q - 1));
  fit->measured = meeting(&fit->step, fit->q);
  fit->ratio = fit->c2 * pow(fit->stable, fit->q - 1) / acceleration;
}

static void short_number(double real, char text[GX_NUMBER_LENGTH])
{
  gx_sheet_text("result.balance", (struct gx_value){.type = GX_REAL, .real = real}, text);
}

/* steffen2010 §7 in numbers. */
static void advise(const struct fit *fit, char *text, size_t room)
{
  char stable[GX_NUMBER_LENGTH], meet[GX_NUMBER_LENGTH], factor[GX_NUMBER_LENGTH];
  short_number(fit->stable, stable);
  short_number(fit->predicted, meet);
  short_number(fit->quadrature, factor);
  size_t used = 0;
  text[0] = '\0';
  if (!(fit->p >= 1))
    used += (size_t)snprintf(text, room, "The space error does not fall with h: there is no balance.");
  else if (fit->ratio < 1)
    used +=
        (size_t)snprintf(text, room,
                         "At the stable step, %s s, the time error is %.2g %% of the space error: run near that step; smaller "
                         "ones gain nothing.",
                         stable, 100 * fit->ratio);
  else if (fit->ratio >= 1)
    used += (size_t)snprintf(text, room,
                             "Time errs more than space down to %s s, below the stable step, %s s: take a clock of higher order, "
                             "or run there.",
                             meet, stable);
  if (fit->quadrature > 1 && used < room)
    snprintf(text + used, room - used,
             "%sForces summed over particles err %s times as much in one step as all else in space: %stwice the particles a cell "
             "divide that by about %d.",
             used ? " " : "", factor, fit->hats ? "take a smoother basis, or more particles as cells become more; " : "",
             fit->hats ? 2 : 4);
}

static const struct {
  const char *name, *unit;
} results[] = {{"c1", ""},           {"space_order", ""}, {"space_order_error", ""},
               {"c2", ""},           {"time_order", ""},  {"predicted_dt", "s"},
               {"measured_dt", "s"}, {"stable_dt", "s"},  {"time_over_space", ""},
               {"quadrature", ""}};

enum { RESULTS = sizeof results / sizeof *results };

static int put_row(struct gx_table *out, size_t row, size_t column, const struct fit *fit)
{
  const double value[RESULTS] = {fit->c1,         fit->space_order, fit->space_order_error, fit->c2,
                                 fit->time_order, fit->predicted,   fit->measured,          fit->stable,
                                 fit->ratio,      fit->quadrature};
  char advice[512];
  struct gx_value cells = {.type = GX_INTEGER, .integer = (long)fit->cells};
  int failed = gx_table_set(out, row, column++, cells);
  for (size_t k = 0; k < RESULTS && !failed; k++) failed = gx_table_set(out, row, column + k, gx_value_from(value[k]));
  advise(fit, advice, sizeof advice);
  if (!failed && *advice) failed = gx_table_set(out, row, column + RESULTS, (struct gx_value){.type = GX_TEXT, .text = advice});
  return failed;
}

static int name_columns(struct gx_table *out, size_t at)
{
  int failed = gx_table_column(out, at++, "mesh.cells", "", GX_INTEGER);
  for (size_t k = 0; k < RESULTS && !failed; k++) {
    char name[64];
    snprintf(name, sizeof name, "result.balance.%s", results[k].name);
    failed = gx_table_column(out, at++, name, results[k].unit, GX_REAL);
  }
  return failed ? failed : gx_table_column(out, at, "result.balance.advice", "", GX_TEXT);
}

/* The columns of the method, and the method of each row. Returns the number of methods, -1 when memory runs out. */
static long split(const struct gx_table *table, size_t *axis, long *axes, size_t *group)
{
  size_t *rank = malloc((table->rows + 1) * sizeof *rank);
  long found = rank ? gx_axes_find(table, 0, axis) : -1, methods = 1;
  *axes = 0;
  for (long i = 0; i < found && methods >= 0; i++) {
    const char *name = table->column[axis[i]].name;
    if (!strcmp(name, "mesh.cells") || !strcmp(name, "time.dt")) continue;
    axis[(*axes)++] = axis[i];
    methods = gx_axes_rank(table, axis[i], rank) < 0 ? -1 : gx_axes_refine(table->rows, group, rank);
  }
  free(rank);
  return found < 0 ? -1 : methods;
}

/* Returns 0, or 1 after a message. */
static int check(const struct fit *fit, const char *name, FILE *errors)
{
  if (!fit->space.count || !fit->time.count) {
    fprintf(errors,
            "%s: a method has no error in any single step: none of its cases take one, or the exact solution does not accelerate "
            "at the start; choose another time.start or a smaller time.dt\n",
            name);
    return 1;
  }
  const char *lacks = fit->space.count < 3 ? "mesh.cells" : fit->time.count < 3 || fit->step.count < 1 ? "time.dt" : NULL;
  if (!lacks) return 0;
  fprintf(errors, "%s: a method has one-step errors for %zu mesh%s and %zu time step%s; give %s a list of three or more\n", name,
          fit->space.count, fit->space.count == 1 ? "" : "es", fit->time.count, fit->time.count == 1 ? "" : "s", lacks);
  return 1;
}

/* Returns 0, 1 after a message, or -1 when memory runs out. */
static int fill(struct gx_table *out, const struct gx_table *table, const size_t *axis, long axes, const size_t *group,
                const char *name, FILE *errors)
{
  double *block = malloc(6 * (table->rows + 1) * sizeof *block), *at = block;
  int failed = block ? 0 : -1;
  for (long c = 0; c < axes && !failed; c++) {
    const struct gx_column *column = &table->column[axis[c]];
    failed = gx_table_column(out, (size_t)c, column->name, column->unit, column->type);
  }
  if (!failed) failed = name_columns(out, (size_t)axes);
  for (size_t m = 0; m < out->rows && !failed; m++) {
    struct fit fit = {.table = table, .group = group, .method = m, .c1 = NAN, .predicted = NAN, .measured = NAN, .ratio = NAN};
    struct curve *curves[] = {&fit.space, &fit.time, &fit.step};
    at = block;
    for (size_t k = 0; k < 3; k++, at += 2 * (table->rows + 1)) *curves[k] = (struct curve){0, at, at + table->rows + 1};
    collect(&fit);
    if ((failed = check(&fit, name, errors))) break;
    balance(&fit);
    size_t first = 0;
    while (group[first] != m) first++;
    for (long c = 0; c < axes && !failed; c++) failed = gx_table_set(out, m, (size_t)c, gx_table_get(table, first, axis[c]));
    if (!failed) failed = put_row(out, m, (size_t)axes, &fit);
  }
  free(block);
  return failed;
}

struct gx_table *gx_balance_table(const struct gx_table *table, const char *name, FILE *errors)
{
  size_t *axis = calloc(table->columns + 1, sizeof *axis), *group = calloc(table->rows + 1, sizeof *group);
  long axes, methods = axis && group ? split(table, axis, &axes, group) : -1;
  struct gx_table *out = methods < 0 ? NULL : gx_table_create((size_t)axes + 1 + RESULTS + 1, (size_t)methods);
  int failed = out ? fill(out, table, axis, axes, group, name, errors) : -1;
  if (failed < 0) fprintf(errors, "%s: out of memory\n", name);
  free(axis);
  free(group);
  if (!failed) return out;
  gx_table_free(out);
  return NULL;
}
