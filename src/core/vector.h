/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementwise updates and sums of component arrays. */
#ifndef GRIDCROSS_CORE_VECTOR_H
#define GRIDCROSS_CORE_VECTOR_H

#include <stddef.h>

/* value += scale * rate; the arrays do not overlap. */
void gx_vector_add(size_t n, double scale, const double *rate, double *value);
/* sum(value); by partial sums, the same for every instruction set. */
double gx_vector_sum(size_t n, const double *value);
/* sum(a * b), likewise; a and b may be the same. */
double gx_vector_dot(size_t n, const double *a, const double *b);
/* sum(weight * value^2), likewise. */
double gx_vector_square(size_t n, const double *weight, const double *value);
/* max(value, 0); what is not a number is passed over. */
double gx_vector_max(size_t n, const double *value);

#endif
