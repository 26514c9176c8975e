/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spectra of errors that are known, Parseval's theorem for those that are not, and planning in several threads. */
#include <pthread.h>

#include <gsl/gsl_errno.h>

#include <gridcross/spectrum.h>

#include "rig.h"

/* A body at rest whose particles are then moved: the error is the alteration. */
struct observed {
  struct rig rig;
  struct gx_measure *measure;
  struct gx_spectrum *spectrum;
  struct gx_spectra spectra; /* one sample */
};

static struct observed observe(const struct gx_case *one, void (*alter)(struct gx_particles *particles, void *context),
                               void *context)
{
  struct observed o = {0};
  double time = 0;
  assert_true(rig_build(&o.rig, one, NULL, alter, context));
  const struct gx_simulation *s = &o.rig.simulation;
  int per_side = s->space_options.cells[0] * s->per_cell;
  o.measure = gx_measure_create(s->space, s->clock, NULL, GX_MEASURE_MAX);
  o.spectrum = gx_spectrum_create(s->particles, per_side, s->space_options.periodic);
  size_t bins = gx_spectrum_bins(o.spectrum);
  o.spectra = (struct gx_spectra){.samples = 1,
                                  .bins = bins,
                                  .spacing = gx_spectrum_spacing(o.spectrum),
                                  .time = malloc(sizeof time),
                                  .rms = malloc(GX_QUANTITIES * bins * sizeof(double))};
  o.spectra.time[0] = time;
  assert_int_equal(gx_measure_take(o.measure, o.rig.stepper, 0, s->dt), GX_OK);
  gx_spectrum_take(o.spectrum, o.measure, o.spectra.rms);
  return o;
}

static void observed_free(struct observed *o)
{
  gx_spectrum_free(o->spectrum);
  gx_measure_free(o->measure);
  free(o->spectra.time);
  free(o->spectra.rms);
  rig_free(&o->rig);
}

static double bin_of(const struct observed *o, enum gx_quantity q, double wavenumber)
{
  return gx_spectrum_band(&o->spectra, 0, q, wavenumber - 0.01, wavenumber + 0.01);
}

/* All of an error lies at one wavenumber. */
static void check_pure(const struct observed *o, enum gx_quantity q, double wavenumber, double rms)
{
  double all = gx_spectrum_band(&o->spectra, 0, q, -1, INFINITY);
  CHECK(fabs(bin_of(o, q, wavenumber) - rms) < 1e-12 * rms, "wavenumber %g: %.17g, not %.17g", wavenumber,
        bin_of(o, q, wavenumber), rms);
  CHECK(fabs(all - rms) < 1e-12 * rms, "wavenumber %g: %.17g in all, not %.17g", wavenumber, all, rms);
}

struct wave {
  double u, v, F;    /* amplitudes */
  double wavenumber; /* 1/m */
  double shift;      /* of the phase, rad */
  double across;     /* wavenumber in y */
  int component, tensor;
};

static void add_wave(struct gx_particles *particles, void *context)
{
  const struct wave *w = context;
  int dim = particles->dim;
  for (size_t p = 0; p < particles->n; p++) {
    double x = 2 * M_PI * w->wavenumber * particles->X[0][p] + w->shift;
    double y = dim > 1 ? 2 * M_PI * w->across * particles->X[1][p] : 0;
    double along = w->component == 0 ? sin(x) : cos(x), over = dim == 1 ? 1 : w->component == 0 ? cos(y) : sin(y);
    particles->u[w->component][p] += w->u * along * over;
    particles->v[w->component][p] += w->v * along * over;
    particles->F[w->tensor][p] += w->F * (w->tensor == 1 ? sin(x) * sin(y) : cos(x) * (dim > 1 ? cos(y) : 1));
  }
}

static const double half_root = M_SQRT1_2;

static void a_wave_has_its_bin(void **state)
{
  (void)state;
  for (int cells = 5; cells <= 8; cells++) {
    const int n = 3 * cells;
    struct gx_case one = case_of("problem.name=bar-linear", "problem.boundary=periodic", "problem.amplitude=0",
                                 "mesh.particles_per_cell=3", "time.dt=1e-6", "method.clock=euler-stress-last");
    case_set_integer(&one, GX_MESH_CELLS, cells);
    for (int k = 0; 2 * k <= n; k++) {
      bool edge = k == 0 || 2 * k == n; /* one of sine and cosine vanishes there: no root of 1/2 */
      double shift = k == 0 ? M_PI_2 : 0.4, peak = 2 * k == n ? fabs(sin(M_PI_2 + shift)) : 1;
      struct wave wave = {.u = 1e-3, .v = 0.5, .F = 1e-3, .wavenumber = k, .shift = shift};
      struct observed o = observe(&one, add_wave, &wave);
      check_pure(&o, GX_DISPLACEMENT, k, 1e-3 * (edge ? peak : half_root));
      check_pure(&o, GX_VELOCITY, k, 0.5 * (edge ? peak : half_root));
      observed_free(&o);
    }
  }
}

/* Between fixed ends: sines of half waves in displacement and velocity, cosines in stress, P = E (F - 1). */
static void a_half_wave_has_its_bin(void **state)
{
  (void)state;
  struct gx_case one = case_of("problem.name=bar-linear", "problem.amplitude=0", "problem.modulus=16", "mesh.cells=6",
                               "mesh.particles_per_cell=2", "time.dt=1e-6", "method.clock=euler-stress-last");
  for (int m = 0; m <= 12; m++) {
    struct wave wave = {.u = 1e-4, .v = 0.5, .F = 1e-3, .wavenumber = 0.5 * m};
    struct observed o = observe(&one, add_wave, &wave);
    if (m > 0) check_pure(&o, GX_DISPLACEMENT, 0.5 * m, 1e-4 * (m == 12 ? 1 : half_root));
    if (m > 0) check_pure(&o, GX_VELOCITY, 0.5 * m, 0.5 * (m == 12 ? 1 : half_root));
    if (m < 12) check_pure(&o, GX_STRESS, 0.5 * m, 16e-3 * (m == 0 ? 1 : half_root));
    observed_free(&o);
  }
}

/* Shells: a wave vector (3, 4) has length 5. A product of two waves of amplitude a has a/2. */
static void wave_vectors_have_their_shell(void **state)
{
  (void)state;
  static const char *const boundary[] = {"periodic", "fixed"};
  for (int fixed = 0; fixed < 2; fixed++)
    for (int component = 0; component < 2; component++) {
      struct gx_case one = case_of("problem.name=axis-aligned", "problem.dimension=2", "problem.amplitude=0", "mesh.cells=6",
                                   "mesh.particles_per_cell=2", "time.dt=1e-6", "method.clock=euler-stress-last");
      case_set(&one, GX_PROBLEM_BOUNDARY, boundary[fixed]);
      double unit = fixed ? 0.5 : 1;
      struct wave wave = {.u = 1e-4, .v = 0.5, .wavenumber = 3 * unit, .across = 4 * unit, .component = component};
      struct observed o = observe(&one, add_wave, &wave);
      check_pure(&o, GX_DISPLACEMENT, 5 * unit, 0.5e-4);
      check_pure(&o, GX_VELOCITY, 5 * unit, 0.25);
      observed_free(&o);
      /* small: shear stress is odd at all ends, normal stress even, and what is of second order is not seen */
      wave = (struct wave){.F = 1e-7, .wavenumber = 3 * unit, .across = 4 * unit, .tensor = component};
      o = observe(&one, add_wave, &wave);
      double all = gx_spectrum_band(&o.spectra, 0, GX_STRESS, -1, INFINITY);
      assert_true(all > 0);
      CHECK(bin_of(&o, GX_STRESS, 5 * unit) > (1 - 1e-6) * all, "%s, F%d: %g of %g", boundary[fixed], component,
            bin_of(&o, GX_STRESS, 5 * unit), all);
      observed_free(&o);
    }
}

static void shake(struct gx_particles *particles, void *context)
{
  uint64_t *seed = context;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) {
      particles->u[d][p] += check_random(seed, -1e-3, 1e-3);
      particles->v[d][p] += check_random(seed, -1, 1);
    }
  for (int k = 0; k < particles->dim * particles->dim; k++)
    for (size_t p = 0; p < particles->n; p++) particles->F[k][p] += check_random(seed, -0.05, 0.05);
}

/* Mean square of a component's error by a plain sum. */
static double mean_square(const struct observed *o, enum gx_quantity q)
{
  const struct gx_particles *particles = o->rig.simulation.particles;
  int components = q == GX_STRESS ? particles->dim * particles->dim : particles->dim;
  double *error = malloc(particles->n * sizeof *error), sum = 0;
  for (int k = 0; k < components; k++) {
    gx_measure_error(o->measure, q, k, error);
    for (size_t p = 0; p < particles->n; p++) sum += error[p] * error[p];
  }
  free(error);
  return sum / (double)particles->n;
}

static void squares_sum_to_the_error_s_square(void **state)
{
  (void)state;
  static const char *const boundary[] = {"periodic", "fixed"}, *const per_cell[] = {"1", "2", "3"};
  uint64_t seed = 5;
  for (int dim = 1; dim <= 3; dim++)
    for (int fixed = 0; fixed < 2; fixed++)
      for (int n = 0; n < 3; n++) {
        struct gx_case one = case_draft("problem.name=axis-aligned", "problem.amplitude=0.02", "mesh.cells=5", "time.dt=1e-6");
        case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
        case_set(&one, GX_PROBLEM_BOUNDARY, boundary[fixed]);
        case_set(&one, GX_MESH_PARTICLES_PER_CELL, per_cell[n]);
        gx_parameter_resolve(one.value);
        struct observed o = observe(&one, shake, &seed);
        for (int q = 0; q < GX_QUANTITIES; q++) {
          double all = gx_spectrum_band(&o.spectra, 0, (enum gx_quantity)q, -1, INFINITY);
          CLOSE(all * all, mean_square(&o, (enum gx_quantity)q), 1e-12);
          CLOSE(all, gx_measure_result(o.measure)->last.error[q][GX_RMS], 1e-12);
        }
        observed_free(&o);
      }
}

/* exp(-3 t) at wavenumber 1, exp(5 t) at 2 and nothing at the first sample. */
static void growth_is_that_of_the_part(void **state)
{
  (void)state;
  enum { SAMPLES = 5, BINS = 3 };
  double time[SAMPLES], rms[SAMPLES][GX_QUANTITIES][BINS] = {0};
  struct gx_spectra spectra = {.samples = SAMPLES, .bins = BINS, .spacing = 1, .time = time, .rms = &rms[0][0][0]};
  for (int i = 0; i < SAMPLES; i++) {
    time[i] = 0.1 * i * i;
    if (i) rms[i][GX_STRESS][1] = 7 * exp(-3 * time[i]);
    if (i) rms[i][GX_STRESS][2] = 1e-9 * exp(5 * time[i]);
  }
  NEAR(gx_spectrum_growth(&spectra, GX_STRESS, 0.5, 1.5), -3, 1e-12);
  NEAR(gx_spectrum_growth(&spectra, GX_STRESS, 1.5, INFINITY), 5, 1e-11);
  assert_true(isnan(gx_spectrum_growth(&spectra, GX_STRESS, -1, 0.5)));
  assert_true(isnan(gx_spectrum_growth(&spectra, GX_VELOCITY, -1, INFINITY)));
  spectra.samples = 2; /* one that is not zero */
  assert_true(isnan(gx_spectrum_growth(&spectra, GX_STRESS, -1, INFINITY)));
  NEAR(gx_spectrum_band(&spectra, 1, GX_STRESS, -1, INFINITY), hypot(rms[1][GX_STRESS][1], rms[1][GX_STRESS][2]), 1e-15);
  NEAR(gx_spectrum_band(&spectra, 1, GX_STRESS, -1, 1), rms[1][GX_STRESS][1], 0); /* high is included, low is not */
  NEAR(gx_spectrum_band(&spectra, 1, GX_STRESS, 1, 2), rms[1][GX_STRESS][2], 0);
}

static void *plan_often(void *argument)
{
  const int *start = argument;
  for (int i = 0; i < 150; i++) {
    int cells = 3 + (*start + 7 * i) % 40;
    struct gx_particles *particles = gx_particles_create(1, &cells, 4, GX_LAYOUT_UNIFORM, 1);
    struct gx_spectrum *spectrum = gx_spectrum_create(particles, 4 * cells, i % 2);
    if (!spectrum) return argument;
    gx_spectrum_free(spectrum);
    gx_particles_free(particles);
  }
  return NULL;
}

static void threads_may_plan_at_once(void **state)
{
  (void)state;
  enum { THREADS = 8 };
  pthread_t thread[THREADS];
  int start[THREADS];
  for (int i = 0; i < THREADS; i++) {
    start[i] = 13 * i;
    assert_int_equal(pthread_create(&thread[i], NULL, plan_often, &start[i]), 0);
  }
  for (int i = 0; i < THREADS; i++) {
    void *failed;
    pthread_join(thread[i], &failed);
    assert_null(failed);
  }
}

/* What observes changes nothing: results are the same to the last bit, in every space. */
static void observers_change_nothing(void **state)
{
  (void)state;
  static const char *const space[] = {"standard", "moving-mesh", "spline-particle", "spline-grid"};
  for (int i = 0; i < 4; i++)
    for (int level = 0; level < 2; level++) {
      struct gx_case one = case_draft("mesh.cells=8", "time.periods=0.3", "time.cfl=0.05");
      case_set(&one, GX_METHOD_SPACE, space[i]);
      case_set(&one, GX_OUTPUT_MEASURES, level ? "final" : "all");
      gx_parameter_resolve(one.value);
      struct gx_measured plain = case_result(&one).measured;
      case_set_integer(&one, GX_OUTPUT_SPECTRA, 1);
      case_set_integer(&one, GX_OUTPUT_FREQUENCY, 2);
      struct gx_result result = gx_case_run(&one);
      assert_true(result.spectra.samples == result.steps + 1);
      assert_true(result.vibration.frequency > 0);
      assert_memory_equal(result.measured.last.error, plain.last.error, sizeof plain.last.error);
      if (!level) assert_memory_equal(result.measured.max_error, plain.max_error, sizeof plain.max_error);
      if (!level) assert_memory_equal(&result.measured.drift, &plain.drift, sizeof plain.drift);
      gx_case_free(&result);
    }
}

static void uneven_particles_are_refused(void **state)
{
  (void)state;
  struct gx_case one = case_of("mesh.layout=gauss", "output.spectra=1");
  struct gx_result result = gx_case_run(&one);
  assert_int_equal(result.outcome.status, GX_REFUSED);
  assert_non_null(strstr(result.outcome.reason, "layout uniform"));
  gx_case_free(&result);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_wave_has_its_bin),
      cmocka_unit_test(a_half_wave_has_its_bin),
      cmocka_unit_test(wave_vectors_have_their_shell),
      cmocka_unit_test(squares_sum_to_the_error_s_square),
      cmocka_unit_test(growth_is_that_of_the_part),
      cmocka_unit_test(threads_may_plan_at_once),
      cmocka_unit_test(observers_change_nothing),
      cmocka_unit_test(uneven_particles_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
