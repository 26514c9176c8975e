/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every space with every basis, mass, transfer and clock keeps, in 1-D to 3-D: momentum and mass where no force acts,
 * uniform motion, and the symmetries of an empty periodic box: mirror, translation by whole cells, order of particles. Strong form
 * takes its particles in the order of their lattice, and keeps momentum at equal distances, through the particles alone: there its
 * derivatives are antisymmetric. */
#include <gsl/gsl_errno.h>

#include "check.h"
#include "rig.h"

enum { STEPS = 4 };

/* Per direction; few in 3-D, to be quick. */
static int cells_of(int dim)
{
  return dim == 3 ? 3 : 4;
}

static int per_cell_of(int dim)
{
  return dim == 3 ? 2 : 3;
}

struct combination {
  const struct gx_space_kind *kind;
  const struct gx_basis *basis;
  const struct gx_clock *clock;
  const char *mass, *quadrature, *transfer, *flip;
  int dim, degree;
};

static const char *describe(const struct combination *c)
{
  static char text[160];
  snprintf(text, sizeof text, "%s %s degree %d %s %s %s flip %s %s %d-D", c->kind->name, c->basis->name, c->degree, c->mass,
           c->quadrature, c->transfer, c->flip, c->clock->name, c->dim);
  return text;
}

/* An empty box at rest: neo-Hookean with a bulk modulus, no body force since the wave has no height. */
static struct gx_case box(const struct combination *c, const char *layout)
{
  struct gx_case one = case_draft("problem.name=axis-aligned", "problem.amplitude=0", "problem.modulus=3", "problem.poisson=0.3",
                                  "time.dt=0.01", "time.end=1");
  case_set_integer(&one, GX_PROBLEM_DIMENSION, c->dim);
  case_set_integer(&one, GX_MESH_CELLS, cells_of(c->dim));
  case_set_integer(&one, GX_MESH_PARTICLES_PER_CELL, per_cell_of(c->dim));
  case_set(&one, GX_MESH_LAYOUT, layout);
  case_set(&one, GX_METHOD_SPACE, c->kind->name);
  case_set(&one, GX_METHOD_BASIS, c->basis->name);
  case_set_integer(&one, GX_METHOD_DEGREE, c->degree);
  case_set(&one, GX_METHOD_MASS, c->mass);
  case_set(&one, GX_METHOD_QUADRATURE, c->quadrature);
  case_set(&one, GX_METHOD_TRANSFER, c->transfer);
  case_set(&one, GX_METHOD_FLIP, c->flip);
  case_set(&one, GX_METHOD_CLOCK, c->clock->name);
  if (strcmp(c->transfer, "flip") || strcmp(c->flip, "1"))
    case_set(&one, GX_METHOD_PROJECTION, "each-step"); /* else no transfer */
  gx_parameter_resolve(one.value);
  return one;
}

/* Clocks that keep nodal velocity while weights change: PIC would not conserve momentum. */
static bool mixes_weights(const struct gx_clock *clock)
{
  for (const struct gx_row *row = clock->rows; row && row->primitive != GX_END; row++)
    if (row->primitive == GX_MASS) return true;
  return false;
}

/* Runs it, or sees that it is refused where it must be. */
static int run_combination(void (*check)(const struct combination *combination), const struct combination *c)
{
  bool transfers = strcmp(c->transfer, "flip") || strcmp(c->flip, "1"), sums = !strcmp(c->quadrature, "particles");
  if ((c->dim > 1 && c->degree > 2) || (c->dim > 2 && transfers)) return 0; /* to be quick */
  bool common = !strcmp(c->clock->name, "central-difference") || !strcmp(c->clock->name, "rk4");
  if (!sums && c->dim > 1 && (!common || transfers || !c->basis->has_degree)) return 0; /* likewise */
  if (!sums && transfers && c->clock->order > 2) return 0;                              /* grid-scale waves grow at each kick */
  struct gx_case one = box(c, "uniform");
  struct gx_plan plan = gx_case_plan(&one);
  bool refused = plan.outcome.status == GX_REFUSED;
  bool affine = !strcmp(c->transfer, "apic"), consistent = !strcmp(c->mass, "consistent");
  bool blends = !c->clock->tableau && !(c->kind->fixed_grid && mixes_weights(c->clock)) && !(affine && (consistent || !sums));
  CHECK(refused == ((c->basis->deforms && !c->kind->fixed_grid) || (transfers && !blends)), "%s", describe(c));
  if (!refused) check(c);
  return !refused;
}

static void each_combination(void (*check)(const struct combination *combination))
{
  static const char *const transfers[][2] = {{"flip", "1"}, {"flip", "0.9"}, {"pic", "1"}, {"apic", "1"}};
  struct combination c;
  int ran = 0;
  for (int s = 0; (c.kind = gx_space_family[s]); s++) {
    if (c.kind->of_problem) continue;
    const bool collocation = c.kind->collocation; /* neither basis nor mass nor transfer */
    for (int b = 0; (c.basis = gx_basis_family[b]) && !(collocation && b); b++)
      for (int k = 0; (c.clock = gx_clock_family[k]); k++)
        for (int mass = 0; mass < (collocation ? 1 : 4); mass++)
          for (int t = 0; t < (collocation ? 1 : 4); t++)
            for (c.dim = 1; c.dim <= GX_MAX_DIM; c.dim++)
              for (c.degree = collocation || c.basis->has_degree ? 2 : 1; c.degree < (collocation || c.basis->has_degree ? 4 : 2);
                   c.degree++) {
                c.mass = mass % 2 ? "consistent" : "lumped";
                c.quadrature = mass / 2 ? "reconstructed" : "particles";
                c.transfer = transfers[t][0];
                c.flip = transfers[t][1];
                ran += run_combination(check, &c);
              }
  }
  assert_true(ran > 100);
}

static void uniform_velocity(struct gx_particles *particles, void *context)
{
  const double *v = context;
  for (int d = 0; d < particles->dim; d++)
    for (size_t p = 0; p < particles->n; p++) particles->v[d][p] = v[d];
}

/* No stress arises: v and F stay, and x = X + v t. */
static void check_uniform(const struct combination *c)
{
  double v[GX_MAX_DIM] = {1, -0.7, 0.3};
  struct gx_case one = box(c, "uniform");
  struct rig rig;
  rig_build(&rig, &one, NULL, uniform_velocity, v);
  rig_run(&rig, STEPS);
  const struct gx_particles *particles = rig.simulation.particles;
  for (size_t p = 0; p < particles->n; p++)
    for (int d = 0; d < c->dim; d++) {
      CHECK(fabs(particles->v[d][p] - v[d]) < 1e-12, "%s: v off by %g", describe(c), particles->v[d][p] - v[d]);
      CHECK(fabs(particles->u[d][p] - v[d] * STEPS * 0.01) < 1e-12, "%s", describe(c));
      for (int e = 0; e < c->dim; e++) CHECK(fabs(particles->F[d * c->dim + e][p] - (d == e)) < 1e-12, "%s: F", describe(c));
    }
  rig_free(&rig);
}

static void uniform_motion_stays(void **state)
{
  (void)state;
  each_combination(check_uniform);
}

/* A velocity field without symmetry, given at positions measured from `origin` and mirrored when sign is -1. */
struct view {
  double sign, origin[GX_MAX_DIM];
};

static void rough_velocity(struct gx_particles *particles, void *context)
{
  const struct view *view = context;
  for (size_t p = 0; p < particles->n; p++)
    for (int d = 0; d < particles->dim; d++) {
      double v = 0.3;
      for (int e = 0; e < particles->dim; e++) {
        double x = view->sign * (particles->X[e][p] - view->origin[e]);
        v += 0.2 * sin(2 * M_PI * x + 0.3 + d) + 0.1 * cos(4 * M_PI * x + e);
      }
      particles->v[d][p] = view->sign * v;
    }
}

static void check_momentum(const struct combination *c)
{
  if (c->kind->nodal) return;
  struct view view = {.sign = 1};
  struct gx_case one = box(c, c->kind->collocation ? "uniform" : "gauss");
  struct rig rig;
  rig_build(&rig, &one, NULL, rough_velocity, &view);
  const struct gx_particles *particles = rig.simulation.particles;
  double before[GX_MAX_DIM] = {0}, size = 0, mass = 0;
  if (rig.simulation.kind->settle) rig.simulation.kind->settle(rig.simulation.space);
  for (size_t p = 0; p < particles->n; p++)
    for (int d = 0; d < c->dim; d++) {
      before[d] += particles->m[p] * particles->v[d][p];
      size += particles->m[p] * fabs(particles->v[d][p]);
    }
  rig_run(&rig, 2 * STEPS);
  double strained = 0;
  for (int d = 0; d < c->dim; d++) {
    double after = 0;
    for (size_t p = 0; p < particles->n; p++) {
      after += particles->m[p] * particles->v[d][p];
      strained = fmax(strained, fabs(particles->F[d * c->dim + d][p] - 1));
    }
    CHECK(fabs(after - before[d]) <= 1e-13 * size, "%s: momentum changed by %g", describe(c), (after - before[d]) / size);
  }
  for (size_t p = 0; p < particles->n; p++) mass += particles->m[p];
  NEAR(mass, 1, 1e-13);
  assert_true(strained > 1e-3); /* forces did act between particles */
  rig_free(&rig);
}

static void momentum_is_kept(void **state)
{
  (void)state;
  each_combination(check_momentum);
}

/* Index of the particle at sign * X + shift cells. */
static size_t partner(int dim, size_t p, int sign, int shift)
{
  size_t base = (size_t)(per_cell_of(dim) * cells_of(dim)), rest = p, there = 0, stride = 1;
  for (int d = 0; d < dim; d++, rest /= base, stride *= base) {
    size_t k = sign < 0 ? base - 1 - rest % base : rest % base;
    there += (k + (size_t)(shift * (d + 1) * per_cell_of(dim))) % base * stride;
  }
  return there;
}

/* Runs the field seen in two views; v, u change sign with the view, F does not. */
static void compare_views(const struct combination *c, struct view *view, int shift, const size_t *order, const char *what)
{
  struct view plain = {.sign = 1};
  struct gx_case one = box(c, "gauss");
  struct rig a, b;
  rig_build(&a, &one, NULL, rough_velocity, &plain);
  rig_build(&b, &one, order, rough_velocity, view);
  rig_run(&a, STEPS);
  rig_run(&b, STEPS);
  const struct gx_particles *left = a.simulation.particles, *right = b.simulation.particles;
  double tolerance = strcmp(c->mass, "lumped") ? 1e-11 : 2e-13, worst = 0;
  for (size_t p = 0; p < left->n; p++) {
    size_t q = order ? order[p] : partner(c->dim, p, (int)view->sign, shift); /* the same particle, seen otherwise */
    size_t here = order ? q : p, there = order ? p : q;
    for (int d = 0; d < c->dim; d++) {
      worst = fmax(worst, fabs(right->v[d][there] - view->sign * left->v[d][here]));
      worst = fmax(worst, fabs(right->u[d][there] - view->sign * left->u[d][here]));
    }
    for (int k = 0; k < c->dim * c->dim; k++) worst = fmax(worst, fabs(right->F[k][there] - left->F[k][here]));
  }
  CHECK(worst <= tolerance, "%s of %s: differs by %g", what, describe(c), worst);
  rig_free(&a);
  rig_free(&b);
}

static void check_mirror(const struct combination *c)
{
  struct view view = {.sign = -1, .origin = {1, 1, 1}};
  compare_views(c, &view, 0, NULL, "mirror image");
}

static void check_translation(const struct combination *c)
{
  struct view view = {.sign = 1};
  for (int d = 0; d < c->dim; d++) view.origin[d] = (double)(d + 1) / cells_of(c->dim);
  compare_views(c, &view, 1, NULL, "translation");
}

static void check_order(const struct combination *c)
{
  if (c->kind->collocation) return;
  size_t n = 1;
  for (int d = 0; d < c->dim; d++) n *= (size_t)(per_cell_of(c->dim) * cells_of(c->dim));
  size_t *order = malloc(n * sizeof *order);
  uint64_t seed = 47;
  for (size_t p = 0; p < n; p++) {
    size_t other = (size_t)check_random(&seed, 0, (double)(p + 1));
    order[p] = order[other];
    order[other] = p;
  }
  struct view view = {.sign = 1};
  compare_views(c, &view, 0, order, "reordering");
  free(order);
}

static void mirror_images_run_alike(void **state)
{
  (void)state;
  each_combination(check_mirror);
}

static void translations_by_cells_run_alike(void **state)
{
  (void)state;
  each_combination(check_translation);
}

static void the_order_of_particles_does_not_matter(void **state)
{
  (void)state;
  each_combination(check_order);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(uniform_motion_stays),
      cmocka_unit_test(momentum_is_kept),
      cmocka_unit_test(mirror_images_run_alike),
      cmocka_unit_test(translations_by_cells_run_alike),
      cmocka_unit_test(the_order_of_particles_does_not_matter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
