/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The search itself: planted failures are found, shrink to the least case that is broken, and can be rerun from what is printed. */
#include "property.h"

#include <string.h>

static const char *const colours[] = {"red", "green", "blue", NULL};
static const struct property_choice choices[] = {{"count", 1, 1000, NULL},
                                                 {"colour", 0, 2, colours},
                                                 {"method.space", 0, 0, NULL},
                                                 {"other", 0, 50, NULL},
                                                 {NULL, 0, 0, NULL}};
enum { COUNT, COLOUR, SPACE, OTHER };

static enum property_verdict holds_below(const struct property *property, const int *value, struct property_finding *finding)
{
  (void)property;
  *finding = (struct property_finding){.measured = value[COUNT], .bound = 136};
  return value[COLOUR] < 1 ? PROPERTY_HOLDS : property_judge(finding);
}

static const struct property planted = {"a planted failure", choices, 100, 10, holds_below};

/* Broken from 137 on in green and blue: no smaller case is. */
static void a_planted_failure_shrinks_to_the_least(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    struct property_search search = property_search(&planted, seed, 100);
    const int least[] = {137, 1, 0, 0};
    assert_true(search.broken && search.drawn[COUNT] > 136);
    assert_memory_equal(search.shrunk, least, sizeof least);
    NEAR(search.of_shrunk.measured, 137, 0);
    NEAR(search.of_drawn.measured, search.drawn[COUNT], 0);
    assert_true(search.trials < 100); /* by halves, not one by one */
    int again[PROPERTY_CHOICES];
    property_draw(&planted, seed, search.cases - 1, again); /* the seed and the number give the case */
    assert_memory_equal(again, search.drawn, 4 * sizeof(int));
  }
}

/* A sum is broken along a diagonal: what is left cannot be lowered in any choice. */
static enum property_verdict holds_below_a_sum(const struct property *property, const int *value,
                                               struct property_finding *finding)
{
  (void)property;
  *finding = (struct property_finding){.measured = value[COUNT] + value[OTHER], .bound = 60};
  return property_judge(finding);
}

static void what_is_left_cannot_be_lowered(void **state)
{
  (void)state;
  const struct property sum = {"a sum", choices, 100, 1, holds_below_a_sum};
  struct property_search search = property_search(&sum, 5, 100);
  assert_true(search.broken);
  assert_int_equal(search.shrunk[COUNT] + search.shrunk[OTHER], 61);
  assert_int_equal(search.shrunk[COLOUR] + search.shrunk[SPACE], 0);
}

static enum property_verdict is_not_a_number(const struct property *property, const int *value, struct property_finding *finding)
{
  (void)property;
  finding->measured = value[COUNT] > 20 ? NAN : 0;
  return property_judge(finding);
}

static void not_a_number_breaks_a_bound(void **state)
{
  (void)state;
  const struct property nan = {"no number", choices, 100, 1, is_not_a_number};
  struct property_search search = property_search(&nan, 5, 100);
  assert_true(search.broken);
  assert_int_equal(search.shrunk[COUNT], 21);
}

static enum property_verdict is_silent_of_red(const struct property *property, const int *value, struct property_finding *finding)
{
  (void)property;
  (void)finding;
  return value[COLOUR] ? PROPERTY_HOLDS : PROPERTY_SILENT;
}

static void cases_are_counted(void **state)
{
  (void)state;
  const struct property sometimes = {"silence", choices, 300, 50, is_silent_of_red};
  struct property_search search = property_search(&sometimes, 9, 300);
  assert_false(search.broken);
  assert_int_equal(search.held + search.silent, 300);
  assert_in_range(search.silent, 60, 140);
}

static void what_is_printed_reads_back(void **state)
{
  (void)state;
  int value[PROPERTY_CHOICES], back[PROPERTY_CHOICES];
  char text[512];
  for (long k = 0; k < 200; k++) {
    property_draw(&planted, 3, k, value);
    property_print(&planted, value, text, sizeof text);
    assert_true(property_read(&planted, text, back));
    assert_memory_equal(back, value, 4 * sizeof(int));
  }
  const int spelt[] = {500, 2, 1, 0};
  assert_true(property_read(&planted, "a planted failure: count=500 colour=blue method.space=moving-mesh", back));
  assert_memory_equal(back, spelt, sizeof spelt);
  static const char *const wrong[] = {"another: count=5",
                                      "a planted failure: count=0",
                                      "a planted failure: count=5x",
                                      "a planted failure: colour=yellow",
                                      "a planted failure: size=5",
                                      "a planted failure: count"};
  for (int i = 0; i < 6; i++) CHECK(!property_read(&planted, wrong[i], back), "%s", wrong[i]);
}

/* Every value of a choice is drawn, names of parameters too. */
static void draws_reach_every_value(void **state)
{
  (void)state;
  int value[PROPERTY_CHOICES], low = 1000, high = 0;
  bool seen[16] = {false};
  for (long k = 0; k < 2000; k++) {
    property_draw(&planted, 4, k, value);
    low = value[COUNT] < low ? value[COUNT] : low;
    high = value[COUNT] > high ? value[COUNT] : high;
    assert_in_range(value[SPACE], 0, 15);
    seen[value[SPACE]] = true;
  }
  assert_true(low >= 1 && low < 10 && high > 990 && high <= 1000);
  for (int i = 0; property_text(&choices[SPACE], i); i++) assert_true(seen[i]);
  assert_string_equal(property_text(&choices[SPACE], 0), "standard");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_planted_failure_shrinks_to_the_least),
      cmocka_unit_test(what_is_left_cannot_be_lowered),
      cmocka_unit_test(not_a_number_breaks_a_bound),
      cmocka_unit_test(cases_are_counted),
      cmocka_unit_test(what_is_printed_reads_back),
      cmocka_unit_test(draws_reach_every_value),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
