/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running a study: its sink is told of every case that was asked for, once, until it fails or somebody cancels. */
#include <stdlib.h>

#include <gridcross/study.h>

#include "../check.h"

enum { CASES = 7 };

static const char *const seven = "problem: {name: bar-linear}\nmesh: {cells: [4, 5, 6, 7, 8, 9, 10]}\n";
/* case 0 is done at once, case 1 not within a year */
static const char *const endless = "problem: {name: bar-linear}\nmesh: {cells: 4}\ntime: {dt: 1e-6, steps: [1, 1000000000000]}\n"
                                   "output: {measures: final}\n";

struct seen {
  atomic_int times[CASES];
  double steps[CASES];
  int fail_at;         /* index whose result is refused */
  atomic_bool *cancel; /* set when told of a case; NULL: nobody does */
};

static int look(void *context, size_t index, struct gx_result *result)
{
  struct seen *seen = context;
  atomic_fetch_add(&seen->times[index], 1);
  seen->steps[index] = result->steps;
  if (seen->cancel) atomic_store(seen->cancel, true);
  return (int)index == seen->fail_at ? -1 : 0;
}

struct told {
  size_t calls, last, total;
};

static void count(void *context, size_t done, size_t total)
{
  struct told *told = context;
  told->calls++;
  assert_int_equal(done, told->last + 1);
  told->last = done;
  told->total = total;
}

static struct gx_study *study_of(const char *text)
{
  struct gx_study *study = gx_runfile_parse("test", text, stderr);
  assert_non_null(study);
  return study;
}

static void test_every_case_is_told_once(void **unused)
{
  (void)unused;
  struct gx_study *study = study_of(seven);
  for (size_t threads = 1; threads <= 3; threads++) {
    struct seen seen = {.fail_at = -1};
    assert_int_equal(gx_study_run(study, &(struct gx_study_means){.threads = threads, .sink = {&seen, look}}), 0);
    for (int i = 0; i < CASES; i++) CHECK(seen.times[i] == 1 && seen.steps[i] > 0, "case %d, %zu threads", i, threads);
  }
  gx_runfile_free(study);
}

static void test_what_is_skipped_is_not_run(void **unused)
{
  (void)unused;
  struct gx_study *study = study_of(seven);
  const bool skip[CASES] = {true, false, true, true, false, false, true}, all[CASES] = {1, 1, 1, 1, 1, 1, 1};
  struct seen seen = {.fail_at = -1};
  struct told told = {0};
  const struct gx_progress progress = {&told, count};
  struct gx_study_means means = {.threads = 2, .sink = {&seen, look}, .progress = &progress, .skip = skip};
  assert_int_equal(gx_study_run(study, &means), 0);
  for (int i = 0; i < CASES; i++) CHECK(seen.times[i] == !skip[i], "case %d", i);
  assert_int_equal(told.calls, 3);
  assert_int_equal(told.total, 3);
  means.skip = all;
  assert_int_equal(gx_study_run(study, &means), 0);
  assert_int_equal(told.calls, 3);
  gx_runfile_free(study);
}

static void test_an_array_keeps_what_results_own(void **unused)
{
  (void)unused;
  struct gx_study *study = study_of("problem: {name: bar-linear}\nmesh: {cells: [4, 5]}\noutput: {histories: 1, spectra: 1}\n");
  struct gx_result *results = calloc(study->count, sizeof *results);
  assert_int_equal(gx_study_run(study, &(struct gx_study_means){.threads = 2, .sink = gx_sink_array(results)}), 0);
  for (size_t i = 0; i < study->count; i++) {
    CHECK((double)results[i].history.samples == results[i].steps + 1, "case %zu", i);
    CHECK(results[i].spectra.rms[0] >= 0 && results[i].spectra.time[1] > 0, "case %zu", i);
    gx_case_free(&results[i]);
  }
  free(results);
  gx_runfile_free(study);
}

/* However many threads there are: a long case under way ends, too. */
static void test_a_sink_that_fails_ends_the_run(void **unused)
{
  (void)unused;
  struct gx_study *study = study_of(endless);
  for (size_t threads = 1; threads <= 2; threads++) {
    struct seen seen = {.fail_at = 0};
    assert_int_equal(gx_study_run(study, &(struct gx_study_means){.threads = threads, .sink = {&seen, look}}), -1);
    assert_int_equal(seen.times[0], 1);
    assert_int_equal(seen.times[1], 0);
  }
  gx_runfile_free(study);
}

static void test_a_run_can_be_cancelled(void **unused)
{
  (void)unused;
  struct gx_study *study = study_of(endless);
  atomic_bool cancel = false;
  struct seen seen = {.fail_at = -1, .cancel = &cancel};
  struct gx_study_means means = {.threads = 2, .sink = {&seen, look}, .cancel = &cancel};
  assert_int_equal(gx_study_run(study, &means), -1);
  assert_int_equal(seen.times[0], 1);
  assert_int_equal(seen.times[1], 0);
  assert_int_equal(gx_study_run(study, &means), -1); /* from the start: nothing is run */
  assert_int_equal(seen.times[0], 1);
  gx_runfile_free(study);
}

static void takes(struct gx_queue *queue, size_t index, double share)
{
  const struct gx_source source = gx_queue_source(queue);
  size_t taken = SIZE_MAX;
  double its_share = -1;
  assert_true(source.take(source.context, &taken, &its_share));
  assert_int_equal(taken, index);
  NEAR(its_share, share, 1e-12);
}

/* 1-D, a clock of one stage, as many steps as cells: the cost goes with the square of the cells. */
static void test_the_longest_case_is_begun_first(void **unused)
{
  (void)unused;
  struct gx_study *study = study_of("problem: {name: bar-linear}\nmesh: {cells: [4, 8, 16, 8]}\nzip: [mesh.cells, time.dt]\n"
                                    "time: {dt: [1e-3, 5e-4, 2.5e-4, 5.0001e-4], end: 0.1, landing: past}\n");
  const bool skip[] = {false, false, false, true};
  struct gx_queue *queue = gx_queue_create(study, skip, true);
  assert_int_equal(gx_queue_count(queue), 3);
  takes(queue, 2, 16. / 21);
  takes(queue, 1, 4. / 5);
  takes(queue, 0, 1);
  size_t index;
  double share;
  const struct gx_source source = gx_queue_source(queue);
  assert_false(source.take(source.context, &index, &share));
  gx_queue_free(queue);
  queue = gx_queue_create(study, NULL, false);
  for (size_t i = 0; i < 4; i++) takes(queue, i, 1. / (double)(4 - i));
  gx_queue_free(queue);
  gx_runfile_free(study);
}

/* Cases of equal cost in the order of the study; methods that cost more a step first. */
static void test_equal_cases_keep_their_order(void **unused)
{
  (void)unused;
  struct gx_study *study = study_of("problem: {name: bar-neo-hookean, amplitude: [0.01, 0.02]}\nmesh: {cells: 8}\n"
                                    "method: {space: [moving-mesh, standard], mass: [lumped, consistent]}\n");
  struct gx_queue *queue = gx_queue_create(study, NULL, true);
  const struct gx_source source = gx_queue_source(queue);
  const size_t order[] = {3, 7, 2, 6, 1, 5, 0, 4};
  for (size_t i = 0; i < 8; i++) {
    size_t index = 99;
    double share;
    assert_true(source.take(source.context, &index, &share));
    CHECK(index == order[i], "at %zu: %zu", i, index);
  }
  gx_queue_free(queue);
  gx_runfile_free(study);
}

/* Of a source with two of seven cases these are run, however many threads there are. */
static void test_a_source_says_which_cases_are_run(void **unused)
{
  (void)unused;
  struct gx_study *study = study_of(seven);
  for (size_t threads = 1; threads <= 4; threads++) {
    const bool skip[CASES] = {true, false, true, true, true, false, true};
    struct gx_queue *queue = gx_queue_create(study, skip, true);
    const struct gx_source source = gx_queue_source(queue);
    struct seen seen = {.fail_at = -1};
    assert_int_equal(gx_study_run(study, &(struct gx_study_means){.threads = threads, .sink = {&seen, look}, .source = &source}),
                     0);
    for (int i = 0; i < CASES; i++) CHECK(seen.times[i] == !skip[i], "case %d", i);
    gx_queue_free(queue);
  }
  gx_runfile_free(study);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_every_case_is_told_once),         cmocka_unit_test(test_what_is_skipped_is_not_run),
      cmocka_unit_test(test_an_array_keeps_what_results_own), cmocka_unit_test(test_a_sink_that_fails_ends_the_run),
      cmocka_unit_test(test_a_run_can_be_cancelled),          cmocka_unit_test(test_the_longest_case_is_begun_first),
      cmocka_unit_test(test_equal_cases_keep_their_order),    cmocka_unit_test(test_a_source_says_which_cases_are_run),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
