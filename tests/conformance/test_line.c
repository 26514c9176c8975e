/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The transfers of 1-D standard MPM against the general ones: every basis and the degrees that it has, periodic and bounded, with and
 * without body force, clocks that ask for them in every combination, blends of FLIP and PIC, particles in any order; through
 * crossings, and in cases that fail. Narrow vectors give the bits of wide ones. */
#include <gsl/gsl_errno.h>

#include "rig.h"
#include "spaces/mesh.h"

enum transfers { GENERAL, NARROW, WIDE, KINDS };
enum { VALUES = 5 };

struct ending {
  struct gx_outcome outcome;
  double steps, crossings;
  size_t n;
  double *value[VALUES]; /* u, v, F, P, and a where all steps were done */
};

static void use(struct gx_space *space, enum transfers transfers, const char *what)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  CHECK(mesh->line, "%s: a line was not taken", what);
  if (transfers == NARROW) mesh->line->passes = &gx_line_narrow_passes;
  if (transfers == WIDE) mesh->line->passes = gx_line_wide_supported() ? &gx_line_wide_passes : &gx_line_narrow_passes;
  if (transfers > GENERAL) return;
  gx_line_free(mesh->line);
  mesh->line = NULL;
}

static double cell_of(const struct gx_particles *particles, size_t p, int cells)
{
  return floor((particles->X[0][p] + particles->u[0][p]) * cells);
}

static struct ending run(const struct gx_case *one, const size_t *order, double most, enum transfers transfers, const char *what)
{
  struct rig rig;
  struct ending end = {.steps = 0};
  CHECK(rig_build(&rig, one, order, NULL, NULL), "%s: %s", what, rig.outcome.reason);
  const struct gx_particles *particles = rig.simulation.particles;
  const double dt = rig.simulation.dt;
  const int cells = rig.simulation.space_options.cells[0];
  double *cell = calloc(particles->n, sizeof *cell);
  use(rig.simulation.space, transfers, what);
  while (end.steps < most && gx_stepper_step(rig.stepper, end.steps * dt, dt) == GX_OK) {
    for (size_t p = 0; p < particles->n; p++) {
      const double now = cell_of(particles, p, cells);
      end.crossings += end.steps > 0 && now != cell[p];
      cell[p] = now;
    }
    end.steps++;
  }
  if (rig.simulation.kind->settle) rig.simulation.kind->settle(rig.simulation.space);
  end.outcome = rig.outcome;
  end.n = particles->n;
  const double *const from[] = {particles->u[0], particles->v[0], particles->F[0], particles->P[0]};
  for (int i = 0; i < VALUES; i++) {
    end.value[i] = calloc(end.n, sizeof(double));
    if (i < 4) memcpy(end.value[i], from[i], end.n * sizeof(double));
  }
  if (end.outcome.status == GX_OK) rig.simulation.kind->particle_acceleration(rig.simulation.space, &end.value[4]);
  free(cell);
  rig_free(&rig);
  return end;
}

/* Runs a case all ways and compares; returns how it ended. */
static struct ending compare(const struct gx_case *one, const size_t *order, double most, double tolerance, const char *what)
{
  struct ending end[KINDS];
  for (int kind = 0; kind < KINDS; kind++) end[kind] = run(one, order, most, (enum transfers)kind, what);
  for (int kind = NARROW; kind < KINDS; kind++) {
    CHECK(end[kind].outcome.status == end[0].outcome.status && end[kind].outcome.particle == end[0].outcome.particle &&
              end[kind].steps == end[0].steps,
          "%s: %s of particle %ld after %g steps, not %s of %ld after %g", what, gx_status_name(end[kind].outcome.status),
          end[kind].outcome.particle, end[kind].steps, gx_status_name(end[0].outcome.status), end[0].outcome.particle,
          end[0].steps);
    CHECK(end[kind].crossings == end[0].crossings, "%s: %g crossings, not %g", what, end[kind].crossings, end[0].crossings);
    for (int i = 0; i < VALUES; i++) {
      double scale = 0, apart = 0;
      for (size_t p = 0; p < end[0].n; p++) {
        scale = fmax(scale, fabs(end[0].value[i][p]));
        apart = fmax(apart, fabs(end[kind].value[i][p] - end[0].value[i][p]));
      }
      CHECK(apart <= tolerance * scale, "%s: value %d is %.3g of %.3g apart from the general transfers'", what, i, apart, scale);
      CHECK(kind == NARROW || !memcmp(end[WIDE].value[i], end[NARROW].value[i], end[0].n * sizeof(double)),
            "%s: wide vectors give other bits of value %d", what, i);
    }
  }
  for (int kind = 0; kind < KINDS; kind++)
    for (int i = 0; i < VALUES; i++) free(end[kind].value[i]);
  return end[0];
}

struct choice {
  const char *basis, *degree;
};

static const struct choice choices[] = {{"linear", ""},   {"ugimp", ""},    {"cpgimp", ""},   {"bspline", "1"},
                                        {"bspline", "2"}, {"bspline", "3"}, {"bspline", "5"}, {"bspline", "9"}};
enum { CHOICES = sizeof choices / sizeof *choices };

static struct gx_case bar(const char *problem, const struct choice *choice, const char *clock, const char *boundary)
{
  struct gx_case one = case_draft("method.space=standard", "mesh.cells=19", "time.cfl=0.1");
  case_set(&one, GX_PROBLEM_NAME, problem);
  case_set(&one, GX_PROBLEM_BOUNDARY, boundary);
  case_set(&one, GX_METHOD_BASIS, choice->basis);
  case_set(&one, GX_METHOD_DEGREE, choice->degree);
  case_set(&one, GX_METHOD_CLOCK, clock);
  return one;
}

/* Some on faces of cells, at both ends, and a little beyond. */
static void put_on_faces(struct gx_particles *particles, void *context)
{
  const int cells = *(const int *)context;
  for (size_t p = 0; p < particles->n; p += 3)
    particles->u[0][p] = round(particles->X[0][p] * cells) / cells - particles->X[0][p] + (p % 2 ? 1e-13 : 0);
  particles->u[0][0] = -particles->X[0][0];
  particles->u[0][particles->n - 1] = 1 + 1e-13 - particles->X[0][particles->n - 1];
}

static void weights_are_those_of_the_basis(void **state)
{
  (void)state;
  for (int choice = 0; choice < CHOICES; choice++)
    for (int bounded = 0; bounded < 2; bounded++)
      for (int kind = NARROW; kind < KINDS; kind++) {
        struct gx_case one = bar("bar-neo-hookean", &choices[choice], "central-difference", bounded ? "fixed" : "periodic");
        struct rig rig;
        int cells = 19;
        case_set(&one, GX_MESH_PARTICLES_PER_CELL, "5");
        gx_parameter_resolve(one.value);
        CHECK(rig_build(&rig, &one, NULL, put_on_faces, &cells), "%s", rig.outcome.reason);
        struct gx_mesh *mesh = (struct gx_mesh *)rig.simulation.space;
        const struct gx_weights *w = &mesh->blocks.whole;
        const size_t n = w->n, entries = n * (size_t)w->support;
        double *S = malloc(entries * sizeof *S), *D = malloc(entries * sizeof *D);
        int *first = malloc(n * sizeof *first);
        use(&mesh->space, (enum transfers)kind, choices[choice].basis);
        assert_int_equal(rig.simulation.kind->weights(&mesh->space), GX_OK);
        memcpy(S, w->S[0], entries * sizeof *S);
        memcpy(D, w->D[0], entries * sizeof *D);
        memcpy(first, w->first[0], n * sizeof *first);
        use(&mesh->space, GENERAL, choices[choice].basis);
        assert_int_equal(rig.simulation.kind->weights(&mesh->space), GX_OK);
        CHECK(!memcmp(S, w->S[0], entries * sizeof *S) && !memcmp(D, w->D[0], entries * sizeof *D) &&
                  !memcmp(first, w->first[0], n * sizeof *first),
              "%s %s%s: other weights", choices[choice].basis, choices[choice].degree, bounded ? ", bounded" : "");
        free(S);
        free(D);
        free(first);
        rig_free(&rig);
      }
}

/* cpGIMP's, which F widens, have no weights when they are turned over, empty or wider than a cell. */
static void domains_without_weights_are_told(void **state)
{
  (void)state;
  static const struct choice cpgimp = {"cpgimp", ""};
  static const double stretch[] = {0, -0.5, 9, NAN};
  enum { STRAY = 7 };
  for (int i = 0; i < 4; i++)
    for (int kind = GENERAL; kind < KINDS; kind++) {
      struct gx_case one = bar("bar-neo-hookean", &cpgimp, "central-difference", "periodic");
      struct rig rig;
      gx_parameter_resolve(one.value);
      CHECK(rig_build(&rig, &one, NULL, NULL, NULL), "%s", rig.outcome.reason);
      use(rig.simulation.space, (enum transfers)kind, "cpgimp");
      rig.simulation.particles->F[0][STRAY] = stretch[i];
      const enum gx_status status = rig.simulation.kind->weights(rig.simulation.space);
      CHECK(status != GX_OK && rig.outcome.particle == STRAY, "stretch %g: %s of particle %ld", stretch[i],
            gx_status_name(status), rig.outcome.particle);
      rig_free(&rig);
    }
}

/* 5 particles a cell: a last block that is not whole. */
static void transfers_agree_on_every_clock(void **state)
{
  (void)state;
  static const char *const problems[] = {"bar-neo-hookean", "bar-linear"}, *const boundaries[] = {"periodic", "fixed"};
  double crossings = 0;
  for (int choice = 0; choice < CHOICES; choice++)
    for (int problem = 0; problem < 2; problem++)
      for (int boundary = 0; boundary < 2; boundary++)
        for (size_t clock = 0; gx_clock_family[clock]; clock++) {
          struct gx_case one = bar(problems[problem], &choices[choice], gx_clock_family[clock]->name, boundaries[boundary]);
          char what[160];
          snprintf(what, sizeof what, "%s %s %s, %s, %s", choices[choice].basis, choices[choice].degree,
                   gx_clock_family[clock]->name, problems[problem], boundaries[boundary]);
          case_set(&one, GX_MESH_PARTICLES_PER_CELL, "5");
          gx_parameter_resolve(one.value);
          crossings += compare(&one, NULL, 60, 1e-12, what).crossings;
        }
  CHECK(crossings > 1000, "only %g crossings", crossings);
}

static void transfers_agree_through_many_crossings(void **state)
{
  (void)state;
  for (int choice = 0; choice < CHOICES; choice++)
    for (int bounded = 0; bounded < 2; bounded++) {
      if (bounded && atoi(choices[choice].degree) > 6) continue; /* particles leave through the walls */
      const char *boundary = bounded ? "fixed" : "periodic";
      struct gx_case one = bar("bar-neo-hookean", &choices[choice], "central-difference", boundary);
      char what[160];
      snprintf(what, sizeof what, "%s %s %s, long", choices[choice].basis, choices[choice].degree, boundary);
      gx_parameter_resolve(one.value);
      const struct ending end = compare(&one, NULL, 1500, 1e-11, what);
      CHECK(end.outcome.status == GX_OK && end.crossings > 100, "%s: %s, %g crossings", what, end.outcome.reason, end.crossings);
    }
}

static void transfers_agree_for_blends(void **state)
{
  (void)state;
  static const char *const clocks[] = {"central-difference", "euler-stress-first", "yoshida4"};
  for (int choice = 0; choice < CHOICES; choice++)
    for (int clock = 0; clock < 3; clock++)
      for (int pic = 0; pic < 2; pic++) {
        struct gx_case one = bar("bar-neo-hookean", &choices[choice], clocks[clock], "periodic");
        char what[160];
        snprintf(what, sizeof what, "%s %s %s, %s", choices[choice].basis, choices[choice].degree, clocks[clock],
                 pic ? "pic" : "flip 0.9");
        if (pic)
          case_set(&one, GX_METHOD_TRANSFER, "pic");
        else
          case_set(&one, GX_METHOD_FLIP, "0.9");
        gx_parameter_resolve(one.value);
        compare(&one, NULL, 60, 1e-12, what);
      }
}

/* Windows and lanes are for particles in the order of the bar; any other works. So do few particles a cell and many. */
static void the_order_of_particles_does_not_matter(void **state)
{
  (void)state;
  static const char *const per_cell[] = {"1", "2", "7", "70"};
  for (int choice = 0; choice < CHOICES; choice++)
    for (int few = strcmp(choices[choice].basis, "cpgimp") ? 0 : 1; few < 4; few++) /* its domains grow beyond a cell */
      for (int mixed = 0; mixed < 2; mixed++) {
        struct gx_case one = bar("bar-neo-hookean", &choices[choice], "central-difference", "periodic");
        char what[160];
        snprintf(what, sizeof what, "%s %s, %s a cell%s", choices[choice].basis, choices[choice].degree, per_cell[few],
                 mixed ? ", mixed" : "");
        case_set(&one, GX_MESH_PARTICLES_PER_CELL, per_cell[few]);
        gx_parameter_resolve(one.value);
        const size_t n = 19 * (size_t)atoi(per_cell[few]);
        size_t *order = malloc(n * sizeof *order);
        uint64_t seed = 11;
        for (size_t p = 0; p < n; p++) order[p] = p;
        for (size_t p = n - 1; mixed && p > 0; p--) {
          const size_t other = (size_t)check_random(&seed, 0, (double)(p + 1)), kept = order[p];
          order[p] = order[other];
          order[other] = kept;
        }
        compare(&one, order, 40, 1e-12, what);
        free(order);
      }
}

/* Failures are the same ones, at the same step, of the same particle. */
static void failures_are_the_same(void **state)
{
  (void)state;
  static const char *const clocks[] = {"central-difference", "euler-stress-first", "rkn3"};
  bool seen[GX_FAILED + 1] = {false};
  for (int choice = 0; choice < CHOICES; choice++)
    for (int clock = 0; clock < 3; clock++)
      for (int bounded = 0; bounded < 2; bounded++) {
        struct gx_case one = bar("bar-linear", &choices[choice], clocks[clock], bounded ? "fixed" : "periodic");
        char what[160];
        snprintf(what, sizeof what, "%s %s %s, fails", choices[choice].basis, choices[choice].degree, clocks[clock]);
        case_set(&one, GX_PROBLEM_AMPLITUDE, bounded ? "0.158" : "0.14");
        case_set(&one, GX_TIME_CFL, "0.7");
        case_set(&one, GX_METHOD_FLIP, "1");
        gx_parameter_resolve(one.value);
        seen[compare(&one, NULL, 60, 1, what).outcome.status] = true;
      }
  CHECK(seen[GX_TANGLED] && seen[GX_LEFT_DOMAIN], "tangled %d, left-domain %d", seen[GX_TANGLED], seen[GX_LEFT_DOMAIN]);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(weights_are_those_of_the_basis), cmocka_unit_test(domains_without_weights_are_told),
      cmocka_unit_test(transfers_agree_on_every_clock), cmocka_unit_test(transfers_agree_through_many_crossings),
      cmocka_unit_test(transfers_agree_for_blends),     cmocka_unit_test(the_order_of_particles_does_not_matter),
      cmocka_unit_test(failures_are_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
