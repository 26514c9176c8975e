/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In 2-D and 3-D, with a bulk modulus and a wave along every axis: every clock, basis, degree and mass matrix ends well in both grid
 * spaces, periodic and between walls. */
#include <gsl/gsl_errno.h>

#include "case_of.h"

static void check_box(struct gx_case one, const char *what)
{
  const char *const boundary[] = {"periodic", "fixed"};
  for (int dim = 2; dim <= GX_MAX_DIM; dim++)
    for (int walls = 0; walls < 2; walls++)
      for (int consistent = 0; consistent < 2; consistent++) {
        case_set_integer(&one, GX_PROBLEM_DIMENSION, dim);
        case_set_integer(&one, GX_MESH_CELLS, dim == 2 ? 4 : 3);
        case_set(&one, GX_PROBLEM_BOUNDARY, boundary[walls]);
        case_set(&one, GX_METHOD_MASS, consistent ? "consistent" : "lumped");
        struct gx_case resolved = one;
        gx_parameter_resolve(resolved.value);
        struct gx_result result = gx_case_run(&resolved);
        const char *mass = consistent ? "consistent" : "lumped";
        CHECK(result.outcome.status == GX_OK, "%s, %d-D, %s, %s: %s %s", what, dim, boundary[walls], mass,
              gx_status_name(result.outcome.status), result.outcome.reason);
        for (int q = 0; q < GX_QUANTITIES; q++) {
          double error = result.measured.last.error[q][GX_RMS];
          CHECK(isfinite(error) && error > 0, "%s, %d-D, %s, %s: error %d is %g", what, dim, boundary[walls], mass, q, error);
        }
        double worst = result.measured.last.error[GX_DISPLACEMENT][GX_INF];
        CHECK(worst < 0.03 * sqrt(dim), "%s, %d-D, %s, %s: %g, as wrong as the wave is high", what, dim, boundary[walls], mass,
              worst);
        gx_case_free(&result);
      }
}

static struct gx_case box_on(const struct gx_space_kind *space, int degree)
{
  struct gx_case one = case_draft("problem.name=axis-aligned", "problem.amplitude=0.03", "problem.poisson=0.3", "time.steps=1",
                                  "time.cfl=0.2", "output.measures=final", "mesh.layout=gauss");
  case_set(&one, GX_METHOD_SPACE, space->name);
  case_set_integer(&one, GX_METHOD_DEGREE, degree);
  case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, degree < 3 ? 3 : 4);
  return one;
}

static void with_every_clock(void **state)
{
  (void)state;
  for (int s = 0; gx_space_family[s]; s++)
    for (int k = 0; gx_clock_family[k] && case_on_grid(gx_space_family[s]); k++) {
      struct gx_case one = box_on(gx_space_family[s], 2);
      case_set(&one, GX_METHOD_CLOCK, gx_clock_family[k]->name);
      check_box(one, gx_clock_family[k]->name);
    }
}

static void with_every_basis(void **state)
{
  (void)state;
  for (int s = 0; gx_space_family[s]; s++)
    for (int b = 0; gx_basis_family[b] && case_on_grid(gx_space_family[s]); b++) {
      const struct gx_basis *basis = gx_basis_family[b];
      if (basis->deforms && !gx_space_family[s]->fixed_grid) continue;
      for (int degree = 1; degree <= (basis->has_degree ? 5 : 1); degree++) {
        struct gx_case one = box_on(gx_space_family[s], degree);
        char what[64];
        snprintf(what, sizeof what, "%s %s %d", gx_space_family[s]->name, basis->name, degree);
        case_set(&one, GX_METHOD_BASIS, basis->name);
        if (basis->has_domain) case_set(&one, GX_MESH_LAYOUT, "uniform"); /* domains that are alike */
        check_box(one, what);
      }
    }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(with_every_clock),
      cmocka_unit_test(with_every_basis),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
