/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots: what they hold, the files they are kept in, and reading those back. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gridcross/recorder.h>
#include <gridcross/series.h>

#include "case_of.h"
#include "temporary.h"

/* What an observer saw of a run. */
struct seen {
  size_t shown, ended;
  bool whole;
  double step[64], time[64];
  double *u;   /* [n] first component at the last snapshot, owned */
  int fail_at; /* snapshot that is refused; -1: none */
};

static void *begin(void *context, const struct gx_case *one)
{
  (void)one;
  return context;
}

static const double *component(const struct gx_record_set *set, const char *name, int k)
{
  const struct gx_record *record = gx_snapshot_record(set, name);
  CHECK(record, "no record %s", name);
  return record->value[k];
}

static double sum(size_t n, const double *weight, const double *value)
{
  double total = 0;
  for (size_t p = 0; p < n; p++) total += weight[p] * (value ? value[p] : 1);
  return total;
}

/* The integral of a field at the vertices of a periodic grid, by the trapezoidal rule, which is exact for what is summed over
 * periodic B-splines. */
static double integral(const struct gx_snapshot *snapshot, const double *value)
{
  const size_t *shape = snapshot->vertices.shape;
  double total = 0;
  for (size_t i = 0, stride; i < snapshot->vertices.n; i++) {
    double w = 1;
    stride = 1;
    for (int d = 0; d < snapshot->dim; stride *= shape[d++]) {
      size_t k = i / stride % shape[d];
      w *= snapshot->spacing[d] * (k == 0 || k == shape[d] - 1 ? 0.5 : 1);
    }
    total += w * value[i];
  }
  return total;
}

static void check_snapshot(const struct gx_snapshot *snapshot)
{
  const struct gx_record_set *p = &snapshot->particles, *v = &snapshot->vertices;
  const double *m = component(p, "mass", 0);
  double mass = sum(p->n, m, NULL), size = 0;
  for (int d = 0; d < snapshot->dim; d++) {
    const double *x = component(p, "position", d), *X = component(p, "reference_position", d),
                 *u = component(p, "displacement", d);
    for (size_t i = 0; i < p->n; i++) NEAR(x[i], X[i] + u[i], 0);
    for (size_t i = 0; i < p->n; i++) size = fmax(size, fabs(component(p, "velocity", d)[i]));
  }
  if (!v->n) return;
  CLOSE(integral(snapshot, component(v, "density", 0)), mass, 1e-12);
  for (int d = 0; d < snapshot->dim; d++)
    NEAR(integral(snapshot, component(v, "momentum", d)), sum(p->n, m, component(p, "velocity", d)), 1e-12 * mass * size);
}

static int show(void *watched, const struct gx_snapshot *snapshot)
{
  struct seen *seen = watched;
  if ((int)seen->shown == seen->fail_at) return -1;
  check_snapshot(snapshot);
  seen->step[seen->shown] = snapshot->step;
  seen->time[seen->shown++] = snapshot->time;
  const size_t bytes = snapshot->particles.n * sizeof *seen->u;
  seen->u = realloc(seen->u, bytes);
  memcpy(seen->u, component(&snapshot->particles, "displacement", 0), bytes);
  return 0;
}

static int end(void *watched, bool whole)
{
  struct seen *seen = watched;
  seen->ended++;
  seen->whole = whole;
  return 0;
}

static struct gx_result watch(const struct gx_case *one, struct seen *seen)
{
  const struct gx_observer observer = {.context = seen, .begin = begin, .show = show, .end = end};
  const struct gx_case_means means = {.observer = &observer};
  seen->fail_at = -1;
  return gx_case_run_by(one, &means);
}

/* Start, every n-th step and the last, of every space and dimension; observing changes no bit of the result. */
static void test_snapshots_hold_what_a_run_has(void **unused)
{
  static const char *const spaces[] = {"standard", "moving-mesh", "spline-particle", "spline-grid"};
  static const char *const dims[] = {"1", "2", "3"};
  (void)unused;
  for (size_t s = 0; s < 4; s++)
    for (size_t d = 0; d < 3; d++) {
      char space[40], dimension[40];
      snprintf(space, sizeof space, "method.space=%s", spaces[s]);
      snprintf(dimension, sizeof dimension, "problem.dimension=%s", dims[d]);
      struct gx_case one = case_of("problem.name=axis-aligned", dimension, space, "method.degree=3", "mesh.cells=6",
                                   "mesh.particles_per_cell=2", "output.snapshots=4", "output.measures=final", "time.steps=10");
      struct seen seen = {0};
      struct gx_result watched = watch(&one, &seen);
      assert_int_equal(watched.outcome.status, GX_OK);
      const double steps[] = {0, 4, 8, 10};
      assert_int_equal(seen.shown, 4);
      assert_int_equal(seen.ended, 1);
      assert_true(seen.whole);
      for (int i = 0; i < 4; i++) {
        NEAR(seen.step[i], steps[i], 0);
        NEAR(seen.time[i], steps[i] * watched.dt, 0);
      }
      one.value[GX_OUTPUT_SNAPSHOTS].type = GX_NULL;
      struct gx_result plain = case_result(&one);
      assert_memory_equal(&plain.measured, &watched.measured, sizeof plain.measured);
      gx_case_free(&watched);
      free(seen.u);
    }
}

static void test_a_failing_observer_cancels(void **unused)
{
  (void)unused;
  struct gx_case one = case_of("mesh.cells=8", "output.snapshots=1", "time.steps=5");
  struct seen seen = {0};
  const struct gx_observer observer = {.context = &seen, .begin = begin, .show = show, .end = end};
  seen.fail_at = 2;
  struct gx_result result = gx_case_run_by(&one, &(struct gx_case_means){.observer = &observer});
  assert_int_equal(result.outcome.status, GX_CANCELLED);
  assert_int_equal(seen.shown, 2);
  assert_int_equal(seen.ended, 1);
  assert_false(seen.whole);
  gx_case_free(&result);
  free(seen.u);
}

static int count(void *context, size_t index, struct gx_result *result)
{
  (void)index, (void)result;
  ++*(int *)context;
  return 0;
}

static void test_a_failing_observer_ends_a_study(void **unused)
{
  (void)unused;
  struct gx_study *study =
      gx_runfile_parse("test", "mesh: {cells: [4, 5, 6]}\nproblem: {name: bar-neo-hookean}\noutput: {snapshots: 1}\n", stderr);
  struct seen seen = {.fail_at = 2};
  int told = 0;
  const struct gx_observer observer = {.context = &seen, .begin = begin, .show = show, .end = end};
  const struct gx_study_means means = {.threads = 1, .sink = {&told, count}, .observer = &observer};
  assert_int_equal(gx_study_run(study, &means), -1);
  assert_int_equal(told, 0);
  assert_int_equal(seen.ended, 1);
  gx_runfile_free(study);
  free(seen.u);
}

static void test_absurd_sizes_are_refused(void **unused)
{
  (void)unused;
  struct gx_case one = case_of("mesh.cells=1000", "output.snapshots=1", "time.steps=1000000000");
  struct gx_plan plan = gx_case_plan(&one);
  assert_int_equal(plan.outcome.status, GX_REFUSED);
  /* 4000 particles of 3 + 3 + 1 numbers, one of body force and three of errors; 1001 vertices of 4 */
  assert_string_equal(plan.outcome.reason,
                      "1e+09 snapshots of 4.8e+04 numbers each would be 3.84e+05 GB: make output.snapshots larger");
}

static int set_up(void **state)
{
  char *directory = malloc(TEMPORARY_ROOM);
  *state = directory;
  return directory && temporary_directory(directory, "snapshots") ? 0 : -1;
}

static int tear_down(void **state)
{
  char command[128];
  snprintf(command, sizeof command, "rm -rf %s", (char *)*state);
  int failed = system(command);
  free(*state);
  return failed;
}

static void record(struct gx_case *one, const char *id, const char *directory)
{
  snprintf(one->id, sizeof one->id, "%s", id);
  struct gx_recorder *recorder = gx_recorder_create(directory, stderr);
  struct gx_result result = gx_case_run_by(one, &(struct gx_case_means){.observer = gx_recorder_observer(recorder)});
  assert_int_equal(result.outcome.status, GX_OK);
  gx_case_free(&result);
  gx_recorder_free(recorder);
}

static const char *const first_id = "0123456789abcdef", *const second_id = "fedcba9876543210";

static void test_files_give_back_what_was_shown(void **state)
{
  struct gx_case one = case_of("problem.name=axis-aligned", "problem.dimension=2", "method.space=moving-mesh", "mesh.cells=5",
                               "mesh.particles_per_cell=2", "output.snapshots=3", "time.steps=11");
  struct seen seen = {0};
  struct gx_result result = watch(&one, &seen);
  assert_false(gx_recorder_has(*state, first_id));
  record(&one, first_id, *state);
  assert_true(gx_recorder_has(*state, first_id));
  struct gx_series *series = gx_series_open(*state, first_id, stderr);
  assert_non_null(series);
  assert_int_equal(series->dim, 2);
  assert_int_equal(series->count, 5);
  assert_int_equal(series->particles, 100);
  assert_int_equal(series->vertices[0], 6);
  assert_int_equal(series->vertices[1], 6);
  assert_int_equal(series->vertices[2], 1);
  assert_true(series->moving);
  NEAR(series->dt, result.dt, 0);
  for (size_t i = 0; i < 5; i++) {
    NEAR(series->step[i], seen.step[i], 0);
    NEAR(series->time[i], seen.time[i], 0);
    NEAR(gx_series_offset(series, i, GX_SERIES_PARTICLES, "velocity"), -0.5 * result.dt, 0);
    NEAR(gx_series_offset(series, i, GX_SERIES_PARTICLES, "position"), 0, 0);
  }
  double *u = gx_series_read(series, 4, GX_SERIES_PARTICLES, "displacement", 0, stderr);
  assert_memory_equal(u, seen.u, 100 * sizeof *u);
  free(u);
  assert_true(gx_series_has(series, GX_SERIES_VERTICES, "displacement"));
  assert_false(gx_series_has(series, GX_SERIES_VERTICES, "first_piola_stress"));
  FILE *quiet = tmpfile();
  assert_null(gx_series_read(series, 0, GX_SERIES_PARTICLES, "displacement", 2, quiet));
  assert_null(gx_series_read(series, 0, GX_SERIES_PARTICLES, "../../dt", 0, quiet));
  assert_null(gx_series_read(series, 0, GX_SERIES_PARTICLES, "mass", 1, quiet));
  double *sigma = gx_series_read(series, 0, GX_SERIES_PARTICLES, "cauchy_stress", 3, stderr);
  assert_non_null(sigma);
  free(sigma);
  gx_series_close(series);
  assert_null(gx_series_open(*state, second_id, quiet));
  assert_true(ftell(quiet) > 0);
  fclose(quiet);
  gx_case_free(&result);
  free(seen.u);
}

static char *contents(const char *directory, const char *id, const char *ending, size_t *length)
{
  char path[128];
  snprintf(path, sizeof path, "%s/case-%s%s", directory, id, ending);
  FILE *in = fopen(path, "rb");
  CHECK(in, "%s", path);
  fseek(in, 0, SEEK_END);
  *length = (size_t)ftell(in);
  rewind(in);
  char *bytes = malloc(*length + 1);
  assert_int_equal(fread(bytes, 1, *length, in), *length);
  fclose(in);
  return bytes;
}

static void check_equal(const char *directory, const char *other)
{
  static const char *const endings[] = {".h5", ".xmf", "-grid.xmf"};
  for (int i = 0; i < 3; i++) {
    size_t n, m;
    char *a = contents(directory, first_id, endings[i], &n), *b = contents(other, first_id, endings[i], &m);
    assert_int_equal(n, m);
    assert_memory_equal(a, b, n);
    free(a);
    free(b);
  }
}

static void test_equal_cases_give_equal_bytes(void **state)
{
  char other[64], copy[64];
  snprintf(other, sizeof other, "%s/other", (char *)*state);
  snprintf(copy, sizeof copy, "%s/copy", (char *)*state);
  assert_int_equal(mkdir(other, 0777) || mkdir(copy, 0777), 0);
  struct gx_case one = case_of("mesh.cells=8", "output.snapshots=1", "time.steps=40");
  record(&one, first_id, *state);
  sleep(1); /* object times have a resolution of one second */
  char *litter[64];
  for (int i = 0; i < 64; i++) memset(litter[i] = malloc(4096), 0xA5, 4096);
  for (int i = 0; i < 64; i++) free(litter[i]);
  record(&one, first_id, other);
  check_equal(*state, other);
  assert_int_equal(gx_recorder_copy(other, copy, first_id, stderr), 0);
  check_equal(*state, copy);
}

/* Without a directory nothing is left behind, and it is said. */
static void test_what_cannot_be_written_cancels(void **state)
{
  char nowhere[64];
  snprintf(nowhere, sizeof nowhere, "%s/nowhere", (char *)*state);
  struct gx_case one = case_of("mesh.cells=8", "output.snapshots=1", "time.steps=5");
  FILE *quiet = tmpfile();
  struct gx_recorder *recorder = gx_recorder_create(nowhere, quiet);
  struct gx_result result = gx_case_run_by(&one, &(struct gx_case_means){.observer = gx_recorder_observer(recorder)});
  assert_int_equal(result.outcome.status, GX_CANCELLED);
  assert_true(ftell(quiet) > 0);
  gx_case_free(&result);
  gx_recorder_free(recorder);
  fclose(quiet);
}

static void test_tidying_keeps_the_study_s_own(void **state)
{
  const char *directory = *state;
  struct gx_case one = case_of("mesh.cells=8", "output.snapshots=1", "time.steps=2");
  record(&one, first_id, directory);
  record(&one, second_id, directory);
  static const char *const others[] = {".case-fedcba9876543210.h5.partial", "mine.h5", "case-0123456789abcdef.png"};
  for (int i = 0; i < 3; i++) {
    char path[128];
    snprintf(path, sizeof path, "%s/%s", directory, others[i]);
    fclose(fopen(path, "wb"));
    assert_int_equal(gx_recorder_owns(others[i]), i == 0);
  }
  assert_true(gx_recorder_owns("case-0123456789abcdef-grid.xmf"));
  const struct gx_study study = {.cases = &one, .count = 1}; /* of the second id */
  assert_int_equal(gx_recorder_tidy(directory, &study, stderr), 0);
  assert_false(gx_recorder_has(directory, first_id));
  assert_true(gx_recorder_has(directory, second_id));
  for (int i = 0; i < 3; i++) {
    char path[128];
    snprintf(path, sizeof path, "%s/%s", directory, others[i]);
    assert_int_equal(!access(path, F_OK), i > 0);
  }
}

/* All that a file says it has; it may be damaged. */
static void read_all(const char *directory, const char *id, FILE *quiet)
{
  static const char *const names[] = {"position", "velocity", "cauchy_stress", "mass", "density"};
  struct gx_series *series = gx_series_open(directory, id, quiet);
  for (size_t i = 0; series && i < series->count; i++)
    for (int set = 0; set < GX_SERIES_SETS; set++)
      for (size_t r = 0; r < sizeof names / sizeof *names; r++) {
        gx_series_offset(series, i, (enum gx_series_set)set, names[r]);
        free(gx_series_read(series, i, (enum gx_series_set)set, names[r], 0, quiet));
      }
  gx_series_close(series);
}

#ifdef __has_feature
#define LEAKS_ARE_SEEN __has_feature(address_sanitizer)
#elif defined __SANITIZE_ADDRESS__
#define LEAKS_ARE_SEEN 1
#else
#define LEAKS_ARE_SEEN 0
#endif

static void test_damaged_files_are_refused(void **state)
{
  struct gx_case one = case_of("mesh.cells=4", "output.snapshots=1", "time.steps=1");
  record(&one, first_id, *state);
  size_t length;
  char *bytes = contents(*state, first_id, ".h5", &length), path[128];
  snprintf(path, sizeof path, "%s/case-%s.h5", (char *)*state, second_id);
  FILE *quiet = tmpfile();
  for (size_t keep = 0; keep < length; keep += length / 37 + 1) {
    FILE *out = fopen(path, "wb");
    assert_int_equal(fwrite(bytes, 1, keep, out), keep);
    fclose(out);
    assert_null(gx_series_open(*state, second_id, quiet));
  }
  const size_t flipped = LEAKS_ARE_SEEN ? 0 : length; /* HDF5 itself loses memory over such files */
  for (size_t at = 0; at < flipped; at += 41) {
    bytes[at] = (char)~bytes[at];
    FILE *out = fopen(path, "wb");
    assert_int_equal(fwrite(bytes, 1, length, out), length);
    fclose(out);
    bytes[at] = (char)~bytes[at];
    read_all(*state, second_id, quiet);
  }
  fclose(quiet);
  free(bytes);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_snapshots_hold_what_a_run_has),
      cmocka_unit_test(test_a_failing_observer_cancels),
      cmocka_unit_test(test_a_failing_observer_ends_a_study),
      cmocka_unit_test(test_absurd_sizes_are_refused),
      cmocka_unit_test_setup_teardown(test_files_give_back_what_was_shown, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_equal_cases_give_equal_bytes, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_what_cannot_be_written_cancels, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_tidying_keeps_the_study_s_own, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_damaged_files_are_refused, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
