/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Banded solves against GSL's banded LU, on random rows that sum to one. */
#include "../spline_band.h"

#include <gsl/gsl_linalg.h>

#include "near.h"

static double random_number(uint64_t *state)
{
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

enum { ROWS = 37, MOST = 9 };

static void against_gsl(int degree, int lower, int upper, uint64_t seed)
{
  double entry[ROWS * (2 * MOST + 1)] = {0}, b[ROWS], x[ROWS];
  struct gx_spline_band band = {.degree = degree, .lower = lower, .upper = upper, .rows = ROWS, .entry = entry};
  size_t l = (size_t)lower, u = (size_t)upper, room = l > u ? l : u;
  gsl_matrix *packed = gsl_matrix_calloc(ROWS, 2 * room + room + 1);
  gsl_vector_uint *pivots = gsl_vector_uint_alloc(ROWS);
  gsl_vector *expected = gsl_vector_alloc(ROWS);
  for (int i = 0; i < ROWS; i++) {
    for (int j = i - lower; j <= i + upper; j++) {
      if (j < 0 || j >= ROWS) continue;
      double value = (i == j ? 2 : 1) * random_number(&seed) + (i == j ? (double)(lower + upper) : 0);
      entry[i * (2 * degree + 1) + degree + j - i] = value;
      gsl_matrix_set(packed, (size_t)j, (size_t)((int)(2 * room) + i - j), value);
    }
    b[i] = random_number(&seed) - 0.5;
    gsl_vector_set(expected, (size_t)i, b[i]);
  }
  assert_int_equal(gsl_linalg_LU_band_decomp(ROWS, room, room, packed, pivots), 0);
  assert_int_equal(gsl_linalg_LU_band_svx(room, room, packed, pivots, expected), 0);
  assert_int_equal(gx_spline_band_factor(&band), -1);
  gx_spline_band_solve(&band, b, x);
  for (size_t i = 0; i < ROWS; i++) NEAR(x[i], gsl_vector_get(expected, i), 1e-14);
  gx_spline_band_solve(&band, b, b);
  for (size_t i = 0; i < ROWS; i++) NEAR(b[i], x[i], 0);
  gsl_vector_free(expected);
  gsl_vector_uint_free(pivots);
  gsl_matrix_free(packed);
}

static void every_width_agrees_with_gsl(void **state)
{
  (void)state;
  for (int degree = 1; degree <= MOST; degree++)
    for (int lower = 0; lower <= degree; lower++)
      for (int upper = 0; upper <= degree; upper++)
        if (lower + upper) against_gsl(degree, lower, upper, (uint64_t)(degree * 100 + lower * 10 + upper));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_width_agrees_with_gsl)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
