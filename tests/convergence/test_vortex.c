/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The generalized vortex, a body that leaves cells partly filled: order 2 with lumped mass in both grid spaces, once particles are
 * small enough beside the cells to show the ring's edge; with large particles its staircase is the error, which is that of the net
 * torque of the body force. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

static double error(const char *space, const char *cells, const char *per_cell)
{
  struct gx_case one = case_draft("problem.name=generalized-vortex", "problem.rotation=0.1", "time.periods=0.5",
                                  "output.measures=max", "time.cfl=0.4");
  case_set(&one, GX_METHOD_SPACE, space);
  case_set(&one, GX_MESH_CELLS, cells);
  case_set(&one, GX_MESH_PARTICLES_PER_CELL, per_cell);
  gx_parameter_resolve(one.value);
  return case_result(&one).measured.max_error[GX_DISPLACEMENT][GX_RMS];
}

static void order_two_with_lumped_mass(void **state)
{
  (void)state;
  const char *const spaces[] = {"standard", "moving-mesh"};
  for (int s = 0; s < 2; s++) {
    double coarse = error(spaces[s], "32", "8"), fine = error(spaces[s], "64", "8");
    CHECK(log2(coarse / fine) > 1.75, "%s: %g, %g", spaces[s], coarse, fine);
  }
}

/* The angle by which a ring of n x n points in the domain turns as a whole in half a period, if the torque of the body force, which
 * should leave only the angular momentum of the exact motion, is summed over the points: theta'' = g(t) torque/inertia. To first
 * order in G the body force against the shear is -mu (3 h' + R h'')/rho0 along the circle. */
static double rigid_turn(int n, const struct gx_moduli *moduli, double G)
{
  const double inner = 0.24, outer = 0.4, width = outer - inner;
  double torque = 0, inertia = 0, points = 0;
  for (int i = 0; i < n * n; i++) {
    double R = hypot((i % n + 0.5) / n - 0.5, (i / n + 0.5) / n - 0.5), s = (R - 0.5 * (inner + outer)) / width;
    if (R < inner || R > outer) continue;
    torque -=
        R * moduli->mu / moduli->density * (3 * -16 * s * (1 - 4 * s * s) / width + R * (192 * s * s - 16) / (width * width));
    inertia += R * R;
    points++;
  }
  double c = sqrt((moduli->lambda + 2 * moduli->mu) / moduli->density), T = 0.375 / c;
  return fabs(G * torque / inertia) * T * T / M_PI * sqrt(inertia / points); /* displacement, RMS */
}

static void the_staircase_of_the_edge_turns_the_ring(void **state)
{
  (void)state;
  struct gx_moduli moduli = gx_material_moduli(1e4, 0.3, 1);
  double turned = rigid_turn(128, &moduli, 0.1);
  CHECK(turned > 2e-3, "%g", turned);
  CLOSE(error("moving-mesh", "64", "2"), turned, 0.2);
  CLOSE(error("standard", "64", "2"), turned, 0.2);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(order_two_with_lumped_mass),
      cmocka_unit_test(the_staircase_of_the_edge_turns_the_ring),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
