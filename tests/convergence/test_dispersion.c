/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numerical dispersion: the frequency at which a grid vibrates, for waves from long ones to those of two cells, against theory.
 * On a periodic uniform grid a wave is an eigenmode: with theta = k h, and stiffness K, mass M as symbols of theta per cell,
 *   (omega h / c)^2 = K/M            projection once, or consistent mass
 *   (omega h / c)^2 = K M            lumped mass re-projected each step: a projection multiplies the mode by M
 *   (omega h / c)^2 = K              lumped mass
 * For B-splines of degree p and exact integrals M is the sum over j of s_j^(2p+2) and K that of (theta + 2 pi j)^2 s_j^(2p+2),
 * s_j = sin(theta/2) / (theta/2 + pi j). */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_gamma.h>

#include "case_of.h"

enum { CELLS = 16 };

struct symbols {
  double K, M;
};

static struct symbols exact_symbols(int degree, double theta)
{
  struct symbols s = {0};
  for (int j = -20000; j <= 20000; j++) {
    double half = theta / 2 + M_PI * j, weight = pow(fabs(sin(theta / 2) / half), 2 * degree + 2);
    s.M += weight;
    s.K += 4 * half * half * weight;
  }
  return s;
}

/* Linear functions: K = 2 (1 - cos theta) for any particles, M = (2 + cos theta)/3 by exact integrals, and by the midpoint rule
 * with n particles a cell less (1 - cos theta)/(6 n^2): the mean of r^2 over a cell, 1/3, becomes 1/3 - 1/(12 n^2). */
static struct symbols linear_symbols(double theta, double particles)
{
  double versine = 1 - cos(theta);
  return (struct symbols){.K = 2 * versine, .M = (2 + cos(theta)) / 3 - versine / (6 * particles * particles)};
}

static struct gx_case vibrating_bar(const char *mass, const char *projection)
{
  struct gx_case one = case_draft("problem.name=bar-linear", "problem.boundary=periodic", "problem.modulus=1",
                                  "problem.amplitude=1e-3", "method.space=moving-mesh", "method.clock=rk4", "time.cfl=0.02",
                                  "time.periods=1", "output.measures=final", "output.frequency=1");
  case_set_integer(&one, GX_MESH_CELLS, CELLS);
  case_set(&one, GX_METHOD_MASS, mass);
  case_set(&one, GX_METHOD_PROJECTION, projection);
  return one;
}

/* omega h / c; NaN: no vibration */
static double frequency_of(struct gx_case one, int mode)
{
  case_set_integer(&one, GX_PROBLEM_MODE, mode);
  gx_parameter_resolve(one.value);
  return 2 * M_PI * case_result(&one).vibration.frequency / (double)one.value[GX_MESH_CELLS].integer;
}

static void lumped_linear_functions(void **state)
{
  (void)state;
  static const char *const per_cell[] = {"1", "2", "3", "7"};
  for (int n = 0; n < 4; n++)
    for (int mode = 1; 2 * mode < CELLS; mode++) {
      struct gx_case one = vibrating_bar("lumped", "once");
      case_set(&one, GX_METHOD_BASIS, "linear");
      case_set(&one, GX_MESH_PARTICLES_PER_CELL, per_cell[n]);
      CLOSE(frequency_of(one, mode), 2 * sin(M_PI * mode / CELLS), 1e-6);
    }
}

static void lumped_linear_functions_projected_each_step(void **state)
{
  (void)state;
  for (int n = 1; n <= 4; n++)
    for (int mode = 1; 2 * mode < CELLS; mode++) {
      double theta = 2 * M_PI * mode / CELLS;
      struct symbols s = linear_symbols(theta, n);
      struct gx_case one = vibrating_bar("lumped", "each-step");
      case_set(&one, GX_METHOD_BASIS, "linear");
      case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, n);
      CLOSE(frequency_of(one, mode), sqrt(s.K * s.M), 1e-6);
      case_set(&one, GX_MESH_LAYOUT, "gauss");
      if (n > 1) CLOSE(frequency_of(one, mode), 2 * sin(theta / 2) * sqrt((2 + cos(theta)) / 3), 1e-6);
    }
}

static void consistent_linear_functions(void **state)
{
  (void)state;
  for (int n = 2; n <= 4; n++)
    for (int mode = 1; 2 * mode < CELLS; mode++) {
      double theta = 2 * M_PI * mode / CELLS;
      struct symbols s = linear_symbols(theta, n);
      struct gx_case one = vibrating_bar("consistent", n == 3 ? "each-step" : "once");
      case_set(&one, GX_METHOD_BASIS, "linear");
      case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, n);
      CLOSE(frequency_of(one, mode), sqrt(s.K / s.M), 1e-6);
      case_set(&one, GX_MESH_LAYOUT, "gauss");
      CLOSE(frequency_of(one, mode), sqrt(6 * (1 - cos(theta)) / (2 + cos(theta))), 1e-6);
    }
}

/* The standard mesh as the amplitude vanishes: the same grid, the same projection. */
static void standard_mesh_in_small_motion(void **state)
{
  (void)state;
  for (int mode = 1; 2 * mode < CELLS; mode += 2) {
    struct symbols s = linear_symbols(2 * M_PI * mode / CELLS, 2);
    struct gx_case one = vibrating_bar("lumped", "each-step");
    case_set(&one, GX_METHOD_SPACE, "standard");
    case_set(&one, GX_METHOD_BASIS, "linear");
    case_set(&one, GX_PROBLEM_AMPLITUDE, "1e-8");
    case_set(&one, GX_MESH_PARTICLES_PER_CELL, "2");
    CLOSE(frequency_of(one, mode), sqrt(s.K * s.M), 1e-6);
  }
}

/* All modes up to the one of two cells, which sines drive on the functions of even degree: those sit between the nodes. */
static void splines_have_the_galerkin_spectrum(void **state)
{
  (void)state;
  for (int degree = 2; degree <= 5; degree++)
    for (int mode = 1; 2 * mode <= CELLS; mode++) {
      struct symbols s = exact_symbols(degree, 2 * M_PI * mode / CELLS);
      double expected[] = {sqrt(s.K / s.M), sqrt(s.K), sqrt(s.K * s.M)};
      const char *const mass[] = {"consistent", "lumped", "lumped"}, *const projection[] = {"once", "once", "each-step"};
      for (int i = 0; i < 3; i++) {
        struct gx_case one = vibrating_bar(mass[i], projection[i]);
        case_set_integer(&one, GX_METHOD_DEGREE, degree);
        case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, degree + 1);
        case_set(&one, GX_MESH_LAYOUT, "gauss");
        double omega = frequency_of(one, mode);
        if (2 * mode == CELLS && degree % 2)
          CHECK(isnan(omega), "degree %d: a wave that vanishes at the nodes has frequency %g", degree, omega);
        else
          CHECK(fabs(omega / expected[i] - 1) < 1e-6, "degree %d, mode %d, %s %s: %.12g, not %.12g", degree, mode, mass[i],
                projection[i], omega, expected[i]);
      }
    }
}

/* |B_2p| by their sum, 2 (2p)! zeta(2p) / (2 pi)^2p. */
static double bernoulli(int p)
{
  double zeta = 0;
  for (int j = 4000; j >= 1; j--) zeta += pow(j, -2 * p);
  return 2 * gsl_sf_fact((unsigned)(2 * p)) * zeta / pow(2 * M_PI, 2 * p);
}

static double relative_error(int degree, int cells)
{
  struct gx_case one = vibrating_bar("consistent", "once");
  case_set(&one, GX_METHOD_CLOCK, "blanes-moan6");
  case_set(&one, GX_TIME_CFL, "0.04");
  case_set(&one, GX_TIME_PERIODS, "4");
  case_set(&one, GX_OUTPUT_FREQUENCY, "30");
  case_set(&one, GX_MESH_LAYOUT, "gauss");
  case_set_integer(&one, GX_METHOD_DEGREE, degree);
  case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, degree + 1);
  case_set_integer(&one, GX_MESH_CELLS, cells);
  return frequency_of(one, 1) / (2 * M_PI / cells) - 1;
}

/* Long waves: error |B_2p| / (2 (2p)!) theta^2p, the leading term of the sums above. Its next term is of relative order theta^2,
 * which an extrapolation of two grids removes. The finest grid's last error is of 1e-14, and round-off is seen. */
static void long_waves_have_order_two_p(void **state)
{
  (void)state;
  static const int cells[] = {12, 16, 24};
  for (int degree = 1; degree <= 5; degree++) {
    double error[3], constant[3];
    for (int i = 0; i < 3; i++) {
      error[i] = relative_error(degree, cells[i]);
      constant[i] = error[i] / pow(2 * M_PI / cells[i], 2 * degree);
    }
    double order = log(error[1] / error[2]) / log(1.5);
    CHECK(fabs(order - 2 * degree) < 0.4, "degree %d: order %.3f (%g, %g)", degree, order, error[1], error[2]);
    double square = 16.0 / 9, leading = bernoulli(degree) / (2 * gsl_sf_fact((unsigned)(2 * degree)));
    double extrapolated = (square * constant[1] - constant[0]) / (square - 1);
    CHECK(fabs(extrapolated / leading - 1) < 0.03, "degree %d: constant %.4e, not %.4e", degree, extrapolated, leading);
  }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lumped_linear_functions),
      cmocka_unit_test(lumped_linear_functions_projected_each_step),
      cmocka_unit_test(consistent_linear_functions),
      cmocka_unit_test(standard_mesh_in_small_motion),
      cmocka_unit_test(splines_have_the_galerkin_spectrum),
      cmocka_unit_test(long_waves_have_order_two_p),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
