/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums of the moving mesh in 1-D over the nodes i that a particle p meets, and the other way round,
 *   value_p = sum_i field_i S_ip,  F_p = 1 + sum_i u_i D_ip,  force_i = sum_p (-V0 P_p D_ip + m_p b_p S_ip),
 * where particles sit alike in every cell. They are taken slot by slot, a slot being those of one place in a cell: neighbours in a slot
 * meet neighbouring nodes, so that both kinds are sums of shifted rows, with nothing to look up, and away from fixed ends a
 * weight is one number for all cells. The same sums as gx_lattice_*, up to round-off. */
#ifndef GRIDCROSS_SPACES_SLOTS_H
#define GRIDCROSS_SPACES_SLOTS_H

#include <gridcross/space.h>

#include "lattice.h"

struct gx_slots;

/* line: of a lattice in 1-D, copied. posed: borrowed. NULL when memory runs out, or a cell meets more than GX_MAX_SUPPORT
 * functions. */
struct gx_slots *gx_slots_create(const struct gx_lattice_line *line, const struct gx_particles *particles,
                                 const struct gx_posed *posed);
void gx_slots_free(struct gx_slots *slots);
/* Nodal fields, [nodes], have room for so many entries behind them that do not count and may be read, and behind a force set to 0. */
enum { GX_SLOTS_ROOM = 8 };

/* force at time t with P of F. Returns whether every F is that of a body that is not tangled. */
bool gx_slots_force(struct gx_slots *slots, const double *u, double t, double *force);
/* The body force's share of the last one, at that time. */
void gx_slots_force_body(struct gx_slots *slots, double t, double *force);
/* value and F of the particles in their own order; either may be NULL. */
void gx_slots_gather(const struct gx_slots *slots, const double *field, double *value, double *F);
/* Row sums of mass, and the state. */
struct gx_slots_nodes {
  const double *mass, *u, *v, *a;
};
/* Right after a force of the same u. survey->kept: as many numbers as this keeps. */
size_t gx_slots_survey_keeps(const struct gx_slots *slots);
void gx_slots_survey(struct gx_slots *slots, const struct gx_slots_nodes *nodes, struct gx_survey *survey);

#endif
