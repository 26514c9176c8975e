/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparisons: axes, cells and orders computed by hand. */
#include <stdlib.h>
#include <string.h>

#include <gridcross/compare.h>

#include "check.h"

enum { COLUMNS = 8 };

static const char *const names[COLUMNS] = {"case",    "mesh.cells",    "method.space",     "method.projection",
                                           "time.dt", "result.status", "result.crossings", "result.displacement.max.rms"};
static const enum gx_type types[COLUMNS] = {GX_TEXT, GX_INTEGER, GX_TEXT, GX_TEXT, GX_REAL, GX_TEXT, GX_INTEGER, GX_REAL};

struct line {
  const char *id;
  long cells;
  const char *space;
  double dt;
  const char *status;
  long crossings;
  double error;
};

/* The projection follows from the space, as defaults do. */
static struct gx_table *make(size_t rows, const struct line *line)
{
  struct gx_table *table = gx_table_create(COLUMNS, rows);
  for (size_t c = 0; c < COLUMNS; c++) gx_table_column(table, c, names[c], c == 7 ? "m" : "", types[c]);
  for (size_t r = 0; r < rows; r++) {
    const char *projection = !strcmp(line[r].space, "standard") ? "each-step" : "once";
    const struct gx_value value[COLUMNS] = {{.type = GX_TEXT, .text = line[r].id},
                                            {.type = GX_INTEGER, .integer = line[r].cells},
                                            {.type = GX_TEXT, .text = line[r].space},
                                            {.type = GX_TEXT, .text = projection},
                                            {.type = GX_REAL, .real = line[r].dt},
                                            {.type = GX_TEXT, .text = line[r].status},
                                            {.type = GX_INTEGER, .integer = line[r].crossings},
                                            {.type = isnan(line[r].error) ? GX_NULL : GX_REAL, .real = line[r].error}};
    for (size_t c = 0; c < COLUMNS; c++) gx_table_set(table, r, c, value[c]);
  }
  return table;
}

/* Out of order on purpose: 1/4 of the error at half the cell width is order 2, 1/27 at a third is order 3. */
static const struct line refinement[] = {
    {"a", 16, "standard", 0.1, "ok", 5, 2.5e-3},    {"b", 8, "standard", 0.1, "ok", 3, 1e-2},
    {"c", 48, "standard", 0.1, "unstable", 9, NAN}, {"d", 8, "moving-mesh", 0.1, "ok", 0, 2.7e-3},
    {"e", 24, "moving-mesh", 0.1, "ok", 0, 1e-4},   {"f", 48, "moving-mesh", 0.1, "ok", 0, 1e-4},
};

static char *printed(const struct gx_comparison *comparison, int *failed, char **message)
{
  char *text;
  size_t length, message_length;
  FILE *out = open_memstream(&text, &length), *errors = open_memstream(message, &message_length);
  *failed = gx_compare_print(comparison, &(struct gx_page){0}, out, errors);
  fclose(out);
  fclose(errors);
  return text;
}

static void a_table_reads_as_expected(void **state)
{
  (void)state;
  struct gx_table *table = make(6, refinement);
  const struct gx_table *const tables[] = {table};
  const char *const name[] = {"s"}, *const value[] = {"result.displacement.max.rms", "result.crossings"};
  struct gx_comparison comparison = {.studies = 1, .table = tables, .name = name, .values = 2, .value = value};
  int failed;
  char *message, *text = printed(&comparison, &failed, &message);
  assert_string_equal(message, "");
  assert_int_equal(failed, 0);
  assert_string_equal(text, "result.displacement.max.rms [m], * the least of its row\n"
                            "\n"
                            "             standard          moving-mesh\n"
                            "mesh.cells             order             order\n"
                            "         8    1.00e-2           2.70e-3*\n"
                            "        16    2.50e-3   2.00\n"
                            "        24                      1.00e-4   3.00\n"
                            "        48   unstable           1.00e-4   0.00\n"
                            "\n"
                            "result.crossings\n"
                            "\n"
                            "mesh.cells      standard   moving-mesh\n"
                            "         8             3             0\n"
                            "        16             5\n"
                            "        24                           0\n"
                            "        48      unstable             0\n");
  free(text);
  free(message);
  gx_table_free(table);
}

/* On a terminal the mark takes no room; a page that holds one column puts them below each other. */
static void the_best_is_bold_on_a_narrow_terminal(void **state)
{
  (void)state;
  struct gx_table *table = make(6, refinement);
  const struct gx_table *const tables[] = {table};
  const char *const name[] = {"s"};
  struct gx_comparison comparison = {.studies = 1, .table = tables, .name = name};
  char *text;
  size_t length;
  FILE *out = open_memstream(&text, &length);
  assert_int_equal(gx_compare_print(&comparison, &(struct gx_page){.width = 30, .attributes = true}, out, stderr), 0);
  fclose(out);
  assert_string_equal(text, "result.displacement.max.rms [m], the least of each row \033[1mbold\033[0m\n"
                            "\n"
                            "             standard\n"
                            "mesh.cells            order\n"
                            "         8    1.00e-2\n"
                            "        16    2.50e-3  2.00\n"
                            "        24\n"
                            "        48   unstable\n"
                            "\n"
                            "             moving-mesh\n"
                            "mesh.cells            order\n"
                            "         8    \033[1m2.70e-3\033[0m\n"
                            "        16\n"
                            "        24    1.00e-4  3.00\n"
                            "        48    1.00e-4  0.00\n");
  free(text);
  gx_table_free(table);
}

static double order_of(const struct gx_table *table, size_t row)
{
  long c = gx_table_find(table, "result.displacement.max.rms.order");
  assert_true(c >= 0);
  struct gx_value value = gx_table_get(table, row, (size_t)c);
  return value.type == GX_NULL ? NAN : value.real;
}

static void steps_in_time_refine_downwards(void **state)
{
  (void)state;
  /* error 3 dt^2, then 3 dt^2 / 2^0.5 for half the step: orders 2 and 2.5 */
  const struct line line[] = {{"a", 8, "standard", 0.05, "ok", 0, 7.5e-3},
                              {"b", 8, "standard", 0.1, "ok", 0, 3e-2},
                              {"c", 8, "standard", 0.025, "ok", 0, 1.3258252147247767e-3}};
  struct gx_table *table = make(3, line);
  const struct gx_table *const tables[] = {table};
  const char *const name[] = {"s"};
  struct gx_comparison comparison = {.studies = 1, .table = tables, .name = name};
  struct gx_table *result = gx_compare_table(&comparison, stderr);
  assert_non_null(result);
  assert_int_equal(result->rows, 3);
  assert_string_equal(result->column[0].name, "time.dt");
  NEAR(gx_table_get(result, 0, 0).real, 0.1, 0);
  NEAR(gx_table_get(result, 2, 0).real, 0.025, 0);
  assert_true(isnan(order_of(result, 0)));
  NEAR(order_of(result, 1), 2, 1e-12);
  NEAR(order_of(result, 2), 2.5, 1e-12);
  gx_table_free(result);
  gx_table_free(table);
}

static void text_rows_have_no_orders(void **state)
{
  (void)state;
  struct gx_table *table =
      make(2, (const struct line[]){{"a", 8, "standard", 0.1, "ok", 0, 1}, {"b", 8, "moving-mesh", 0.1, "ok", 0, 2}});
  const struct gx_table *const tables[] = {table};
  const char *const name[] = {"s"};
  struct gx_comparison comparison = {.studies = 1, .table = tables, .name = name};
  struct gx_table *result = gx_compare_table(&comparison, stderr);
  assert_string_equal(result->column[0].name, "method.space");
  assert_int_equal(gx_table_find(result, "result.displacement.max.rms.order"), -1);
  gx_table_free(result);
  gx_table_free(table);
}

static void studies_join_and_are_told_apart_where_needed(void **state)
{
  (void)state;
  struct gx_table *coarse = make(2, refinement), *other = make(2, refinement), *fine = make(1, refinement + 2);
  const char *const name[] = {"one", "two"};
  const struct gx_table *const disjoint[] = {coarse, fine}, *const equal[] = {coarse, other};
  struct gx_comparison comparison = {.studies = 2, .table = disjoint, .name = name};
  struct gx_table *result = gx_compare_table(&comparison, stderr);
  assert_int_equal(result->rows, 3);
  assert_int_equal(gx_table_find(result, "study"), -1);
  gx_table_free(result);
  comparison.table = equal;
  result = gx_compare_table(&comparison, stderr);
  assert_int_equal(result->rows, 4);
  assert_int_equal(gx_table_find(result, "study"), 1);
  assert_string_equal(gx_table_get(result, 1, 1).text, "two");
  NEAR(order_of(result, 3), 2, 1e-12);
  gx_table_free(result);
  const char *const same[] = {"one", "one"};
  comparison.name = same;
  FILE *quiet = tmpfile();
  assert_null(gx_compare_table(&comparison, quiet));
  fclose(quiet);
  gx_table_free(coarse);
  gx_table_free(other);
  gx_table_free(fine);
}

static void expect_error(struct gx_comparison comparison, const char *expected)
{
  int failed;
  char *message, *text = printed(&comparison, &failed, &message);
  assert_int_equal(failed, -1);
  assert_string_equal(text, "");
  assert_string_equal(message, expected);
  free(text);
  free(message);
}

static void wrong_names_are_answered(void **state)
{
  (void)state;
  struct gx_table *table = make(6, refinement);
  const struct gx_table *const tables[] = {table};
  const char *const name[] = {"s"}, *const cells[] = {"mesh.cells"}, *const crossing[] = {"result.crosings"},
                    *const far[] = {"xyzzy"};
  struct gx_comparison all = {.studies = 1, .table = tables, .name = name}, one = all;
  one.rows = "cells";
  expect_error(one, "gridcross: no parameter 'cells': did you mean mesh.cells?; what varies here: mesh.cells, method.space, "
                    "method.projection\n");
  one = all;
  one.rows = "time.dt";
  one.columns = 1;
  one.column = cells;
  expect_error(one, "gridcross: method.space varies too: add --columns method.space, or leave out --columns\n");
  one.rows = "mesh.cells";
  expect_error(one, "gridcross: mesh.cells cannot be both rows and columns\n");
  one = all;
  one.values = 1;
  one.value = crossing;
  expect_error(one, "gridcross: no column 'result.crosings': did you mean result.crossings?\n");
  one.value = far;
  expect_error(one, "gridcross: no column 'xyzzy'; the first line of the study's table.csv names all\n");
  gx_table_free(table);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_table_reads_as_expected),
      cmocka_unit_test(the_best_is_bold_on_a_narrow_terminal),
      cmocka_unit_test(steps_in_time_refine_downwards),
      cmocka_unit_test(text_rows_have_no_orders),
      cmocka_unit_test(studies_join_and_are_told_apart_where_needed),
      cmocka_unit_test(wrong_names_are_answered),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
