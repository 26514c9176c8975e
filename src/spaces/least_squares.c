/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles are sorted by cells; the three cells of a row around one are then a run, but for the ends of the row. */
#include "least_squares.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../bases/locate.h"
#include "../core/aligned.h"
#include "../core/kernel.h"

enum { MOST_TERMS = 56, NEIGHBOURS = 27, MOST_FIELDS = GX_MAX_TENSOR }; /* terms of degree 5 in 3-D */

struct least_squares {
  struct gx_fit fit;
  const struct gx_grid *grid;        /* borrowed */
  const struct gx_particles *points; /* borrowed */
  size_t n, cells;
  int degree, per_cell, terms, in_cell;     /* points in a cell */
  int exponent[GX_MAX_DIM][MOST_TERMS];     /* of the monomials, by rising degree */
  int through[GX_LEAST_SQUARES_DEGREE + 1]; /* how many are of this degree or a lower one */
  double *at_point;                         /* [in_cell][terms] monomials at the points of a cell */
  double *factor;                           /* [cells][terms (terms + 1) / 2] rows of Cholesky factors; diagonals inverted */
  double *inside[GX_MAX_DIM];               /* [n] place of the particles, sorted, in their cell, from its middle, in cells */
  double *value[MOST_FIELDS];               /* [n] fields, sorted */
  size_t *order, *start;                    /* [n] particles by cell; [cells + 1] */
  size_t *cell;                             /* [n] of the particles */
  int *kept;                                /* [cells] terms that the particles determine: the leading ones, of whole degrees */
  bool *poor;                               /* [cells] left to the particles */
  bool *left;                               /* [n] particles in those */
  void *block;
};

static void release(struct gx_fit *fit)
{
  struct least_squares *s = (struct least_squares *)fit;
  if (!s) return;
  free(s->block);
  free(s->order);
  free(s->kept);
  free(s->poor);
  free(s);
}

/* Monomials of total degree up to `degree` at x. */
GX_CORE void monomials(const int dim, const struct least_squares *s, const double *x, double *term)
{
  double power[GX_MAX_DIM][GX_LEAST_SQUARES_DEGREE + 1];
  for (int d = 0; d < dim; d++) {
    power[d][0] = 1;
    for (int k = 1; k <= s->degree; k++) power[d][k] = power[d][k - 1] * x[d];
  }
  for (int j = 0; j < s->terms; j++) {
    double product = power[0][s->exponent[0][j]];
    for (int d = 1; d < dim; d++) product *= power[d][s->exponent[d][j]];
    term[j] = product;
  }
}

/* Quadratic B-spline of support [-1.5, 1.5]. */
static double bell(double x)
{
  const double r = fabs(x);
  return r < 0.5 ? 0.75 - r * r : 0.5 * (1.5 - r) * (1.5 - r);
}

/* One of the cells around a cell, where it lies within the domain. */
struct neighbour {
  size_t cell;
  double offset[GX_MAX_DIM]; /* of its middle, in cells */
};

static int neighbours_of(const struct least_squares *s, size_t cell, struct neighbour *list)
{
  const struct gx_grid *grid = s->grid;
  int count = 0, around = grid->dim == 1 ? 3 : grid->dim == 2 ? 9 : 27;
  for (int k = 0; k < around; k++) {
    struct neighbour *one = &list[count];
    size_t rest = cell, stride = 1;
    bool within = true;
    one->cell = 0;
    for (int d = 0, step = k; d < grid->dim; d++, step /= 3) {
      const long cells = grid->axis[d].cells;
      long at = (long)(rest % (size_t)cells) + step % 3 - 1;
      rest /= (size_t)cells;
      if (grid->axis[d].periodic) at = (at + cells) % cells;
      within = within && at >= 0 && at < cells;
      one->cell += (size_t)at * stride;
      one->offset[d] = step % 3 - 1;
      stride *= (size_t)cells;
    }
    count += within;
  }
  return count;
}

/* Monomials and weight of particle q of a neighbour. */
GX_CORE double sample(const int dim, const struct least_squares *s, const struct neighbour *one, size_t q, double *term)
{
  double x[GX_MAX_DIM], weight = 1;
  for (int d = 0; d < dim; d++) {
    x[d] = one->offset[d] + s->inside[d][q];
    weight *= bell(x[d]);
  }
  monomials(dim, s, x, term);
  return weight;
}

/* In place, rows of the lower triangle. Returns how many leading ones are positive definite beyond round-off. */
static int cholesky(int n, double *row)
{
  double *at[MOST_TERMS];
  for (int i = 0; i < n; i++) {
    at[i] = i ? at[i - 1] + i : row;
    double diagonal = at[i][i];
    for (int j = 0; j <= i; j++) {
      double sum = at[i][j];
      for (int k = 0; k < j; k++) sum -= at[i][k] * at[j][k];
      if (j < i) {
        at[i][j] = sum * at[j][j];
      } else {
        if (!(sum > GX_LEAST_SQUARES_PIVOT * diagonal)) return i;
        at[i][i] = 1 / sqrt(sum);
      }
    }
  }
  return n;
}

/* Terms of the highest whole degree among the first `terms`; 0 where there is not even a linear one. */
static int whole_degree(const struct least_squares *s, int terms)
{
  int degree = s->degree;
  while (degree > 0 && s->through[degree] > terms) degree--;
  return degree > 0 ? s->through[degree] : 0;
}

/* Returns how many terms the particles determine. */
GX_CORE int factor_cell(const int dim, struct least_squares *s, size_t cell)
{
  const int terms = s->terms;
  double normal[MOST_TERMS][MOST_TERMS] = {{0}}, term[MOST_TERMS];
  struct neighbour around[NEIGHBOURS];
  const int count = neighbours_of(s, cell, around);
  for (int k = 0; k < count; k++) {
    const size_t from = s->start[around[k].cell], to = s->start[around[k].cell + 1];
    if (from == to) return 0; /* the edge of a body */
    for (size_t q = from; q < to; q++) {
      const double weight = sample(dim, s, &around[k], q, term);
      for (int i = 0; i < terms; i++) {
        const double scaled = weight * term[i];
        for (int j = 0; j < terms; j++) normal[i][j] += scaled * term[j];
      }
    }
  }
  double *row = s->factor + cell * (size_t)(terms * (terms + 1) / 2);
  for (int i = 0, at = 0; i < terms; at += ++i) memcpy(row + at, normal[i], (size_t)(i + 1) * sizeof *row);
  return whole_degree(s, cholesky(terms, row));
}

GX_CLONES static void factor_cells(struct least_squares *s)
{
  for (size_t cell = 0; cell < s->cells; cell++) GX_FOR_DIM(s->grid->dim, s->kept[cell] = factor_cell(dim, s, cell))
  for (size_t cell = 0; cell < s->cells; cell++) s->poor[cell] = s->kept[cell] == 0;
}

/* Cells of the particles, and their order by cells. */
static void sort(struct least_squares *s, const double *const *x)
{
  const struct gx_grid *grid = s->grid;
  memset(s->start, 0, (s->cells + 1) * sizeof *s->start);
  for (size_t p = 0; p < s->n; p++) {
    size_t stride = 1;
    s->cell[p] = 0;
    for (int d = 0; d < grid->dim; d++) {
      const int cells = grid->axis[d].cells;
      s->cell[p] += stride * (size_t)gx_locate_cell(cells, gx_locate(grid->axis[d].periodic, cells, x[d][p]));
      stride *= (size_t)cells;
    }
    s->start[s->cell[p] + 1]++;
  }
  for (size_t c = 0; c < s->cells; c++) s->start[c + 1] += s->start[c];
  for (size_t p = s->n; p-- > 0;) { /* start becomes its own shift; restored below */
    s->order[--s->start[s->cell[p] + 1]] = p;
  }
  for (size_t c = 0; c < s->cells; c++) s->start[c] = s->start[c + 1];
  s->start[s->cells] = s->n;
  for (size_t q = 0; q < s->n; q++)
    for (int d = 0; d < grid->dim; d++) {
      const int cells = grid->axis[d].cells;
      const double at = gx_locate(grid->axis[d].periodic, cells, x[d][s->order[q]]);
      s->inside[d][q] = at - gx_locate_cell(cells, at) - 0.5;
    }
}

static enum gx_status place(struct gx_fit *fit, const double *const *x)
{
  struct least_squares *s = (struct least_squares *)fit;
  size_t poor = 0;
  sort(s, x);
  factor_cells(s);
  for (size_t c = 0; c < s->cells; c++) poor += s->poor[c];
  for (size_t p = 0; p < s->n; p++) s->left[p] = s->poor[s->cell[p]];
  fit->left = poor ? s->left : NULL;
  for (size_t c = 0; c < s->cells; c++) poor -= s->poor[c] && s->start[c] == s->start[c + 1]; /* nothing to sum over either */
  fit->left_cells = poor;
  return GX_OK;
}

/* Coefficients of one field from its moments. */
static void solve(const struct least_squares *s, size_t cell, double *x)
{
  const int n = s->kept[cell];
  const double *row = s->factor + cell * (size_t)(s->terms * (s->terms + 1) / 2), *at[MOST_TERMS];
  for (int i = 0; i < n; i++) {
    at[i] = i ? at[i - 1] + i : row;
    for (int k = 0; k < i; k++) x[i] -= at[i][k] * x[k];
    x[i] *= at[i][i];
  }
  for (int i = n; i-- > 0;) {
    for (int k = i + 1; k < n; k++) x[i] -= at[k][i] * x[k];
    x[i] *= at[i][i];
  }
}

/* Number of point `inside` of a cell in their lattice. */
static size_t point_of(const struct least_squares *s, size_t cell, size_t inside)
{
  size_t number = 0, stride = 1;
  const size_t per_cell = (size_t)s->per_cell;
  for (int d = 0; d < s->grid->dim; d++) {
    const size_t cells = (size_t)s->grid->axis[d].cells;
    number += (cell % cells * per_cell + inside % per_cell) * stride;
    stride *= cells * per_cell;
    cell /= cells;
    inside /= per_cell;
  }
  return number;
}

GX_CORE void take_cell(const int dim, const struct least_squares *s, size_t cell, int count, double *const *out)
{
  const int terms = s->terms;
  double moment[MOST_FIELDS][MOST_TERMS] = {{0}}, term[MOST_TERMS];
  struct neighbour around[NEIGHBOURS];
  const int neighbours = s->poor[cell] ? 0 : neighbours_of(s, cell, around);
  for (int k = 0; k < neighbours; k++)
    for (size_t q = s->start[around[k].cell]; q < s->start[around[k].cell + 1]; q++) {
      const double weight = sample(dim, s, &around[k], q, term);
      for (int i = 0; i < count; i++) {
        const double scaled = weight * s->value[i][q];
        for (int j = 0; j < terms; j++) moment[i][j] += scaled * term[j];
      }
    }
  for (int i = 0; i < count && neighbours; i++) solve(s, cell, moment[i]);
  for (int g = 0; g < s->in_cell; g++) {
    const size_t point = point_of(s, cell, (size_t)g);
    for (int i = 0; i < count; i++) {
      double sum = 0;
      for (int j = 0; j < s->kept[cell]; j++) sum += s->at_point[g * terms + j] * moment[i][j];
      out[i][point] = sum;
    }
  }
}

GX_CLONES static void take(struct gx_fit *fit, int count, bool odd, double *const *value, double *const *out)
{
  struct least_squares *s = (struct least_squares *)fit;
  (void)odd; /* polynomials go on to the end that they see from within */
  for (int i = 0; i < count; i++)
    for (size_t q = 0; q < s->n; q++) s->value[i][q] = value[i][s->order[q]];
  for (size_t cell = 0; cell < s->cells; cell++) GX_FOR_DIM(s->grid->dim, take_cell(dim, s, cell, count, out))
}

static const struct gx_fit_kind kind = {.scales = true, .free = release, .place = place, .take = take};

/* Exponents, and the monomials at the points of the first cell. */
static void tabulate(struct least_squares *s)
{
  const int dim = s->grid->dim, side = s->degree + 1;
  const int all = dim == 1 ? side : dim == 2 ? side * side : side * side * side;
  for (int degree = 0; degree <= s->degree; degree++) {
    for (int k = 0; k < all; k++) {
      const int exponent[GX_MAX_DIM] = {k % side, k / side % side, k / side / side};
      if (exponent[0] + exponent[1] + exponent[2] != degree) continue;
      for (int d = 0; d < dim; d++) s->exponent[d][s->terms] = exponent[d];
      s->terms++;
    }
    s->through[degree] = s->terms;
  }
}

static bool allocate(struct least_squares *s)
{
  const size_t dim = (size_t)s->grid->dim, terms = (size_t)s->terms, stride = (s->n + 7) / 8 * 8 + 8;
  const size_t fields = dim * dim;
  double *at = gx_aligned_zeros(
      sizeof(double) * ((dim + fields) * stride + (size_t)s->in_cell * terms + s->cells * terms * (terms + 1) / 2), &s->block);
  s->order = malloc((2 * s->n + s->cells + 1) * sizeof *s->order);
  s->kept = calloc(s->cells, sizeof *s->kept);
  s->poor = calloc(s->cells + s->n, sizeof *s->poor);
  if (!at || !s->order || !s->kept || !s->poor) return false;
  s->cell = s->order + s->n;
  s->start = s->cell + s->n;
  s->left = s->poor + s->cells;
  for (size_t d = 0; d < dim; d++, at += stride) s->inside[d] = at;
  for (size_t k = 0; k < fields; k++, at += stride) s->value[k] = at;
  s->at_point = at;
  s->factor = at + (size_t)s->in_cell * terms;
  return true;
}

enum gx_status gx_least_squares_create(struct gx_fit **fit, const struct gx_grid *grid, int degree, int per_cell,
                                       const struct gx_particles *points, size_t n, struct gx_outcome *outcome)
{
  if (degree > GX_LEAST_SQUARES_DEGREE)
    return gx_status_set(
        outcome, GX_REFUSED, -1,
        "quadrature reconstructed in 2-D and 3-D takes polynomials of degree %d at most, and this degree takes %d: "
        "use a lower degree",
        GX_LEAST_SQUARES_DEGREE, degree);
  struct least_squares *s = calloc(1, sizeof *s);
  if (!s) return gx_status_set(outcome, GX_FAILED, -1, "out of memory");
  *s = (struct least_squares){
      .fit = {.kind = &kind}, .grid = grid, .points = points, .n = n, .cells = 1, .degree = degree, .per_cell = per_cell};
  s->in_cell = 1;
  for (int d = 0; d < grid->dim; d++) {
    s->cells *= (size_t)grid->axis[d].cells;
    s->in_cell *= per_cell;
  }
  tabulate(s);
  if (!allocate(s)) {
    release(&s->fit);
    return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the polynomials of the cells");
  }
  for (int g = 0; g < s->in_cell; g++) {
    double x[GX_MAX_DIM];
    for (int d = 0; d < grid->dim; d++) x[d] = points->X[d][point_of(s, 0, (size_t)g)] * grid->axis[d].cells - 0.5;
    GX_FOR_DIM(grid->dim, monomials(dim, s, x, s->at_point + g * s->terms))
  }
  *fit = &s->fit;
  return GX_OK;
}
