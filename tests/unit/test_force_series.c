/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series in time of what depends on the cosine of an angle, against the functions themselves in long double: at angles of either sign, of
 * few and of many turns, where a series meets the next one and next to it; as many nodes as fill vectors or do not. */
#include "spaces/force_series.h"

#include <float.h>
#include <stdlib.h>

#include "check.h"

enum { MOST_NODES = 70, ANGLES = 2000 };

/* cos(angle) sin(x) / (1 + slope cos(x) cos(angle))^2 at x = i, which is what the standing waves have. */
struct wave {
  double slope;
  size_t nodes;
  int samples;
};

static long double value_of(const struct wave *wave, size_t i, long double cosine)
{
  const long double x = (long double)i, F = 1 + wave->slope * cosl(x) * cosine;
  return cosine * sinl(x) / (F * F);
}

static void take(void *context, double angle, double *force)
{
  struct wave *wave = context;
  wave->samples++;
  for (size_t i = 0; i < wave->nodes; i++) force[i] = (double)value_of(wave, i, cosl((long double)angle));
}

static double largest_of(const struct wave *wave)
{
  double largest = 0;
  for (size_t i = 0; i < wave->nodes; i++)
    for (int end = -1; end <= 1; end += 2) largest = fmax(largest, (double)fabsl(value_of(wave, i, end)));
  return largest;
}

static double angle_of(int a, uint64_t *seed)
{
  if (a < 200) return nextafter((a - 100) * M_PI / 32, a % 2 ? 10 : -10); /* where series meet, and their middles */
  if (a < 210) return (a - 205) * 0x1p14 * M_PI;
  const double reach[] = {1, 10, 1e5, 1e9};
  return reach[a % 4] * check_random(seed, -1, 1);
}

/* What is cut is at most 4 / (rho - 1) + 1 epsilon of the largest term, which is at most the largest value; samples and the sums of the
 * series err by no more than some epsilon each. */
static void check_wave(double slope, size_t nodes)
{
  struct wave wave = {slope, nodes, 0};
  struct gx_force_series *series = gx_force_series_create(nodes, 16, take, &wave);
  CHECK(series, "no series for slope %g at %zu nodes", slope, nodes);
  CHECK(gx_force_series_terms(series) <= 16, "%zu terms", gx_force_series_terms(series));
  const double rho = (1 + sqrt(1 - slope * slope)) / slope, bound = (4 / (rho - 1) + 1 + 16) * DBL_EPSILON * largest_of(&wave);
  uint64_t seed = 3;
  for (int a = 0; a < ANGLES; a++) {
    const double angle = angle_of(a, &seed);
    double force[MOST_NODES + GX_FORCE_SERIES_ROOM + 1];
    for (size_t i = 0; i < sizeof force / sizeof *force; i++) force[i] = 7;
    gx_force_series_at(series, angle, force);
    for (size_t i = 0; i < nodes; i++) NEAR(force[i], (double)value_of(&wave, i, cosl((long double)angle)), bound);
    assert_true(force[nodes + GX_FORCE_SERIES_ROOM] == 7);
    for (size_t i = nodes; i < nodes + GX_FORCE_SERIES_ROOM; i++) assert_true(force[i] == 0 || force[i] == 7);
  }
  gx_force_series_free(series);
}

static void waves(void **state)
{
  (void)state;
  const double slopes[] = {1e-6, 6e-4, 0.03, 0.314, 0.5, 0.63, 0.754};
  for (size_t s = 0; s < sizeof slopes / sizeof *slopes; s++) {
    check_wave(slopes[s], 66);
    check_wave(slopes[s], 64);
    check_wave(slopes[s], 3);
  }
}

/* The steeper the wave, the more terms; a finite sum of cosines has as many as it needs to be a Taylor series. */
static void terms_grow_with_the_slope(void **state)
{
  (void)state;
  size_t before = 0;
  for (double slope = 0.001; slope < 0.76; slope *= 3) {
    struct wave wave = {slope, 9, 0};
    struct gx_force_series *series = gx_force_series_create(9, 16, take, &wave);
    assert_non_null(series);
    assert_true(gx_force_series_terms(series) >= before);
    before = gx_force_series_terms(series);
    gx_force_series_free(series);
    struct gx_force_series *fewer = gx_force_series_create(9, before - 1, take, &wave);
    CHECK(!fewer, "a series of %zu terms is made where %zu are allowed", before, before - 1);
  }
  assert_true(before > 8);
}

static void take_kink(void *context, double angle, double *force)
{
  (void)context;
  force[0] = fabs(cos(angle));
}

static void take_nothing(void *context, double angle, double *force)
{
  (void)angle;
  force[0] = force[1] = *(double *)context;
}

static void what_is_no_series(void **state)
{
  (void)state;
  double nan = NAN, infinite = INFINITY;
  struct wave steep = {0.99, 9, 0}, few = {0.3, 9, 0};
  assert_null(gx_force_series_create(9, 16, take, &steep));
  assert_null(gx_force_series_create(1, 16, take_kink, NULL));
  assert_null(gx_force_series_create(2, 16, take_nothing, &nan));
  assert_null(gx_force_series_create(2, 16, take_nothing, &infinite));
  assert_null(gx_force_series_create(9, 3, take, &few));
  assert_int_equal(few.samples, 0);
}

static void constants(void **state)
{
  (void)state;
  const double values[] = {0, -3.25, 1e300};
  for (int i = 0; i < 3; i++) {
    double value = values[i], force[2 + GX_FORCE_SERIES_ROOM];
    struct gx_force_series *series = gx_force_series_create(2, 16, take_nothing, &value);
    assert_non_null(series);
    gx_force_series_at(series, 12.3, force);
    CLOSE(force[1], value, 4 * DBL_EPSILON);
    gx_force_series_free(series);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(waves),
      cmocka_unit_test(terms_grow_with_the_slope),
      cmocka_unit_test(what_is_no_series),
      cmocka_unit_test(constants),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
