/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementwise updates of component arrays. */
#ifndef GRIDCROSS_CORE_VECTOR_H
#define GRIDCROSS_CORE_VECTOR_H

#include <stddef.h>

/* value += scale * rate; the arrays do not overlap. */
void gx_vector_add(size_t n, double scale, const double *rate, double *value);

#endif
