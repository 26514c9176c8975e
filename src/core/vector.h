/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementwise updates and sums of component arrays. */
#ifndef GRIDCROSS_CORE_VECTOR_H
#define GRIDCROSS_CORE_VECTOR_H

#include <stddef.h>

/* value += scale * rate; the arrays do not overlap. */
void gx_vector_add(size_t n, double scale, const double *rate, double *value);

/* value = start + slope * x, likewise. */
void gx_vector_line(size_t n, double start, double slope, const double *x, double *value);

/* Sums are made of partial results side by side, of every eighth entry: one addition need not wait for the one before, and the bits
 * are the same for every instruction set. They are the same too when an array is summed piece by piece, each piece but the last a
 * multiple of LANES long. PIECE: what is made of that many entries stays in cache. */
enum { GX_VECTOR_LANES = 8, GX_VECTOR_PIECE = 256 };
/* parts += those of sum(value). parts: [LANES], 0 before the first piece */
void gx_vector_sum_piece(size_t n, const double *value, double *parts);
/* parts += those of sum(a * b); a and b may be the same. */
void gx_vector_dot_piece(size_t n, const double *a, const double *b, double *parts);
/* The sum of all pieces. */
double gx_vector_total(const double *parts);
/* Length of the piece of n entries that starts at `from`. */
static inline size_t gx_vector_piece(size_t n, size_t from)
{
  return n - from < GX_VECTOR_PIECE ? n - from : GX_VECTOR_PIECE;
}

/* sum(value) */
double gx_vector_sum(size_t n, const double *value);
/* sum(a * b); a and b may be the same. */
double gx_vector_dot(size_t n, const double *a, const double *b);
/* sum(weight * a * b); a and b may be the same. */
double gx_vector_weighted(size_t n, const double *weight, const double *a, const double *b);
/* max(value, 0); what is not a number is passed over. */
double gx_vector_max(size_t n, const double *value);

#endif
