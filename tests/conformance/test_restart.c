/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run that is stopped half-way, imaged, and continued in a simulation built anew has the bits of one that was not: every space with
 * every clock, and every option that keeps something over steps. */
#include <gsl/gsl_errno.h>

#include "image_of.h"
#include "rig.h"

static void step(struct rig *rig)
{
  const struct gx_simulation *simulation = &rig->simulation;
  const double t = simulation->start + rig->steps++ * simulation->dt;
  enum gx_status status = gx_stepper_step(rig->stepper, t, simulation->dt);
  CHECK(status == GX_OK, "%s", rig->outcome.reason);
}

/* As a measure does at the end of a step. */
static void look(struct rig *rig)
{
  const struct gx_simulation *simulation = &rig->simulation;
  CHECK(gx_stepper_accelerate(rig->stepper, simulation->start + rig->steps * simulation->dt) == GX_OK, "%s", rig->outcome.reason);
  if (simulation->kind->settle) simulation->kind->settle(simulation->space);
}

static void move(struct rig *rig, struct image_memory *memory, bool loading)
{
  struct gx_image image = image_of(memory, loading);
  enum gx_status status = gx_stepper_image(rig->stepper, &image);
  CHECK(status == GX_OK && !image.failed, "%s", rig->outcome.reason);
  CHECK(!loading || memory->at == memory->length, "%zu of %zu bytes were loaded", memory->at, memory->length);
}

/* Everything that the end shows: the image, what settling brings, nodal energy and accelerations. */
static void finish(struct rig *rig, struct image_memory *memory)
{
  const struct gx_simulation *simulation = &rig->simulation;
  struct gx_particles *particles = simulation->particles;
  double *a[GX_MAX_DIM], kinetic;
  look(rig);
  move(rig, memory, false);
  struct gx_image image = image_of(memory, false);
  image_save(memory, &rig->steps, sizeof rig->steps);
  gx_space_image(simulation->space, &image);
  kinetic = simulation->kind->kinetic(simulation->space);
  GX_IMAGE(&image, kinetic);
  double *block = calloc((particles->n + 2) * (size_t)particles->dim, sizeof *block);
  for (int d = 0; d < particles->dim; d++) a[d] = block + (size_t)d * (particles->n + 2);
  simulation->kind->particle_acceleration(simulation->space, a);
  gx_image_reals(&image, particles->dim, a, particles->n);
  free(block);
}

/* looked: samples are taken at the ends of all steps, of none, or of those before the stop. */
static void check_restart(const struct gx_case *one, const char *what, int looked)
{
  enum { STEPS = 7, STOP = 4 };
  struct rig straight, stopped, continued;
  if (!rig_build(&straight, one, NULL, NULL, NULL)) {
    rig_free(&straight);
    return;
  }
  rig_build(&stopped, one, NULL, NULL, NULL);
  rig_build(&continued, one, NULL, NULL, NULL);
  struct image_memory memory = {0}, end = {0}, other = {0};
  for (int k = 0; k < STEPS; k++) {
    struct rig *rig = k < STOP ? &stopped : &continued;
    if (k == STOP) {
      move(&stopped, &memory, false);
      move(&continued, &memory, true);
      move(&continued, &other, false);
      CHECK(memory.length == other.length && !memcmp(memory.bytes, other.bytes, memory.length), "%s: is loaded otherwise", what);
      continued.steps = stopped.steps;
    }
    step(&straight);
    step(rig);
    if (looked == 0 || (looked == 1 && k >= STOP)) continue;
    look(&straight);
    look(rig);
  }
  finish(&straight, &end);
  finish(&continued, &other);
  CHECK(end.length == other.length && !memcmp(end.bytes, other.bytes, end.length), "%s looked %d: continues otherwise", what,
        looked);
  free(memory.bytes);
  free(end.bytes);
  free(other.bytes);
  rig_free(&straight);
  rig_free(&stopped);
  rig_free(&continued);
}

struct option {
  enum gx_parameter_id id;
  const char *text;
  enum gx_parameter_id also; /* GX_PROBLEM_NAME: nothing */
  const char *with;
};

/* What changes how a grid space keeps its state. */
static const struct option options[] = {
    {.id = GX_METHOD_FLIP, .text = "0.9"},
    {.id = GX_METHOD_TRANSFER, .text = "pic"},
    {.id = GX_METHOD_TRANSFER, .text = "apic"},
    {.id = GX_METHOD_TRANSFER, .text = "apic", .also = GX_METHOD_BASIS, .with = "linear"},
    {.id = GX_METHOD_MASS, .text = "consistent"},
    {.id = GX_METHOD_QUADRATURE, .text = "reconstructed"},
    {.id = GX_METHOD_POSITION, .text = "particle"},
    {.id = GX_METHOD_PROJECTION, .text = "once"},
    {.id = GX_METHOD_PROJECTION, .text = "each-step"},
    {.id = GX_METHOD_STRESS, .text = "rate"},
    {.id = GX_METHOD_BASIS, .text = "cpgimp"},
    {.id = GX_METHOD_BASIS, .text = "ugimp"},
    {.id = GX_METHOD_BASIS, .text = "linear"},
    {.id = GX_METHOD_FRAME, .text = "current"},
    {.id = GX_METHOD_CLOSURE, .text = "papers", .also = GX_PROBLEM_NAME, .with = "bar-linear"},
    {.id = GX_METHOD_FRAME, .text = "current", .also = GX_METHOD_STRESS, .with = "rate"},
};

static bool applies(const struct gx_space_kind *kind, const struct option *option)
{
  bool of_splines = option->id == GX_METHOD_FRAME || option->id == GX_METHOD_CLOSURE;
  return option->id == GX_METHOD_STRESS || of_splines == kind->collocation;
}

static void check_method(const struct gx_space_kind *kind, const struct gx_clock *clock, const char *problem, const char *dim,
                         const struct option *option)
{
  char what[160];
  struct gx_case one = case_draft("mesh.cells=6", "mesh.particles_per_cell=3", "problem.modulus=100");
  case_set(&one, GX_PROBLEM_NAME, problem);
  if (*dim) case_set(&one, GX_PROBLEM_DIMENSION, dim);
  case_set(&one, GX_METHOD_SPACE, kind->name);
  case_set(&one, GX_METHOD_CLOCK, clock->name);
  case_set(&one, GX_TIME_CFL, kind->collocation ? "0.04" : "0.15");
  if (option) case_set(&one, option->id, option->text);
  if (option && option->with) case_set(&one, option->also, option->with);
  gx_parameter_resolve(one.value);
  snprintf(what, sizeof what, "%s %s %s %s %s", problem, dim, kind->name, clock->name, option ? option->text : "");
  for (int looked = 0; looked < 3; looked++) check_restart(&one, what, looked);
}

static void every_space_and_clock(void **state)
{
  (void)state;
  for (int s = 0; gx_space_family[s]; s++)
    for (int k = 0; gx_clock_family[k]; k++) {
      const struct gx_space_kind *kind = gx_space_family[s];
      if (kind->of_problem) continue;
      check_method(kind, gx_clock_family[k], "bar-neo-hookean", "", NULL);
      check_method(kind, gx_clock_family[k], "bar-linear", "", NULL);
      check_method(kind, gx_clock_family[k], "axis-aligned", "2", NULL);
    }
}

static void every_option(void **state)
{
  (void)state;
  for (int s = 0; gx_space_family[s]; s++)
    for (int k = 0; gx_clock_family[k]; k++)
      for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        const struct gx_space_kind *kind = gx_space_family[s];
        if (kind->of_problem || !applies(kind, &options[i])) continue;
        check_method(kind, gx_clock_family[k], "bar-neo-hookean", "", &options[i]);
        if (!kind->collocation) check_method(kind, gx_clock_family[k], "axis-aligned", "2", &options[i]);
      }
}

/* Problems with equations of their own, and bodies. */
static void every_problem(void **state)
{
  (void)state;
  for (int p = 0; gx_problem_family[p]; p++)
    for (int k = 0; gx_clock_family[k]; k++) {
      const struct gx_problem *problem = gx_problem_family[p];
      if (!problem->space && k) continue; /* one clock is enough where the spaces are the same */
      struct gx_case one = case_draft("mesh.cells=8", "mesh.particles_per_cell=2");
      case_set(&one, GX_PROBLEM_NAME, problem->name);
      case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
      if (problem->space) case_set(&one, GX_TIME_DT, problem->cycles > 0 ? "0.02" : "0.004");
      if (problem->space) case_set(&one, GX_PROBLEM_MODULUS, "1");
      gx_parameter_resolve(one.value);
      for (int looked = 0; looked < 3; looked++) check_restart(&one, problem->name, looked);
    }
}

/* An image of something else is told, not taken. */
static void a_foreign_image_is_not_loaded(void **state)
{
  (void)state;
  struct gx_case one = case_of("mesh.cells=8"), other = case_of("mesh.cells=9");
  struct rig rig, foreign;
  struct image_memory memory = {0};
  assert_true(rig_build(&rig, &one, NULL, NULL, NULL) && rig_build(&foreign, &other, NULL, NULL, NULL));
  move(&rig, &memory, false);
  struct gx_image image = image_of(&memory, true);
  gx_stepper_image(foreign.stepper, &image);
  assert_true(image.failed);
  memory.length /= 2;
  image = image_of(&memory, true);
  gx_stepper_image(rig.stepper, &image);
  assert_true(image.failed);
  free(memory.bytes);
  rig_free(&rig);
  rig_free(&foreign);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_space_and_clock),
      cmocka_unit_test(every_option),
      cmocka_unit_test(every_problem),
      cmocka_unit_test(a_foreign_image_is_not_loaded),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
