/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The affine part of APIC transfers (Jiang, Schroeder, Selle, Teran & Stomakhin 2015; Jiang, Schroeder & Teran 2017): about a
 * particle the velocity is v_p + C_p (g - x_p) at the points g that reproduce linear functions (gx_basis.site),
 *   B_p = sum_i w_ip v_i (g_i - x_p)^T,  D_p = sum_i w_ip (g_i - x_p)(g_i - x_p)^T,  C_p = B_p D_p^-1.
 * B is what a particle keeps, since its antisymmetric part is angular momentum; D is that of where the particle has moved to. With
 * hats D vanishes on a node: sum_i w_ip (g_i - x_p)_e f_i = D_ee sum_i (dw_ip/dx_e) f_i at every other point, so that C is the
 * gradient of velocity there, and B with an older D could be divided by next to nothing. Particles that pass nodes keep C then.
 * On a moving mesh g_i are the nodes where they are now, X_i + u_i, so that angular momentum about current positions is kept. D is
 * then a full tensor, and a particle stays where it is between the nodes.
 * All this belongs to lumped mass: the affine part is what row sums smooth away. */
#ifndef GRIDCROSS_SPACES_AFFINE_H
#define GRIDCROSS_SPACES_AFFINE_H

#include <gridcross/space.h>

struct gx_affine;
struct gx_mesh;

/* For a mesh whose grid and weights have their shapes. NULL when memory runs out. */
struct gx_affine *gx_affine_create(const struct gx_mesh *mesh);
void gx_affine_free(struct gx_affine *affine);
/* After the mesh has taken weights at x. x: [dim][n], m */
void gx_affine_weigh(struct gx_mesh *mesh, const double *const *x);
/* momentum_i += sum_p w_ip m_p C_p (g_i - x_p). momentum: [dim][stored] */
void gx_affine_scatter(struct gx_mesh *mesh, double *const *momentum);
/* What the particles keep, from the nodal velocity. */
void gx_affine_gather(struct gx_mesh *mesh);
/* Of what the particles keep. */
void gx_affine_image(struct gx_mesh *mesh, struct gx_image *image);
/* gx_space_kind.spin */
void gx_affine_spin(struct gx_space *space, double ahead, double *spin);

#endif
