/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The consistent mass matrix: the band solver against a dense one, on grids periodic and bounded, fewer cells than functions
 * in a cell included. */
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include "check.h"
#include "points.h"
#include "spaces/mass.h"

/* Random points, every cell well filled. */
static struct points scatter_points(const struct gx_basis *basis, int dim, int cells, bool periodic, int degree, size_t n,
                                    double **m)
{
  double *x[GX_MAX_DIM], *half[GX_MAX_DIM];
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

/* Number of the distinct function behind a stored one; whether a fixed end holds it along direction d. */
static size_t distinct(const struct gx_grid *grid, size_t node)
{
  size_t number = 0, stride = 1;
  for (int d = 0; d < grid->dim; d++) {
    number += node / grid->stride[d] % (size_t)grid->axis[d].stored % (size_t)grid->axis[d].functions * stride;
    stride *= (size_t)grid->axis[d].functions;
  }
  return number;
}

static bool is_held(const struct gx_grid *grid, size_t node, int d)
{
  const struct gx_axis *axis = &grid->axis[d];
  int k = (int)(node / grid->stride[d] % (size_t)axis->stored);
  return !axis->periodic && (k < axis->edge || k >= axis->functions - axis->edge);
}

static void add_particle(gsl_matrix *M, const struct points *points, size_t p, double m)
{
  const struct gx_weights *w = &points->weights;
  gsl_vector *S = gsl_vector_calloc(M->size1);
  int count = 1;
  for (int d = 0; d < w->dim; d++) count *= w->support;
  for (int q = 0; q < count; q++) {
    size_t node = 0;
    double weight = 1;
    for (int d = 0, rest = q; d < w->dim; d++, rest /= w->support) {
      node += (size_t)(w->first[d][p] + rest % w->support) * w->stride[d];
      weight *= w->S[d][(size_t)(rest % w->support) * w->n + p];
    }
    S->data[distinct(&points->grid, node)] += weight;
  }
  for (size_t i = 0; i < M->size1; i++)
    for (size_t j = 0; j < M->size2; j++) *gsl_matrix_ptr(M, i, j) += m * S->data[i] * S->data[j];
  gsl_vector_free(S);
}

/* M with rows and columns of held functions replaced by those of the identity. */
static gsl_matrix *dense_mass(const struct points *points, const double *m, int d)
{
  const struct gx_grid *grid = &points->grid;
  size_t unknowns = 1;
  for (int e = 0; e < grid->dim; e++) unknowns *= (size_t)grid->axis[e].functions;
  gsl_matrix *M = gsl_matrix_calloc(unknowns, unknowns);
  for (size_t p = 0; p < points->weights.n; p++) add_particle(M, points, p, m[p]);
  for (size_t node = 0; node < grid->stored; node++) {
    if (!is_held(grid, node, d)) continue;
    size_t i = distinct(grid, node);
    for (size_t j = 0; j < unknowns; j++) {
      gsl_matrix_set(M, i, j, 0);
      gsl_matrix_set(M, j, i, 0);
    }
    gsl_matrix_set(M, i, i, 1);
  }
  return M;
}

/* The band solution must solve the dense system, and agree with the dense solution as far as its condition lets it. */
static void compare(const struct points *points, const double *m, struct gx_mass *mass, int d)
{
  const struct gx_grid *grid = &points->grid;
  gsl_matrix *M = dense_mass(points, m, d);
  size_t unknowns = M->size1;
  gsl_vector *right = gsl_vector_calloc(unknowns), *solution = gsl_vector_alloc(unknowns), *ours = gsl_vector_alloc(unknowns);
  double *field = calloc(grid->stored, sizeof(double));
  uint64_t seed = 31;
  for (size_t node = 0; node < grid->stored; node++) field[node] = check_random(&seed, -1, 1);
  gx_grid_fold(grid, field);
  for (size_t node = 0; node < grid->stored; node++)
    right->data[distinct(grid, node)] += is_held(grid, node, d) ? 0 : field[node];
  gx_mass_solve(mass, d, field);
  for (size_t node = 0; node < grid->stored; node++) {
    ours->data[distinct(grid, node)] = field[node];
    if (is_held(grid, node, d)) NEAR(field[node], 0, 0);
  }
  for (size_t node = 0; node < grid->stored; node++) NEAR(field[node], ours->data[distinct(grid, node)], 0); /* images alike */
  gsl_matrix *LU = gsl_matrix_alloc(unknowns, unknowns);
  gsl_matrix_memcpy(LU, M);
  gsl_permutation *permutation = gsl_permutation_alloc(unknowns);
  int sign;
  gsl_linalg_LU_decomp(LU, permutation, &sign);
  gsl_linalg_LU_solve(LU, permutation, right, solution);
  double largest = 0;
  for (size_t i = 0; i < unknowns; i++) largest = fmax(largest, fabs(solution->data[i]));
  for (size_t i = 0; i < unknowns; i++) {
    double product = 0, magnitude = fabs(right->data[i]);
    for (size_t j = 0; j < unknowns; j++) {
      product += gsl_matrix_get(M, i, j) * ours->data[j];
      magnitude += fabs(gsl_matrix_get(M, i, j) * ours->data[j]);
    }
    NEAR(product, right->data[i], 1e-13 * magnitude);
    NEAR(ours->data[i], solution->data[i], 1e-8 * largest);
  }
  gsl_permutation_free(permutation);
  gsl_matrix_free(LU);
  gsl_matrix_free(M);
  gsl_vector_free(right);
  gsl_vector_free(solution);
  gsl_vector_free(ours);
  free(field);
}

static void compare_grid(const struct gx_basis *basis, int dim, int cells, bool periodic, int degree, size_t n)
{
  double *m;
  struct points points = scatter_points(basis, dim, cells, periodic, degree, n, &m);
  struct gx_mass *mass = gx_mass_create(&points.grid);
  assert_non_null(mass);
  if (gx_mass_factor(mass, &points.weights, m))
    fail_msg("%s degree %d, %d-D, %d cells, periodic %d: singular", basis->name, degree, dim, cells, periodic);
  assert_int_equal(gx_mass_factor(mass, &points.weights, m), 0); /* twice is the same */
  for (int d = 0; d < dim; d++) compare(&points, m, mass, d);
  gx_mass_free(mass);
  points_free(&points);
  free(m);
}

static void band_solver_agrees_with_a_dense_one(void **state)
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

/* Each row of M sums to the lumped mass: M times the constant 1. */
static void the_solution_of_lumped_masses_is_one(void **state)
{
  (void)state;
  for (int degree = 1; degree <= GX_MAX_DEGREE; degree++) {
    double *m;
    struct points points = scatter_points(gx_basis_find("bspline"), 1, 7, true, degree, 500, &m);
    struct gx_mass *mass = gx_mass_create(&points.grid);
    assert_int_equal(gx_mass_factor(mass, &points.weights, m), 0);
    double field[32] = {0};
    gx_transfer_scatter(&points.weights, m, NULL, field, NULL);
    gx_grid_fold(&points.grid, field);
    gx_mass_solve(mass, 0, field);
    for (size_t node = 0; node < points.grid.stored; node++) NEAR(field[node], 1, 1e-9);
    gx_mass_free(mass);
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
    for (int cells = 6; cells <= 486; cells += cells < 30 ? 2 : 60) {
      double x[500], m[500], half[500] = {0};
      double place = degrees[i] % 2 ? 0.5 : 1; /* where the alternating function vanishes */
      for (int p = 0; p < cells; p++) {
        x[p] = (p + place) / cells;
        m[p] = 1.0 / cells;
      }
      struct points points = points_at(bases[i], 1, cells, true, degrees[i], (size_t)cells, (double *[]){x}, (double *[]){half});
      struct gx_mass *mass = gx_mass_create(&points.grid);
      CHECK(gx_mass_factor(mass, &points.weights, m) == -1, "degree %d, %d cells", degrees[i], cells);
      gx_mass_free(mass);
      points_free(&points);
    }
}

int main(void)
{
  gsl_set_error_handler_off();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(band_solver_agrees_with_a_dense_one),
      cmocka_unit_test(the_solution_of_lumped_masses_is_one),
      cmocka_unit_test(too_few_particles_are_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
