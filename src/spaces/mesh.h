/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the two grid spaces share: grid, weights, nodal fields, mass, and per-particle scratch. All memory is taken at creation. */
#ifndef GRIDCROSS_SPACES_MESH_H
#define GRIDCROSS_SPACES_MESH_H

#include <gridcross/space.h>

#include "mass.h"
#include "transfer.h"

struct gx_mesh {
  struct gx_space space;
  struct gx_space_options options;
  struct gx_grid grid;
  struct gx_weights weights;
  struct gx_mass *consistent; /* NULL: lumped */
  /* nodal fields, [grid.stored]; mass is zero at periodic images, the others are copied there */
  double *mass;          /* row sums, kg */
  double *v[GX_MAX_DIM]; /* m/s */
  double *a[GX_MAX_DIM]; /* m/s^2 */
  double *u[GX_MAX_DIM]; /* m; moving mesh only */
  /* scratch, [n] */
  double *x[GX_MAX_DIM], *half[GX_MAX_DIM];
  double *T[GX_MAX_TENSOR];         /* what the force scatters by gradients */
  double *body[GX_MAX_DIM];         /* what it scatters by weights: body force on a particle, N */
  double *opened[GX_MAX_DIM];       /* y of GX_OPEN, at particles */
  double *opened_nodes[GX_MAX_DIM]; /* the same at nodes, [grid.stored] */
  double *gathered_a[GX_MAX_DIM], *gathered_v[GX_MAX_DIM];
  double *gradient[GX_MAX_TENSOR], *rate_P[GX_MAX_TENSOR]; /* of velocity; of P */
  void *block;
  int *first_block;
};

/* A zeroed mesh of `size` bytes (a struct that begins with gx_mesh). */
enum gx_status gx_mesh_create(struct gx_mesh **mesh, size_t size, const struct gx_space_kind *kind,
                              const struct gx_space_options *options, struct gx_particles *particles,
                              const struct gx_posed *posed, struct gx_outcome *outcome);
void gx_mesh_free(struct gx_space *space);

/* Weights at X + u (u NULL: at X), particle domains stretched by F when the basis follows it. */
enum gx_status gx_mesh_weigh(struct gx_mesh *mesh, double *const *u, double *const *F);
/* The same with particle domains as they were. */
enum gx_status gx_mesh_weigh_frozen(struct gx_mesh *mesh, double *const *u);
/* Nodal mass of the current weights and, when value is not NULL, in the same pass field = M^-1 sum_p m_p value_p S_ip. */
enum gx_status gx_mesh_assemble(struct gx_mesh *mesh, double *const *value, double *const *field);
/* field = M^-1 sum_p m_p value_p S_ip with the mass assembled last. */
void gx_mesh_project(struct gx_mesh *mesh, double *const *value, double *const *field);
/* P of the particles from their F, unless it is integrated by rate; GX_TANGLED where det F <= 0, either way. */
enum gx_status gx_mesh_stress(struct gx_mesh *mesh);
/* v_p <- flip (v_p + kick S a) + (1 - flip) S v, from gathered_a and gathered_v; the latter is not looked at where flip is 1. */
void gx_mesh_kick_particles(struct gx_mesh *mesh, double kick);
/* Nodal acceleration from the forces of T and of the problem's body force at time t. */
void gx_mesh_accelerate(struct gx_mesh *mesh, double t);
double gx_mesh_kinetic(const struct gx_space *space);
/* Adds component arrays to the list of what a space advances. */
void gx_mesh_append(struct gx_state *state, int count, double *const *array, size_t length);
void gx_mesh_particle_acceleration(struct gx_space *space, double *const *a);
void gx_mesh_field(const struct gx_space *space, enum gx_field which, size_t n, double *const *point, double *const *value);

#endif
