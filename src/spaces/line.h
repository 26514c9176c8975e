/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard MPM in 1-D with lumped mass and sums over particles: the transfers of a step, between particles p and nodes i,
 *   weigh    S_ip, D_ip at x_p = X_p + u_p
 *   scatter  m_i = sum_p m_p S_ip,  v_i = sum_p m_p v_p S_ip / m_i,  a_i = sum_p (-V0 P_p F_p D_ip + m_p b_p S_ip) / m_i
 *   advance  v_p += kick sum_i a_i S_ip,  F_p += strain (sum_i v_i D_ip) F_p,  u_p += drift sum_i v_i S_ip
 * Particles are taken eight at a time from eight distant parts of the bar in turn, so that adding to a node does not wait for the
 * particle before to have done so; what they add lies together in a record of each node. What is gathered is looked up in a
 * window of nodes that is held in registers. line_core.h has the passes, line_narrow.c and line_wide.c make them for vectors of four and
 * of eight doubles, to the same bits. */
#ifndef GRIDCROSS_SPACES_LINE_H
#define GRIDCROSS_SPACES_LINE_H

#include <gridcross/space.h>

#include "line_pass.h"

struct gx_mesh;

struct gx_line {
  struct gx_line_fields fields;
  const struct gx_line_passes *passes;
  void *block;
};

/* NULL: not a line, options that it lacks, or out of memory; the general transfers do all of that. */
struct gx_line *gx_line_create(struct gx_mesh *mesh);
void gx_line_free(struct gx_line *line);

/* Weights at X + u, which must lie in [low, high]. Returns false, with weights that mean nothing, where something is wrong. */
bool gx_line_weigh(struct gx_line *line, double low, double high);
/* Nodal mass and velocity from the particles at the current weights. */
void gx_line_project(struct gx_mesh *mesh);
/* Nodal acceleration from P and the body force that the particles have; project: mass and velocity as well. */
void gx_line_accelerate(struct gx_mesh *mesh, bool project);
/* Velocity, F and position of the particles by nodal v and a. Returns false where nothing was done: a combination that it lacks. */
bool gx_line_advance(struct gx_mesh *mesh, double kick, double strain, double drift);
/* Nodal acceleration at the particles. a: [n] */
void gx_line_acceleration(const struct gx_mesh *mesh, double *a);

#endif
