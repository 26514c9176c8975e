/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Advice: fronts, choices and reasons worked out by hand, fronts against their definition, run files of cases read back. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <gridcross/advise.h>
#include <gridcross/study.h>

#include "view/front.h"
#include "view/recipe.h"

#include "check.h"
#include "temporary.h"

enum { COLUMNS = 10 };

static const char *const names[COLUMNS] = {"case",
                                           "problem.name",
                                           "mesh.cells",
                                           "method.space",
                                           "time.cfl",
                                           "result.status",
                                           "result.dt",
                                           "result.displacement.max.rms",
                                           "result.stable_dt",
                                           "result.seconds"};
static const enum gx_type types[COLUMNS] = {GX_TEXT, GX_TEXT, GX_INTEGER, GX_TEXT, GX_REAL,
                                            GX_TEXT, GX_REAL, GX_REAL,    GX_REAL, GX_REAL};

struct line {
  const char *id;
  long cells;
  const char *space;
  double cfl;
  const char *status;
  double dt, error, stable, seconds;
};

static struct gx_value real(double number)
{
  return isnan(number) ? (struct gx_value){0} : (struct gx_value){.type = GX_REAL, .real = number};
}

static struct gx_table *make(size_t rows, const struct line *line)
{
  struct gx_table *table = gx_table_create(COLUMNS, rows);
  for (size_t c = 0; c < COLUMNS; c++) gx_table_column(table, c, names[c], "", types[c]);
  for (size_t r = 0; r < rows; r++) {
    const struct gx_value value[COLUMNS] = {{.type = GX_TEXT, .text = line[r].id},
                                            {.type = GX_TEXT, .text = "bar-linear"},
                                            {.type = GX_INTEGER, .integer = line[r].cells},
                                            {.type = GX_TEXT, .text = line[r].space},
                                            real(line[r].cfl),
                                            {.type = GX_TEXT, .text = line[r].status},
                                            real(line[r].dt),
                                            real(line[r].error),
                                            real(line[r].stable),
                                            real(line[r].seconds)};
    for (size_t c = 0; c < COLUMNS; c++) gx_table_set(table, r, c, value[c]);
  }
  return table;
}

/* The front is a, c, d, e: b costs and errs more than c, f takes a step above the stable one, g ended early, h has no error. */
static const struct line study[] = {
    {"b", 16, "standard", 0.4, "ok", 0.2, 5e-3, 0.5, 2},         {"a", 8, "standard", 0.4, "ok", 0.4, 1e-2, 1, 1},
    {"e", 16, "moving-mesh", 0.2, "ok", 0.1, 9.9e-5, 0.5, 6},    {"d", 16, "moving-mesh", 0.4, "ok", 0.2, 1e-4, 0.5, 3},
    {"f", 16, "moving-mesh", 0.8, "ok", 0.6, 2e-4, 0.5, 1},      {"c", 8, "moving-mesh", 0.4, "ok", 0.4, 1e-3, 1, 1.5},
    {"g", 32, "standard", 0.4, "unstable", 0.1, NAN, 0.05, 0.5}, {"h", 8, "moving-mesh", 0.2, "ok", 0.2, NAN, 1, 0.1},
};
enum { STUDY = sizeof study / sizeof *study };

static const char *const one_name[] = {"s"};

static char *printed(const struct gx_advice *advice, int *failed, char **message)
{
  char *text;
  size_t length, message_length;
  FILE *out = open_memstream(&text, &length), *errors = open_memstream(message, &message_length);
  *failed = gx_advise_print(advice, &(struct gx_page){0}, out, errors);
  fclose(out);
  fclose(errors);
  return text;
}

static void advice_reads_as_expected(void **state)
{
  (void)state;
  struct gx_table *table = make(STUDY, study);
  const struct gx_table *const tables[] = {table};
  const double bound[] = {5e-4, 1e-6};
  struct gx_advice advice = {.studies = 1, .table = tables, .name = one_name, .bounds = 2, .bound = bound};
  int failed;
  char *message, *text = printed(&advice, &failed, &message);
  assert_int_equal(failed, 0);
  assert_string_equal(message, "note: 1 case is left out: 1 unstable\n"
                               "note: 1 case has no value there\n"
                               "note: 1 case is left out: dt is above the stable step\n");
  assert_string_equal(text,
                      "front: 4 of 8 cases; x: times its cost, the cheapest case of each space with no greater error\n"
                      "\n"
                      "mesh.cells  method.space  time.cfl  displacement.max.rms  seconds  dt/stable  standard  moving-mesh\n"
                      "                                                                                     x            x\n"
                      "         8  standard           0.4               1.00e-2        1        0.4         1          1.5\n"
                      "         8  moving-mesh        0.4               1.00e-3      1.5        0.4         -            1\n"
                      "        16  moving-mesh        0.4               1.00e-4        3        0.4         -            1\n"
                      "        16  moving-mesh        0.2               9.90e-5        6        0.2         -            1\n"
                      "\n"
                      "error at most 0.0005: case d, error 1.00e-4, 3 s\n"
                      "  problem: {name: bar-linear}\n"
                      "  mesh: {cells: 16}\n"
                      "  method: {space: moving-mesh}\n"
                      "  time: {cfl: 0.4}\n"
                      "  - cheapest with another mesh.cells: 8 (1.00e-3 at best), 32 (none)\n"
                      "  - cheapest with another method.space: standard (5.00e-3 at best)\n"
                      "  - cheapest with another time.cfl: 0.2 (2.0x), 0.8 (none)\n"
                      "  - next cheaper on the front: mesh.cells 8, error 1.00e-3 (0.50x)\n"
                      "  - cheaper by one change: method.space standard, error 5.00e-3 (0.67x)\n"
                      "  - dt is 0.4 of the stable step; above it: time.cfl 0.8, error 2.00e-4 (0.33x)\n"
                      "  - the step does not limit the error: 9.90e-5 with time.cfl 0.2\n"
                      "\n"
                      "error at most 1e-6: no case; the nearest is case e, error 9.90e-5, 6 s\n"
                      "  problem: {name: bar-linear}\n"
                      "  mesh: {cells: 16}\n"
                      "  method: {space: moving-mesh}\n"
                      "  time: {cfl: 0.2}\n"
                      "  - cheapest with another mesh.cells: 8 (1.00e-3 at best), 32 (none)\n"
                      "  - cheapest with another method.space: standard (5.00e-3 at best)\n"
                      "  - cheapest with another time.cfl: 0.4 (1.00e-4 at best), 0.8 (none)\n"
                      "  - next cheaper on the front: time.cfl 0.4, error 1.00e-4 (0.50x)\n"
                      "  - dt is 0.2 of the stable step\n"
                      "  - the step does not limit the error: 1.00e-4 with time.cfl 0.4\n");
  free(text);
  free(message);
  gx_table_free(table);
}

static const char *entry(const struct gx_table *table, size_t row, const char *name)
{
  struct gx_value value = gx_table_get(table, row, (size_t)gx_table_find(table, name));
  return value.type == GX_TEXT ? value.text : "";
}

static void the_table_holds_the_front(void **state)
{
  (void)state;
  struct gx_table *table = make(STUDY, study);
  const struct gx_table *const tables[] = {table};
  const double bound[] = {1e-3, 6e-3, 1e-4, 1e-9};
  struct gx_advice advice = {.studies = 1, .table = tables, .name = one_name, .bounds = 4, .bound = bound};
  char *message;
  size_t length;
  FILE *errors = open_memstream(&message, &length);
  struct gx_table *front = gx_advise_table(&advice, errors);
  fclose(errors);
  assert_non_null(front);
  assert_non_null(strstr(message, "no case has an error of at most 1e-09; the nearest, case e, has 9.9e-05\n"));
  static const char *const id[] = {"a", "c", "d", "e"}, *const pick[] = {"", "0.001 0.006", "0.0001", ""};
  assert_int_equal(front->rows, 4);
  for (size_t i = 0; i < 4; i++) {
    assert_string_equal(entry(front, i, "case"), id[i]);
    assert_string_equal(entry(front, i, "pick"), pick[i]);
  }
  assert_non_null(strstr(entry(front, 1, "run_file"), "mesh: {cells: 8}\n"));
  /* for the larger of its errors: b meets 6e-3, and costs 2 in place of 1.5 */
  assert_non_null(strstr(entry(front, 1, "why"), "cheapest with another method.space: standard (1.3x)\n"));
  assert_non_null(strstr(entry(front, 3, "why"), "next cheaper on the front: time.cfl 0.4, error 1.00e-4 (0.50x)\n"));
  free(message);
  gx_table_free(front);
  gx_table_free(table);
}

/* A step that is the limit: of order 2 the error falls to a quarter. */
static void the_step_is_told_from_the_rest(void **state)
{
  (void)state;
  static const struct {
    double finer;
    const char *verdict;
  } row[] = {{2.5e-4, "the step limits the error: 2.50e-4 with time.cfl 0.2"},
             {7e-4, "the step has a part in the error: 7.00e-4 with time.cfl 0.2"},
             {9.5e-4, "the step does not limit the error: 9.50e-4 with time.cfl 0.2"},
             {2e-3, "the step does not limit the error: 2.00e-3 with time.cfl 0.2"}};
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    const struct line line[] = {{"a", 8, "standard", 0.4, "ok", 0.4, 1e-3, 1, 1},
                                {"b", 8, "standard", 0.2, "ok", 0.2, row[i].finer, 1, 2},
                                {"c", 8, "standard", 0.1, "ok", 0.1, 1e-5, 1, 4}};
    struct gx_table *table = make(3, line);
    const struct gx_table *const tables[] = {table};
    const double bound = 1e-3;
    struct gx_advice advice = {.studies = 1, .table = tables, .name = one_name, .bounds = 1, .bound = &bound};
    int failed;
    char *message, *text = printed(&advice, &failed, &message);
    CHECK(strstr(text, row[i].verdict), "%s\nin\n%s", row[i].verdict, text);
    free(text);
    free(message);
    gx_table_free(table);
  }
}

/* Of many numbers the nearest are shown, eight on either side. */
static void long_axes_are_cut(void **state)
{
  (void)state;
  struct line line[40];
  for (int r = 0; r < 40; r++) line[r] = (struct line){"x", r + 1, "standard", 0.4, "ok", 1, 1.0 / (r + 1), 2, r + 1};
  struct gx_table *table = make(40, line);
  const struct gx_table *const tables[] = {table};
  const double bound = 0.05; /* met by 20 cells and more */
  struct gx_advice advice = {.studies = 1, .table = tables, .name = one_name, .bounds = 1, .bound = &bound};
  int failed;
  char *message, *text = printed(&advice, &failed, &message);
  assert_non_null(strstr(text, "another mesh.cells: 12 (8.33e-2 at best), 13 (7.69e-2 at best), "));
  assert_non_null(strstr(text, " 28 (1.4x)\n"));
  assert_null(strstr(text, " 29 ("));
  free(text);
  free(message);
  gx_table_free(table);
}

/* Small whole numbers, so that there are ties. */
static void fronts_are_what_they_are_defined_to_be(void **state)
{
  (void)state;
  enum { ROWS = 40 };
  uint64_t seed = 7;
  for (int trial = 0; trial < 200; trial++) {
    struct line line[ROWS];
    for (int r = 0; r < ROWS; r++)
      line[r] = (struct line){
          "x", r, "standard", 0.4, "ok", 1, floor(check_random(&seed, 1, 12)), 2, floor(check_random(&seed, 1, 12))};
    struct gx_table *table = make(ROWS, line);
    struct gx_front front;
    assert_int_equal(gx_front_find(&front, table, "result.displacement.max.rms", "result.seconds", stderr), 0);
    for (size_t i = 0; i < front.members; i++)
      for (int r = 0; r < ROWS; r++) {
        const struct line *m = &line[front.member[i]];
        CHECK(!(line[r].error <= m->error && line[r].seconds <= m->seconds &&
                (line[r].error < m->error || line[r].seconds < m->seconds)),
              "trial %d: member %zu is beaten by %d", trial, front.member[i], r);
      }
    for (double bound = 0.5; bound < 13; bound++) {
      double least = INFINITY;
      for (int r = 0; r < ROWS; r++)
        if (line[r].error <= bound) least = fmin(least, line[r].seconds);
      long pick = gx_front_pick(&front, bound);
      CHECK(pick < 0 ? isinf(least) : line[pick].error <= bound && line[pick].seconds == least, "trial %d: pick %ld for %g",
            trial, pick, bound);
    }
    gx_front_free(&front);
    gx_table_free(table);
  }
}

static void expect_error(struct gx_advice advice, const char *expected)
{
  int failed;
  char *message, *text = printed(&advice, &failed, &message);
  assert_int_equal(failed, -1);
  assert_string_equal(text, "");
  assert_string_equal(message, expected);
  free(text);
  free(message);
}

static void what_cannot_be_advised_is_refused(void **state)
{
  (void)state;
  struct line line[2] = {{"a", 8, "standard", 0.4, "ok", 0.4, 1e-2, 1, NAN}, {"b", 16, "standard", 0.4, "ok", 0.4, 1e-3, 1, NAN}};
  struct gx_table *untimed = make(2, line);
  line[0].error = line[1].error = NAN;
  struct gx_table *empty = make(2, line);
  struct gx_table *mixed = make(STUDY, study);
  gx_table_set(mixed, 0, 1, (struct gx_value){.type = GX_TEXT, .text = "bar-neo-hookean"});
  const struct gx_table *tables[] = {untimed, untimed};
  const char *const same[] = {"s", "s"};
  struct gx_advice advice = {.studies = 1, .table = tables, .name = same};
  expect_error(advice, "gridcross: no case has result.seconds: is timing.csv still beside study.h5? If not, run again\n");
  tables[0] = empty;
  expect_error(advice, "gridcross: no case has result.displacement.max.rms; run again with output.measures: all\n");
  tables[0] = mixed;
  expect_error(advice, "gridcross: problem.name varies, and costs compare on one problem alone: choose one by --where "
                       "problem.name=VALUE\n");
  advice.value = "result.status";
  tables[0] = untimed;
  expect_error(advice, "gridcross: result.status is not an error: name a --value such as result.velocity.final.rms\n");
  advice.value = "result.displacement.max.rsm";
  expect_error(advice, "gridcross: no column 'result.displacement.max.rsm': did you mean result.displacement.max.rms?\n");
  advice = (struct gx_advice){.studies = 2, .table = tables, .name = same};
  expect_error(advice, "gridcross: two studies are called s: was one named twice?\n");
  gx_table_free(untimed);
  gx_table_free(empty);
  gx_table_free(mixed);
}

static struct gx_study *read_text(const char *text)
{
  char path[TEMPORARY_ROOM];
  int descriptor = temporary_file(path, "advise");
  assert_true(descriptor >= 0);
  assert_int_equal(write(descriptor, text, strlen(text)), strlen(text));
  close(descriptor);
  struct gx_study *study_read = gx_runfile_read(path, 0, NULL, NULL, stderr);
  unlink(path);
  return study_read;
}

/* Every case from its own run file has the same id, and no line of that says what follows from the others. */
static void a_run_file_gives_its_case_back(void **state)
{
  (void)state;
  struct gx_study *many = read_text(
      "problem: {name: bar-neo-hookean}\n"
      "cases:\n"
      "  - {}\n"
      "  - {mesh: {cells: [8, 16], layout: gauss}, method: {space: [standard, moving-mesh], degree: [1, 2], mass: consistent}}\n"
      "  - {method: {space: [spline-particle, spline-grid], degree: [5, 7], frame: [current, reference]}, time: {dt: 1.1e-5}}\n"
      "  - {method: {space: moving-mesh, projection: each-step, transfer: flip, flip: 0.95}, time: {cfl: 0.1, end: 0.3}}\n"
      "  - {problem: {name: bar-linear, mode: 2, boundary: periodic}, method: {basis: cpgimp}, time: {dt: "
      "3.3333333333333333e-6}}\n"
      "  - {problem: {name: axis-aligned, dimension: 2, active: xy, phases: '0 0.5', poisson: 0.3}, output: {histories: 10}}\n"
      "  - {problem: {name: axis-aligned, dimension: 3, active: x}, mesh: {cells: 4}}\n"
      "  - {problem: {name: oscillator, interpolation_error: 0.01}, method: {clock: rk4}, time: {dt: 1e-3}}\n");
  assert_non_null(many);
  assert_int_equal(many->count, 22);
  struct gx_result *none = calloc(many->count, sizeof *none);
  struct gx_table *table = gx_study_table(many, none, false);
  for (size_t i = 0; i < many->count; i++) {
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    gx_recipe_write(table, i, "", "", out);
    fclose(out);
    struct gx_study *again = read_text(text);
    CHECK(again && again->count == 1 && !strcmp(again->cases[0].id, many->cases[i].id), "case %zu:\n%s", i, text);
    if (i == 0) assert_string_equal(text, "problem: {name: bar-neo-hookean}\n");
    gx_runfile_free(again);
    free(text);
  }
  gx_table_free(table);
  free(none);
  gx_runfile_free(many);
}

static void texts_are_quoted(void **state)
{
  (void)state;
  char *text;
  size_t length;
  FILE *out = open_memstream(&text, &length);
  gx_recipe_quote("a \"b\" \\ \n: {h\xC3\xB6}", out);
  fclose(out);
  assert_string_equal(text, "\"a \\\"b\\\" \\\\ \\x0A: {h\xC3\xB6}\"");
  free(text);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(advice_reads_as_expected),
      cmocka_unit_test(the_table_holds_the_front),
      cmocka_unit_test(the_step_is_told_from_the_rest),
      cmocka_unit_test(long_axes_are_cut),
      cmocka_unit_test(fronts_are_what_they_are_defined_to_be),
      cmocka_unit_test(what_cannot_be_advised_is_refused),
      cmocka_unit_test(a_run_file_gives_its_case_back),
      cmocka_unit_test(texts_are_quoted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
