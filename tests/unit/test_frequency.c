/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frequencies of signals that are known, and of what does not vibrate. */
#include <gridcross/frequency.h>

#include "rig.h"

static struct gx_vibration fit(double frequency, double growth, double interval, int samples, double noise)
{
  struct gx_frequency f = {.interval = interval};
  uint64_t seed = 3;
  for (int i = 0; i < samples; i++) {
    double t = i * interval;
    gx_frequency_add(&f, exp(growth * t) * cos(2 * M_PI * frequency * t + 0.7) + check_random(&seed, -noise, noise));
  }
  return gx_frequency_fit(&f, 1e-9);
}

static void one_mode_is_fitted_exactly(void **state)
{
  (void)state;
  static const double growth[] = {0, -0.3, 2};
  for (int i = 0; i < 3; i++)
    for (int per_period = 3; per_period <= 400; per_period *= 3) {
      struct gx_vibration v = fit(1.7, growth[i], 1 / (1.7 * per_period), 3 * per_period, 0);
      CLOSE(v.frequency, 1.7, 1e-15 * per_period * per_period + 1e-13);
      NEAR(v.growth, growth[i], 1e-12 * per_period);
    }
}

static void part_of_a_period_is_enough(void **state)
{
  (void)state;
  struct gx_vibration v = fit(1, 0, 0.05, 5, 0);
  NEAR(v.frequency, 1, 1e-12);
}

static void noise_does_little(void **state)
{
  (void)state;
  CLOSE(fit(1.7, 0, 0.02, 1000, 1e-6).frequency, 1.7, 1e-6);
}

static void what_does_not_vibrate_has_no_frequency(void **state)
{
  (void)state;
  assert_true(isnan(fit(1, 0, 0.05, 3, 0).frequency)); /* two unknowns, one equation */
  struct gx_frequency still = {.interval = 1}, tiny = still, ramp = still, step = still, growing = still;
  for (int i = 0; i < 100; i++) {
    gx_frequency_add(&still, 0);
    gx_frequency_add(&tiny, 1e-12 * cos(i));
    gx_frequency_add(&ramp, 1 + i);
    gx_frequency_add(&step, 1);
    gx_frequency_add(&growing, cosh(0.1 * i));
  }
  assert_true(isnan(gx_frequency_fit(&still, 0).frequency));
  assert_true(isnan(gx_frequency_fit(&tiny, 1e-9).frequency));
  NEAR(2 * M_PI * gx_frequency_fit(&tiny, 1e-13).frequency, 1, 1e-12);
  assert_true(isnan(gx_frequency_fit(&ramp, 0).frequency));
  assert_true(isnan(gx_frequency_fit(&step, 0).frequency));
  assert_true(isnan(gx_frequency_fit(&growing, 0).frequency));
}

static void add_third_wave(struct gx_particles *particles, void *context)
{
  const double *amplitude = context;
  for (size_t p = 0; p < particles->n; p++) particles->u[0][p] += *amplitude * sin(6 * M_PI * particles->X[0][p]);
}

/* Wave 3 has the values of wave -1 at equal places of four cells: only the particles' volumes tell them apart. */
static void projection_is_by_volume(void **state)
{
  (void)state;
  struct gx_case one = case_of("problem.name=axis-aligned", "problem.amplitude=0.01", "mesh.cells=4", "mesh.particles_per_cell=6",
                               "mesh.layout=gauss", "time.dt=1e-3");
  double amplitude = 0.02;
  struct rig rig;
  assert_true(rig_build(&rig, &one, NULL, add_third_wave, &amplitude));
  NEAR(gx_frequency_project(rig.simulation.space), 0.01, 1e-7);
  rig_free(&rig);
}

/* In two dimensions the first direction that moves is followed. */
static void the_direction_that_moves_is_projected(void **state)
{
  (void)state;
  struct gx_case one = case_of("problem.name=axis-aligned", "problem.dimension=2", "problem.active=y", "problem.amplitude=0.01",
                               "mesh.cells=4", "time.dt=1e-3");
  struct rig rig;
  assert_true(rig_build(&rig, &one, NULL, NULL, NULL));
  NEAR(gx_frequency_project(rig.simulation.space), 0.01, 1e-15);
  rig_free(&rig);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_mode_is_fitted_exactly),
      cmocka_unit_test(part_of_a_period_is_enough),
      cmocka_unit_test(noise_does_little),
      cmocka_unit_test(projection_is_by_volume),
      cmocka_unit_test(the_direction_that_moves_is_projected),
      cmocka_unit_test(what_does_not_vibrate_has_no_frequency),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
