/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the two grid spaces share: grid, weights, nodal fields, mass, and per-particle scratch. All memory is taken at creation. */
#ifndef GRIDCROSS_SPACES_MESH_H
#define GRIDCROSS_SPACES_MESH_H

#include <gridcross/space.h>

#include "affine.h"
#include "blocks.h"
#include "exchange.h"
#include "lattice.h"
#include "line.h"
#include "mass.h"
#include "reconstruction.h"

struct gx_mesh {
  struct gx_space space;
  struct gx_space_options options;
  struct gx_grid grid;
  struct gx_blocks blocks; /* of particles, with their weights and scratch */
  struct gx_exchange exchange;
  struct gx_lattice *lattice;               /* moving mesh: its transfers factored by direction; NULL: by blocks alone */
  struct gx_line *line;                     /* standard space in 1-D: its transfers; NULL: by blocks alone */
  struct gx_mass *consistent;               /* NULL: lumped */
  struct gx_affine *affine;                 /* NULL: particles keep no affine part of velocity */
  struct gx_reconstruction *reconstruction; /* NULL: integrals are sums over particles */
  /* nodal fields, [grid.stored]; mass is zero at periodic images, the others are copied there */
  double *mass;                     /* row sums, kg */
  double trace;                     /* lumped: up to here mass is none but that of round-off in the positions of particles, kg */
  double *inverse;                  /* of mass, 0 where there is none, at images too, 1/kg, once kept */
  bool kept;                        /* mass never changes again */
  double *v[GX_MAX_DIM];            /* m/s */
  double *a[GX_MAX_DIM];            /* m/s^2 */
  double *u[GX_MAX_DIM];            /* m; moving mesh only */
  bool unprojected;                 /* mass and v are still to be assembled, see gx_mesh_postpone */
  double *half[GX_MAX_DIM];         /* [n] half lengths of particle domains that follow F */
  double *opened[GX_MAX_DIM];       /* [n] y of GX_OPEN, at particles */
  double *opened_nodes[GX_MAX_DIM]; /* the same at nodes, [grid.stored] */
  void *block;
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
/* Nodal mass of the current weights and, when value is not NULL, in the same pass field = M^-1 sum_p m_p value_p S_ip. Velocities of
 * the particles, particles->v, come with their affine part. */
enum gx_status gx_mesh_assemble(struct gx_mesh *mesh, double *const *value, double *const *field);
/* field = M^-1 sum_p m_p value_p S_ip with the mass assembled last. */
enum gx_status gx_mesh_project(struct gx_mesh *mesh, double *const *value, double *const *field);
/* Says that the mass assembled last stays. */
void gx_mesh_keep_mass(struct gx_mesh *mesh);
/* Assembles mass and, where it is projected each step, v from the particles: lumped, not now but in gx_mesh_accelerate, which does all
 * in one pass, or in gx_mesh_catch_up, which whoever needs them before calls. */
enum gx_status gx_mesh_postpone(struct gx_mesh *mesh);
void gx_mesh_catch_up(struct gx_mesh *mesh);
/* Nodal acceleration from stress and from the problem's body force at time t. load: makes T of a block, what the force scatters by
 * gradients; returns the first particle of the block with det F <= 0, or -1. GX_TANGLED where there is one. */
enum gx_status gx_mesh_accelerate(struct gx_mesh *mesh, double t, long (*load)(struct gx_mesh *mesh, struct gx_block *block));
/* P of a block from its F, unless it is integrated by rate; returns as load. */
long gx_mesh_stress(struct gx_mesh *mesh, struct gx_block *block);
/* A load: T = -V0 P of the P that the particles have. */
long gx_mesh_load_nominal(struct gx_mesh *mesh, struct gx_block *block);
/* v_p <- flip (v_p + kick S a) + (1 - flip) S v, from a and v of the block; the latter is not looked at where flip is 1. Their affine
 * part is gx_affine_gather's, once the nodes are kicked. */
void gx_mesh_kick_block(const struct gx_mesh *mesh, const struct gx_block *block, double kick);
/* The momentum that a kick with the nodes' a is to leave the particles with, and bringing them to it; only where the integrals are not
 * sums over particles, which would keep it anyway. Kicked nodes: v is that after the kick. */
void gx_mesh_momentum_expect(const struct gx_mesh *mesh, double kick, double *momentum);
void gx_mesh_momentum_keep(const struct gx_mesh *mesh, const double *momentum, double *const *v);
/* Sum of mass times field over the nodes. moment: [dim] */
void gx_mesh_momentum_of(const struct gx_mesh *mesh, double *const *field, double *moment);
/* Particles: GX_OPEN: y = u + span S v; GX_CLOSE: u = y + span S v. */
void gx_mesh_open(struct gx_mesh *mesh, enum gx_primitive primitive, double span);
/* A nodal field at all particles, and its gradient; either may be NULL. */
void gx_mesh_gather(struct gx_mesh *mesh, double *const *field, double *const *value, double *const *gradient);
/* field[d] <- M^-1 field[d] with ends held, for every component. */
enum gx_status gx_mesh_solve(struct gx_mesh *mesh, double *const *field);
double gx_mesh_kinetic(const struct gx_space *space);
/* gx_space_kind.image */
void gx_mesh_image(struct gx_space *space, struct gx_image *image);
/* Adds component arrays to the list of what a space advances. */
void gx_mesh_append(struct gx_state *state, int count, double *const *array, size_t length);
void gx_mesh_particle_acceleration(struct gx_space *space, double *const *a);
void gx_mesh_field(const struct gx_space *space, enum gx_field which, size_t n, double *const *point, double *const *value);
/* The same of any nodal field, [dim][grid.stored]. */
void gx_mesh_field_at(const struct gx_mesh *mesh, double *const *field, size_t n, double *const *point, double *const *value);
/* Integrals of the grid's functions over the domain, m^dim, those of GIMP as in gx_space_kind.field; zero at periodic images and where
 * a function does not reach into the domain. volume: [grid.stored]. -1 when memory runs out. */
int gx_mesh_volumes(const struct gx_mesh *mesh, double *volume);

#endif
