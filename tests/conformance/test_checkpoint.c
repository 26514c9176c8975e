/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whole cases that go on from a checkpoint: results, histories, spectra and snapshots have the bits of a run that was never stopped,
 * and keeping checkpoints changes none; every space with every clock, with each measure. */
#include <gsl/gsl_errno.h>

#include "case_of.h"
#include "image_of.h"

enum { MOST = 8 };

/* An observer in memory. */
struct keeper {
  struct image_memory kept[MOST], shown; /* shown: snapshots so far */
  size_t shown_then[MOST];               /* bytes, when it was kept */
  double step[MOST];
  int count;
  const struct keeper *from; /* whose checkpoint `number` is loaded; NULL: none */
  int number;
};

static void *begin(void *context, const struct gx_case *one)
{
  (void)one;
  return context;
}

static void add_records(struct image_memory *memory, int dim, const struct gx_record_set *set)
{
  for (int i = 0; i < set->count && set->n; i++)
    for (int k = 0; k < gx_snapshot_components(dim, set->record[i].rank); k++)
      image_save(memory, set->record[i].value[k], set->n * sizeof(double));
}

static int show(void *watched, const struct gx_snapshot *snapshot)
{
  struct keeper *keeper = watched;
  double when[] = {snapshot->step, snapshot->time};
  image_save(&keeper->shown, when, sizeof when);
  add_records(&keeper->shown, snapshot->dim, &snapshot->particles);
  add_records(&keeper->shown, snapshot->dim, &snapshot->vertices);
  return 0;
}

static int end(void *watched, bool whole)
{
  (void)watched, (void)whole;
  return 0;
}

static int restore(void *watched, const struct gx_checkpoint *checkpoint)
{
  struct keeper *keeper = watched;
  if (!keeper->from) return 0;
  struct image_memory memory = keeper->from->kept[keeper->number]; /* borrows its bytes */
  struct gx_image image = image_of(&memory, true);
  checkpoint->image(checkpoint->run, &image);
  CHECK(!image.failed && memory.at == memory.length, "%zu of %zu bytes were loaded", memory.at, memory.length);
  if (keeper->from->shown_then[keeper->number])
    image_save(&keeper->shown, keeper->from->shown.bytes, keeper->from->shown_then[keeper->number]);
  return 1;
}

static int keep(void *watched, const struct gx_checkpoint *checkpoint)
{
  struct keeper *keeper = watched;
  assert_true(keeper->count < MOST);
  struct gx_image image = image_of(&keeper->kept[keeper->count], false);
  checkpoint->image(checkpoint->run, &image);
  assert_false(image.failed);
  keeper->step[keeper->count] = checkpoint->step;
  keeper->shown_then[keeper->count++] = keeper->shown.length;
  return 0;
}

static struct gx_result run_with(struct keeper *keeper, const struct gx_case *one)
{
  const struct gx_observer observer = {
      .context = keeper, .begin = begin, .show = show, .end = end, .restore = restore, .keep = keep};
  return gx_case_run_by(one, &(struct gx_case_means){.observer = &observer});
}

static void release(struct keeper *keeper)
{
  for (int i = 0; i < MOST; i++) free(keeper->kept[i].bytes);
  free(keeper->shown.bytes);
}

static void check_bytes(const void *a, const void *b, size_t length, const char *what, const char *part)
{
  CHECK(!length || (a && b && !memcmp(a, b, length)), "%s: %s differ", what, part);
}

static void check_results(const struct gx_result *a, const struct gx_result *b, const char *what)
{
  CHECK(a->outcome.status == b->outcome.status && a->outcome.particle == b->outcome.particle &&
            !strcmp(a->outcome.reason, b->outcome.reason),
        "%s: %s %s, %s %s", what, gx_status_name(a->outcome.status), a->outcome.reason, gx_status_name(b->outcome.status),
        b->outcome.reason);
#define SAME(member) check_bytes(&a->member, &b->member, sizeof a->member, what, #member)
  SAME(dt);
  SAME(steps);
  SAME(time);
  SAME(left_cells);
  SAME(measured);
  SAME(restitution);
  SAME(reference);
  SAME(budget);
  SAME(vibration);
  SAME(history.samples);
  SAME(spectra.samples);
  SAME(spectra.bins);
#undef SAME
  const struct gx_history *left = &a->history, *right = &b->history;
  check_bytes(left->sample, right->sample, left->samples * sizeof *left->sample, what, "samples");
  if (left->probe) check_bytes(left->probe, right->probe, left->samples * sizeof *left->probe, what, "probes");
  if (left->budget) check_bytes(left->budget, right->budget, left->samples * sizeof *left->budget, what, "budgets");
  check_bytes(a->spectra.time, b->spectra.time, a->spectra.samples * sizeof(double), what, "times of spectra");
  check_bytes(a->spectra.rms, b->spectra.rms, a->spectra.samples * GX_QUANTITIES * a->spectra.bins * sizeof(double), what,
              "spectra");
}

/* Returns how many checkpoints there were. */
static int check_case(struct gx_case one, const char *what)
{
  struct keeper straight = {0};
  struct gx_result first = run_with(&straight, &one);
  struct gx_case bare = one;
  case_set(&bare, GX_OUTPUT_CHECKPOINT, "");
  struct gx_result plain = gx_case_run(&bare);
  check_results(&first, &plain, what);
  gx_case_free(&plain);
  const int count = straight.count;
  for (int i = 0; i < count; i++) {
    struct keeper again = {.from = &straight, .number = i};
    struct gx_result result = run_with(&again, &one);
    check_results(&first, &result, what);
    CHECK(again.shown.length == straight.shown.length, "%s: %zu bytes of snapshots, not %zu", what, again.shown.length,
          straight.shown.length);
    check_bytes(again.shown.bytes, straight.shown.bytes, straight.shown.length, what, "snapshots");
    CHECK(again.count == count - i - 1, "%s: %d checkpoints after one at step %g", what, again.count, straight.step[i]);
    gx_case_free(&result);
    release(&again);
  }
  gx_case_free(&first);
  release(&straight);
  return count;
}

static void every_space_and_clock(void **state)
{
  (void)state;
  static const char *const levels[] = {"all", "max", "final"};
  for (int s = 0; gx_space_family[s]; s++)
    for (int k = 0; gx_clock_family[k]; k++) {
      const struct gx_space_kind *kind = gx_space_family[s];
      if (kind->of_problem) continue;
      struct gx_case one =
          case_draft("mesh.cells=6", "problem.modulus=100", "mesh.particles_per_cell=2", "time.steps=8", "output.checkpoint=3",
                     "output.histories=2", "output.snapshots=2", "output.spectra=3", "output.frequency=1", "output.probe=0.3");
      case_set(&one, GX_TIME_CFL, kind->collocation ? "0.04" : "0.15");
      case_set(&one, GX_METHOD_SPACE, kind->name);
      case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
      case_set(&one, GX_OUTPUT_MEASURES, levels[k % 3]);
      gx_parameter_resolve(one.value);
      char what[96];
      snprintf(what, sizeof what, "%s %s", kind->name, gx_clock_family[k]->name);
      assert_int_equal(check_case(one, what), 2);
    }
}

/* Measures that only some methods have, and the ways to sum up time. */
static void every_measure(void **state)
{
  (void)state;
  static const struct {
    enum gx_parameter_id id;
    const char *text;
  } options[] = {{GX_OUTPUT_JUMPS, "yes"},
                 {GX_OUTPUT_BUDGET, "2"},
                 {GX_OUTPUT_REFERENCE, "2"},
                 {GX_TIME_ACCUMULATE, "sum"},
                 {GX_TIME_ACCUMULATE, "compensated"},
                 {GX_OUTPUT_MEASURES, "max"},
                 {GX_METHOD_QUADRATURE, "reconstructed"},
                 {GX_METHOD_TRANSFER, "apic"}};
  static const char *const clocks[] = {"euler-stress-last", "central-difference", "rk4"};
  for (size_t i = 0; i < sizeof options / sizeof *options; i++)
    for (int k = 0; k < 3; k++)
      for (int s = 0; gx_space_family[s]; s++) {
        if (!case_on_grid(gx_space_family[s])) continue;
        struct gx_case one = case_draft("mesh.cells=6", "problem.modulus=100", "mesh.particles_per_cell=2", "time.steps=7",
                                        "time.cfl=0.15", "output.checkpoint=2", "output.histories=1", "output.probe=0.3");
        case_set(&one, GX_METHOD_SPACE, gx_space_family[s]->name);
        case_set(&one, GX_METHOD_CLOCK, clocks[k]);
        case_set(&one, options[i].id, options[i].text);
        if (options[i].id == GX_OUTPUT_JUMPS || options[i].id == GX_TIME_ACCUMULATE) { /* until cells are crossed, and sums err */
          case_set(&one, GX_TIME_STEPS, "40");
          case_set(&one, GX_OUTPUT_CHECKPOINT, "13");
        }
        gx_parameter_resolve(one.value);
        check_case(one, options[i].text);
      }
}

/* Two bodies, momentum that is kept, equations of their own, a case that fails after its checkpoint. */
static void every_problem(void **state)
{
  (void)state;
  for (int p = 0; gx_problem_family[p]; p++) {
    const struct gx_problem *problem = gx_problem_family[p];
    struct gx_case one =
        case_draft("mesh.cells=8", "mesh.particles_per_cell=2", "time.steps=7", "output.checkpoint=3", "output.histories=1");
    case_set(&one, GX_PROBLEM_NAME, problem->name);
    if (problem->space) case_set(&one, GX_TIME_DT, problem->cycles > 0 ? "0.02" : "0.004");
    if (problem->space) case_set(&one, GX_PROBLEM_MODULUS, "1");
    gx_parameter_resolve(one.value);
    CHECK(check_case(one, problem->name) > 0, "%s keeps none", problem->name);
  }
}

static void a_case_that_fails_later(void **state)
{
  (void)state;
  struct gx_case one = case_of("mesh.cells=8", "time.cfl=3", "time.periods=10", "output.checkpoint=1", "output.histories=1",
                               "method.space=moving-mesh");
  struct gx_result result = gx_case_run(&one);
  assert_true(result.outcome.status == GX_UNSTABLE || result.outcome.status == GX_TANGLED);
  gx_case_free(&result);
  assert_true(check_case(one, "an unstable case") > 0);
}

/* What the observer says ends a case. */
static int refuse(void *watched, const struct gx_checkpoint *checkpoint)
{
  (void)watched, (void)checkpoint;
  return -1;
}

static void failures_cancel(void **state)
{
  (void)state;
  struct gx_case one = case_of("mesh.cells=8", "time.steps=5", "output.checkpoint=2");
  struct keeper keeper = {0};
  struct gx_observer observer = {
      .context = &keeper, .begin = begin, .show = show, .end = end, .restore = restore, .keep = refuse};
  struct gx_result result = gx_case_run_by(&one, &(struct gx_case_means){.observer = &observer});
  assert_int_equal(result.outcome.status, GX_CANCELLED);
  NEAR(result.steps, 2, 0);
  gx_case_free(&result);
  observer.restore = refuse;
  result = gx_case_run_by(&one, &(struct gx_case_means){.observer = &observer});
  assert_int_equal(result.outcome.status, GX_CANCELLED);
  NEAR(result.steps, 0, 0);
  gx_case_free(&result);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_space_and_clock),   cmocka_unit_test(every_measure),   cmocka_unit_test(every_problem),
      cmocka_unit_test(a_case_that_fails_later), cmocka_unit_test(failures_cancel),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
