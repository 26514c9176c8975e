/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nodes' share of a body force as series in time, where it is a function of the cosine of one angle and weights never change. It then
 * is f_i = sum_k c_ik cos(k angle), the Chebyshev series in that cosine (Trefethen, Approximation Theory and Approximation Practice, SIAM
 * 2013, chapters 3, 4 and 8), whose terms fall off like rho^-k where it is analytic. For 1/F^2 with F = 1 + s cos(2 pi X) cos(angle),
 * |s| < 1, of the standing waves, rho = (1 + sqrt(1 - s^2)) / |s|: 21 terms for s = 0.31. The power series of the same about the nearest of
 * equidistant angles takes 11 and no cosine. */
#ifndef GRIDCROSS_SPACES_FORCE_SERIES_H
#define GRIDCROSS_SPACES_FORCE_SERIES_H

#include <stddef.h>

struct gx_force_series;

/* Entries behind the nodes that a force has room for; they are set to 0. */
enum { GX_FORCE_SERIES_ROOM = 7 };

/* force: [nodes] at an angle in [0, pi], rad; zeros before. */
typedef void gx_force_sample(void *context, double angle, double *force);

/* Fits series to samples. What is cut, c_k behind the last that is above 4 epsilon of the largest, epsilon = 2^-52, and powers that are
 * together below epsilon of it, changes the force by at most (4 / (rho - 1) + 1) epsilon of that term: round-off. NULL: a power series
 * takes more terms than most_terms or 16, c_k do not fall off within 48, or memory runs out. */
struct gx_force_series *gx_force_series_create(size_t nodes, size_t most_terms, gx_force_sample *sample, void *context);
void gx_force_series_free(struct gx_force_series *series);
/* Of a power series. */
size_t gx_force_series_terms(const struct gx_force_series *series);
/* force: [nodes] */
void gx_force_series_at(const struct gx_force_series *series, double angle, double *force);

#endif
