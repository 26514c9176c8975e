/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Teams of threads: every part is done once, by workers that are told apart, for any number of threads and parts. */
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

#include "../check.h"
#include "core/team.h"

enum { MOST_PARTS = 37, MOST_THREADS = 5, ROUNDS = 300 };

struct count {
  atomic_int done[MOST_PARTS];
  atomic_int inside[MOST_THREADS]; /* parts that a worker is at */
  atomic_int clashes;
};

static void count_part(void *context, size_t part, size_t worker)
{
  struct count *count = context;
  if (atomic_fetch_add(&count->inside[worker], 1)) atomic_fetch_add(&count->clashes, 1);
  atomic_fetch_add(&count->done[part], 1);
  atomic_fetch_sub(&count->inside[worker], 1);
}

static void test_every_part_is_done_once(void **unused)
{
  (void)unused;
  for (size_t threads = 1; threads <= MOST_THREADS; threads++) {
    struct gx_team *team = gx_team_create(threads);
    assert_int_equal(gx_team_size(team), threads);
    struct count count = {0};
    for (size_t round = 0; round < ROUNDS; round++) gx_team_run(team, round % (MOST_PARTS + 1), count_part, &count);
    for (size_t part = 0; part < MOST_PARTS; part++) {
      int expected = 0;
      for (size_t round = 0; round < ROUNDS; round++) expected += part < round % (MOST_PARTS + 1);
      assert_int_equal(atomic_load(&count.done[part]), expected);
    }
    assert_int_equal(atomic_load(&count.clashes), 0);
    gx_team_free(team);
  }
}

/* What a task writes is there when gx_team_run returns, and what the caller wrote before is there in a task. */
struct chain {
  double value[MOST_PARTS];
  double scale;
};

static void add_scale(void *context, size_t part, size_t worker)
{
  (void)worker;
  struct chain *chain = context;
  chain->value[part] += chain->scale;
}

static void test_memory_is_passed_on(void **unused)
{
  (void)unused;
  struct gx_team *team = gx_team_create(3);
  struct chain chain = {0};
  for (int round = 1; round <= ROUNDS; round++) {
    chain.scale = round;
    gx_team_run(team, MOST_PARTS, add_scale, &chain);
    for (size_t part = 0; part < MOST_PARTS; part++) assert_true(chain.value[part] == round * (round + 1) / 2);
  }
  gx_team_free(team);
}

static void burn(void *context, size_t part, size_t worker)
{
  (void)part, (void)worker;
  volatile double *sum = context;
  for (int i = 0; i < 2000000; i++) sum[8 * part] += 1;
}

/* The other threads' time is counted; the caller's is its own to read. */
static void test_time_of_helpers_is_counted(void **unused)
{
  (void)unused;
  static double sum[8 * MOST_PARTS];
  struct gx_team *team = gx_team_create(2);
  assert_true(gx_team_seconds(team) == 0);
  for (int round = 0; round < 100 && gx_team_seconds(team) == 0; round++) gx_team_run(team, MOST_PARTS, burn, sum);
  assert_true(gx_team_seconds(team) > 0);
  gx_team_free(team);
  assert_true(gx_team_seconds(NULL) == 0);
  assert_int_equal(gx_team_size(NULL), 1);
}

static void test_bounds_cover(void **unused)
{
  (void)unused;
  for (size_t n = 0; n < 300; n++)
    for (size_t parts = 1; parts < 20; parts++) {
      assert_int_equal(gx_team_bound(n, parts, 0), 0);
      assert_int_equal(gx_team_bound(n, parts, parts), n);
      for (size_t part = 0; part < parts; part++) {
        size_t from = gx_team_bound(n, parts, part), to = gx_team_bound(n, parts, part + 1);
        assert_true(from <= to && (from % 8 == 0 || from == n));
        assert_true(to - from <= n / parts + 16);
      }
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_every_part_is_done_once),
      cmocka_unit_test(test_memory_is_passed_on),
      cmocka_unit_test(test_time_of_helpers_is_counted),
      cmocka_unit_test(test_bounds_cover),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
