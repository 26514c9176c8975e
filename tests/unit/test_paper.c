/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Papers: expressions, gates and verdicts against a study made by hand. */
#include <stdlib.h>
#include <string.h>

#include <gridcross/paper.h>

#include "papers/expression.h"
#include "papers/gate.h"

#include "check.h"

/* Three cases: errors 4e-2, 1e-2 (order 2 in dt), and one that blew up. */
static struct gx_table *make_study(void)
{
  static const char *const name[] = {"time.dt", "method.clock", "result.status", "result.reason", "result.steps", "result.error"};
  static const enum gx_type type[] = {GX_REAL, GX_TEXT, GX_TEXT, GX_TEXT, GX_INTEGER, GX_REAL};
  enum { COLUMNS = sizeof name / sizeof *name };
  const struct gx_value row[][COLUMNS] = {
      {{.type = GX_REAL, .real = 0.1},
       {.type = GX_TEXT, .text = "rk4"},
       {.type = GX_TEXT, .text = "ok"},
       {.type = GX_NULL},
       {.type = GX_INTEGER, .integer = 10},
       {.type = GX_REAL, .real = 4e-2}},
      {{.type = GX_REAL, .real = 0.1 / 2 * (1 + 1e-15)},
       {.type = GX_TEXT, .text = "rk4"},
       {.type = GX_TEXT, .text = "ok"},
       {.type = GX_NULL},
       {.type = GX_INTEGER, .integer = 20},
       {.type = GX_REAL, .real = 1e-2}},
      {{.type = GX_REAL, .real = 0.1},
       {.type = GX_TEXT, .text = "euler"},
       {.type = GX_TEXT, .text = "unstable"},
       {.type = GX_TEXT, .text = "too fast"},
       {.type = GX_INTEGER, .integer = 3},
       {.type = GX_NULL}},
  };
  struct gx_table *table = gx_table_create(COLUMNS, 3);
  for (size_t c = 0; c < COLUMNS; c++) gx_table_column(table, c, name[c], "", type[c]);
  for (size_t r = 0; r < 3; r++)
    for (size_t c = 0; c < COLUMNS; c++) gx_table_set(table, r, c, row[r][c]);
  return table;
}

static void expressions(void **state)
{
  (void)state;
  struct gx_table *study = make_study();
  static const struct {
    const char *text;
    double value;
  } good[] = {
      {"2.5e-1", 0.25},
      {"result.error{time.dt=0.1 method.clock=rk4}", 4e-2},
      {"result.error{time.dt=0.05}", 1e-2}, /* equal but for round-off */
      {"result.steps{time.dt=5e-2}", 20},
      {"2 * result.error{time.dt=0.1 method.clock=rk4} / result.error{time.dt=0.05}", 8},
      {"result.error{time.dt=0.05}^-0.5", 10},
      {"result.error{time.dt=0.05}^0.5 * 10^2 / 4", 2.5},
  };
  for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
    struct gx_expression found = gx_expression_value(good[i].text, study);
    CHECK(!*found.reason && found.value.type == GX_REAL, "%s: %s", good[i].text, found.reason);
    CLOSE(found.value.real, good[i].value, 1e-14);
  }
  static const struct {
    const char *text, *reason;
  } bad[] = {
      {"", "no name"},
      {"result.error", "3 cases"},
      {"result.error{time.dt=0.1}", "2 cases"},
      {"result.error{time.dt=0.2}", "0 cases"},
      {"result.errors{time.dt=0.05}", "no column 'result.errors'"},
      {"result.error{time.dt}", "'time.dt' has no value"},
      {"result.error{time.dq=1}", "no column 'time.dq'"},
      {"result.error{time.dt=0.05", "no closing brace"},
      {"result.error{time.dt=0.05}^", "no power"},
      {"2 + 2", "neither"},
      {"2 * ", "no name"},
      {"2 * result.status{time.dt=0.05}", "multiplied"},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    struct gx_expression found = gx_expression_value(bad[i].text, study);
    CHECK(strstr(found.reason, bad[i].reason), "'%s' gave '%s'", bad[i].text, found.reason);
  }
  struct gx_expression blown = gx_expression_value("2 * result.error{method.clock=euler}", study);
  assert_int_equal(blown.value.type, GX_NULL);
  assert_string_equal(blown.because, "our case ended unstable: too fast");
  assert_string_equal(gx_expression_value("result.status{method.clock=euler}", study).value.text, "unstable");
  gx_table_free(study);
}

static void gates(void **state)
{
  (void)state;
  static const struct {
    const char *text;
    double target, met, missed; /* target: of gates without one */
  } good[] = {
      {"5%", 2, 2.09, 2.11},       {"5%", -2, -1.91, -1.89},     {"5% of 4", 2, 3.81, 2},
      {"factor 2", 3, 1.51, 1.49}, {"factor 2 of 1", 3, 2, 2.1}, {"below 1e-3", 0, -5, 1.01e-3},
      {"above 10", 0, 10.1, 9.9},  {"between 1 2", 0, 1.5, 2.5}, {"0.5%", 1, 1.0049, 1.0051},
      {"5%", 2, 2, NAN},           {"below 1", 0, 0, NAN},
  };
  struct gx_gate gate;
  for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
    CHECK(!gx_gate_read(&gate, good[i].text), "%s", good[i].text);
    if (!gate.own_target) gate.target = good[i].target;
    CHECK(gx_gate_met(&gate, good[i].met), "%s of %g", good[i].text, good[i].met);
    CHECK(!gx_gate_met(&gate, good[i].missed), "%s of %g", good[i].text, good[i].missed);
  }
  static const char *const bad[] = {"",    "5",         "5 percent",   "5% of", "5% 4",  "factor", "factor 0.5",
                                    "-5%", "between 1", "between 2 1", "below", "shown", "nan%",   "5% of x"};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) CHECK(gx_gate_read(&gate, bad[i]), "'%s' was taken", bad[i]);
}

static void verdicts(void **state)
{
  (void)state;
  static const char error[] = "result.error{time.dt=0.05}"; /* 1e-2 */
  static const char blown[] = "result.error{method.clock=euler}";
  static const struct {
    struct gx_paper_row row; /* value, printed, corrected, gate, reason */
    const char *verdict;
  } expected[] = {
      {{"", "", error, "1.0e-2", "", "5%", ""}, "matches"},
      {{"", "", error, "1.09e-2", "", "show", ""}, "matches"},
      {{"", "", error, "0.02", "", "show", ""}, "differs"}, /* half of it: no reason is asked for */
      {{"", "", error, "0.01", "", "5% of 1e-2", ""}, "matches"},
      {{"", "", error, "1.8e-2", "", "5% of 1e-2", ""}, "differs"},
      {{"", "", error, "1.8e-2", "", "factor 2 of 1e-2", ""}, "matches"},
      {{"", "", error, "1.5e-2", "", "5%", "known"}, "misses its gate"},
      {{"", "", error, "1", "1e-2", "5%", "misprint"}, "matches corrected"},
      {{"", "", error, "1", "2e-2", "5%", "misprint"}, "misses its gate"},
      {{"", "", error, "1", "2e-2", "show", "misprint"}, "differs"},
      {{"", "", error, "1", "", "show", ""}, "unexplained"},
      {{"", "", error, "1", "", "show", "other norm"}, "differs"},
      {{"", "", error, "", "", "below 0.1", ""}, "holds"},
      {{"", "", error, "", "", "above 0.1", ""}, "misses its gate"},
      {{"", "", error, "", "", "show", ""}, "shown"},
      {{"", "", error, "*", "", "show", ""}, "unexplained"},
      {{"", "", error, "*", "", "show", "dt"}, "differs"},
      {{"", "", blown, "*", "", "show", ""}, "matches"},
      {{"", "", blown, "1", "*", "show", "unstable"}, "matches corrected"},
      {{"", "", blown, "1", "", "show", ""}, "unexplained"},
      {{"", "", blown, "1", "", "show", "unstable"}, "differs"},
      {{"", "", blown, "1", "", "5%", "unstable"}, "misses its gate"},
      {{"", "", blown, "", "", "show", ""}, "unexplained"},
      {{"", "", "result.status{method.clock=euler}", "unstable", "", "show", ""}, "matches"},
      {{"", "", "result.status{time.dt=0.05}", "unstable", "", "show", "dt"}, "differs"},
      {{"", "", "result.status{time.dt=0.05}", "unstable", "", "show", ""}, "unexplained"},
      {{"", "", "result.nothing{time.dt=0.05}", "1", "", "5%", ""}, "invalid"},
      {{"", "", error, "1", "", "5 percent", ""}, "invalid"},
  };
  enum { ROWS = sizeof expected / sizeof *expected };
  struct gx_paper_row row[ROWS];
  size_t missed, should_miss = 0;
  for (size_t r = 0; r < ROWS; r++) {
    row[r] = expected[r].row;
    const char *verdict = expected[r].verdict;
    should_miss += !strcmp(verdict, "misses its gate") || !strcmp(verdict, "unexplained") || !strcmp(verdict, "invalid");
  }
  const struct gx_paper_item item = {.paper = "p", .item = "i", .run_file = "", .plot = "", .row = row, .rows = ROWS};
  struct gx_table *study = make_study(), *table = gx_paper_compare(&item, study, &missed);
  for (size_t r = 0; r < ROWS; r++) {
    const char *verdict = gx_table_get(table, r, (size_t)gx_table_find(table, "verdict")).text;
    CHECK(!strcmp(verdict, expected[r].verdict), "row %zu: %s printed '%s' corrected '%s' gate '%s': %s, not %s", r, row[r].value,
          row[r].printed, row[r].corrected, row[r].gate, verdict, expected[r].verdict);
  }
  assert_int_equal(missed, should_miss);
  CLOSE(gx_table_get(table, 2, (size_t)gx_table_find(table, "ratio")).real, 0.5, 1e-15);
  assert_string_equal(gx_table_get(table, 20, (size_t)gx_table_find(table, "reason")).text,
                      "unstable; our case ended unstable: too fast");
  gx_table_free(table);
  gx_table_free(study);
}

/* Every item reads as a run file, has rows, and a name of its own. */
static void items(void **state)
{
  (void)state;
  for (size_t i = 0; i < gx_paper_item_count; i++) {
    char name[GX_PAPER_NAME_LENGTH], other[GX_PAPER_NAME_LENGTH];
    gx_paper_name(&gx_paper_items[i], name);
    struct gx_study *study = gx_paper_study(&gx_paper_items[i], stderr);
    CHECK(study && *study->title && gx_paper_items[i].rows, "%s", name);
    gx_runfile_free(study);
    for (size_t k = 0; k < i; k++) {
      gx_paper_name(&gx_paper_items[k], other);
      CHECK(strcmp(name, other) != 0, "%s twice", name);
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(expressions), cmocka_unit_test(gates), cmocka_unit_test(verdicts),
                                     cmocka_unit_test(items)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
