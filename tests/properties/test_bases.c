/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every basis owes a transfer, at random points of random grids, near and on faces of cells and at ends: weights sum to 1 and
 * gradients to 0, linear fields are reproduced, scatter and gather are adjoint, mass and momentum pass whole. Bounds are roundings:
 * their number times 2^-53 times the sum of what is added without its signs. */
#include "property.h"

#include "points.h"
#include "spaces/packed.h"

static const char *const ends[] = {"periodic", "bounded", NULL}, *const places[] = {"anywhere", "near-faces", "on-faces", NULL};
static const struct property_choice choices[] = {
    {"dimension", 1, 3, NULL}, {"cells", 1, 12, NULL},       {"points", 1, 60, NULL},
    {"ends", 0, 1, ends},      {"method.basis", 0, 0, NULL}, {"degree", 1, GX_MAX_DEGREE, NULL},
    {"place", 0, 2, places},   {"seed", 0, 99999, NULL},     {NULL, 0, 0, NULL}};
enum { DIMENSION, CELLS, POINTS, ENDS, BASIS, DEGREE, PLACE, SEED };
enum { MOST = 60 };
static const double unit = 0x1p-53; /* of rounding */

/* Points of a case with their weights; m, half and field values follow from the seed too. */
struct setting {
  const struct gx_basis *basis;
  struct points points;
  int dim, degree;
  size_t n;
  uint64_t seed;
  double x_store[GX_MAX_DIM][MOST], half_store[GX_MAX_DIM][MOST], m[MOST];
  double *x[GX_MAX_DIM], *half[GX_MAX_DIM];
};

static double coordinate(int place, int cells, bool periodic, uint64_t *seed)
{
  double x = check_random(seed, periodic ? -2 : 0, periodic ? 3 : 1);
  const double face = round(x * cells) / cells;
  if (place == 1) x = face + check_random(seed, -1, 1) * pow(10, check_random(seed, -17, -2));
  if (place == 2) x = face;
  return periodic ? x : fmin(fmax(x, 0), 1);
}

static void build(struct setting *setting, const int *value)
{
  const bool periodic = value[ENDS] == 0;
  setting->basis = gx_basis_family[value[BASIS]];
  setting->dim = value[DIMENSION];
  setting->degree = setting->basis->has_degree ? value[DEGREE] : 1;
  setting->n = (size_t)value[POINTS];
  setting->seed = (uint64_t)value[SEED];
  const int cells = value[CELLS] < 12 / setting->dim ? value[CELLS] : 12 / setting->dim;
  for (int d = 0; d < setting->dim; d++) {
    setting->x[d] = setting->x_store[d];
    setting->half[d] = setting->half_store[d];
    for (size_t p = 0; p < setting->n; p++) {
      setting->x[d][p] = coordinate(value[PLACE], cells + d, periodic, &setting->seed);
      setting->half[d][p] = check_random(&setting->seed, 0.001, 0.5) / (cells + d);
    }
  }
  for (size_t p = 0; p < setting->n; p++) setting->m[p] = check_random(&setting->seed, 0.1, 2);
  setting->points =
      points_at(setting->basis, setting->dim, cells, periodic, value[DEGREE], setting->n, setting->x, setting->half);
}

/* Roundings behind a sum over the weights of a point: five a degree and direction in S (Cox and de Boor's recursion has no
 * cancellation), and the terms of the sums. GIMP's and hats' weights take fewer. */
static double roundings(const struct setting *setting)
{
  return setting->dim * (5.0 * setting->degree + 2 * setting->points.weights.support + 6);
}

/* Bound of sum_i |D_ip,e|: 2 cells of uniform knots, the degree's multiple where these crowd at an end. */
static double steepness(const struct setting *setting, int e)
{
  const struct gx_axis *axis = &setting->points.grid.axis[e];
  return 2.0 * axis->cells * (axis->periodic ? 1 : setting->degree);
}

static enum property_verdict check_unity(const struct property *property, const int *value, struct property_finding *finding)
{
  (void)property;
  struct setting setting;
  build(&setting, value);
  const int dim = setting.dim;
  double **field = fields(dim, setting.points.grid.stored), **sum = fields(dim, setting.n),
         **slope = fields(dim * dim, setting.n);
  for (int d = 0; d < dim; d++)
    for (size_t i = 0; i < setting.points.grid.stored; i++) field[d][i] = 1;
  gx_transfer_gather(&setting.points.weights, field, sum);
  gx_transfer_gather_gradient(&setting.points.weights, field, slope);
  for (size_t p = 0; p < setting.n; p++) {
    property_compare(finding, fabs(sum[0][p] - 1), roundings(&setting) * unit, "sum of weights");
    for (int e = 0; e < dim; e++)
      property_compare(finding, fabs(slope[e][p]), roundings(&setting) * unit * steepness(&setting, e), "sum of gradients");
    for (int k = 0; k < setting.points.weights.support; k++)
      property_compare(finding, -setting.points.weights.S[0][(size_t)k * setting.n + p], unit, "negative weight");
  }
  fields_free(field, dim);
  fields_free(sum, dim);
  fields_free(slope, dim * dim);
  points_free(&setting.points);
  return property_judge(finding);
}

/* f = c0 + sum_e c_e x_e by way of the sites. */
static enum property_verdict check_linear(const struct property *property, const int *value, struct property_finding *finding)
{
  (void)property;
  struct setting setting;
  build(&setting, value);
  const struct gx_grid *grid = &setting.points.grid;
  const int dim = setting.dim;
  double **field = fields(dim, grid->stored), **found = fields(dim, setting.n), **slope = fields(dim * dim, setting.n);
  double c[GX_MAX_DIM + 1], largest = 0;
  for (int e = 0; e <= dim; e++) c[e] = check_random(&setting.seed, -1, 1);
  for (size_t i = 0; i < grid->stored; i++) {
    double sum = fabs(c[dim]);
    field[0][i] = c[dim];
    for (int e = 0; e < dim; e++) {
      const int k = (int)(i / grid->stride[e] % (size_t)grid->axis[e].stored);
      const double term = c[e] * grid->axis[e].h * setting.basis->site(&grid->axis[e], k);
      field[0][i] += term;
      sum += fabs(term);
    }
    largest = fmax(largest, sum);
    for (int d = 1; d < dim; d++) field[d][i] = field[0][i];
  }
  gx_transfer_gather(&setting.points.weights, field, found);
  gx_transfer_gather_gradient(&setting.points.weights, field, slope);
  for (size_t p = 0; p < setting.n; p++) {
    double expected = c[dim];
    for (int e = 0; e < dim; e++) {
      const double x = setting.x[e][p];
      expected += c[e] * (grid->axis[e].periodic ? x - floor(x) : x);
      property_compare(finding, fabs(slope[e][p] - c[e]), roundings(&setting) * unit * steepness(&setting, e) * largest,
                       "gradient");
    }
    property_compare(finding, fabs(found[0][p] - expected), roundings(&setting) * unit * largest, "value");
  }
  fields_free(field, dim);
  fields_free(found, dim);
  fields_free(slope, dim * dim);
  points_free(&setting.points);
  return property_judge(finding);
}

/* Random fields of both sides of a transfer. */
struct pair {
  double **f, **moment, **force;                 /* [dim][stored] */
  double **q, **load, **T, **at_points, **slope; /* [dim], [dim * dim][n] */
};

static struct pair pair_of(struct setting *setting)
{
  const struct gx_grid *grid = &setting->points.grid;
  const int dim = setting->dim;
  const size_t n = setting->n;
  struct pair pair = {fields(dim, grid->stored),
                      fields(dim, grid->stored),
                      fields(dim, grid->stored),
                      fields(dim, n),
                      fields(dim, n),
                      fields(dim * dim, n),
                      fields(dim, n),
                      fields(dim * dim, n)};
  for (int d = 0; d < dim; d++) {
    for (size_t i = 0; i < grid->stored; i++) pair.f[d][i] = check_random(&setting->seed, -1, 1);
    gx_grid_spread(grid, pair.f[d]);
    for (size_t p = 0; p < n; p++) {
      pair.q[d][p] = check_random(&setting->seed, -1, 1);
      pair.load[d][p] = check_random(&setting->seed, -1, 1);
    }
  }
  for (int k = 0; k < dim * dim; k++)
    for (size_t p = 0; p < n; p++) pair.T[k][p] = check_random(&setting->seed, -1, 1);
  return pair;
}

static void pair_free(struct pair *pair, int dim)
{
  double **vectors[] = {pair->f, pair->moment, pair->force, pair->q, pair->load, pair->at_points};
  for (int i = 0; i < 6; i++) fields_free(vectors[i], dim);
  fields_free(pair->T, dim * dim);
  fields_free(pair->slope, dim * dim);
}

/* By component arrays, or by packed nodes, which know 2-D and 3-D. */
static void scatter(const struct setting *setting, const struct pair *pair, bool packed)
{
  const struct gx_weights *weights = &setting->points.weights;
  const size_t stored = setting->points.grid.stored;
  if (!packed) {
    gx_transfer_scatter(weights, setting->m, pair->q, NULL, pair->moment);
    gx_transfer_scatter_force(weights, pair->T, pair->load, pair->force);
    gx_transfer_gather(weights, pair->f, pair->at_points);
    gx_transfer_gather_gradient(weights, pair->f, pair->slope);
    return;
  }
  double *block = aligned_alloc(32, 3 * stored * GX_PACKED * sizeof *block);
  double *momentum = block, *force = block + stored * GX_PACKED, *nodes = force + stored * GX_PACKED;
  double *into[GX_PACKED] = {NULL};
  for (size_t i = 0; i < 3 * stored * GX_PACKED; i++) block[i] = 0;
  gx_packed_scatter(weights, setting->m, pair->q, momentum, pair->T, pair->load, force);
  for (int d = 0; d < setting->dim; d++) into[d + 1] = pair->moment[d];
  gx_packed_unpack(setting->dim + 1, stored, momentum, into);
  gx_packed_unpack(setting->dim, stored, force, pair->force);
  gx_packed_pack(setting->dim, stored, (const double *const *)pair->f, nodes);
  gx_packed_gather(weights, nodes, pair->at_points);
  gx_packed_gather_gradient(weights, nodes, pair->slope);
  free(block);
}

/* sum_i f_i (scatter q)_i = sum_p m_p q_p (gather f)_p, and sum_i f_i force_i = sum_p T : gather grad f + load . gather f. */
static void compare_pair(const struct setting *setting, const struct pair *pair, struct property_finding *finding,
                         const char *what)
{
  const struct gx_grid *grid = &setting->points.grid;
  const int dim = setting->dim;
  const double terms = roundings(setting) + (double)(setting->n + grid->stored);
  double nodes = 0, particles = 0, size = 0, force = 0, power = 0, force_size = 0, steepest = 0;
  for (int e = 0; e < dim; e++) steepest = fmax(steepest, steepness(setting, e));
  for (int d = 0; d < dim; d++) {
    gx_grid_fold(grid, pair->moment[d]);
    gx_grid_fold(grid, pair->force[d]);
    for (size_t i = 0; i < grid->stored; i++) {
      nodes += pair->f[d][i] * pair->moment[d][i];
      force += pair->f[d][i] * pair->force[d][i];
    }
    for (size_t p = 0; p < setting->n; p++) { /* |f| <= 1, and weights sum to 1 */
      particles += setting->m[p] * pair->q[d][p] * pair->at_points[d][p];
      size += setting->m[p] * fabs(pair->q[d][p]);
      power += pair->load[d][p] * pair->at_points[d][p];
      force_size += fabs(pair->load[d][p]);
      for (int e = 0; e < dim; e++) {
        power += pair->T[d * dim + e][p] * pair->slope[d * dim + e][p];
        force_size += fabs(pair->T[d * dim + e][p]) * steepest;
      }
    }
  }
  property_compare(finding, fabs(nodes - particles), terms * unit * size, what);
  property_compare(finding, fabs(force - power), terms * unit * force_size, what);
}

static enum property_verdict check_adjoint(const struct property *property, const int *value, struct property_finding *finding)
{
  (void)property;
  for (int packed = 0; packed < (value[DIMENSION] > 1 ? 2 : 1); packed++) {
    struct setting setting;
    build(&setting, value);
    struct pair pair = pair_of(&setting);
    scatter(&setting, &pair, packed);
    compare_pair(&setting, &pair, finding, packed ? "packed" : "plain");
    pair_free(&pair, setting.dim);
    points_free(&setting.points);
  }
  return property_judge(finding);
}

/* Mass and momentum of the nodes are those of the points, and forces of gradients alone sum to nothing. */
static enum property_verdict check_totals(const struct property *property, const int *value, struct property_finding *finding)
{
  (void)property;
  struct setting setting;
  build(&setting, value);
  struct pair pair = pair_of(&setting);
  const struct gx_grid *grid = &setting.points.grid;
  const double terms = roundings(&setting) + (double)(setting.n + grid->stored);
  double **total = fields(1, grid->stored), mass = 0, nodal = 0;
  gx_transfer_scatter(&setting.points.weights, setting.m, pair.q, total[0], pair.moment);
  gx_transfer_scatter_force(&setting.points.weights, pair.T, NULL, pair.force);
  gx_grid_fold(grid, total[0]);
  for (size_t i = 0; i < grid->stored; i++) nodal += total[0][i];
  for (size_t p = 0; p < setting.n; p++) mass += setting.m[p];
  property_compare(finding, fabs(nodal - mass), terms * unit * mass, "mass");
  for (int d = 0; d < setting.dim; d++) {
    double momentum = 0, size = 0, moment = 0, force = 0, force_size = 0;
    gx_grid_fold(grid, pair.moment[d]);
    for (size_t i = 0; i < grid->stored; i++) {
      moment += pair.moment[d][i];
      force += pair.force[d][i];
    }
    for (size_t p = 0; p < setting.n; p++) {
      momentum += setting.m[p] * pair.q[d][p];
      size += setting.m[p] * fabs(pair.q[d][p]);
      for (int e = 0; e < setting.dim; e++) force_size += fabs(pair.T[d * setting.dim + e][p]) * steepness(&setting, e);
    }
    property_compare(finding, fabs(moment - momentum), terms * unit * size, "momentum");
    property_compare(finding, fabs(force), terms * unit * force_size, "force");
  }
  fields_free(total, 1);
  pair_free(&pair, setting.dim);
  points_free(&setting.points);
  return property_judge(finding);
}

#define PROPERTY(function, title, check)                                                                                         \
  static void function(void **state)                                                                                             \
  {                                                                                                                              \
    (void)state;                                                                                                                 \
    property_check(&(const struct property){title, choices, 300, 100, check});                                                   \
  }
PROPERTY(partition_of_unity, "partition of unity", check_unity)
PROPERTY(linear_reproduction, "linear reproduction", check_linear)
PROPERTY(adjoint_transfer, "adjoint transfer", check_adjoint)
PROPERTY(totals, "totals", check_totals)

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(partition_of_unity),
      cmocka_unit_test(linear_reproduction),
      cmocka_unit_test(adjoint_transfer),
      cmocka_unit_test(totals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
