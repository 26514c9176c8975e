/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums and maxima of arrays, at every length about the number of partial results. */
#include "core/vector.h"

#include "check.h"

enum { MOST = 40 };

static void sums(void **state)
{
  (void)state;
  double value[MOST];
  for (int i = 0; i < MOST; i++) value[i] = i * i - 7; /* whole numbers: exact in any order */
  for (int n = 0; n <= MOST; n++) NEAR(gx_vector_sum((size_t)n, value), (n - 1) * n * (2 * n - 1) / 6 - 7 * n, 0);
}

static void squares(void **state)
{
  (void)state;
  double weight[MOST], value[MOST], sum = 0;
  for (int i = 0; i < MOST; i++) {
    weight[i] = i - 3;
    value[i] = i % 5 - 2;
  }
  for (int n = 0; n <= MOST; n++) {
    NEAR(gx_vector_weighted((size_t)n, weight, value, value), sum, 0);
    if (n < MOST) sum += (n - 3) * (n % 5 - 2) * (n % 5 - 2);
  }
}

static void products(void **state)
{
  (void)state;
  double a[MOST], b[MOST], sum = 0;
  for (int i = 0; i < MOST; i++) {
    a[i] = i - 3;
    b[i] = i % 5 - 2;
  }
  for (int n = 0; n <= MOST; n++) {
    NEAR(gx_vector_dot((size_t)n, a, b), sum, 0);
    if (n < MOST) sum += (n - 3) * (n % 5 - 2);
  }
}

/* Of numbers whose sums are rounded: equal bits, wherever the last piece ends. */
static void sums_do_not_depend_on_pieces(void **state)
{
  (void)state;
  enum { ENTRIES = 3 * GX_VECTOR_PIECE + 5 };
  static const size_t lengths[] = {GX_VECTOR_LANES, 3 * GX_VECTOR_LANES, GX_VECTOR_PIECE};
  double a[ENTRIES], b[ENTRIES];
  uint64_t seed = 71;
  for (int i = 0; i < ENTRIES; i++) {
    a[i] = check_random(&seed, -1, 1);
    b[i] = check_random(&seed, 1, 2);
  }
  for (size_t n = 0; n <= ENTRIES; n++)
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++) {
      double sum[GX_VECTOR_LANES] = {0}, dot[GX_VECTOR_LANES] = {0};
      for (size_t from = 0; from < n; from += lengths[k]) {
        size_t piece = n - from < lengths[k] ? n - from : lengths[k];
        if (lengths[k] == GX_VECTOR_PIECE) assert_int_equal(gx_vector_piece(n, from), piece);
        gx_vector_sum_piece(piece, a + from, sum);
        gx_vector_dot_piece(piece, a + from, b + from, dot);
      }
      NEAR(gx_vector_total(sum), gx_vector_sum(n, a), 0);
      NEAR(gx_vector_total(dot), gx_vector_dot(n, a, b), 0);
    }
}

static void maxima(void **state)
{
  (void)state;
  for (int n = 1; n <= MOST; n++)
    for (int at = 0; at < n; at++) {
      double value[MOST];
      for (int i = 0; i < n; i++) value[i] = i == at ? 3.5 : -i;
      NEAR(gx_vector_max((size_t)n, value), 3.5, 0);
      value[at] = NAN;
      NEAR(gx_vector_max((size_t)n, value), 0, 0);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sums),     cmocka_unit_test(squares),
      cmocka_unit_test(products), cmocka_unit_test(sums_do_not_depend_on_pieces),
      cmocka_unit_test(maxima),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
