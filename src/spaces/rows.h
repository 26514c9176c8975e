/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weighted sums of contiguous rows: what operators factored by direction are made of. Up to GX_MAX_SUPPORT rows. No output may
 * overlap an input. */
#ifndef GRIDCROSS_SPACES_ROWS_H
#define GRIDCROSS_SPACES_ROWS_H

#include <stddef.h>

/* out[i] = sum_j w[j] in[j][i] */
void gx_rows_combine(int rows, const double *w, double *const *in, size_t n, double *out);
/* out[j][i] += w[j] in[i]; with more: + w_more[j] more[i] */
void gx_rows_spread(int rows, const double *w, const double *in, const double *w_more, const double *more, size_t n,
                    double *const *out);
/* Along a row, where neighbours `apart` entries from each other are combined. w: [rows][n]; nodes: [n + (rows - 1) apart].
 * out[i] = sum_j w[j][i] nodes[i + j apart] */
void gx_rows_gather(int rows, size_t apart, const double *w, const double *nodes, size_t n, double *out);
/* nodes[k] = sum over i + j apart = k of w[j][i] in[i]; with more: + w_more[j][i] more[i] */
void gx_rows_scatter(int rows, size_t apart, const double *w, const double *in, const double *w_more, const double *more,
                     size_t n, double *nodes);
/* Such rows of nodes from those of a field, in which points r, r + period, ... meet entries first[r], first[r] + 1, ...; count of each:
 * nodes[c period + r] = row[first[r] + c] */
void gx_rows_expand(int period, int count, const int *first, const double *row, double *nodes);
/* row[first[r] + c] += nodes[c period + r] */
void gx_rows_fold(int period, int count, const int *first, const double *nodes, double *row);

#endif
