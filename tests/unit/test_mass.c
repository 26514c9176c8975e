/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The consistent mass matrix: the band solver against a dense one, on grids periodic and bounded, fewer cells than functions
 * in a cell included. */
#include <string.h>

#include <gsl/gsl_errno.h>

#include "check.h"
#include "dense_mass.h"
#include "points.h"
#include "spaces/mass.h"
#include "spaces/mass_band.h"
#include "spaces/mass_cg.h"
#include "spaces/mass_kronecker.h"

/* Random points, every cell well filled. */
static struct points scatter_points(const struct gx_basis *basis, int dim, int cells, bool periodic, int degree, size_t n,
                                    double **m)
{
  double *x[GX_MAX_DIM] = {NULL}, *half[GX_MAX_DIM] = {NULL};
  uint64_t seed = 29;
  for (int d = 0; d < dim; d++) {
    x[d] = malloc(n * sizeof(double));
    half[d] = malloc(n * sizeof(double));
    for (size_t p = 0; p < n; p++) {
      x[d][p] = check_random(&seed, 0, 1);
      half[d][p] = 0.25 / (cells + d);
    }
  }
  *m = malloc(n * sizeof(double));
  for (size_t p = 0; p < n; p++) (*m)[p] = check_random(&seed, 0.5, 1.5) / (double)n;
  struct points points = points_at(basis, dim, cells, periodic, degree, n, x, half);
  for (int d = 0; d < dim; d++) {
    free(x[d]);
    free(half[d]);
  }
  return points;
}

/* A right side that particles could leave: none where none is. */
static void fill_right_side(const struct points *points, const double *m, double *const *field)
{
  const struct gx_grid *grid = &points->grid;
  const size_t n = points->weights.n;
  uint64_t seed = 31;
  double *value[GX_MAX_DIM];
  for (int d = 0; d < grid->dim; d++) {
    value[d] = malloc(n * sizeof(double));
    for (size_t p = 0; p < n; p++) value[d][p] = check_random(&seed, -1, 1);
    memset(field[d], 0, grid->stored * sizeof(double));
  }
  gx_transfer_scatter(&points->weights, m, value, NULL, field);
  for (int d = 0; d < grid->dim; d++) {
    for (size_t node = 0; node < grid->stored; node++) field[d][node] *= check_random(&seed, 0.5, 1.5);
    gx_grid_fold(grid, field[d]);
    free(value[d]);
  }
}

/* right: [dim][stored], folded; solved: what a solver made of it. */
static void compare(const struct points *points, const double *m, double *const *right, double *const *solved, double residual,
                    double error)
{
  const struct gx_grid *grid = &points->grid;
  for (int d = 0; d < grid->dim; d++) {
    gsl_matrix *M = dense_mass(points, m, d);
    gsl_vector *b = gsl_vector_calloc(M->size1), *x = gsl_vector_alloc(M->size1);
    for (size_t node = 0; node < grid->stored; node++) {
      b->data[dense_number(grid, node)] += dense_holds(grid, node, d) ? 0 : right[d][node];
      x->data[dense_number(grid, node)] = solved[d][node];
      if (dense_holds(grid, node, d)) NEAR(solved[d][node], 0, 0);
    }
    for (size_t node = 0; node < grid->stored; node++)
      NEAR(solved[d][node], x->data[dense_number(grid, node)], 0); /* images alike */
    dense_compare(M, b, x, residual, error);
    gsl_matrix_free(M);
    gsl_vector_free(b);
    gsl_vector_free(x);
  }
}

/* Fields of every component, in one block that [0] owns. */
static void take_fields(const struct gx_grid *grid, double **field)
{
  field[0] = calloc((size_t)grid->dim * grid->stored, sizeof(double));
  for (int d = 1; d < grid->dim; d++) field[d] = field[0] + (size_t)d * grid->stored;
}

static void copy_fields(const struct gx_grid *grid, double *const *from, double *const *to)
{
  memcpy(to[0], from[0], (size_t)grid->dim * grid->stored * sizeof(double));
}

/* Round-off of a factorisation, and of an iteration that ends at 1e-14 of energy; the dense solution errs by its condition. */
static const double direct = 1e-13, iterated = 3e-13, conditioned = 1e-8;

static void compare_band(const struct points *points, const double *m, double *const *right)
{
  double *field[GX_MAX_DIM];
  take_fields(&points->grid, field);
  copy_fields(&points->grid, right, field);
  struct gx_mass_band *band = gx_mass_band_create(&points->grid.axis[0], 1);
  for (int twice = 0; twice < 2; twice++)
    CHECK(!gx_mass_band_factor(band, points->weights.n, points->weights.first[0], points->weights.S[0], m), "singular");
  gx_mass_band_solve(band, 0, field[0]);
  compare(points, m, right, field, direct, conditioned);
  gx_mass_band_free(band);
  free(field[0]);
}

static void compare_cg(const struct points *points, const struct gx_basis *basis, const double *m, double *const *right)
{
  const struct gx_grid *grid = &points->grid;
  double *field[GX_MAX_DIM], *again[GX_MAX_DIM];
  take_fields(grid, field);
  take_fields(grid, again);
  struct gx_mass_cg *cg = gx_mass_cg_create(grid, basis, points->weights.n);
  assert_non_null(cg);
  assert_int_equal(gx_mass_cg_prepare(cg, &points->weights, m), 0);
  copy_fields(grid, right, field);
  int iterations = gx_mass_cg_solve(cg, field);
  CHECK(iterations >= 0, "%s degree %d, %d-D: no end", basis->name, grid->axis[0].degree, grid->dim);
  compare(points, m, right, field, iterated, conditioned);
  copy_fields(grid, right, again);
  assert_int_equal(gx_mass_cg_prepare(cg, &points->weights, m), 0);
  assert_int_equal(gx_mass_cg_solve(cg, again), iterations); /* the same whatever came before */
  assert_memory_equal(field[0], again[0], (size_t)grid->dim * grid->stored * sizeof(double));
  memset(again[0], 0, (size_t)grid->dim * grid->stored * sizeof(double));
  assert_int_equal(gx_mass_cg_solve(cg, again), 0);
  gx_mass_cg_free(cg);
  free(field[0]);
  free(again[0]);
}

static void compare_grid(const struct gx_basis *basis, int dim, int cells, bool periodic, int degree, size_t n)
{
  double *m, *right[GX_MAX_DIM];
  struct points points = scatter_points(basis, dim, cells, periodic, degree, n, &m);
  take_fields(&points.grid, right);
  fill_right_side(&points, m, right);
  if (dim == 1) compare_band(&points, m, right);
  if (dim > 1 || degree <= 5) compare_cg(&points, basis, m, right);
  free(right[0]);
  points_free(&points);
  free(m);
}

static void solvers_agree_with_a_dense_one(void **state)
{
  (void)state;
  for (size_t i = 0; gx_basis_family[i]; i++) {
    const struct gx_basis *basis = gx_basis_family[i];
    for (int periodic = 0; periodic < 2; periodic++) {
      for (int degree = 1; degree <= (basis->has_degree ? GX_MAX_DEGREE : 1); degree++)
        for (int cells = 1; cells <= 24; cells += cells < 6 ? 1 : 9) compare_grid(basis, 1, cells, periodic, degree, 1000);
      for (int degree = 1; degree <= (basis->has_degree ? 4 : 1); degree++)
        for (int cells = 2; cells <= 6; cells += 4) compare_grid(basis, 2, cells, periodic, degree, 1500);
      for (int degree = 1; degree <= (basis->has_degree ? 2 : 1); degree++) compare_grid(basis, 3, 2, periodic, degree, 1500);
    }
  }
}

/* A complete lattice in a box of cells, cells + 1, ... cells, its mass a product that differs from point to point. */
static struct points lattice_points(const struct gx_basis *basis, int dim, int cells, bool periodic, int degree, int per_cell,
                                    enum gx_layout layout, struct gx_particles **particles)
{
  const int counts[] = {cells, cells + 1, cells + 2};
  struct gx_particles *lattice = gx_particles_create(dim, counts, per_cell, layout, 1);
  for (size_t p = 0; p < lattice->n; p++)
    for (int d = 0; d < dim; d++) lattice->m[p] *= 1 + 0.3 * sin(7 * lattice->X[d][p] + d);
  *particles = lattice;
  return points_at(basis, dim, cells, periodic, degree, lattice->n, lattice->X, lattice->half_length);
}

/* The walls of points_at hold normal components; here the low face of the first direction holds all, the high one of the last the
 * first. */
static void hold_otherwise(struct gx_grid *grid)
{
  for (int d = 0; d < grid->dim; d++) grid->axis[d].held[0] = grid->axis[d].held[1] = 0;
  grid->axis[0].held[0] = 7;
  grid->axis[grid->dim - 1].held[1] = 1;
}

static void compare_kronecker(const struct points *points, const struct gx_basis *basis, const struct gx_particles *particles)
{
  const struct gx_grid *grid = &points->grid;
  double *right[GX_MAX_DIM], *field[GX_MAX_DIM], *chosen[GX_MAX_DIM];
  take_fields(grid, right);
  take_fields(grid, field);
  take_fields(grid, chosen);
  fill_right_side(points, particles->m, right);
  struct gx_mass_kronecker *kronecker = gx_mass_kronecker_create(grid, particles->lattice);
  assert_true(gx_mass_kronecker_fits(kronecker, &points->weights, particles->m));
  assert_int_equal(gx_mass_kronecker_factor(kronecker, &points->weights, particles->m), 0);
  copy_fields(grid, right, field);
  for (int d = 0; d < grid->dim; d++) {
    gx_mass_kronecker_solve(kronecker, d, field[d]);
    gx_grid_spread(grid, field[d]);
  }
  compare(points, particles->m, right, field, direct, conditioned);
  if (grid->dim == 1) compare_band(points, particles->m, right);
  compare_cg(points, basis, particles->m, right);
  /* what gx_mass takes of the three */
  struct gx_outcome outcome;
  struct gx_mass *mass = gx_mass_create(grid, basis, particles);
  assert_int_equal(gx_mass_factor(mass, &points->weights, particles->m, &outcome), GX_OK);
  copy_fields(grid, right, chosen);
  assert_int_equal(gx_mass_solve(mass, chosen, &outcome), GX_OK);
  if (grid->dim > 1) assert_memory_equal(chosen[0], field[0], (size_t)grid->dim * grid->stored * sizeof(double));
  gx_mass_free(mass);
  gx_mass_kronecker_free(kronecker);
  free(right[0]);
  free(field[0]);
  free(chosen[0]);
}

static void products_are_solved_by_directions(void **state)
{
  (void)state;
  for (size_t i = 0; gx_basis_family[i]; i++) {
    const struct gx_basis *basis = gx_basis_family[i];
    for (int periodic = 0; periodic < 2; periodic++)
      for (int dim = 1; dim <= GX_MAX_DIM; dim++)
        for (int degree = 1; degree <= (!basis->has_degree ? 1 : dim < 3 ? 5 : 2); degree++)
          for (int layout = 0; layout < 2; layout++) {
            struct gx_particles *particles;
            const int cells[] = {21, 7, 3};
            struct points points = lattice_points(basis, dim, cells[dim - 1], periodic, degree, degree + 1,
                                                  layout ? GX_LAYOUT_GAUSS : GX_LAYOUT_UNIFORM, &particles);
            if ((degree + layout) % 2) hold_otherwise(&points.grid);
            compare_kronecker(&points, basis, particles);
            points_free(&points);
            gx_particles_free(particles);
          }
  }
}

/* One mass or position that is out of line is seen. */
static void what_is_no_product_is_seen(void **state)
{
  (void)state;
  const struct gx_basis *basis = gx_basis_find("bspline");
  struct gx_particles *particles;
  struct points points = lattice_points(basis, 2, 5, true, 2, 3, GX_LAYOUT_UNIFORM, &particles);
  struct gx_mass_kronecker *kronecker = gx_mass_kronecker_create(&points.grid, particles->lattice);
  const size_t last = particles->n - 1;
  double mass = particles->m[last], weight = points.weights.S[1][last];
  particles->m[last] *= 1 + 1e-12;
  assert_false(gx_mass_kronecker_fits(kronecker, &points.weights, particles->m));
  particles->m[last] = mass;
  points.weights.S[1][last] *= 1 + 1e-15;
  assert_false(gx_mass_kronecker_fits(kronecker, &points.weights, particles->m));
  points.weights.S[1][last] = weight;
  points.weights.first[0][last]--;
  assert_false(gx_mass_kronecker_fits(kronecker, &points.weights, particles->m));
  points.weights.first[0][last]++;
  assert_true(gx_mass_kronecker_fits(kronecker, &points.weights, particles->m));
  gx_mass_kronecker_free(kronecker);
  const int none[GX_MAX_DIM] = {0};
  kronecker = gx_mass_kronecker_create(&points.grid, none);
  assert_false(gx_mass_kronecker_fits(kronecker, &points.weights, particles->m));
  gx_mass_kronecker_free(kronecker);
  points_free(&points);
  gx_particles_free(particles);
}

/* A body that leaves nodes empty: those get 0, the others what the dense matrix without them gives. */
static void nodes_without_mass_are_taken_out(void **state)
{
  (void)state;
  const struct gx_basis *basis = gx_basis_find("bspline");
  for (int dim = 1; dim <= GX_MAX_DIM; dim++)
    for (int degree = 1; degree <= 3; degree++) {
      const int counts[] = {12, 8, 5}, cells = counts[dim - 1];
      struct gx_particles *all;
      struct points box = lattice_points(basis, dim, cells, false, degree, degree + 2, GX_LAYOUT_UNIFORM, &all);
      double *x[GX_MAX_DIM], *half[GX_MAX_DIM], *m = malloc(all->n * sizeof *m);
      size_t n = 0;
      for (int d = 0; d < dim; d++) {
        x[d] = malloc(all->n * sizeof(double));
        half[d] = calloc(all->n, sizeof(double));
      }
      for (size_t p = 0; p < all->n; p++) { /* the cells of a ball about the middle */
        double square = 0;
        for (int d = 0; d < dim; d++) square += pow((floor(all->X[d][p] * (cells + d)) + 0.5) / (cells + d) - 0.5, 2);
        if (square > 0.35 * 0.35) continue;
        for (int d = 0; d < dim; d++) x[d][n] = all->X[d][p];
        m[n++] = all->m[p];
      }
      struct points points = points_at(basis, dim, cells, false, degree, n, x, half);
      double *right[GX_MAX_DIM];
      take_fields(&points.grid, right);
      fill_right_side(&points, m, right);
      if (dim == 1) compare_band(&points, m, right);
      compare_cg(&points, basis, m, right);
      free(right[0]);
      for (int d = 0; d < dim; d++) {
        free(x[d]);
        free(half[d]);
      }
      free(m);
      points_free(&points);
      points_free(&box);
      gx_particles_free(all);
    }
}

/* Each row of M sums to the lumped mass: M times the constant 1. */
static void the_solution_of_lumped_masses_is_one(void **state)
{
  (void)state;
  for (int degree = 1; degree <= GX_MAX_DEGREE; degree++)
    for (int dim = 1; dim <= (degree <= 3 ? 2 : 1); dim++) {
      double *m;
      struct points points = scatter_points(gx_basis_find("bspline"), dim, 7, true, degree, 500 * (size_t)dim * (size_t)dim, &m);
      struct gx_particles particles = {.dim = dim, .n = points.weights.n};
      struct gx_outcome outcome;
      struct gx_mass *mass = gx_mass_create(&points.grid, gx_basis_find("bspline"), &particles);
      assert_int_equal(gx_mass_factor(mass, &points.weights, m, &outcome), GX_OK);
      double *field[GX_MAX_DIM];
      take_fields(&points.grid, field);
      for (int d = 0; d < dim; d++) {
        gx_transfer_scatter(&points.weights, m, NULL, field[d], NULL);
        gx_grid_fold(&points.grid, field[d]);
      }
      assert_int_equal(gx_mass_solve(mass, field, &outcome), GX_OK);
      for (int d = 0; d < dim; d++)
        for (size_t node = 0; node < points.grid.stored; node++) NEAR(field[d][node], 1, 1e-9);
      gx_mass_free(mass);
      free(field[0]);
      points_free(&points);
      free(m);
    }
}

/* Too few particles: one at a cell's centre leaves the function that alternates from node to node without mass. */
static void too_few_particles_are_reported(void **state)
{
  (void)state;
  const struct gx_basis *bases[] = {gx_basis_find("linear"), gx_basis_find("bspline"), gx_basis_find("bspline")};
  const int degrees[] = {1, 3, 2};
  for (int i = 0; i < 3; i++)
    for (int dim = 1; dim <= 2; dim++)
      for (int cells = 6; cells <= (dim == 1 ? 486 : 10); cells += cells < 30 ? 2 : 60) {
        const int counts[] = {cells, cells + (dim == 2 ? 2 : 0), 1};
        struct gx_particles *particles = gx_particles_create(dim, counts, 1, GX_LAYOUT_UNIFORM, 1);
        for (int d = 0; d < dim && degrees[i] % 2 == 0; d++) /* where the alternating function vanishes */
          for (size_t p = 0; p < particles->n; p++) particles->X[d][p] += 0.5 / counts[d];
        struct points points =
            points_at(bases[i], dim, cells, true, degrees[i], particles->n, particles->X, particles->half_length);
        for (int cleared = 0; cleared < 2; cleared++) { /* by directions, then by conjugate gradients */
          if (cleared) memset(particles->lattice, 0, sizeof particles->lattice);
          struct gx_outcome outcome;
          struct gx_mass *mass = gx_mass_create(&points.grid, bases[i], particles);
          double *field[GX_MAX_DIM];
          take_fields(&points.grid, field);
          field[0][0] = 1; /* alternates in part */
          enum gx_status status = gx_mass_factor(mass, &points.weights, particles->m, &outcome);
          if (status == GX_OK) status = gx_mass_solve(mass, field, &outcome);
          CHECK(status == GX_SINGULAR, "%d-D, degree %d, %d cells, lattice cleared %d", dim, degrees[i], cells, cleared);
          gx_mass_free(mass);
          free(field[0]);
        }
        points_free(&points);
        gx_particles_free(particles);
      }
}

/* A point on an edge but for round-off leaves no mass in the cell beyond. */
static void what_round_off_reaches_is_taken_out(void **state)
{
  (void)state;
  const struct gx_basis *basis = gx_basis_find("linear");
  double x[13], half[13] = {0}, m[13], field[2][7] = {{0}};
  for (int p = 0; p < 13; p++) {
    x[p] = p < 12 ? (p + 0.5) / 18 : 4.0 / 6 + 1e-15; /* cells 0 to 3 of 6, and the edge of 4 */
    m[p] = 1;
  }
  struct points points = points_at(basis, 1, 6, false, 1, 13, (double *[]){x}, (double *[]){half});
  gx_transfer_scatter_force(&points.weights, (double *[]){m}, NULL, (double *[]){field[0]});
  assert_true(field[0][5] != 0);
  memcpy(field[1], field[0], sizeof field[0]);
  struct gx_mass_band *band = gx_mass_band_create(&points.grid.axis[0], 1);
  assert_int_equal(gx_mass_band_factor(band, 13, points.weights.first[0], points.weights.S[0], m), 0);
  gx_mass_band_solve(band, 0, field[0]);
  struct gx_mass_cg *cg = gx_mass_cg_create(&points.grid, basis, 13);
  assert_int_equal(gx_mass_cg_prepare(cg, &points.weights, m), 0);
  assert_true(gx_mass_cg_solve(cg, (double *[]){field[1]}) > 0);
  for (int k = 0; k < 2; k++) assert_true(field[k][5] == 0 && field[k][6] == 0);
  for (int i = 0; i < 5; i++) NEAR(field[0][i], field[1][i], 1e-11 * fabs(field[0][4]));
  gx_mass_band_free(band);
  gx_mass_cg_free(cg);
  points_free(&points);
}

/* Functions that one point of negative mass sees, far from the others, are not taken for functions that no point sees. */
static void negative_mass_is_reported(void **state)
{
  (void)state;
  const struct gx_basis *basis = gx_basis_find("linear");
  double x[10], half[10] = {0}, m[10];
  for (int p = 0; p < 10; p++) {
    x[p] = p < 9 ? (p + 0.5) / 18 : 0.9; /* cells 0 to 2 of 6, and the last one */
    m[p] = p < 9 ? 1 : -1;
  }
  struct points points = points_at(basis, 1, 6, false, 1, 10, (double *[]){x}, (double *[]){half});
  struct gx_mass_band *band = gx_mass_band_create(&points.grid.axis[0], 1);
  struct gx_mass_cg *cg = gx_mass_cg_create(&points.grid, basis, 10);
  for (int negative = 1; negative >= 0; negative--) {
    if (!negative) m[9] = 1;
    assert_int_equal(gx_mass_band_factor(band, 10, points.weights.first[0], points.weights.S[0], m), -negative);
    assert_int_equal(gx_mass_cg_prepare(cg, &points.weights, m), -negative);
  }
  gx_mass_band_free(band);
  gx_mass_cg_free(cg);
  points_free(&points);
}

/* A field that has blown up is no matter of the mass: it stays so, for the run to say. */
static void what_is_not_finite_stays_so(void **state)
{
  (void)state;
  double *m, *field[GX_MAX_DIM];
  const struct gx_basis *basis = gx_basis_find("bspline");
  struct points points = scatter_points(basis, 2, 5, true, 2, 300, &m);
  struct gx_mass_cg *cg = gx_mass_cg_create(&points.grid, basis, points.weights.n);
  take_fields(&points.grid, field);
  field[0][3] = NAN;
  field[1][3] = 1;
  assert_int_equal(gx_mass_cg_prepare(cg, &points.weights, m), 0);
  assert_true(gx_mass_cg_solve(cg, field) > 0);
  assert_true(isnan(field[0][3]));
  assert_true(isfinite(field[1][3]));
  gx_mass_cg_free(cg);
  free(field[0]);
  points_free(&points);
  free(m);
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(solvers_agree_with_a_dense_one),
      cmocka_unit_test(products_are_solved_by_directions),
      cmocka_unit_test(what_is_no_product_is_seen),
      cmocka_unit_test(nodes_without_mass_are_taken_out),
      cmocka_unit_test(the_solution_of_lumped_masses_is_one),
      cmocka_unit_test(too_few_particles_are_reported),
      cmocka_unit_test(what_round_off_reaches_is_taken_out),
      cmocka_unit_test(what_is_not_finite_stays_so),
      cmocka_unit_test(negative_mass_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
