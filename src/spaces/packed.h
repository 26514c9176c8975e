/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transfers between particles and nodes in 2-D and 3-D, as in transfer.h, on nodal fields whose components lie together: four
 * doubles a node, so that one vector operation serves all of a node. Zeros fill up. Nodes: [grid.stored][4], 32-byte aligned. */
#ifndef GRIDCROSS_SPACES_PACKED_H
#define GRIDCROSS_SPACES_PACKED_H

#include "transfer.h"

enum { GX_PACKED = 4 };

/* momentum[i] += sum_p m_p S_ip (1, v_p), force[i] += sum_p (T_p D_ip + body_p S_ip). momentum, or force with T and body, may be
 * NULL, and so may v (mass alone) and body. */
void gx_packed_scatter(const struct gx_weights *weights, const double *m, double *const *v, double *momentum, double *const *T,
                       double *const *body, double *force);
/* value[d][p] = sum_i nodes[i][d] S_ip */
void gx_packed_gather(const struct gx_weights *weights, const double *nodes, double *const *value);
/* gradient[d*dim+e][p] = sum_i nodes[i][d] D_ip,e */
void gx_packed_gather_gradient(const struct gx_weights *weights, const double *nodes, double *const *gradient);
/* Both of v, and the first of a. */
void gx_packed_gather_all(const struct gx_weights *weights, const double *a, const double *v, double *const *acceleration,
                          double *const *velocity, double *const *gradient);

/* Between `count` component arrays and packed nodes. Packing fills up with zeros; a field that is NULL is not unpacked. */
void gx_packed_pack(int count, size_t nodes, const double *const *field, double *packed);
void gx_packed_unpack(int count, size_t nodes, const double *packed, double *const *field);

#endif
