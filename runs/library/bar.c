/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program of one's own on the installed library: own material, own problem, own basis, on a space and a clock of the library.
 * cc bar.c -o bar $(pkg-config --cflags --libs gridcross) -lm && ./bar
 *
 * A periodic bar of P(F) = E (F - 1 + (F - 1)^2) is kept by a body force on u = A sin(2 pi X) cos(w t), w = 2 pi sqrt(E/rho). */
#include <math.h>
#include <stdio.h>

#include <gridcross/measure.h>
#include <gridcross/simulation.h>

static const double k = 2 * 3.14159265358979323846; /* wavenumber, 1/m */

static long piola(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *const *P)
{
  for (size_t p = 0; p < n; p++) {
    if (dim != 1 || !(F[0][p] > 0)) return (long)p; /* tangled */
    P[0][p] = moduli->young * (F[0][p] - 1) * F[0][p];
  }
  return -1;
}

static double wave_speed(const struct gx_moduli *moduli)
{
  return sqrt(moduli->young / moduli->density);
}

static const struct gx_material hardening = {.name = "hardening", .piola = piola, .wave_speed = wave_speed};

static void exact(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F, double *const *a)
{
  const double A = posed->options.amplitude, w = k * posed->speed;
  for (size_t p = 0; p < posed->n; p++) {
    const double s = A * sin(k * posed->X[0][p]), c = A * cos(k * posed->X[0][p]);
    if (u) u[0][p] = s * cos(w * t);
    if (v) v[0][p] = -w * s * sin(w * t);
    if (F) F[0][p] = 1 + k * c * cos(w * t);
    if (a) a[0][p] = -w * w * s * cos(w * t);
  }
}

/* b = d2u/dt2 - (dP/dX)/rho, of which the linear part is zero */
static void body(const struct gx_posed *posed, double t, double *const *b)
{
  const double A = posed->options.amplitude, c2 = posed->speed * posed->speed, T = cos(k * posed->speed * t);
  for (size_t p = 0; p < posed->n; p++) {
    const double slope = k * A * T * cos(k * posed->X[0][p]), curve = -k * k * A * T * sin(k * posed->X[0][p]);
    b[0][p] = -c2 * 2 * slope * curve;
  }
}

static const struct gx_problem bar = {.name = "hardening-bar",
                                      .material = &hardening,
                                      .max_dim = 1,
                                      .boundaries = 1u << GX_BOUNDARY_PERIODIC,
                                      .boundary = GX_BOUNDARY_PERIODIC,
                                      .cycles = 1,
                                      .exact = exact,
                                      .body = body};

/* Quadratic B-splines on a periodic axis: functions cell, cell + 1, cell + 2 meet in a cell. */
static void layout(struct gx_axis *axis)
{
  axis->support = 3;
  axis->functions = axis->cells;
  axis->stored = axis->cells + 2;
}

static double site(const struct gx_axis *axis, int function)
{
  return axis->periodic ? function - 0.5 : NAN;
}

static long evaluate(const struct gx_axis *axis, size_t n, const double *x, const double *half, int *first, double *S, double *D)
{
  for (size_t p = 0; p < n; p++) {
    const double s = (x[p] - floor(x[p])) * axis->cells;
    first[p] = s < axis->cells ? (int)s : 0;
    const double r = s - first[p];
    S[p] = 0.5 * (1 - r) * (1 - r), S[n + p] = 0.5 + r * (1 - r), S[2 * n + p] = 0.5 * r * r;
    D[p] = (r - 1) * axis->cells, D[n + p] = (1 - 2 * r) * axis->cells, D[2 * n + p] = r * axis->cells;
  }
  (void)half; /* of particle domains, which these functions do not see */
  return -1;
}

static const struct gx_basis quadratic = {.name = "quadratic", .layout = layout, .site = site, .evaluate = evaluate};

/* Largest RMS error of the displacement over a period, m; NaN after a message. */
static double error_of(const char *space, int cells)
{
  struct gx_simulation simulation = gx_simulation_begin(&bar, gx_space_find(space), gx_clock_find("central-difference"));
  struct gx_outcome outcome = {.status = GX_OK, .particle = -1};
  simulation.space_options.cells[0] = cells;
  simulation.space_options.basis = &quadratic;
  simulation.steps = 4 * cells; /* dt = h/4c */
  simulation.dt = simulation.end = 1 / wave_speed(&simulation.problem_options.moduli);
  simulation.dt /= simulation.steps;
  enum gx_status status = gx_simulation_check(&simulation, &outcome);
  if (!status) status = gx_simulation_build(&simulation, &outcome);
  struct gx_measure *measure = status ? NULL : gx_measure_create(simulation.space, simulation.clock, NULL, GX_MEASURE_MAX);
  struct gx_work_observer work = {0};
  if (measure) work = gx_measure_work(measure);
  struct gx_stepper *stepper = measure ? gx_stepper_create(simulation.clock, simulation.space, &work) : NULL;
  if (stepper) status = gx_measure_take(measure, stepper, 0, simulation.dt);
  for (double step = 1; stepper && !status && step <= simulation.steps; step++) {
    status = gx_stepper_step(stepper, (step - 1) * simulation.dt, simulation.dt);
    if (!status) status = gx_measure_take(measure, stepper, step * simulation.dt, simulation.dt);
  }
  double error = stepper && !status ? gx_measure_result(measure)->max_error[GX_DISPLACEMENT][GX_RMS] : NAN;
  if (isnan(error)) fprintf(stderr, "%s, %d cells: %s, %s\n", space, cells, gx_status_name(status), outcome.reason);
  gx_stepper_free(stepper);
  gx_measure_free(measure);
  gx_simulation_free(&simulation);
  return error;
}

int main(void)
{
  static const char *const spaces[] = {"standard", "moving-mesh"};
  gx_status_quiet_gsl();
  for (int i = 0; i < 2; i++) {
    double before = NAN;
    for (int cells = 16; cells <= 128; cells *= 2) {
      double error = error_of(spaces[i], cells);
      printf("%-12s %4d cells  error %.3e m  order %5.2f\n", spaces[i], cells, error, log2(before / error));
      before = error;
    }
  }
  return 0;
}
