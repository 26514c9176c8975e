/* SPDX-License-Identifier: GPL-3.0-or-later */
/* c_k by a cosine transform of samples at M + 1 angles from 0 to pi, where M is doubled, old samples being every second of the new ones,
 * until the last quarter of the terms has fallen to round-off. Then about angles n h, h = pi / PIECES, with x = 2 (angle - n h) / h in
 * [-1, 1], the terms x^r (h/2)^r / r! d^r/dangle^r sum_k c_k cos(k angle), of which the highest are economised (Lanczos, Applied Analysis,
 * 1956, ch. 7). Sums are in one order for every instruction set. */
#include "force_series.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "../core/aligned.h"
#include "../core/kernel.h"

/* M at first and at last: at most 48 cosines. Terms of a Taylor series: behind 24, (48 h/2)^24 / 24! = 1e-8 of a c_48 that hardly counts is
 * nothing; those left of it. Nodes that lie together in the table; rows that are added at once. */
enum { FEW = 16, MANY = 64, PIECES = 16, TAYLOR = 24, LEAST = 4, MOST = 16, LANES = GX_FORCE_SERIES_ROOM + 1, GROUP = 4 };

struct gx_force_series {
  size_t terms, pitch; /* nodes, and what fills up the last lanes */
  double *table;       /* [PIECES + 1][pitch / LANES][terms][LANES] */
  void *block;
};

/* Rows of `length` entries that are `stride` apart. */
struct rows {
  size_t count, stride, length;
  const double *first;
};

GX_CORE void add_rows(const size_t count, const struct rows *rows, size_t from, const double *weight, double *restrict sum)
{
  const double *restrict row = rows->first + from * rows->stride;
  const size_t stride = rows->stride;
  for (size_t i = 0; i < rows->length; i++)
    for (size_t r = 0; r < count; r++) sum[i] += weight[from + r] * row[r * stride + i];
}

/* sum = sum_r weight_r row_r */
GX_CLONES static void combine(const struct rows *rows, const double *weight, double *sum)
{
  size_t r = 0;
  memset(sum, 0, rows->length * sizeof *sum);
  for (; r + GROUP <= rows->count; r += GROUP) add_rows(GROUP, rows, r, weight, sum);
  for (; r < rows->count; r++) add_rows(1, rows, r, weight, sum);
}

/* c_k = 2/M sum_j f_j cos(pi j k / M), where the first and the last sample, and the first and the last term, count half. */
static void transform(size_t pitch, size_t M, const double *samples, double *coefficient)
{
  const struct rows rows = {.count = M + 1, .stride = MANY / M * pitch, .length = pitch, .first = samples};
  double cosine[2 * MANY], weight[MANY + 1];
  for (size_t j = 0; j < 2 * M; j++) cosine[j] = cos(M_PI * (double)j / (double)M);
  for (size_t k = 0; k <= M; k++) {
    for (size_t j = 0; j <= M; j++)
      weight[j] = (j % M ? 1 : 0.5) * (k % M ? 1 : 0.5) * 2 / (double)M * cosine[j * k & (2 * M - 1)];
    combine(&rows, weight, coefficient + k * pitch);
  }
}

/* Infinite where one is not a number. */
static double largest_of(size_t n, const double *x)
{
  double largest = 0;
  for (size_t i = 0; i < n; i++)
    if (!(fabs(x[i]) <= largest)) largest = isnan(x[i]) ? INFINITY : fabs(x[i]);
  return largest;
}

/* How many of the M + 1 terms count; 0: one of the last quarter does, or not all are finite. most: [M + 1] the largest of each */
static size_t count_cosines(size_t pitch, size_t M, const double *coefficient, double *most)
{
  double largest = 0;
  for (size_t k = 0; k <= M; k++) {
    most[k] = largest_of(pitch, coefficient + k * pitch);
    largest = fmax(largest, most[k]);
  }
  size_t count = M + 1;
  while (count > 1 && most[count - 1] <= 4 * DBL_EPSILON * largest) count--;
  return count <= M * 3 / 4 && isfinite(largest) ? count : 0;
}

/* Samples and coefficients of the cosines: [MANY + 1][pitch] each, 0. Returns how many cosines there are; 0: too many. */
static size_t fit(size_t pitch, gx_force_sample *sample, void *context, double *samples, double *coefficient, double *most)
{
  size_t count = 0;
  for (size_t M = FEW; M <= MANY && count == 0; M *= 2) {
    for (size_t j = M == FEW ? 0 : 1; j <= M; j += M == FEW ? 1 : 2)
      sample(context, M_PI * (double)j / (double)M, samples + j * (MANY / M) * pitch);
    transform(pitch, M, samples, coefficient);
    count = count_cosines(pitch, M, coefficient, most);
  }
  return count;
}

/* factor[r][k] = (k h/2)^r / r! */
static void find_factors(size_t count, double factor[TAYLOR][MANY])
{
  for (size_t r = 0; r < TAYLOR; r++)
    for (size_t k = 0; k < count; k++) factor[r][k] = r ? factor[r - 1][k] * ((double)k * M_PI / (2 * PIECES)) / (double)r : 1;
}

/* Puts lower powers in the place of the highest as long as what is lost stays below epsilon of the largest term: x^r less 2^(1-r) times
 * the polynomial T_r, whose coefficients have the signs of the derivatives of a cosine. Returns how many powers are left. */
static size_t economise(size_t count, const double *most, double factor[TAYLOR][MANY])
{
  const double bearable = DBL_EPSILON * largest_of(count, most);
  size_t terms = TAYLOR;
  double lost = 0;
  for (; terms > LEAST; terms--) {
    const size_t r = terms - 1;
    for (size_t k = 0; k < count; k++) lost += ldexp(most[k] * fabs(factor[r][k]), 1 - (int)r);
    if (!(lost <= bearable)) break;
    double share = 1;
    for (size_t s = r; s-- > 0 && s-- > 0;) {
      share *= (double)((s + 2) * (s + 1)) / (double)((r - s) * (r + s));
      for (size_t k = 0; k < count; k++) factor[s][k] -= share * factor[r][k];
    }
  }
  return terms;
}

/* d^r/dx^r cos x = cos(x + r pi/2). row: [pitch] scratch */
static void expand(struct gx_force_series *series, size_t count, double factor[TAYLOR][MANY], const double *coefficient,
                   double *row)
{
  const struct rows rows = {.count = count, .stride = series->pitch, .length = series->pitch, .first = coefficient};
  double cosine[2 * PIECES], weight[MANY];
  for (size_t j = 0; j < 2 * PIECES; j++) cosine[j] = cos(M_PI * (double)j / PIECES);
  for (size_t n = 0; n <= PIECES; n++)
    for (size_t r = 0; r < series->terms; r++) {
      double *to = series->table + n * series->pitch * series->terms + r * LANES;
      for (size_t k = 0; k < count; k++) weight[k] = factor[r][k] * cosine[(k * n + r * PIECES / 2) % (2 * PIECES)];
      combine(&rows, weight, row);
      for (size_t i = 0; i < series->pitch; i += LANES, to += series->terms * LANES) memcpy(to, row + i, LANES * sizeof *to);
    }
}

/* scratch: [2 (MANY + 1)][pitch], 0 */
static bool make(struct gx_force_series *series, size_t most_terms, gx_force_sample *sample, void *context, double *scratch)
{
  double *coefficient = scratch + (MANY + 1) * series->pitch, most[MANY + 1], factor[TAYLOR][MANY];
  const size_t count = fit(series->pitch, sample, context, scratch, coefficient, most);
  if (count == 0) return false;
  find_factors(count, factor);
  series->terms = economise(count, most, factor);
  if (series->terms > MOST || series->terms > most_terms) return false;
  series->table = gx_aligned_zeros((PIECES + 1) * series->terms * series->pitch * sizeof(double), &series->block);
  if (!series->table) return false;
  expand(series, count, factor, coefficient, scratch);
  return true;
}

struct gx_force_series *gx_force_series_create(size_t nodes, size_t most_terms, gx_force_sample *sample, void *context)
{
  if (most_terms < LEAST) return NULL;
  const size_t pitch = (nodes + LANES - 1) / LANES * LANES;
  struct gx_force_series *series = malloc(sizeof *series);
  void *block = NULL;
  double *scratch = gx_aligned_zeros(2 * (MANY + 1) * pitch * sizeof(double), &block);
  if (series) *series = (struct gx_force_series){.pitch = pitch};
  if (!series || !scratch || !make(series, most_terms, sample, context, scratch)) {
    gx_force_series_free(series);
    series = NULL;
  }
  free(block);
  return series;
}

void gx_force_series_free(struct gx_force_series *series)
{
  if (series) free(series->block);
  free(series);
}

size_t gx_force_series_terms(const struct gx_force_series *series)
{
  return series->terms;
}

/* An angle about which there is a series. */
struct piece {
  size_t n;
  double x;
};

/* pi/2 in two parts, of which the first has 33 bits, so that its products with less than 2^20 are exact. */
static struct piece piece_of(double angle)
{
  const double high = 0x1.921fb544p0 * 2 / PIECES, low = 0x1.0b4611a626331p-34 * 2 / PIECES, whole = 0x1.8p52;
  if (!(fabs(angle) < 0x1p16)) angle = acos(cos(angle));
  const double n = (angle * (PIECES / M_PI) + whole) - whole; /* nearest */
  const double x = ((angle - n * high) - n * low) * (2 * PIECES / M_PI);
  const size_t turned = (size_t)(long)n % (2 * PIECES);
  return turned <= PIECES ? (struct piece){turned, x} : (struct piece){2 * PIECES - turned, -x};
}

/* sum = sum_r row_r x^r, even and odd powers apart, so that operations wait for each other half as long. */
GX_CORE void sum_powers(const int terms, size_t n, double x, const double *restrict row, double *restrict sum)
{
  const double square = x * x;
  for (size_t at = 0; at < n; at += LANES, row += terms * LANES)
    for (size_t i = 0; i < LANES; i++) {
      double part[2];
      for (int r = terms - 1; r >= 0; r--) {
        const double c = row[(size_t)r * LANES + i];
        part[r % 2] = r + 2 < terms ? part[r % 2] * square + c : c;
      }
      sum[at + i] = part[0] + x * part[1];
    }
}

GX_CLONES static void sum_series(size_t terms, size_t n, double x, const double *row, double *sum)
{
#define SUM(terms)                                                                                                               \
  case terms:                                                                                                                    \
    sum_powers(terms, n, x, row, sum);                                                                                           \
    break;
#define SUM_OF_FOUR(first) SUM(first) SUM(first + 1) SUM(first + 2) SUM(first + 3)
  switch (terms) {
    SUM_OF_FOUR(4)
    SUM_OF_FOUR(8)
    SUM_OF_FOUR(12)
    SUM(16)
  }
#undef SUM_OF_FOUR
#undef SUM
}

void gx_force_series_at(const struct gx_force_series *series, double angle, double *force)
{
  const struct piece piece = piece_of(angle);
  sum_series(series->terms, series->pitch, piece.x, series->table + piece.n * series->terms * series->pitch, force);
}
