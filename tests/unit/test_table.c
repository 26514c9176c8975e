/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables, values, and the columns of a study. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include <gridcross/study.h>

#include "check.h"

static struct gx_value integer(long i)
{
  return (struct gx_value){.type = GX_INTEGER, .integer = i};
}

static struct gx_value real(double x)
{
  return (struct gx_value){.type = GX_REAL, .real = x};
}

static struct gx_value text(const char *s)
{
  return (struct gx_value){.type = GX_TEXT, .text = s};
}

static void cells_start_null_and_keep_what_is_set(void **state)
{
  (void)state;
  struct gx_table *table = gx_table_create(2, 3);
  assert_int_equal(gx_table_column(table, 0, "a", "m", GX_REAL), 0);
  assert_int_equal(gx_table_column(table, 1, "b", "", GX_TEXT), 0);
  char word[] = "before";
  assert_int_equal(gx_table_set(table, 2, 1, text(word)), 0);
  memcpy(word, "after!", 6);
  assert_int_equal(gx_table_set(table, 1, 0, real(1.5)), 0);
  assert_int_equal(gx_table_get(table, 0, 0).type, GX_NULL);
  NEAR(gx_table_get(table, 1, 0).real, 1.5, 0);
  assert_string_equal(gx_table_get(table, 2, 1).text, "before");
  assert_int_equal(gx_table_find(table, "b"), 1);
  assert_int_equal(gx_table_find(table, "c"), -1);
  gx_table_free(table);
}

static void tables_beyond_memory_are_refused(void **state)
{
  (void)state;
  assert_null(gx_table_create(SIZE_MAX / 4, SIZE_MAX / 4));
}

static void columns_copy_with_their_texts(void **state)
{
  (void)state;
  struct gx_table *from = gx_table_create(2, 2), *to = gx_table_create(1, 2);
  gx_table_column(from, 0, "n", "", GX_INTEGER);
  gx_table_column(from, 1, "t", "s", GX_TEXT);
  gx_table_set(from, 0, 1, text("x"));
  assert_int_equal(gx_table_copy(to, 0, from, 1), 0);
  gx_table_free(from);
  assert_string_equal(to->column[0].name, "t");
  assert_string_equal(to->column[0].unit, "s");
  assert_string_equal(gx_table_get(to, 0, 0).text, "x");
  assert_int_equal(gx_table_get(to, 1, 0).type, GX_NULL);
  gx_table_free(to);
}

static void numbers_read_back_bit_for_bit(void **state)
{
  (void)state;
  char printed[GX_NUMBER_LENGTH];
  gx_value_real(0.1, printed);
  assert_string_equal(printed, "0.1");
  gx_value_real(0.1 + 0.2, printed);
  assert_string_equal(printed, "0.30000000000000004");
  gx_value_real(1e4, printed);
  assert_string_equal(printed, "10000");
  uint64_t bits = 88172645463325252u;
  for (int i = 0; i < 100000; i++) {
    bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
    double x, back;
    memcpy(&x, &bits, sizeof x);
    if (isnan(x)) continue;
    gx_value_real(x, printed);
    back = strtod(printed, NULL);
    assert_memory_equal(&x, &back, sizeof x);
  }
}

/* Against the first of %.15g to %.17g that reads back. */
static void prints_as_printf(double x)
{
  char printed[GX_NUMBER_LENGTH], expected[GX_NUMBER_LENGTH];
  int digits = 14;
  do snprintf(expected, sizeof expected, "%.*g", ++digits, x);
  while (digits < 17 && strtod(expected, NULL) != x);
  gx_value_real(x, printed);
  assert_string_equal(printed, expected);
}

/* Every magnitude, short numbers, and powers of two, whose neighbours are not equally far. */
static void numbers_print_as_printf_prints_them(void **state)
{
  (void)state;
  uint64_t bits = 88172645463325252u;
  for (int i = 0; i < 200000; i++) {
    bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
    double share = (double)(bits >> 11) * 0x1p-53;
    const double kinds[] = {share - 0.5, exp(-100 + 160 * share), ldexp(1, (int)(bits % 200) - 140),
                            nearbyint(1e6 * share) / 1000};
    char shortened[GX_NUMBER_LENGTH];
    snprintf(shortened, sizeof shortened, "%.*g", 1 + i % 17, kinds[i % 4]);
    prints_as_printf(i % 8 < 4 ? kinds[i % 4] : strtod(shortened, NULL));
  }
  const double edges[] = {0,      -0.0,  1,       -1, 1e15, 1e16, 1e17, 123456789012345, 1e-4, 1e-5, 9.9999999999999995e-5,
                          5e-324, 1e300, INFINITY};
  for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) prints_as_printf(edges[i]);
  const long integers[] = {0, 7, -1, 1000000, LONG_MAX, LONG_MIN};
  for (size_t i = 0; i < sizeof integers / sizeof *integers; i++) {
    char printed[GX_NUMBER_LENGTH], expected[GX_NUMBER_LENGTH];
    gx_value_integer(integers[i], printed);
    snprintf(expected, sizeof expected, "%ld", integers[i]);
    assert_string_equal(printed, expected);
  }
}

static void values_have_an_order(void **state)
{
  (void)state;
  struct gx_value null = {.type = GX_NULL};
  assert_true(gx_value_compare(null, integer(-5)) < 0);
  assert_true(gx_value_compare(integer(2), real(2.5)) < 0);
  assert_true(gx_value_compare(integer(9), integer(10)) < 0);
  assert_true(gx_value_compare(real(1e9), text("")) < 0);
  assert_true(gx_value_compare(text("b"), text("a")) > 0);
  assert_int_equal(gx_value_compare(null, null), 0);
  assert_int_equal(gx_value_compare(integer(2), real(2)), 0);
}

static void numbers_become_values_and_back(void **state)
{
  (void)state;
  struct gx_value half = gx_value_from(0.5);
  assert_int_equal(half.type, GX_REAL);
  assert_true(gx_value_number(half) == 0.5);
  assert_true(gx_value_number(integer(7)) == 7);
  assert_int_equal(gx_value_from(NAN).type, GX_NULL);
  assert_int_equal(gx_value_from(-INFINITY).type, GX_NULL);
  assert_true(isnan(gx_value_number(gx_value_from(NAN))));
  assert_true(isnan(gx_value_number(text("0.5"))));
}

/* The columns after the parameters, as scripts know them. */
static const char *const result_columns[] = {
    "result.status",
    "result.reason",
    "result.particle",
    "result.dt",
    "result.steps",
    "result.time",
    "result.crossings",
    "result.displacement.final.inf",
    "result.displacement.final.rms",
    "result.displacement.final.l2n",
    "result.displacement.max.inf",
    "result.displacement.max.rms",
    "result.displacement.max.l2n",
    "result.velocity.final.inf",
    "result.velocity.final.rms",
    "result.velocity.final.l2n",
    "result.velocity.max.inf",
    "result.velocity.max.rms",
    "result.velocity.max.l2n",
    "result.stress.final.inf",
    "result.stress.final.rms",
    "result.stress.final.l2n",
    "result.stress.max.inf",
    "result.stress.max.rms",
    "result.stress.max.l2n",
    "result.energy.defect",
    "result.energy.drift",
    "result.momentum.linear",
    "result.momentum.angular",
    "result.restitution",
    "result.displacement.reference.inf",
    "result.displacement.reference.rms",
    "result.displacement.reference.l2n",
    "result.velocity.reference.inf",
    "result.velocity.reference.rms",
    "result.velocity.reference.l2n",
    "result.stress.reference.inf",
    "result.stress.reference.rms",
    "result.stress.reference.l2n",
    "result.jump.final.inf",
    "result.jump.final.rms",
    "result.jump.final.l2n",
    "result.jump.max.inf",
    "result.jump.max.rms",
    "result.jump.max.l2n",
    "result.jump.last",
    "result.jump.estimate",
    "result.probe.particle",
    "result.probe.acceleration_change",
    "result.probe.displacement.max",
    "result.spectrum.displacement.below",
    "result.spectrum.displacement.above",
    "result.spectrum.displacement.driven",
    "result.spectrum.displacement.growth",
    "result.spectrum.velocity.below",
    "result.spectrum.velocity.above",
    "result.spectrum.velocity.driven",
    "result.spectrum.velocity.growth",
    "result.spectrum.stress.below",
    "result.spectrum.stress.above",
    "result.spectrum.stress.driven",
    "result.spectrum.stress.growth",
    "result.frequency",
    "result.frequency.ratio",
    "result.frequency.error",
    "result.frequency.growth",
    "result.frequency.kh",
    "result.budget.velocity.step",
    "result.budget.velocity.sum",
    "result.budget.velocity.time",
    "result.budget.velocity.interpolation",
    "result.budget.velocity.lumping",
    "result.budget.velocity.projection",
    "result.budget.velocity.quadrature",
    "result.budget.velocity.gradient",
    "result.budget.velocity.rest",
    "result.budget.displacement.step",
    "result.budget.displacement.sum",
    "result.budget.displacement.time",
    "result.budget.displacement.interpolation",
    "result.budget.displacement.lumping",
    "result.budget.displacement.projection",
    "result.budget.displacement.rest",
    "result.budget.displacement.jump",
    "result.budget.inf.acceleration",
    "result.budget.inf.velocity",
    "result.budget.inf.gradient",
    "result.budget.l2.projected",
    "result.budget.l2.force",
    "result.budget.l2.method",
    "result.budget.l2.velocity",
    "result.budget.l2.increment",
    "result.budget.l2.time",
    "result.quadrature.left_cells",
    "result.stable_dt",
    "result.seconds",
    "result.ns_per_particle_step",
};

enum { RESULTS = sizeof result_columns / sizeof *result_columns };

static struct gx_result ended(enum gx_status status)
{
  struct gx_result result = {.outcome = {.status = status, .particle = status == GX_OK ? -1 : 7},
                             .dt = 0.5,
                             .steps = 3,
                             .time = 1.5,
                             .seconds = 2,
                             .ns_per_particle_step = 40};
  if (status != GX_OK) strcpy(result.outcome.reason, "because");
  struct gx_measured *measured = &result.measured;
  for (int q = 0; q < GX_QUANTITIES; q++)
    for (int n = 0; n < GX_NORMS; n++) {
      measured->last.error[q][n] = 10 * q + n;
      measured->max_error[q][n] = 100 + 10 * q + n;
    }
  measured->last.crossings = 12;
  measured->max_defect = 0.25;
  measured->drift = NAN;
  return result;
}

static struct gx_value find(const struct gx_table *table, size_t row, const char *name)
{
  long c = gx_table_find(table, name);
  assert_true(c >= 0);
  return gx_table_get(table, row, (size_t)c);
}

static void a_study_has_the_columns_that_scripts_know(void **state)
{
  (void)state;
  struct gx_case cases[3] = {{.id = "a"}, {.id = "b"}, {.id = "c"}};
  cases[1].value[GX_MESH_CELLS] = integer(64);
  struct gx_study study = {.cases = cases, .count = 3};
  struct gx_result results[3] = {ended(GX_OK), ended(GX_LEFT_DOMAIN), ended(GX_REFUSED)};
  struct gx_table *table = gx_study_table(&study, results, true);
  assert_int_equal(table->columns, 1 + GX_PARAMETERS + RESULTS);
  assert_string_equal(table->column[0].name, "case");
  for (int p = 0; p < GX_PARAMETERS; p++) assert_string_equal(table->column[1 + p].name, gx_parameters[p].path);
  for (int r = 0; r < RESULTS; r++) assert_string_equal(table->column[1 + GX_PARAMETERS + r].name, result_columns[r]);
  assert_string_equal(find(table, 1, "case").text, "b");
  assert_int_equal(find(table, 1, "mesh.cells").integer, 64);
  assert_string_equal(find(table, 0, "result.status").text, "ok");
  assert_int_equal(find(table, 0, "result.reason").type, GX_NULL);
  assert_int_equal(find(table, 0, "result.particle").type, GX_NULL);
  assert_int_equal(find(table, 0, "result.steps").integer, 3);
  NEAR(find(table, 0, "result.velocity.final.rms").real, 11, 0);
  NEAR(find(table, 0, "result.stress.max.l2n").real, 122, 0);
  NEAR(find(table, 0, "result.energy.defect").real, 0.25, 0);
  assert_int_equal(find(table, 0, "result.energy.drift").type, GX_NULL);
  NEAR(find(table, 0, "result.ns_per_particle_step").real, 40, 0);
  gx_table_free(table);
  table = gx_study_table(&study, results, false);
  assert_int_equal(table->columns, 1 + GX_PARAMETERS + RESULTS - 2);
  gx_table_free(table);
}

static void a_case_that_did_not_end_well_has_no_errors(void **state)
{
  (void)state;
  struct gx_case cases[2] = {{.id = "a"}, {.id = "b"}};
  struct gx_study study = {.cases = cases, .count = 2};
  struct gx_result results[2] = {ended(GX_LEFT_DOMAIN), ended(GX_REFUSED)};
  struct gx_table *table = gx_study_table(&study, results, false);
  assert_string_equal(find(table, 0, "result.status").text, "left-domain");
  assert_string_equal(find(table, 0, "result.reason").text, "because");
  assert_int_equal(find(table, 0, "result.particle").integer, 7);
  assert_int_equal(find(table, 0, "result.steps").integer, 3);
  assert_int_equal(find(table, 0, "result.crossings").integer, 12);
  NEAR(find(table, 0, "result.time").real, 1.5, 0);
  assert_int_equal(find(table, 1, "result.steps").type, GX_NULL);
  assert_int_equal(find(table, 1, "result.dt").type, GX_NULL);
  for (size_t row = 0; row < 2; row++)
    for (int r = 0; r < RESULTS - 2; r++)
      if (strstr(result_columns[r], ".final.") || strstr(result_columns[r], ".max.") || strstr(result_columns[r], "energy") ||
          strstr(result_columns[r], "momentum") || strstr(result_columns[r], "spectrum") ||
          strstr(result_columns[r], "frequency"))
        assert_int_equal(find(table, row, result_columns[r]).type, GX_NULL);
  gx_table_free(table);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cells_start_null_and_keep_what_is_set),
      cmocka_unit_test(numbers_become_values_and_back),
      cmocka_unit_test(tables_beyond_memory_are_refused),
      cmocka_unit_test(columns_copy_with_their_texts),
      cmocka_unit_test(numbers_read_back_bit_for_bit),
      cmocka_unit_test(numbers_print_as_printf_prints_them),
      cmocka_unit_test(values_have_an_order),
      cmocka_unit_test(a_study_has_the_columns_that_scripts_know),
      cmocka_unit_test(a_case_that_did_not_end_well_has_no_errors),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
