/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where errors live: above the grid's Nyquist wavenumber those of the standard mesh grow from period to period, as particles cross
 * cells, and stay under refinement; those of the moving mesh are the images of its basis functions, which neither grow nor last. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

enum { PERIODS = 4, SAMPLES = 20 }; /* samples a period */

/* Largest part above Nyquist's wavenumber in each period of the neo-Hookean bar at CFL 0.4. */
static void envelope(const char *space, int degree, int cells, enum gx_quantity quantity, double *largest)
{
  struct gx_case one = case_draft("time.cfl=0.4", "output.measures=final");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set_integer(&one, GX_METHOD_DEGREE, degree);
  case_set_integer(&one, GX_MESH_CELLS, cells);
  case_set_real(&one, GX_TIME_PERIODS, PERIODS);
  case_set_integer(&one, GX_OUTPUT_SPECTRA, cells / 4); /* of 5 steps a cell: a period is 2/c */
  gx_parameter_resolve(one.value);
  struct gx_result result = gx_case_run(&one);
  const struct gx_spectra *spectra = &result.spectra;
  CHECK(result.outcome.status == GX_OK, "%s: %s", space, result.outcome.reason);
  assert_int_equal(spectra->samples, PERIODS * SAMPLES + 1);
  for (size_t i = 0; i < PERIODS; i++) {
    largest[i] = 0;
    for (size_t k = 1; k <= SAMPLES; k++)
      largest[i] = fmax(largest[i], gx_spectrum_band(spectra, i * SAMPLES + k, quantity, spectra->nyquist, INFINITY));
  }
  gx_case_free(&result);
}

static void standard_mesh_rings_louder_and_louder(void **state)
{
  (void)state;
  for (int degree = 1; degree <= 2; degree++) {
    double u[PERIODS], stress[2][PERIODS];
    for (int fine = 0; fine < 2; fine++) {
      envelope("standard", degree, 32 << fine, GX_DISPLACEMENT, u);
      envelope("standard", degree, 32 << fine, GX_STRESS, stress[fine]);
      for (int i = 1; i < PERIODS; i++) {
        CHECK(u[i] > u[i - 1], "degree %d, period %d: displacement %g after %g", degree, i, u[i], u[i - 1]);
        CHECK(stress[fine][i] > stress[fine][i - 1], "degree %d, period %d: stress %g after %g", degree, i, stress[fine][i],
              stress[fine][i - 1]);
      }
    }
    double order = log2(stress[0][PERIODS - 1] / stress[1][PERIODS - 1]);
    CHECK(order < 0.5, "degree %d: stress above Nyquist falls with order %g", degree, order);
  }
}

static void moving_mesh_keeps_its_images(void **state)
{
  (void)state;
  static const enum gx_quantity quantity[] = {GX_DISPLACEMENT, GX_STRESS};
  for (int degree = 1; degree <= 2; degree++)
    for (int q = 0; q < 2; q++) {
      double part[2][PERIODS];
      for (int fine = 0; fine < 2; fine++) {
        envelope("moving-mesh", degree, 32 << fine, quantity[q], part[fine]);
        for (int i = 1; i < PERIODS; i++)
          CHECK(fabs(part[fine][i] / part[fine][0] - 1) < 0.01, "degree %d, quantity %d, period %d: %g, first %g", degree, q, i,
                part[fine][i], part[fine][0]);
      }
      double order = log2(part[0][0] / part[1][0]), expected = degree + 1 - q; /* stress goes with the derivative */
      CHECK(fabs(order - expected) < 0.1, "degree %d, quantity %d: order %g", degree, q, order);
    }
}

/* Root mean square above Nyquist's wavenumber of the wave that nodal values sin(2 pi X) span, at four particles a cell, by plain
 * sums. */
static double images_of_a_wave(int degree, int cells)
{
  int n = 4 * cells;
  double square = 0, *u = calloc((size_t)n, sizeof *u);
  for (int p = 0; p < n; p++) {
    double s = (p + 0.5) / 4, r = s - floor(s), node = floor(s);
    double hat[] = {1 - r, r, 0}, parabola[] = {0.5 * (1 - r) * (1 - r), 0.5 + r * (1 - r), 0.5 * r * r};
    for (int j = 0; j < 3; j++)
      u[p] += degree == 1 ? hat[j] * sin(2 * M_PI * (node + j) / cells) : parabola[j] * sin(2 * M_PI * (node + j - 0.5) / cells);
  }
  for (int k = cells / 2 + 1; k <= n / 2; k++) {
    double along = 0, across = 0;
    for (int p = 0; p < n; p++) {
      along += u[p] * cos(2 * M_PI * k * (p + 0.5) / n) / n;
      across += u[p] * sin(2 * M_PI * k * (p + 0.5) / n) / n;
    }
    square += (2 * k == n ? 1 : 2) * (along * along + across * across);
  }
  free(u);
  return sqrt(square);
}

static void images_are_those_of_the_basis(void **state)
{
  (void)state;
  for (int degree = 1; degree <= 2; degree++)
    for (int cells = 32; cells <= 64; cells *= 2) {
      double part[PERIODS], expected = 0.05 * images_of_a_wave(degree, cells);
      envelope("moving-mesh", degree, cells, GX_DISPLACEMENT, part);
      double own = 0.03 * 32 * 32 / (cells * cells); /* error of the wave itself, of order 2 with lumped mass */
      CHECK(fabs(part[0] / expected - 1) < own, "degree %d, %d cells: %g, images of the wave %g", degree, cells, part[0],
            expected);
    }
}

/* A bar in a plane: shells hold what the bar's wavenumbers do, and no more than the error there is. */
static void a_plane_wave_has_the_bar_s_spectrum(void **state)
{
  (void)state;
  static const char *const space[] = {"standard", "moving-mesh"}, *const boundary[] = {"periodic", "fixed"};
  for (int i = 0; i < 4; i++) {
    struct gx_case one = case_draft("problem.name=axis-aligned", "problem.active=x", "mesh.cells=8", "mesh.particles_per_cell=2",
                                    "time.periods=0.3", "output.spectra=4");
    case_set(&one, GX_METHOD_SPACE, space[i % 2]);
    case_set(&one, GX_PROBLEM_BOUNDARY, boundary[i / 2]);
    struct gx_case plane = one;
    case_set_integer(&plane, GX_PROBLEM_DIMENSION, 2);
    gx_parameter_resolve(one.value);
    gx_parameter_resolve(plane.value);
    struct gx_result line = gx_case_run(&one), result = gx_case_run(&plane);
    const struct gx_spectra *s = &result.spectra;
    assert_int_equal(s->samples, line.spectra.samples);
    for (size_t sample = 0; sample < s->samples; sample++)
      for (int q = 0; q < GX_QUANTITIES; q++) {
        double all = gx_spectrum_band(s, sample, (enum gx_quantity)q, -1, INFINITY);
        const double *flat = line.spectra.rms + (sample * GX_QUANTITIES + (size_t)q) * line.spectra.bins;
        const double *shell = s->rms + (sample * GX_QUANTITIES + (size_t)q) * s->bins;
        if (sample + 1 == s->samples) CLOSE(all, result.measured.last.error[q][GX_RMS], 1e-12);
        for (size_t b = 0; b < line.spectra.bins; b++) NEAR(shell[b], flat[b], 1e-9 * all);
      }
    gx_case_free(&line);
    gx_case_free(&result);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(standard_mesh_rings_louder_and_louder),
      cmocka_unit_test(moving_mesh_keeps_its_images),
      cmocka_unit_test(images_are_those_of_the_basis),
      cmocka_unit_test(a_plane_wave_has_the_bar_s_spectrum),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
