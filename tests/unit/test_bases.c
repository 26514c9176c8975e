/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bases one direction at a time: against hand formulas, against GSL's B-splines, at cell edges and domain ends. */
#include <stdlib.h>

#include <gsl/gsl_bspline.h>
#include <gsl/gsl_errno.h>

#include <gridcross/basis.h>

#include "check.h"

struct point {
  int first;
  double S[GX_MAX_SUPPORT], D[GX_MAX_SUPPORT];
};

static struct gx_axis axis_of(const struct gx_basis *basis, int cells, bool periodic, int degree)
{
  struct gx_axis axis = {.cells = cells, .periodic = periodic, .h = 1.0 / cells, .degree = degree};
  basis->layout(&axis);
  return axis;
}

static struct point at(const struct gx_basis *basis, const struct gx_axis *axis, double x, double half)
{
  struct point point;
  assert_int_equal(basis->evaluate(axis, 1, &x, &half, &point.first, point.S, point.D), -1);
  assert_in_range(point.first, 0, axis->stored - axis->support);
  return point;
}

static void linear_by_hand(void **state)
{
  (void)state;
  const struct gx_basis *basis = gx_basis_find("linear");
  struct gx_axis axis = axis_of(basis, 4, false, 1);
  assert_int_equal(axis.functions, 5);
  struct point point = at(basis, &axis, 0.3, 0);
  assert_int_equal(point.first, 1);
  NEAR(point.S[0], 0.8, 1e-15);
  NEAR(point.S[1], 0.2, 1e-15);
  NEAR(point.D[0], -4, 0);
  NEAR(point.D[1], 4, 0);
  point = at(basis, &axis, 1, 0);
  assert_int_equal(point.first, 3);
  NEAR(point.S[1], 1, 0x1p-53);
}

/* Where a hat has a slope it has a share too, or a node at the edge of a body could have none of the velocity. */
static void hats_share_on_faces(void **state)
{
  (void)state;
  static const char *const names[] = {"linear", "bspline"};
  for (int b = 0; b < 2; b++)
    for (int periodic = 0; periodic < 2; periodic++)
      for (int i = 0; i <= 4; i++) {
        const struct gx_basis *basis = gx_basis_find(names[b]);
        struct gx_axis axis = axis_of(basis, 4, periodic, 1);
        struct point point = at(basis, &axis, 0.25 * i, 0);
        double least = fmin(point.S[0], point.S[1]);
        CHECK(least > 0 && least < 1e-15 && point.S[0] + point.S[1] == 1, "%s at %g: %g, %g", names[b], 0.25 * i, point.S[0],
              point.S[1]);
        NEAR(point.D[1], 4, 0);
      }
}

/* The three pieces of a hat averaged over a domain: S and D of the node at distance r, half width l. */
static void gimp_formula(double r, double h, double l, double *S, double *D)
{
  double q = fabs(r), sign = r < 0 ? -1 : 1, w = h + l - q;
  if (q < l) {
    *S = 1 - (r * r + l * l) / (2 * h * l);
    *D = -r / (h * l);
  } else if (q <= h - l) {
    *S = 1 - q / h;
    *D = -sign / h;
  } else if (w > 0) {
    *S = w * w / (4 * h * l);
    *D = -sign * w / (2 * h * l);
  } else {
    *S = *D = 0;
  }
}

static void gimp_follows_its_formula(void **state)
{
  (void)state;
  const struct gx_basis *bases[] = {gx_basis_find("ugimp"), gx_basis_find("cpgimp")};
  const int cells = 8;
  const double h = 1.0 / cells;
  for (int which = 0; which < 2; which++)
    for (int periodic = 0; periodic < 2; periodic++)
      for (int i = 0; i <= 960; i++) { /* edges, ends and where the pieces meet among them */
        double x = i / 960.0;
        for (int per_cell = 1; per_cell <= 5; per_cell++) {
          double l = h / (2 * per_cell);
          struct gx_axis axis = axis_of(bases[which], cells, periodic, 1);
          struct point point = at(bases[which], &axis, x, l);
          double found = 0;
          for (int k = 0; k < 3; k++) {
            double S, D, r = x - (point.first + k - 1) * h; /* function 0 is the node behind the left end */
            if (periodic && r > 0.5) r -= 1;
            gimp_formula(r, h, l, &S, &D);
            NEAR(point.S[k], S, 1e-14);
            if (fabs(fabs(r) - l) > 1e-9 || per_cell > 1) NEAR(point.D[k] * h, D * h, 1e-13);
            found += S;
          }
          NEAR(found, 1, 1e-14); /* so no other node is met */
        }
      }
}

static void gimp_reports_a_domain_wider_than_its_cell(void **state)
{
  (void)state;
  const struct gx_basis *basis = gx_basis_find("cpgimp");
  struct gx_axis axis = axis_of(basis, 4, true, 1);
  int first[3];
  double S[9], D[9], x[] = {0.1, 0.4, 0.7};
  assert_int_equal(basis->evaluate(&axis, 3, x, (double[]){0.1, 0.125, 0.126}, first, S, D), 2);
  assert_int_equal(basis->evaluate(&axis, 3, x, (double[]){0.1, 0.125, 0.125}, first, S, D), -1);
  assert_int_equal(basis->evaluate(&axis, 3, x, (double[]){0.1, -0.01, 0.1}, first, S, D), 1);
  assert_int_equal(basis->evaluate(&axis, 3, x, (double[]){0.1, 0.1, NAN}, first, S, D), 2);
}

static void quadratic_by_hand(void **state)
{
  (void)state;
  const struct gx_basis *basis = gx_basis_find("bspline");
  struct gx_axis axis = axis_of(basis, 5, true, 2);
  assert_int_equal(axis.functions, 5);
  for (int i = 0; i < 100; i++) {
    double s = 5 * i / 100.0, x = s / 5;
    int cell = i / 20;
    double r = s - cell;
    struct point point = at(basis, &axis, x, 0);
    assert_int_equal(point.first, cell);
    NEAR(point.S[0], 0.5 * (1 - r) * (1 - r), 1e-14);
    NEAR(point.S[1], 0.5 + r * (1 - r), 1e-14);
    NEAR(point.S[2], 0.5 * r * r, 1e-14);
    NEAR(point.D[0], -5 * (1 - r), 1e-13);
    NEAR(point.D[1], 5 * (1 - 2 * r), 1e-13);
    NEAR(point.D[2], 5 * r, 1e-13);
  }
}

/* GSL's B-splines on knots built by hand: uniform beyond both ends when periodic, open otherwise. */
static gsl_bspline_workspace *gsl_splines(int degree, int cells, bool periodic)
{
  size_t order = (size_t)degree + 1;
  gsl_bspline_workspace *work = gsl_bspline_alloc(order, (size_t)cells + 1);
  assert_int_equal(work->knots->size, (size_t)(cells + 1 + 2 * degree));
  for (size_t i = 0; i < work->knots->size; i++) {
    double k = (double)i - degree;
    if (!periodic) k = k < 0 ? 0 : k > cells ? cells : k;
    gsl_vector_set(work->knots, i, k / cells);
  }
  return work;
}

static void compare_with_gsl(const struct gx_axis *axis, gsl_bspline_workspace *work, gsl_matrix *expected, double x)
{
  const struct gx_basis *basis = gx_basis_find("bspline");
  size_t start, end;
  assert_int_equal(gsl_bspline_deriv_eval_nonzero(x, 1, expected, &start, &end, work), GSL_SUCCESS);
  struct point point = at(basis, axis, x, 0);
  assert_int_equal(point.first, start);
  for (int k = 0; k <= axis->degree; k++) {
    NEAR(point.S[k], gsl_matrix_get(expected, (size_t)k, 0), 1e-13);
    NEAR(point.D[k] * axis->h, gsl_matrix_get(expected, (size_t)k, 1) * axis->h, 1e-13);
  }
}

static void splines_agree_with_gsl(void **state)
{
  (void)state;
  const struct gx_basis *basis = gx_basis_find("bspline");
  const int sizes[] = {1, 2, 3, 7, 16, 32};
  for (int degree = 1; degree <= GX_MAX_DEGREE; degree++)
    for (int periodic = 0; periodic < 2; periodic++)
      for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        int cells = sizes[i];
        struct gx_axis axis = axis_of(basis, cells, periodic, degree);
        assert_int_equal(axis.stored, cells + degree);
        gsl_bspline_workspace *work = gsl_splines(degree, cells, periodic);
        gsl_matrix *expected = gsl_matrix_alloc((size_t)degree + 1, 2);
        uint64_t seed = 7;
        for (int j = 0; j < 200; j++) compare_with_gsl(&axis, work, expected, check_random(&seed, 0, 1));
        if ((cells & (cells - 1)) == 0) /* edges that both sides round alike */
          for (int c = 0; c < cells + !periodic; c++) compare_with_gsl(&axis, work, expected, (double)c / cells);
        gsl_matrix_free(expected);
        gsl_bspline_free(work);
      }
}

static void each_basis(void (*check)(const struct gx_basis *basis, const struct gx_axis *axis, double half))
{
  for (size_t i = 0; gx_basis_family[i]; i++)
    for (int degree = 1; degree <= (gx_basis_family[i]->has_degree ? GX_MAX_DEGREE : 1); degree++)
      for (int periodic = 0; periodic < 2; periodic++) {
        struct gx_axis axis = axis_of(gx_basis_family[i], 12, periodic, degree);
        check(gx_basis_family[i], &axis, axis.h / 4);
      }
}

static void check_slope(const struct gx_basis *basis, const struct gx_axis *axis, double half)
{
  const double step = 1e-6;
  for (int i = 0; i < 240; i++) {
    double x = (i + 0.37) / 240;
    struct point point = at(basis, axis, x, half), low = at(basis, axis, x - step, half), high = at(basis, axis, x + step, half);
    assert_int_equal(low.first, point.first);
    assert_int_equal(high.first, point.first);
    for (int k = 0; k < axis->support; k++) NEAR((high.S[k] - low.S[k]) / (2 * step), point.D[k], 1e-6 * axis->cells);
  }
}

static void derivatives_are_slopes(void **state)
{
  (void)state;
  each_basis(check_slope);
}

static void expand(const struct gx_axis *axis, const struct point *point, double *S)
{
  for (int j = 0; j < axis->functions; j++) S[j] = 0;
  for (int k = 0; k < axis->support; k++) S[(point->first + k) % axis->functions] += point->S[k];
}

/* Values are continuous across every cell edge, from the nearest doubles on both sides; so are images of a periodic point. */
static void check_edges(const struct gx_basis *basis, const struct gx_axis *axis, double half)
{
  double S[3][64];
  for (int c = 0; c <= axis->cells; c++) {
    double edge = (double)c / axis->cells;
    bool ends = !axis->periodic && (c == 0 || c == axis->cells);
    double x[] = {ends && c == 0 ? edge : nextafter(edge, -1), edge, ends && c ? edge : nextafter(edge, 2)};
    for (int i = 0; i < 3; i++) {
      struct point point = at(basis, axis, x[i], half);
      expand(axis, &point, S[i]);
      if (!axis->periodic) continue;
      struct point image = at(basis, axis, x[i] - 3, half);
      double shifted[64];
      expand(axis, &image, shifted);
      for (int j = 0; j < axis->functions; j++) NEAR(shifted[j], S[i][j], 4e-14);
    }
    for (int j = 0; j < axis->functions; j++) {
      NEAR(S[0][j], S[1][j], 4e-14);
      NEAR(S[2][j], S[1][j], 4e-14);
    }
  }
}

static void edges_are_no_exception(void **state)
{
  (void)state;
  each_basis(check_edges);
}

/* With the `edge` functions at each end held at zero, no other function is left at a fixed end. */
static void fixed_ends_hold_the_end(void **state)
{
  (void)state;
  for (size_t i = 0; gx_basis_family[i]; i++)
    for (int degree = 1; degree <= (gx_basis_family[i]->has_degree ? GX_MAX_DEGREE : 1); degree++) {
      struct gx_axis axis = axis_of(gx_basis_family[i], 12, false, degree);
      for (int end = 0; end < 2; end++) {
        /* a particle domain that follows the end's node is centred as close as half its width */
        struct point point = at(gx_basis_family[i], &axis, end, axis.h / 4);
        for (int k = 0; k < axis.support; k++) {
          int j = point.first + k;
          bool held = j < axis.edge || j >= axis.functions - axis.edge;
          if (!held && !gx_basis_family[i]->has_domain) NEAR(point.S[k], 0, 1e-15);
        }
      }
    }
}

static void unknown_names_are_not_found(void **state)
{
  (void)state;
  assert_null(gx_basis_find("b-spline"));
  for (size_t i = 0; gx_basis_family[i]; i++) assert_ptr_equal(gx_basis_find(gx_basis_family[i]->name), gx_basis_family[i]);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(linear_by_hand),           cmocka_unit_test(hats_share_on_faces),
      cmocka_unit_test(gimp_follows_its_formula), cmocka_unit_test(gimp_reports_a_domain_wider_than_its_cell),
      cmocka_unit_test(quadratic_by_hand),        cmocka_unit_test(splines_agree_with_gsl),
      cmocka_unit_test(derivatives_are_slopes),   cmocka_unit_test(edges_are_no_exception),
      cmocka_unit_test(fixed_ends_hold_the_end),  cmocka_unit_test(unknown_names_are_not_found),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
