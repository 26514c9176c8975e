/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run files: counts and orders of cases worked out by hand, and starter files read back. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include <gridcross/problem.h>
#include <gridcross/starter.h>
#include <gridcross/study.h>

#include "temporary.h"

enum { MOST_SETS = 4 };

/* Reads yaml with up to four --set strings (NULL-ended). errors: the text of errors, for the caller to free; NULL: none allowed. */
static struct gx_study *read_yaml(const char *yaml, const char *const *set, char **errors)
{
  char path[TEMPORARY_ROOM], *message = NULL;
  size_t sets = 0, length = 0;
  int descriptor = temporary_file(path, "runfile");
  assert_true(descriptor >= 0);
  assert_int_equal(write(descriptor, yaml, strlen(yaml)), strlen(yaml));
  close(descriptor);
  while (set && sets < MOST_SETS && set[sets]) sets++;
  FILE *out = open_memstream(&message, &length);
  struct gx_study *study = gx_runfile_read(path, sets, set, NULL, out);
  fclose(out);
  unlink(path);
  if (errors)
    *errors = message;
  else {
    if (!study) print_error("%s\n%s", yaml, message);
    assert_non_null(study);
    assert_string_equal(message, "");
    free(message);
  }
  return study;
}

/* The values of one parameter over the cases, as "8 16 -". */
static const char *column(const struct gx_study *study, enum gx_parameter_id id)
{
  static char text[512];
  size_t used = 0;
  *text = '\0';
  for (size_t i = 0; i < study->count; i++) {
    const struct gx_value *value = &study->cases[i].value[id];
    const char *gap = i ? " " : "";
    assert_true(used < sizeof text - 64);
    switch (value->type) {
    case GX_NULL:
      used += (size_t)sprintf(text + used, "%s-", gap);
      break;
    case GX_INTEGER:
      used += (size_t)sprintf(text + used, "%s%ld", gap, value->integer);
      break;
    case GX_REAL:
      used += (size_t)sprintf(text + used, "%s%.17g", gap, value->real);
      break;
    case GX_TEXT:
      used += (size_t)sprintf(text + used, "%s%s", gap, value->text);
      break;
    }
  }
  return text;
}

#define COLUMN(study, id, expected) assert_string_equal(column(study, id), expected)

static void defaults_and_id(void **state)
{
  (void)state;
  struct gx_study *study = read_yaml("problem: {name: bar-linear}", NULL, NULL);
  assert_int_equal(study->count, 1);
  assert_int_equal(study->axes, 0);
  assert_string_equal(study->title, "");
  assert_string_equal(study->source, "problem: {name: bar-linear}");
  /* FNV-1a 64 of the lines problem.name=bar-linear, problem.dimension=1, problem.amplitude=0.050000000000000003, ... with the
   * defaults as published, by an independent program. It changes when a parameter or a default does, and then only. */
  assert_string_equal(study->cases[0].id, "235f058b066e4c59");
  COLUMN(study, GX_PROBLEM_BOUNDARY, "fixed");
  COLUMN(study, GX_PROBLEM_MODE, "1");
  COLUMN(study, GX_PROBLEM_POISSON, "-");
  COLUMN(study, GX_PROBLEM_ACTIVE, "-");
  COLUMN(study, GX_PROBLEM_PHASES, "-");
  COLUMN(study, GX_TIME_DT, "-");
  COLUMN(study, GX_TIME_CFL, "0.40000000000000002");
  COLUMN(study, GX_TIME_END, "-");
  COLUMN(study, GX_TIME_PERIODS, "1");
  gx_runfile_free(study);
}

static void equal_cases_have_equal_ids(void **state)
{
  (void)state;
  struct gx_study *a = read_yaml("problem: {name: bar-linear, amplitude: 0.05}\nmesh.cells: 16\n", NULL, NULL);
  struct gx_study *b =
      read_yaml("mesh:\n  cells: +16\ntitle: other\nproblem.name: 'bar-linear'\ntime: {cfl: 4.0e-1}\n", NULL, NULL);
  struct gx_study *c =
      read_yaml("problem: {name: bar-linear}\nmesh: {cells: 17}", (const char *const[]){"mesh.cells=16", NULL}, NULL);
  struct gx_study *d = read_yaml("problem: {name: bar-linear}\nmesh: {cells: 17}\n", NULL, NULL);
  assert_string_equal(a->cases[0].id, b->cases[0].id);
  assert_string_equal(a->cases[0].id, c->cases[0].id);
  assert_string_not_equal(a->cases[0].id, d->cases[0].id);
  gx_runfile_free(a);
  gx_runfile_free(b);
  gx_runfile_free(c);
  gx_runfile_free(d);
}

static void accepted_oddities(void **state)
{
  (void)state;
  static const char *const yaml[] = {
      "\xEF\xBB\xBFproblem: {name: bar-linear}\n", /* byte order mark */
      "problem:\r\n  name: bar-linear\r\n",        /* lines of Windows */
      "%YAML 1.1\n---\nproblem.name: bar-linear\n...\n",
      "problem.name: bar-linear\nmesh:\noutput:\n  # histories: 1\n", /* sections with every key commented out */
  };
  for (size_t i = 0; i < sizeof yaml / sizeof *yaml; i++) {
    struct gx_study *study = read_yaml(yaml[i], NULL, NULL);
    assert_string_equal(study->cases[0].id, "235f058b066e4c59");
    gx_runfile_free(study);
  }
}

static void lists_multiply_in_file_order(void **state)
{
  (void)state;
  struct gx_study *study = read_yaml("method: {degree: [1, 2]}\n"
                                     "problem: {name: bar-linear}\n"
                                     "mesh.cells: [8, 16, 32]\n",
                                     NULL, NULL);
  COLUMN(study, GX_METHOD_DEGREE, "1 1 1 2 2 2");
  COLUMN(study, GX_MESH_CELLS, "8 16 32 8 16 32");
  assert_int_equal(study->axes, 2);
  assert_int_equal(study->axis[0], GX_METHOD_DEGREE);
  assert_int_equal(study->axis[1], GX_MESH_CELLS);
  gx_runfile_free(study);
}

static void ranges(void **state)
{
  (void)state;
  struct gx_study *study = read_yaml("problem: {name: bar-linear}\n"
                                     "mesh: {cells: {geom: [8, 64, 4]}}\n"
                                     "time: {dt: {geom: [1e-3, 1e-1, 3]}, end: {lin: [0.1, 0.5, 5]}}\n",
                                     NULL, NULL);
  assert_int_equal(study->count, 60);
  for (size_t i = 0; i < 60; i++) {
    const struct gx_value *value = study->cases[i].value;
    static const double dt[] = {1e-3, 1e-2, 1e-1}, end[] = {0.1, 0.2, 0.3, 0.4, 0.5};
    assert_int_equal(value[GX_MESH_CELLS].integer, 8 << (i / 15));
    assert_true(value[GX_TIME_DT].real == dt[i / 5 % 3]); /* as a list would write them, to the last bit */
    assert_true(value[GX_TIME_END].real == end[i % 5]);
    assert_int_equal(value[GX_TIME_CFL].type, GX_NULL);
    assert_int_equal(value[GX_TIME_PERIODS].type, GX_NULL);
  }
  gx_runfile_free(study);
  /* Rounding would make these 0.39999999999999997, 0.6000000000000001 and 0.009999999999999993. */
  study = read_yaml("problem: {name: bar-linear}\ntime: {dt: {geom: [1e-6, 1, 7]}, end: {lin: [0.1, 0.7, 7]}}\n", NULL, NULL);
  for (size_t i = 0; i < 49; i++) {
    static const double dt[] = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1}, end[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
    assert_true(study->cases[i].value[GX_TIME_DT].real == dt[i / 7]);
    assert_true(study->cases[i].value[GX_TIME_END].real == end[i % 7]);
  }
  gx_runfile_free(study);
  study = read_yaml("problem: {name: bar-linear}\ntime: {dt: {geom: [1e-300, 1e300, 3]}}\nmesh: {cells: {lin: [10, 4, 4]}}", NULL,
                    NULL);
  assert_true(fabs(study->cases[4].value[GX_TIME_DT].real - 1) < 1e-12);
  study->count = 4;
  COLUMN(study, GX_MESH_CELLS, "10 8 6 4");
  gx_runfile_free(study);
}

static void zips(void **state)
{
  (void)state;
  struct gx_study *study = read_yaml("zip: [[mesh.cells, time.dt], [method.degree, method.mass]]\n"
                                     "problem: {name: bar-linear, amplitude: [0.1, 0.2]}\n"
                                     "mesh: {cells: [8, 16]}\n"
                                     "method: {degree: [1, 3], mass: [lumped, consistent]}\n"
                                     "time: {dt: [2, 1]}\n",
                                     NULL, NULL);
  COLUMN(study, GX_MESH_CELLS, "8 8 16 16 8 8 16 16");
  COLUMN(study, GX_TIME_DT, "2 2 1 1 2 2 1 1");
  COLUMN(study, GX_METHOD_DEGREE, "1 3 1 3 1 3 1 3");
  COLUMN(study, GX_METHOD_MASS, "lumped consistent lumped consistent lumped consistent lumped consistent");
  assert_int_equal(study->axes, 5);
  gx_runfile_free(study);
  const char *yaml = "zip: [mesh.cells, time.dt]\nproblem: {name: bar-linear}\nmesh: {cells: [8, 16]}\ntime: {dt: [2, 1]}\n";
  study = read_yaml(yaml, (const char *const[]){"time.dt=5", NULL}, NULL);
  COLUMN(study, GX_MESH_CELLS, "8 16");
  COLUMN(study, GX_TIME_DT, "5 5");
  gx_runfile_free(study);
}

static void cases_replace_the_base(void **state)
{
  (void)state;
  struct gx_study *study = read_yaml("problem: {name: bar-linear}\n"
                                     "mesh: {cells: [8, 16]}\n"
                                     "method: {space: standard}\n"
                                     "cases:\n"
                                     "  - method: {mass: consistent}\n"
                                     "  - {method.space: moving-mesh, mesh.cells: 4}\n"
                                     "  - {mesh: {cells: [2, 3]}, method.degree: [1, 2]}\n",
                                     NULL, NULL);
  COLUMN(study, GX_MESH_CELLS, "8 16 4 2 2 3 3");
  COLUMN(study, GX_METHOD_DEGREE, "2 2 2 1 2 1 2");
  COLUMN(study, GX_METHOD_MASS, "consistent consistent lumped lumped lumped lumped lumped");
  COLUMN(study, GX_METHOD_SPACE, "standard standard moving-mesh standard standard standard standard");
  COLUMN(study, GX_METHOD_PROJECTION, "each-step each-step once each-step each-step each-step each-step");
  /* As first named: cells and space by the base, mass and degree by cases; projection only follows. */
  assert_int_equal(study->axes, 4);
  assert_int_equal(study->axis[0], GX_MESH_CELLS);
  assert_int_equal(study->axis[1], GX_METHOD_SPACE);
  assert_int_equal(study->axis[2], GX_METHOD_MASS);
  assert_int_equal(study->axis[3], GX_METHOD_DEGREE);
  gx_runfile_free(study);
}

static void a_rival_clears(void **state)
{
  (void)state;
  const char *yaml = "problem: {name: bar-linear}\n"
                     "time: {cfl: [0.1, 0.2], end: 3}\n"
                     "cases:\n"
                     "  - {method.mass: lumped}\n"
                     "  - {time.dt: 1}\n"
                     "  - {time: {dt: [2, 4], periods: 5}}\n";
  struct gx_study *study = read_yaml(yaml, NULL, NULL);
  COLUMN(study, GX_TIME_DT, "- - 1 2 4");
  COLUMN(study, GX_TIME_CFL, "0.10000000000000001 0.20000000000000001 - - -");
  COLUMN(study, GX_TIME_END, "3 3 3 - -");
  COLUMN(study, GX_TIME_PERIODS, "- - - 5 5");
  assert_int_equal(study->axes, 4); /* end varies because a case clears it */
  assert_int_equal(study->axis[0], GX_TIME_CFL);
  assert_int_equal(study->axis[1], GX_TIME_END);
  assert_int_equal(study->axis[2], GX_TIME_DT);
  assert_int_equal(study->axis[3], GX_TIME_PERIODS);
  gx_runfile_free(study);
  study = read_yaml(yaml, (const char *const[]){"time.dt=8", "time.periods=7", NULL}, NULL);
  COLUMN(study, GX_TIME_DT, "8 1 2 4");
  COLUMN(study, GX_TIME_CFL, "- - - -");
  COLUMN(study, GX_TIME_PERIODS, "7 7 5 5");
  gx_runfile_free(study);
  study = read_yaml("problem.name: bar-linear", (const char *const[]){"time.dt=8", "time.cfl=0.5", "time.cfl=0.25", NULL}, NULL);
  COLUMN(study, GX_TIME_CFL, "0.25");
  COLUMN(study, GX_TIME_DT, "-");
  gx_runfile_free(study);
}

static void of_three_rivals_one_stays(void **state)
{
  (void)state;
  struct gx_study *study = read_yaml("problem: {name: bar-linear}\n"
                                     "time: {start: -2, steps: 7}\n"
                                     "cases: [{method.mass: lumped}, {time.end: 3}, {time.periods: 5}, {time.start: 1}]\n",
                                     NULL, NULL);
  COLUMN(study, GX_TIME_START, "-2 -2 -2 1");
  COLUMN(study, GX_TIME_STEPS, "7 - - 7");
  COLUMN(study, GX_TIME_END, "- 3 - -");
  COLUMN(study, GX_TIME_PERIODS, "- - 5 -");
  COLUMN(study, GX_TIME_LANDING, "- exact exact -");
  gx_runfile_free(study);
  study = read_yaml("problem: {name: bar-linear}\ntime: {end: 4}\n",
                    (const char *const[]){"time.periods=2", "time.steps=3", NULL}, NULL);
  COLUMN(study, GX_TIME_STEPS, "3");
  COLUMN(study, GX_TIME_END, "-");
  COLUMN(study, GX_TIME_PERIODS, "-");
  gx_runfile_free(study);
}

static void sets_take_lists(void **state)
{
  (void)state;
  struct gx_study *study = read_yaml("problem: {name: bar-linear}\nmesh: {cells: 8}\nmethod: {mass: [lumped, consistent]}\n",
                                     (const char *const[]){"mesh.cells=[1, 2]", "method.degree={lin: [1, 3, 3]}", NULL}, NULL);
  COLUMN(study, GX_MESH_CELLS, "1 1 1 1 1 1 2 2 2 2 2 2"); /* keeps its place in the order; degree comes last */
  COLUMN(study, GX_METHOD_DEGREE, "1 2 3 1 2 3 1 2 3 1 2 3");
  gx_runfile_free(study);
}

static void set_errors(void **state)
{
  (void)state;
  static const struct {
    const char *set, *message;
  } bad[] = {
      {"method.spase=standard", "unknown parameter 'method.spase'; did you mean 'method.space'?"},
      {"cells=4", "unknown parameter 'cells'; did you mean 'mesh.cells'?"},
      {"mesh.cells", "expected path=value, such as mesh.cells=64"},
      {"mesh.cells=", "mesh.cells has no value; give one or remove the key"},
      {"mesh.cells=64.5", "mesh.cells: '64.5' is not a whole number; write digits only"},
      {"problem.dimension=2", "problem.dimension: bar-linear has at most 1 dimension, not 2"},
      {"problem.poisson=0.1",
       "problem.poisson applies to no case; remove it (Poisson's ratio; problems whose solution admits one)"},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    char *errors, expected[256];
    assert_null(read_yaml("problem: {name: bar-linear}\n", (const char *const[]){bad[i].set, NULL}, &errors));
    snprintf(expected, sizeof expected, "--set %s: %s\n", bad[i].set, bad[i].message);
    assert_string_equal(errors, expected);
    free(errors);
  }
}

static void equal_cases_run_once(void **state)
{
  (void)state;
  struct gx_study *study =
      read_yaml("problem: {name: bar-linear}\n"
                "method: {basis: [linear, bspline], degree: [1, 2, 3], transfer: [pic, flip], flip: [0.5, 1]}\n"
                "mesh: {cells: [8, 8]}\n",
                NULL, NULL);
  /* linear: pic, flip 0.5, flip 1; bspline: those at each degree */
  assert_int_equal(study->count, 12);
  assert_int_equal(study->duplicates, 2 * 3 * 2 * 2 * 2 - 12);
  COLUMN(study, GX_METHOD_DEGREE, "- - - 1 1 1 2 2 2 3 3 3");
  COLUMN(study, GX_METHOD_FLIP, "- 0.5 1 - 0.5 1 - 0.5 1 - 0.5 1");
  assert_int_equal(study->axes, 4); /* cells does not vary */
  gx_runfile_free(study);
}

static void velocity_on_nodes_has_no_transfer(void **state)
{
  (void)state;
  struct gx_study *study =
      read_yaml("problem: {name: bar-neo-hookean}\n"
                "method: {space: [standard, moving-mesh], projection: [each-step, once], position: particle}\n",
                NULL, NULL);
  COLUMN(study, GX_METHOD_TRANSFER, "flip flip flip -");
  COLUMN(study, GX_METHOD_FLIP, "1 1 1 -");
  COLUMN(study, GX_METHOD_POSITION, "particle particle particle -");
  COLUMN(study, GX_PROBLEM_BOUNDARY, "periodic periodic periodic periodic");
  gx_runfile_free(study);
}

static void directions(void **state)
{
  (void)state;
  struct gx_study *study = read_yaml("problem: {name: axis-aligned, dimension: [1, 2, 3], poisson: 0.3}\n", NULL, NULL);
  COLUMN(study, GX_PROBLEM_ACTIVE, "x xy xyz");
  COLUMN(study, GX_PROBLEM_PHASES, "0 0 0 0 0 0");
  gx_runfile_free(study);
  study = read_yaml("problem: {name: axis-aligned, dimension: 3, active: [z, xz], phases: 0 0.5 -1e0}\n", NULL, NULL);
  COLUMN(study, GX_PROBLEM_ACTIVE, "z xz");
  COLUMN(study, GX_PROBLEM_PHASES, "0 0.5 -1e0 0 0.5 -1e0");
  gx_runfile_free(study);
}

static void starters_read_back(void **state)
{
  (void)state;
  for (size_t p = 0; gx_problem_family[p]; p++) {
    char *text = NULL, minimal[128];
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    assert_int_equal(gx_starter_write(out, gx_problem_family[p]), 0);
    fclose(out);
    snprintf(minimal, sizeof minimal, "problem.name: %s", gx_problem_family[p]->name);
    struct gx_study *study = read_yaml(text, NULL, NULL), *plain = read_yaml(minimal, NULL, NULL);
    assert_int_equal(study->count, 1);
    assert_string_equal(study->cases[0].id, plain->cases[0].id); /* it writes the defaults */
    for (int id = 0; id < GX_PARAMETERS; id++)
      if (study->cases[0].value[id].type != GX_NULL) {
        char key[64];
        snprintf(key, sizeof key, " %s:", strchr(gx_parameters[id].path, '.') + 1);
        if (!strstr(text, key)) print_error("%s lacks%s\n", gx_problem_family[p]->name, key);
        assert_non_null(strstr(text, key));
      }
    gx_runfile_free(study);
    /* Another method is one edit away, where methods are a choice. */
    bool chooses = plain->cases[0].value[GX_METHOD_SPACE].type == GX_TEXT;
    gx_runfile_free(plain);
    if (chooses) {
      study = read_yaml(text, (const char *const[]){"method.space=moving-mesh", "method.basis=linear", NULL}, NULL);
      COLUMN(study, GX_METHOD_PROJECTION, "once");
      gx_runfile_free(study);
    }
    free(text);
  }
}

static void unreadable_paths(void **state)
{
  (void)state;
  char *message = NULL;
  size_t length = 0;
  FILE *out = open_memstream(&message, &length);
  assert_null(gx_runfile_read("no/such/file.yaml", 0, NULL, NULL, out));
  assert_null(gx_runfile_read(".", 0, NULL, NULL, out));
  fclose(out);
  assert_string_equal(message, "no/such/file.yaml: cannot be opened: No such file or directory\n"
                               ".: cannot be read: Is a directory\n");
  free(message);
}

static void the_table_is_sound(void **state)
{
  (void)state;
  for (int id = 0; id < GX_PARAMETERS; id++) {
    const struct gx_parameter *parameter = &gx_parameters[id];
    struct gx_value value = gx_parameter_default((enum gx_parameter_id)id);
    assert_int_equal(gx_parameter_find(parameter->path), id);
    assert_true(parameter->unit && *parameter->help && *parameter->why);
    assert_true(value.type == GX_NULL || value.type == parameter->type);
    assert_true(parameter->type == GX_TEXT || parameter->least < parameter->most);
    if (value.type == GX_TEXT) {
      int i = 0;
      while (parameter->choice(i) && strcmp(parameter->choice(i), value.text)) i++;
      assert_non_null(parameter->choice(i));
    } else if (value.type != GX_NULL) {
      double number = value.type == GX_REAL ? value.real : (double)value.integer;
      assert_true(number >= parameter->least && number <= parameter->most);
    }
  }
  assert_int_equal(gx_parameter_find("mesh"), -1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_and_id),
      cmocka_unit_test(equal_cases_have_equal_ids),
      cmocka_unit_test(accepted_oddities),
      cmocka_unit_test(lists_multiply_in_file_order),
      cmocka_unit_test(ranges),
      cmocka_unit_test(zips),
      cmocka_unit_test(cases_replace_the_base),
      cmocka_unit_test(a_rival_clears),
      cmocka_unit_test(of_three_rivals_one_stays),
      cmocka_unit_test(sets_take_lists),
      cmocka_unit_test(set_errors),
      cmocka_unit_test(equal_cases_run_once),
      cmocka_unit_test(velocity_on_nodes_has_no_transfer),
      cmocka_unit_test(directions),
      cmocka_unit_test(starters_read_back),
      cmocka_unit_test(unreadable_paths),
      cmocka_unit_test(the_table_is_sound),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
