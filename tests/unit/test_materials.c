/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials: stress is the derivative of energy, its rate the derivative of stress, in every dimension a problem uses. */
#include <gridcross/problem.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

enum { N = 40 };

struct tensors {
  double store[GX_MAX_TENSOR][N];
  double *component[GX_MAX_TENSOR];
};

static struct tensors *point_at(struct tensors *tensors)
{
  for (int k = 0; k < GX_MAX_TENSOR; k++) tensors->component[k] = tensors->store[k];
  return tensors;
}

/* Deformation gradients well away from det F = 0, with off-diagonal parts. */
static void fill(struct tensors *F, int dim, uint64_t *seed, double centre)
{
  point_at(F);
  for (int k = 0; k < dim * dim; k++)
    for (int p = 0; p < N; p++) F->store[k][p] = (k % (dim + 1) == 0 ? centre : 0) + check_random(seed, -0.3, 0.3);
}

/* Of the problems that use it; a material without one is tried in every dimension. */
static int largest_dimension(const struct gx_material *material)
{
  int most = 0;
  for (size_t i = 0; gx_problem_family[i]; i++)
    if (gx_problem_family[i]->material == material && gx_problem_family[i]->max_dim > most) most = gx_problem_family[i]->max_dim;
  return most ? most : GX_MAX_DIM;
}

static void each_material(void (*check)(const struct gx_material *material, const struct gx_moduli *moduli, int dim))
{
  for (size_t i = 0; gx_material_family[i]; i++) {
    const struct gx_material *material = gx_material_family[i];
    int most = largest_dimension(material);
    for (int dim = 1; dim <= most; dim++)
      for (int with_bulk = 0; with_bulk < 3; with_bulk++) {
        struct gx_moduli moduli = gx_material_moduli(7, with_bulk ? 0.3 : 0, 1.5);
        if (with_bulk == 2) moduli.lambda = 1; /* a number that may stand in the source, too */
        check(material, &moduli, dim);
      }
  }
}

static void lame_parameters_by_hand(void **state)
{
  (void)state;
  struct gx_moduli moduli = gx_material_moduli(2.6, 0.3, 4);
  NEAR(moduli.mu, 1, 1e-15);
  NEAR(moduli.lambda, 1.5, 1e-14);
  NEAR(moduli.density, 4, 0);
  NEAR(moduli.young, 2.6, 0);
  NEAR(gx_material_find("neo-hookean")->wave_speed(&moduli), sqrt(3.5 / 4), 1e-14);
  moduli = gx_material_moduli(64, 0, 1);
  NEAR(gx_material_find("neo-hookean")->wave_speed(&moduli), 8, 1e-15);
  NEAR(gx_material_find("linear-elastic")->wave_speed(&moduli), 8, 1e-15);
}

static void check_stress(const struct gx_material *material, const struct gx_moduli *moduli, int dim)
{
  const double step = 1e-4;
  struct tensors F, P;
  double W[4][N];
  uint64_t seed = 3;
  fill(&F, dim, &seed, 1.1);
  assert_int_equal(material->piola(moduli, dim, N, F.component, point_at(&P)->component), -1);
  for (int k = 0; k < dim * dim; k++) {
    const double shift[] = {-2, -1, 1, 2};
    struct tensors moved;
    for (int i = 0; i < 4; i++) {
      memcpy(moved.store, F.store, sizeof F.store);
      point_at(&moved);
      for (int p = 0; p < N; p++) moved.store[k][p] += shift[i] * step;
      material->energy(moduli, dim, N, moved.component, W[i]);
    }
    for (int p = 0; p < N; p++)
      NEAR((W[0][p] - 8 * W[1][p] + 8 * W[2][p] - W[3][p]) / (12 * step), P.store[k][p], 1e-9 * moduli->young);
  }
}

static void stress_is_the_derivative_of_energy(void **state)
{
  (void)state;
  each_material(check_stress);
}

static void check_rate(const struct gx_material *material, const struct gx_moduli *moduli, int dim)
{
  const double step = 1e-4, shift[] = {-2, -1, 1, 2};
  struct tensors F, rate_F, rate_P, P[4];
  uint64_t seed = 5;
  fill(&F, dim, &seed, 1);
  fill(&rate_F, dim, &seed, 0.2);
  material->piola_rate(moduli, dim, N, F.component, rate_F.component, point_at(&rate_P)->component);
  for (int i = 0; i < 4; i++) {
    struct tensors moved;
    point_at(&moved);
    for (int k = 0; k < dim * dim; k++)
      for (int p = 0; p < N; p++) moved.store[k][p] = F.store[k][p] + shift[i] * step * rate_F.store[k][p];
    material->piola(moduli, dim, N, moved.component, point_at(&P[i])->component);
  }
  for (int k = 0; k < dim * dim; k++)
    for (int p = 0; p < N; p++)
      NEAR((P[0].store[k][p] - 8 * P[1].store[k][p] + 8 * P[2].store[k][p] - P[3].store[k][p]) / (12 * step), rate_P.store[k][p],
           1e-8 * moduli->young);
}

static void stress_rate_is_the_derivative_of_stress(void **state)
{
  (void)state;
  each_material(check_rate);
}

/* Straight from their formulas, P and sigma alike in 1-D. */
static void one_dimension_by_hand(void **state)
{
  (void)state;
  struct gx_moduli moduli = gx_material_moduli(1e4, 0, 1);
  for (double stretch = 0.3; stretch < 2; stretch += 0.1) {
    double F = stretch, P, sigma, W;
    double *in[] = {&F}, *out[] = {&P}, *cauchy[] = {&sigma};
    gx_material_find("neo-hookean")->piola(&moduli, 1, 1, in, out);
    gx_material_cauchy(1, 1, in, out, cauchy);
    NEAR(P, 5e3 * (F - 1 / F), 1e-11);
    NEAR(sigma, P, 1e-11);
    gx_material_find("neo-hookean")->energy(&moduli, 1, 1, in, &W);
    NEAR(W, 5e3 * ((F * F - 1) / 2 - log(F)), 1e-11);
    gx_material_find("linear-elastic")->piola(&moduli, 1, 1, in, out);
    gx_material_cauchy(1, 1, in, out, cauchy);
    NEAR(P, 1e4 * (F - 1), 0);
    NEAR(sigma, P, 1e-11);
    gx_material_find("linear-elastic")->energy(&moduli, 1, 1, in, &W);
    NEAR(W, 5e3 * (F - 1) * (F - 1), 1e-11);
  }
}

/* sigma = (mu (F F^T - I) + lambda ln J I) / J, by hand for simple shear with stretch: F = [[2, 1], [0, 1]], J = 2. */
static void cauchy_by_hand(void **state)
{
  (void)state;
  struct gx_moduli moduli = gx_material_moduli(2.6, 0.3, 1); /* mu 1, lambda 1.5 */
  double f[] = {2, 1, 0, 1}, p[4], s[4];
  double *F[] = {f, f + 1, f + 2, f + 3}, *P[] = {p, p + 1, p + 2, p + 3}, *sigma[] = {s, s + 1, s + 2, s + 3};
  gx_material_find("neo-hookean")->piola(&moduli, 2, 1, F, P);
  gx_material_cauchy(2, 1, F, P, sigma);
  double bulk = 1.5 * log(2) / 2;
  NEAR(s[0], 2 + bulk, 1e-14);
  NEAR(s[1], 0.5, 1e-14);
  NEAR(s[2], 0.5, 1e-14);
  NEAR(s[3], bulk, 1e-14);
}

/* det F by permutations. */
static double determinant(int dim, const struct tensors *F, int p)
{
  double f[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < dim; i++)
    for (int j = 0; j < dim; j++) f[i][j] = F->store[i * dim + j][p];
  return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) - f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
         f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}

/* sigma = (mu/J) (F F^T - I) + (lambda ln J/J) I is P F^T/J, with and without the bulk term. */
static void cauchy_form_is_that_of_piola(void **state)
{
  (void)state;
  const struct gx_material *material = gx_material_find("neo-hookean");
  for (int dim = 1; dim <= GX_MAX_DIM; dim++)
    for (int with_bulk = 0; with_bulk < 2; with_bulk++) {
      struct gx_moduli moduli = gx_material_moduli(7, with_bulk ? 0.3 : 0, 1.5);
      struct tensors F, P, sigma;
      uint64_t seed = 31;
      fill(&F, dim, &seed, 1.1);
      material->piola(&moduli, dim, N, F.component, point_at(&P)->component);
      gx_material_cauchy(dim, N, F.component, P.component, point_at(&sigma)->component);
      for (int p = 0; p < N; p++) {
        double J = determinant(dim, &F, p);
        for (int i = 0; i < dim; i++)
          for (int j = 0; j < dim; j++) {
            double left = 0; /* (F F^T)_ij */
            for (int k = 0; k < dim; k++) left += F.store[i * dim + k][p] * F.store[j * dim + k][p];
            double expected = moduli.mu * (left - (i == j)) / J + (i == j ? moduli.lambda * log(J) / J : 0);
            NEAR(sigma.store[i * dim + j][p], expected, 1e-14 * moduli.young);
          }
      }
    }
}

/* A body in `dim` dimensions is one in 3-D whose other directions do not move: plane strain in 2-D, uniaxial strain in 1-D. The
 * walls across carry P_zz = lambda ln J. */
static void fewer_dimensions_are_plane_strain(void **state)
{
  (void)state;
  const struct gx_material *material = gx_material_find("neo-hookean");
  struct gx_moduli moduli = gx_material_moduli(7, 0.3, 1.5);
  for (int dim = 1; dim < 3; dim++) {
    struct tensors flat, rate, P, rate_P, solid = {0}, solid_rate = {0}, solid_P, solid_rate_P;
    double W[N], solid_W[N];
    uint64_t seed = 37;
    fill(&flat, dim, &seed, 1.1);
    fill(&rate, dim, &seed, 0.2);
    for (int p = 0; p < N; p++)
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
          bool moves = i < dim && j < dim;
          solid.store[3 * i + j][p] = moves ? flat.store[i * dim + j][p] : i == j;
          solid_rate.store[3 * i + j][p] = moves ? rate.store[i * dim + j][p] : 0;
        }
    point_at(&solid), point_at(&solid_rate);
    material->piola(&moduli, dim, N, flat.component, point_at(&P)->component);
    material->piola(&moduli, 3, N, solid.component, point_at(&solid_P)->component);
    material->piola_rate(&moduli, dim, N, flat.component, rate.component, point_at(&rate_P)->component);
    material->piola_rate(&moduli, 3, N, solid.component, solid_rate.component, point_at(&solid_rate_P)->component);
    material->energy(&moduli, dim, N, flat.component, W);
    material->energy(&moduli, 3, N, solid.component, solid_W);
    for (int p = 0; p < N; p++) {
      for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) {
          NEAR(P.store[i * dim + j][p], solid_P.store[3 * i + j][p], 1e-14 * moduli.young);
          NEAR(rate_P.store[i * dim + j][p], solid_rate_P.store[3 * i + j][p], 1e-13 * moduli.young);
        }
      NEAR(solid_P.store[8][p], moduli.lambda * log(determinant(dim, &flat, p)), 1e-14 * moduli.young);
      NEAR(W[p], solid_W[p], 1e-14 * moduli.young);
    }
  }
}

static void check_symmetry(const struct gx_material *material, const struct gx_moduli *moduli, int dim)
{
  struct tensors F, P, sigma;
  uint64_t seed = 11;
  fill(&F, dim, &seed, 1);
  material->piola(moduli, dim, N, F.component, point_at(&P)->component);
  gx_material_cauchy(dim, N, F.component, P.component, point_at(&sigma)->component);
  for (int i = 0; i < dim; i++)
    for (int j = 0; j < i; j++)
      for (int p = 0; p < N; p++) NEAR(sigma.store[i * dim + j][p], sigma.store[j * dim + i][p], 1e-13 * moduli->young);
}

static void cauchy_stress_is_symmetric(void **state)
{
  (void)state;
  each_material(check_symmetry);
}

/* W(RF) = W(F), P(RF) = R P(F) for a rotation R by 0.7 in every plane. */
static void check_rotation(const struct gx_material *material, const struct gx_moduli *moduli, int dim)
{
  struct tensors F, P, turned, turned_P;
  double W[N], turned_W[N];
  for (int a = 0; a < dim; a++)
    for (int b = 0; b < dim; b++) {
      uint64_t seed = 13;
      if (a == b) continue;
      fill(&F, dim, &seed, 1.1);
      memcpy(turned.store, F.store, sizeof F.store);
      point_at(&turned);
      for (int j = 0; j < dim; j++)
        for (int p = 0; p < N; p++) {
          double above = F.store[a * dim + j][p], below = F.store[b * dim + j][p];
          turned.store[a * dim + j][p] = cos(0.7) * above - sin(0.7) * below;
          turned.store[b * dim + j][p] = sin(0.7) * above + cos(0.7) * below;
        }
      material->piola(moduli, dim, N, F.component, point_at(&P)->component);
      material->piola(moduli, dim, N, turned.component, point_at(&turned_P)->component);
      material->energy(moduli, dim, N, F.component, W);
      material->energy(moduli, dim, N, turned.component, turned_W);
      for (int p = 0; p < N; p++) NEAR(turned_W[p], W[p], 1e-13 * moduli->young);
      for (int j = 0; j < dim; j++)
        for (int p = 0; p < N; p++)
          NEAR(turned_P.store[a * dim + j][p], cos(0.7) * P.store[a * dim + j][p] - sin(0.7) * P.store[b * dim + j][p],
               1e-12 * moduli->young);
    }
}

static void rotations_change_nothing(void **state)
{
  (void)state;
  each_material(check_rotation);
}

static void check_rest(const struct gx_material *material, const struct gx_moduli *moduli, int dim)
{
  struct tensors F = {0}, P;
  double W[N];
  point_at(&F);
  for (int d = 0; d < dim; d++)
    for (int p = 0; p < N; p++) F.store[d * dim + d][p] = 1;
  assert_int_equal(material->piola(moduli, dim, N, F.component, point_at(&P)->component), -1);
  material->energy(moduli, dim, N, F.component, W);
  for (int k = 0; k < dim * dim; k++)
    for (int p = 0; p < N; p++) NEAR(P.store[k][p], 0, 0);
  for (int p = 0; p < N; p++) NEAR(W[p], 0, 0);
}

static void undeformed_is_free_of_stress(void **state)
{
  (void)state;
  each_material(check_rest);
}

static void check_tangled(const struct gx_material *material, const struct gx_moduli *moduli, int dim)
{
  const double bad[] = {0, -0.5, NAN, INFINITY, -INFINITY};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    for (int at = 0; at < N; at += 13) {
      struct tensors F, P;
      uint64_t seed = 17;
      fill(&F, dim, &seed, 1.1);
      for (int k = 0; k < dim * dim; k++) F.store[k][at] = k % (dim + 1) == 0;
      F.store[0][at] = bad[i];
      if (at + 2 < N) memcpy(&F.store[0][at + 2], &bad[i], sizeof bad[i]); /* the first one is meant */
      assert_int_equal(material->piola(moduli, dim, N, F.component, point_at(&P)->component), at);
    }
}

static void tangling_is_reported_with_its_particle(void **state)
{
  (void)state;
  each_material(check_tangled);
}

/* Of n points and no more, whatever pieces it is made of: behind them nothing is a number. scale 1e100: J is one where J^4 is none. */
static void check_total(const struct gx_material *material, const struct gx_moduli *moduli, int dim, size_t n, double scale)
{
  double *F[GX_MAX_TENSOR], *W = malloc((n + 1) * sizeof *W);
  long double sum = 0, size = 0;
  uint64_t seed = 19 + n;
  for (int k = 0; k < dim * dim; k++) {
    F[k] = malloc((n + 1) * sizeof *F[k]);
    for (size_t p = 0; p < n; p++) F[k][p] = scale * ((k % (dim + 1) == 0) + check_random(&seed, -0.3, 0.3));
    F[k][n] = NAN;
  }
  material->energy(moduli, dim, n, F, W);
  for (size_t p = 0; p < n; p++) {
    sum += W[p];
    size += fabs(W[p]) + moduli->mu * (scale * scale + 1);
  }
  const double total = material->total(moduli, dim, n, F);
  if (!(fabsl(total - sum) <= 1e-14L * size))
    fail_msg("%s in %d-D: %zu energies add up to %.17Lg, in pieces to %.17g", material->name, dim, n, sum, total);
  for (int k = 0; k < dim * dim; k++) free(F[k]);
  free(W);
}

static void totals_of(const struct gx_material *material, const struct gx_moduli *moduli, int dim)
{
  static const size_t n[] = {0, 1, 3, 4, 7, 255, 1021, 1024, 1026, 2048, 3075, 5003};
  for (size_t i = 0; material->total && i < sizeof n / sizeof *n; i++)
    for (int huge = 0; huge < 2; huge++) check_total(material, moduli, dim, n[i], huge ? 1e100 : 1);
}

static void totals_are_sums_of_energies(void **state)
{
  (void)state;
  each_material(totals_of);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lame_parameters_by_hand),
      cmocka_unit_test(stress_is_the_derivative_of_energy),
      cmocka_unit_test(stress_rate_is_the_derivative_of_stress),
      cmocka_unit_test(one_dimension_by_hand),
      cmocka_unit_test(cauchy_by_hand),
      cmocka_unit_test(cauchy_form_is_that_of_piola),
      cmocka_unit_test(fewer_dimensions_are_plane_strain),
      cmocka_unit_test(cauchy_stress_is_symmetric),
      cmocka_unit_test(rotations_change_nothing),
      cmocka_unit_test(undeformed_is_free_of_stress),
      cmocka_unit_test(tangling_is_reported_with_its_particle),
      cmocka_unit_test(totals_are_sums_of_energies),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
