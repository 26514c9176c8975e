/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cantilever's largest tip deflection converges under refinement in both grid spaces, to the same value, which is that of beam
 * theory: of Reissner's beam where deflections are large, of the modes of Euler and Bernoulli where they are small. */
#include <gsl/gsl_errno.h>

#include "beam.h"
#include "case_of.h"

static const double young = 4e6, poisson = 0.3, length = 0.75, thickness = 0.0625, first_swing = 0.5; /* s */

/* Largest displacement of the middle of the free end over the first swing down. */
static double tip(const char *space, int cells, double gravity)
{
  struct gx_case one = case_draft("problem.name=cantilever", "output.probe=0.75 0.84375", "output.measures=max", "time.end=0.5");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set_integer(&one, GX_MESH_CELLS, cells);
  case_set_real(&one, GX_PROBLEM_GRAVITY, gravity);
  gx_parameter_resolve(one.value);
  return case_result(&one).measured.probe_displacement;
}

static struct beam theory(void)
{
  struct gx_moduli moduli = gx_material_moduli(young, poisson, 1e3);
  return beam_of(length, thickness, young / (1 - poisson * poisson), moduli.mu, moduli.density);
}

/* Reissner's beam, without shear and inertia of rotation but for 1 %, is that of Euler and Bernoulli. */
static void the_beam_is_that_of_small_deflections(void **state)
{
  (void)state;
  struct beam beam = theory();
  double farthest = 0;
  for (double t = 0; t < first_swing; t += 1e-4) farthest = fmax(farthest, beam_modes(&beam, 0.0981, t));
  CLOSE(beam_swing(&beam, 0.0981, first_swing), farthest, 0.012);
  double at_rest = 0;
  for (int n = 0; n < 4000; n++) at_rest += beam_modes(&beam, 1, 0.0137 * n) / 4000; /* the mean of a vibration from rest */
  CLOSE(at_rest, beam.mass * pow(length, 4) / (8 * beam.bend), 0.01);
}

/* In the spaces from `first` to the moving mesh. */
static void check_tip(int first, double gravity, double of_length)
{
  struct beam beam = theory();
  double expected = beam_swing(&beam, gravity, first_swing), coarse[3], at[2];
  CHECK(expected > of_length * length && expected < 1.1 * of_length * length, "%g", expected);
  for (int s = first; s < 2; s++) {
    for (int k = 0; k < 3; k++) coarse[k] = tip(s ? "moving-mesh" : "standard", 16 << k, gravity);
    at[s] = coarse[2];
    double order = log2((coarse[0] - coarse[1]) / (coarse[1] - coarse[2]));
    CHECK(order > 1.5, "space %d: %g, %g, %g", s, coarse[0], coarse[1], coarse[2]);
    CLOSE(at[s], expected, 0.01);
  }
  CLOSE(at[first], at[1], 0.01);
}

static void large_deflections_are_those_of_the_beam(void **state)
{
  (void)state;
  check_tip(0, 9.81, 0.64);
}

static void small_deflections_are_those_of_the_beam(void **state)
{
  (void)state;
  check_tip(1, 0.0981, 0.007);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_beam_is_that_of_small_deflections),
      cmocka_unit_test(large_deflections_are_those_of_the_beam),
      cmocka_unit_test(small_deflections_are_those_of_the_beam),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
