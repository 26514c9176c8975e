/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splines of degree 1 to 9 through given values at given sites, open, periodic or mirrored, and their derivatives.
 *
 *   interpolant  sites -> knots, collocation matrix, its factors; values -> coefficients, as often as wanted
 *   points       fixed points -> weights; coefficients -> values or derivatives there, as banded products
 *   circulant    the same for uniform periodic sites by FFT
 *   lines        interpolant, then points, along every line of one direction of a product grid
 *   tensor       lines of every direction of a product grid
 *
 * Nothing is allocated after create. Sites, points and values have the caller's units; a derivative of order d is per unit of
 * the sites to the power d. Objects are changed by the functions that take them without const alone: several threads may share
 * one that is only read. Sources: C. de Boor, A Practical Guide to Splines (2001), ch. IX-XIII; C. de Boor and A. Pinkus, Backward
 * error analysis for totally positive linear systems, Numer. Math. 27 (1977): elimination without pivoting is stable here. */
#ifndef GRIDCROSS_SPLINES_H
#define GRIDCROSS_SPLINES_H

#include <stdbool.h>
#include <stddef.h>

enum { GX_SPLINE_MAX_DEGREE = 9, GX_SPLINE_MESSAGE_LENGTH = 192 };

/* Errors */

enum gx_spline_status {
  GX_SPLINE_OK,
  GX_SPLINE_DEGREE,             /* degree or derivative order out of range */
  GX_SPLINE_TOO_FEW,            /* fewer than degree + 1 sites */
  GX_SPLINE_NOT_INCREASING,     /* a site or knot not above the one before it, or not finite */
  GX_SPLINE_OUTSIDE,            /* a site beyond the ends, or sites longer than the period */
  GX_SPLINE_SCHOENBERG_WHITNEY, /* function i vanishes at site i: no unique interpolant on these knots */
  GX_SPLINE_SINGULAR,           /* collocation matrix singular to rounding */
  GX_SPLINE_MEMORY,
  GX_SPLINE_STATUSES
};

struct gx_spline_error {
  enum gx_spline_status status;
  long site; /* the site at fault, -1: none */
  char message[GX_SPLINE_MESSAGE_LENGTH];
};

/* "ok", "not-increasing", ... */
const char *gx_spline_error_name(enum gx_spline_status status);

/* Fills error unless it is NULL, and returns status. */
enum gx_spline_status gx_spline_error_set(struct gx_spline_error *error, enum gx_spline_status status, long site,
                                          const char *format, ...) __attribute__((format(printf, 4, 5)));

/* Knots */

enum gx_spline_ends {
  GX_SPLINE_OPEN,     /* between the first and the last site, end knots degree + 1 times; beyond them the end pieces go on */
  GX_SPLINE_PERIODIC, /* period high - low */
  GX_SPLINE_EVEN,     /* mirrored at low and high: s(low - x) = s(low + x) */
  GX_SPLINE_ODD       /* mirrored with a change of sign */
};

/* n sites carry n coefficients. Unless open, `ghosts` more on either side repeat or mirror them, so that every sum is the same
 * plain product: coefficient i of the n is number i + ghosts of the `functions` stored. */
struct gx_spline_knots {
  enum gx_spline_ends ends;
  int degree;
  size_t sites, ghosts, functions;
  double low, high; /* the domain; periodic: one period, from the first site */
  bool at_end[2];   /* mirrored: a site lies on low, on high */
  double *knot;     /* [functions + degree + 1], owned; function i lives on knot[i] ... knot[i + degree + 1] */
  double *inverse;  /* [degree][functions + degree + 1], owned; row q - 1: 1 / (knot[i + q] - knot[i]), 0 for a width of 0 */
  double *extended; /* scratch: sites continued beyond the ends */
  size_t beyond;    /* sites added on either side of them */
};

enum gx_spline_status gx_spline_knots_create(struct gx_spline_knots **knots, enum gx_spline_ends ends, int degree, size_t sites,
                                             struct gx_spline_error *error);
void gx_spline_knots_free(struct gx_spline_knots *knots);

/* Averages of sites, MATLAB's aptknt: open: degree + 1 times the first and the last site, interior knot j the mean of sites
 * j + 1 ... j + degree. Otherwise the same mean over the sites continued beyond the ends; for uniform sites the functions are
 * then centred on them, with knots at sites (odd degree) or half-way (even). site: [sites], strictly increasing; open: low and
 * high are not used; periodic: the last site lies within high - low of the first, anywhere on the axis; mirrored: low <= site[0],
 * site[sites - 1] <= high. Function i never vanishes at site i. */
enum gx_spline_status gx_spline_knots_average(struct gx_spline_knots *knots, const double *site, double low, double high,
                                              struct gx_spline_error *error);

/* Open only. Uniform: equal pieces between low and high. Given: [sites + degree + 1] not decreasing, copied; low and high are
 * knots degree and sites. */
enum gx_spline_status gx_spline_knots_uniform(struct gx_spline_knots *knots, double low, double high,
                                              struct gx_spline_error *error);
enum gx_spline_status gx_spline_knots_given(struct gx_spline_knots *knots, const double *knot, struct gx_spline_error *error);

/* Fills the ghosts of count splines at once from their coefficients. coefficient: [functions][count] */
void gx_spline_knots_close(const struct gx_spline_knots *knots, size_t count, double *coefficient);

/* Interpolation */

struct gx_spline_interpolant {
  struct gx_spline_knots *knots;   /* owned */
  int lower, upper;                /* bandwidths of the factors now held */
  double *band;                    /* [sites][2 degree + 1], owned: factors, see spline_band.h */
  struct gx_spline_border *border; /* periodic: rows and columns that close the ring; else NULL */
  double *scratch;                 /* [functions] */
};

enum gx_spline_status gx_spline_interpolant_create(struct gx_spline_interpolant **interpolant, enum gx_spline_ends ends,
                                                   int degree, size_t sites, struct gx_spline_error *error);
void gx_spline_interpolant_free(struct gx_spline_interpolant *interpolant);

/* Averaged knots (gx_spline_knots_average), then the collocation matrix and its factors. After a failure no solve until a
 * success. */
enum gx_spline_status gx_spline_interpolant_set_sites(struct gx_spline_interpolant *interpolant, const double *site, double low,
                                                      double high, struct gx_spline_error *error);

/* The matrix alone, on the knots that interpolant->knots now holds. */
enum gx_spline_status gx_spline_interpolant_collocate(struct gx_spline_interpolant *interpolant, const double *site,
                                                      struct gx_spline_error *error);

/* value: [sites]; coefficient: [knots->functions], ghosts included; they do not overlap. */
void gx_spline_interpolant_solve(const struct gx_spline_interpolant *interpolant, const double *value, double *coefficient);

/* count splines at once. value: [sites][count]; coefficient: [functions][count] */
void gx_spline_interpolant_solve_many(const struct gx_spline_interpolant *interpolant, size_t count, const double *value,
                                      double *coefficient);

/* Condition number of the collocation matrix in the maximum norm: exact to rounding, from one solve, because signs of the
 * inverse alternate; a lower bound for periodic splines of an odd number of sites. Uses the scratch. */
double gx_spline_interpolant_condition(struct gx_spline_interpolant *interpolant);

/* Evaluation */

struct gx_spline_points {
  int degree;
  unsigned orders; /* bit d: derivatives of order d are held */
  size_t count;
  size_t *first;                            /* [count], owned: first function, ghosts counted */
  double *weight[GX_SPLINE_MAX_DEGREE + 1]; /* per order [count][degree + 1], owned; NULL: not asked for */
};

/* orders: bit d asks for derivatives of order d <= degree: 1 values, 2 first derivatives, 3 both ... */
enum gx_spline_status gx_spline_points_create(struct gx_spline_points **points, int degree, unsigned orders, size_t count,
                                              struct gx_spline_error *error);
void gx_spline_points_free(struct gx_spline_points *points);

/* Weights of count points x on knots of the same degree. Any order of points; increasing ones are found fastest. Periodic: points
 * are taken into the period; else a point beyond the domain takes the polynomial of the end piece. At a knot the piece above. */
void gx_spline_points_set(struct gx_spline_points *points, const struct gx_spline_knots *knots, const double *x);

/* out: [count], derivative of an order asked for at creation. */
void gx_spline_points_evaluate(const struct gx_spline_points *points, int order, const double *coefficient, double *out);

/* coefficient: [functions][splines]; out: [count][splines] */
void gx_spline_points_evaluate_many(const struct gx_spline_points *points, int order, size_t splines, const double *coefficient,
                                    double *out);

/* Uniform periodic sites j period / sites by FFT. Creation and freeing may run in several threads; one object serves one. */

struct gx_spline_circulant;

enum gx_spline_status gx_spline_circulant_create(struct gx_spline_circulant **circulant, int degree, size_t sites, double period,
                                                 struct gx_spline_error *error);
void gx_spline_circulant_free(struct gx_spline_circulant *circulant);

/* The knots of its coefficients, for gx_spline_points_set. */
const struct gx_spline_knots *gx_spline_circulant_knots(const struct gx_spline_circulant *circulant);

/* As gx_spline_interpolant_solve. */
void gx_spline_circulant_solve(struct gx_spline_circulant *circulant, const double *value, double *coefficient);

/* Derivative of order < degree of the interpolant at the sites in one go. value, out: [sites], may be the same. */
void gx_spline_circulant_derivative(struct gx_spline_circulant *circulant, int order, const double *value, double *out);

/* Lines of one direction of a product grid: a row-major array [before][sites][after] has before * after of them. */

struct gx_spline_lines;

/* Borrows both: solved and evaluated as they are when applied. One object serves one thread. */
enum gx_spline_status gx_spline_lines_create(struct gx_spline_lines **lines, const struct gx_spline_interpolant *interpolant,
                                             const struct gx_spline_points *points, struct gx_spline_error *error);
void gx_spline_lines_free(struct gx_spline_lines *lines);

/* Every line's interpolant, its derivative of an order asked for at the points' creation. in: [before][sites][after]; out:
 * [before][points->count][after], added to when `add`; they do not overlap. Each line has the bits it would have alone. */
void gx_spline_lines_apply(const struct gx_spline_lines *lines, int order, size_t before, size_t after, const double *in,
                           bool add, double *out);

/* Product grids: arrays are row-major, the last direction runs fastest. The product of splines through values on a grid, and its
 * derivatives: one set of lines a direction, order[d] >= 0 that of the derivative along d at the points; -1: the values at the
 * sites as they are, which a spline through them takes there. At least one is not. */

/* Numbers that an array of `work` takes. */
size_t gx_spline_tensor_room(int dim, const struct gx_spline_lines *const *lines);

/* in: [sites 0][sites 1]...; out: [count 0][count 1]..., with sites in place of count where the order is -1; added to when `add`.
 * work: two arrays, used from two directions on; none of them overlap. */
void gx_spline_tensor_apply(int dim, const struct gx_spline_lines *const *lines, const int *order, const double *in, bool add,
                            double *out, double *const *work);

#endif
