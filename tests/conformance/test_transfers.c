/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every basis owes a transfer, in 1-D to 3-D, periodic and bounded: partition of unity, gradients that sum to zero,
 * reproduction of linear fields, scatter and gather adjoint to each other, mass and momentum passed on whole; the same by way of
 * packed nodes. */
#include <string.h>

#include "check.h"
#include "points.h"
#include "spaces/packed.h"

enum { N = 150 };

static double x_store[GX_MAX_DIM][N], half_store[GX_MAX_DIM][N], m[N];

struct setting {
  const struct gx_basis *basis;
  int dim, degree;
  struct points points;
  double *x[GX_MAX_DIM], *half[GX_MAX_DIM];
};

/* Cell edges and domain ends first, then random points. */
static void place(struct setting *setting, bool periodic, int cells)
{
  uint64_t seed = 37;
  for (int d = 0; d < setting->dim; d++) {
    setting->x[d] = x_store[d];
    setting->half[d] = half_store[d];
    int edges = cells + d;
    for (int p = 0; p < N; p++) {
      x_store[d][p] = p <= edges ? (double)p / edges : check_random(&seed, periodic ? -2 : 0, periodic ? 3 : 1);
      half_store[d][p] = check_random(&seed, 0.1, 0.5) / edges;
    }
  }
  for (int p = 0; p < N; p++) m[p] = check_random(&seed, 0.5, 1.5);
}

static void each_setting(void (*check)(const struct setting *setting))
{
  for (size_t i = 0; gx_basis_family[i]; i++)
    for (int dim = 1; dim <= GX_MAX_DIM; dim++)
      for (int periodic = 0; periodic < 2; periodic++)
        for (int degree = 1; degree <= (gx_basis_family[i]->has_degree ? GX_MAX_DEGREE : 1); degree++)
          for (int cells = 2; cells <= 9; cells += 7) {
            struct setting setting = {.basis = gx_basis_family[i], .dim = dim, .degree = degree};
            place(&setting, periodic, cells);
            setting.points = points_at(setting.basis, dim, cells, periodic, degree, N, setting.x, setting.half);
            check(&setting);
            points_free(&setting.points);
          }
}

static void check_unity(const struct setting *setting)
{
  const struct gx_grid *grid = &setting->points.grid;
  int dim = setting->dim;
  double **field = fields(dim, grid->stored), **value = fields(dim, N), **gradient = fields(dim * dim, N);
  for (int d = 0; d < dim; d++)
    for (size_t i = 0; i < grid->stored; i++) field[d][i] = d + 1;
  gx_transfer_gather(&setting->points.weights, field, value);
  gx_transfer_gather_gradient(&setting->points.weights, field, gradient);
  for (int p = 0; p < N; p++) {
    for (int d = 0; d < dim; d++) NEAR(value[d][p], d + 1, 1e-14);
    for (int k = 0; k < dim * dim; k++) NEAR(gradient[k][p], 0, 2e-14 * (setting->degree + 1) * 11);
  }
  fields_free(field, dim);
  fields_free(value, dim);
  fields_free(gradient, dim * dim);
}

static void weights_sum_to_one_and_gradients_to_zero(void **state)
{
  (void)state;
  each_setting(check_unity);
}

/* Coefficients of a periodic axis are those of the unwrapped line. */
static void check_linear(const struct setting *setting)
{
  const struct gx_grid *grid = &setting->points.grid;
  const double slope[GX_MAX_DIM] = {1, -2, 0.5};
  int dim = setting->dim;
  double **field = fields(dim, grid->stored), **value = fields(dim, N), **gradient = fields(dim * dim, N);
  for (int d = 0; d < dim; d++)
    for (size_t i = 0; i < grid->stored; i++)
      for (int e = 0; e < dim; e++)
        field[d][i] += (d + 1) * slope[e] * grid->axis[e].h *
                       setting->basis->site(&grid->axis[e], (int)(i / grid->stride[e] % (size_t)grid->axis[e].stored));
  gx_transfer_gather(&setting->points.weights, field, value);
  gx_transfer_gather_gradient(&setting->points.weights, field, gradient);
  for (int p = 0; p < N; p++)
    for (int d = 0; d < dim; d++) {
      double expected = 0;
      for (int e = 0; e < dim; e++) {
        double x = setting->x[e][p];
        expected += (d + 1) * slope[e] * (grid->axis[e].periodic ? x - floor(x) : x);
        NEAR(gradient[d * dim + e][p], (d + 1) * slope[e], 1e-12);
      }
      NEAR(value[d][p], expected, 1e-13);
    }
  fields_free(field, dim);
  fields_free(value, dim);
  fields_free(gradient, dim * dim);
}

static void linear_fields_are_reproduced(void **state)
{
  (void)state;
  each_setting(check_linear);
}

/* sum_i f_i (scatter q)_i = sum_p m_p q_p (gather f)_p, and the same for the gradient and force pair; images included. */
static void check_adjoint(const struct setting *setting)
{
  const struct gx_grid *grid = &setting->points.grid;
  const struct gx_weights *weights = &setting->points.weights;
  int dim = setting->dim;
  uint64_t seed = 41;
  double **f = fields(dim, grid->stored), **moment = fields(dim, grid->stored), **force = fields(dim, grid->stored);
  double **q = fields(dim, N), **T = fields(dim * dim, N), **value = fields(dim, N), **gradient = fields(dim * dim, N);
  double **load = fields(dim, N), **v = fields(dim, N), **all = fields(dim * dim, N);
  for (int d = 0; d < dim; d++) {
    for (size_t i = 0; i < grid->stored; i++) f[d][i] = check_random(&seed, -1, 1);
    gx_grid_spread(grid, f[d]);
    for (int p = 0; p < N; p++) {
      q[d][p] = check_random(&seed, -1, 1);
      load[d][p] = m[p] * q[d][p];
    }
  }
  for (int k = 0; k < dim * dim; k++)
    for (int p = 0; p < N; p++) T[k][p] = check_random(&seed, -1, 1);
  gx_transfer_scatter(weights, m, q, NULL, moment);
  gx_transfer_scatter_force(weights, T, load, force);
  gx_transfer_gather(weights, f, value);
  gx_transfer_gather_gradient(weights, f, gradient);
  double left = 0, right = 0, left_force = 0, right_force = 0;
  for (int d = 0; d < dim; d++) {
    gx_grid_fold(grid, moment[d]);
    gx_grid_fold(grid, force[d]);
    for (size_t i = 0; i < grid->stored; i++) {
      left += f[d][i] * moment[d][i];
      left_force += f[d][i] * force[d][i];
    }
    for (int p = 0; p < N; p++) {
      right += m[p] * q[d][p] * value[d][p];
      for (int e = 0; e < dim; e++) right_force += T[d * dim + e][p] * gradient[d * dim + e][p];
    }
  }
  NEAR(left, right, 1e-13 * N);
  NEAR(left_force, right_force + right, 1e-12 * N);
  gx_transfer_gather_all(weights, f, f, value, v, all); /* the same sums in one pass */
  for (int p = 0; p < N; p++) {
    for (int d = 0; d < dim; d++) NEAR(v[d][p], value[d][p], 0);
    for (int k = 0; k < dim * dim; k++) NEAR(all[k][p], gradient[k][p], 1e-13 * 11);
  }
  fields_free(load, dim);
  double **nodal[] = {f, moment, force}, **vectors[] = {q, value, v}, **tensors[] = {T, gradient, all};
  for (int i = 0; i < 3; i++) {
    fields_free(nodal[i], dim);
    fields_free(vectors[i], dim);
    fields_free(tensors[i], dim * dim);
  }
}

static void scatter_is_adjoint_to_gather(void **state)
{
  (void)state;
  each_setting(check_adjoint);
}

static double sum_of(const double *field, size_t length)
{
  long double sum = 0;
  for (size_t i = 0; i < length; i++) sum += field[i];
  return (double)sum;
}

/* Totals survive scattering and folding; spreading shows each image what it stands for. */
static void check_totals(const struct setting *setting)
{
  const struct gx_grid *grid = &setting->points.grid;
  int dim = setting->dim;
  double **moment = fields(dim, grid->stored), **q = fields(dim, N), *total = calloc(grid->stored, sizeof(double));
  double *alone = calloc(grid->stored, sizeof(double)), momentum[GX_MAX_DIM] = {0};
  uint64_t seed = 43;
  for (int d = 0; d < dim; d++)
    for (int p = 0; p < N; p++) {
      q[d][p] = check_random(&seed, 0, 1);
      momentum[d] += m[p] * q[d][p];
    }
  gx_transfer_scatter(&setting->points.weights, m, q, total, moment);
  gx_transfer_scatter(&setting->points.weights, m, NULL, alone, NULL);
  for (size_t i = 0; i < grid->stored; i++) NEAR(alone[i], total[i], 0);
  gx_grid_fold(grid, total);
  CLOSE(sum_of(total, grid->stored), sum_of(m, N), 4e-15);
  for (int d = 0; d < dim; d++) {
    gx_grid_fold(grid, moment[d]);
    CLOSE(sum_of(moment[d], grid->stored), momentum[d], 4e-15);
  }
  double folded = sum_of(total, grid->stored);
  for (size_t i = 0; i < grid->stored; i++)
    for (int e = 0; e < dim; e++)
      if ((int)(i / grid->stride[e] % (size_t)grid->axis[e].stored) >= grid->axis[e].functions) NEAR(total[i], 0, 0);
  gx_grid_spread(grid, total);
  gx_grid_spread(grid, total);
  for (size_t i = 0; i < grid->stored; i++)
    for (int e = 0; e < dim; e++) {
      int k = (int)(i / grid->stride[e] % (size_t)grid->axis[e].stored), functions = grid->axis[e].functions;
      if (k >= functions) NEAR(total[i], total[i - (size_t)functions * grid->stride[e]], 0);
    }
  for (size_t i = 0; i < grid->stored; i++)
    for (int e = 0; e < dim; e++)
      if ((int)(i / grid->stride[e] % (size_t)grid->axis[e].stored) >= grid->axis[e].functions) total[i] = 0;
  CLOSE(sum_of(total, grid->stored), folded, 1e-15);
  free(total);
  free(alone);
  fields_free(moment, dim);
  fields_free(q, dim);
}

static void mass_and_momentum_pass_whole(void **state)
{
  (void)state;
  each_setting(check_totals);
}

/* Fixing direction d zeroes `edge` layers at each of its ends and nothing else; nothing on a periodic axis. */
static void check_fixed(const struct setting *setting)
{
  const struct gx_grid *grid = &setting->points.grid;
  double *field = malloc(grid->stored * sizeof(double));
  for (int d = 0; d < setting->dim; d++) {
    const struct gx_axis *axis = &grid->axis[d];
    for (size_t i = 0; i < grid->stored; i++) field[i] = 1;
    gx_grid_fix(grid, d, field);
    for (size_t i = 0; i < grid->stored; i++) {
      int k = (int)(i / grid->stride[d] % (size_t)axis->stored);
      bool held = !axis->periodic && (k < axis->edge || k >= axis->functions - axis->edge);
      NEAR(field[i], held ? 0 : 1, 0);
    }
  }
  free(field);
}

static void fixed_ends_touch_the_ends_alone(void **state)
{
  (void)state;
  each_setting(check_fixed);
}

/* Random values: nodes of a packed field, or of the particles. */
static void fill(double *value, size_t count, uint64_t *seed)
{
  for (size_t i = 0; i < count; i++) value[i] = check_random(seed, -1, 1);
}

/* packed: [stored][4]; its components from `skip` are those of field. */
static void check_nodes(const struct setting *setting, const double *packed, int skip, int count, double *const *field)
{
  for (size_t i = 0; i < setting->points.grid.stored; i++)
    for (int k = 0; k < count; k++) NEAR(packed[i * GX_PACKED + (size_t)(skip + k)], field[k][i], 1e-12);
}

static void check_packed_scatter(const struct setting *setting)
{
  const struct gx_weights *weights = &setting->points.weights;
  const int dim = setting->dim;
  const size_t stored = setting->points.grid.stored, bytes = stored * GX_PACKED * sizeof(double);
  double **v = fields(dim, N), **T = fields(dim * dim, N), **body = fields(dim, N);
  double **moment = fields(dim, stored), **force = fields(dim, stored), **loaded = fields(dim, stored),
         **total = fields(1, stored);
  double *packed = aligned_alloc(32, 2 * bytes), *other = packed + stored * GX_PACKED;
  uint64_t seed = 47;
  for (int d = 0; d < dim; d++) fill(v[d], N, &seed), fill(body[d], N, &seed);
  for (int k = 0; k < dim * dim; k++) fill(T[k], N, &seed);
  gx_transfer_scatter(weights, m, v, total[0], moment);
  gx_transfer_scatter_force(weights, T, NULL, force);
  gx_transfer_scatter_force(weights, T, body, loaded);
  memset(packed, 0, 2 * bytes);
  gx_packed_scatter(weights, m, v, packed, T, body, other); /* in one pass */
  check_nodes(setting, packed, 0, 1, total);
  check_nodes(setting, packed, 1, dim, moment);
  check_nodes(setting, other, 0, dim, loaded);
  memset(packed, 0, 2 * bytes);
  gx_packed_scatter(weights, m, NULL, packed, NULL, NULL, NULL);
  gx_packed_scatter(weights, NULL, NULL, NULL, T, NULL, other);
  check_nodes(setting, packed, 0, 1, total);
  check_nodes(setting, other, 0, dim, force);
  for (size_t i = 0; i < stored; i++)
    for (int k = 1; k < GX_PACKED; k++) NEAR(packed[i * GX_PACKED + (size_t)k], 0, 0);
  free(packed);
  double **nodal[] = {moment, force, loaded}, **vectors[] = {v, body};
  for (int i = 0; i < 3; i++) fields_free(nodal[i], dim);
  for (int i = 0; i < 2; i++) fields_free(vectors[i], dim);
  fields_free(T, dim * dim);
  fields_free(total, 1);
}

static void check_packed_gather(const struct setting *setting)
{
  const struct gx_weights *weights = &setting->points.weights;
  const int dim = setting->dim;
  const size_t stored = setting->points.grid.stored;
  double **a = fields(dim, stored), **v = fields(dim, stored), **back = fields(dim, stored);
  double **of_a = fields(dim, N), **of_v = fields(dim, N), **slope = fields(dim * dim, N);
  double **packed_a = fields(dim, N), **packed_v = fields(dim, N), **packed_slope = fields(dim * dim, N);
  double *packed = aligned_alloc(32, 2 * stored * GX_PACKED * sizeof(double)), *other = packed + stored * GX_PACKED;
  uint64_t seed = 53;
  for (int d = 0; d < dim; d++) fill(a[d], stored, &seed), fill(v[d], stored, &seed);
  gx_transfer_gather_all(weights, a, v, of_a, of_v, slope);
  gx_packed_pack(dim, stored, (const double *const *)a, packed);
  gx_packed_pack(dim, stored, (const double *const *)v, other);
  gx_packed_gather_all(weights, packed, other, packed_a, packed_v, packed_slope);
  for (int p = 0; p < N; p++) {
    for (int d = 0; d < dim; d++) {
      NEAR(packed_a[d][p], of_a[d][p], 1e-14);
      NEAR(packed_v[d][p], of_v[d][p], 1e-14);
    }
    for (int k = 0; k < dim * dim; k++) NEAR(packed_slope[k][p], slope[k][p], 1e-13 * 11);
  }
  gx_packed_gather(weights, packed, of_a); /* the same sums one at a time */
  gx_packed_gather_gradient(weights, other, slope);
  for (int p = 0; p < N; p++) {
    for (int d = 0; d < dim; d++) NEAR(packed_a[d][p], of_a[d][p], 0);
    for (int k = 0; k < dim * dim; k++) NEAR(packed_slope[k][p], slope[k][p], 0);
  }
  gx_packed_unpack(dim, stored, other, back);
  for (int d = 0; d < dim; d++) assert_memory_equal(back[d], v[d], stored * sizeof(double));
  free(packed);
  double **nodal[] = {a, v, back}, **vectors[] = {of_a, of_v, packed_a, packed_v};
  for (int i = 0; i < 3; i++) fields_free(nodal[i], dim);
  for (int i = 0; i < 4; i++) fields_free(vectors[i], dim);
  fields_free(slope, dim * dim);
  fields_free(packed_slope, dim * dim);
}

static void check_packed(const struct setting *setting)
{
  if (setting->dim == 1) return;
  check_packed_scatter(setting);
  check_packed_gather(setting);
}

static void packed_nodes_see_the_same(void **state)
{
  (void)state;
  each_setting(check_packed);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(weights_sum_to_one_and_gradients_to_zero),
      cmocka_unit_test(linear_fields_are_reproduced),
      cmocka_unit_test(scatter_is_adjoint_to_gather),
      cmocka_unit_test(mass_and_momentum_pass_whole),
      cmocka_unit_test(fixed_ends_touch_the_ends_alone),
      cmocka_unit_test(packed_nodes_see_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
