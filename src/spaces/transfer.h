/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transfers between particles and nodes: every sum over the weights of a position. One source for 1-D, 2-D and 3-D. */
#ifndef GRIDCROSS_SPACES_TRANSFER_H
#define GRIDCROSS_SPACES_TRANSFER_H

#include <gridcross/grid.h>
#include <gridcross/particles.h>

/* Weights of n particles per direction; S and D are [support][n], D in 1/m. Products over directions give S_ip and D_ip. */
struct gx_weights {
  int dim, support;
  size_t n;
  size_t stride[GX_MAX_DIM]; /* of nodal fields */
  int *first[GX_MAX_DIM];
  double *S[GX_MAX_DIM], *D[GX_MAX_DIM];
};

/* total[i] += sum_p m_p S_ip, moment[d][i] += sum_p m_p value[d][p] S_ip; total, or value and moment, may be NULL. */
void gx_transfer_scatter(const struct gx_weights *weights, const double *m, double *const *value, double *total,
                         double *const *moment);
/* force[d][i] += sum_p (sum_e T[d*dim+e][p] D_ip,e + body[d][p] S_ip); body may be NULL. */
void gx_transfer_scatter_force(const struct gx_weights *weights, double *const *T, double *const *body, double *const *force);
/* value[d][p] = sum_i field[d][i] S_ip */
void gx_transfer_gather(const struct gx_weights *weights, double *const *field, double *const *value);
/* gradient[d*dim+e][p] = sum_i field[d][i] D_ip,e */
void gx_transfer_gather_gradient(const struct gx_weights *weights, double *const *field, double *const *gradient);
/* All that a step takes from the nodes in one pass. acceleration[d][p] and velocity[d][p] as gather, gradient as above. */
void gx_transfer_gather_all(const struct gx_weights *weights, double *const *a, double *const *v, double *const *acceleration,
                            double *const *velocity, double *const *gradient);

#endif
