/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces of the moving mesh in 1-D where particles sit alike in every cell. Particles are taken slot by slot, a slot being those of
 * one place in a cell: neighbours in a slot meet neighbouring nodes, so that a sum over the nodes of a particle and its adjoint are
 * sums of shifted rows, with nothing to gather or to scatter, and away from fixed ends a weight is one number for all cells. The same
 * sums as gx_lattice_*, up to round-off. */
#ifndef GRIDCROSS_SPACES_SLOTS_H
#define GRIDCROSS_SPACES_SLOTS_H

#include <gridcross/problem.h>

#include "lattice.h"

struct gx_slots;

/* line: of a lattice in 1-D, copied. posed: borrowed. NULL when memory runs out, or a cell meets more than GX_MAX_SUPPORT
 * functions. */
struct gx_slots *gx_slots_create(const struct gx_lattice_line *line, const struct gx_particles *particles,
                                 const struct gx_posed *posed);
void gx_slots_free(struct gx_slots *slots);
/* force[i] = sum_p (-V0 P_p D_ip + m_p b_p S_ip) at time t, with P of F_p = 1 + sum_i u_i D_ip. u, force: [nodes], with room for eight
 * entries that may be read, and do not count, behind u. Returns whether every F is that of a body that is not tangled. */
bool gx_slots_force(struct gx_slots *slots, const double *u, double t, double *force);

#endif
