/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which term of a budget is named the largest, and which the next. */
#include <gridcross/budget.h>

#include "check.h"

static void terms(struct gx_budget_values *values, enum gx_budget_entry of, enum gx_budget_entry largest,
                  enum gx_budget_entry next)
{
  enum gx_budget_entry second;
  assert_int_equal(gx_budget_dominant(values, of, &second), largest);
  assert_int_equal(second, next);
}

static void the_largest_term_is_named(void **state)
{
  (void)state;
  struct gx_budget_values values = {0};
  terms(&values, GX_BUDGET_VELOCITY_STEP, GX_BUDGET_ENTRIES, GX_BUDGET_ENTRIES);
  terms(&values, GX_BUDGET_DISPLACEMENT_STEP, GX_BUDGET_ENTRIES, GX_BUDGET_ENTRIES);
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++) values.value[i] = NAN; /* not measured */
  terms(&values, GX_BUDGET_VELOCITY_STEP, GX_BUDGET_ENTRIES, GX_BUDGET_ENTRIES);
  values.value[GX_BUDGET_VELOCITY_STEP] = values.value[GX_BUDGET_VELOCITY_SUM] = 9; /* no terms */
  values.value[GX_BUDGET_DISPLACEMENT_STEP] = values.value[GX_BUDGET_DISPLACEMENT_SUM] = 9;
  values.value[GX_BUDGET_DISPLACEMENT_JUMP] = 8;
  values.value[GX_BUDGET_VELOCITY_REST] = 1e-9;
  terms(&values, GX_BUDGET_VELOCITY_STEP, GX_BUDGET_VELOCITY_REST, GX_BUDGET_ENTRIES);
  terms(&values, GX_BUDGET_DISPLACEMENT_STEP, GX_BUDGET_ENTRIES, GX_BUDGET_ENTRIES);
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++)
    if (isnan(values.value[i])) values.value[i] = 0;
  for (int first = GX_BUDGET_VELOCITY_TIME; first <= GX_BUDGET_VELOCITY_REST; first++)
    for (int second = GX_BUDGET_VELOCITY_TIME; second <= GX_BUDGET_VELOCITY_REST; second++) {
      if (second == first) continue;
      for (int i = GX_BUDGET_VELOCITY_TIME; i <= GX_BUDGET_VELOCITY_REST; i++)
        values.value[i] = i == first ? 3 : i == second ? 2 : 1;
      terms(&values, GX_BUDGET_VELOCITY_STEP, (enum gx_budget_entry)first, (enum gx_budget_entry)second);
    }
  values.value[GX_BUDGET_DISPLACEMENT_TIME] = 2;
  values.value[GX_BUDGET_DISPLACEMENT_REST] = 3;
  terms(&values, GX_BUDGET_DISPLACEMENT_STEP, GX_BUDGET_DISPLACEMENT_REST, GX_BUDGET_DISPLACEMENT_TIME);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_largest_term_is_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
