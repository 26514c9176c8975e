/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots: what the particles and the grid hold at the end of a step, as named records with their units. */
#ifndef GRIDCROSS_SNAPSHOT_H
#define GRIDCROSS_SNAPSHOT_H

#include <gridcross/measure.h>

enum { GX_SNAPSHOT_RECORDS = 16 };

/* A quantity of particles or vertices, in SI units. */
struct gx_record {
  const char *name;             /* letters and _ */
  int rank;                     /* 0: scalar; 1: vector; 2: tensor, row-major: dim to the power rank components */
  int length, mass, time;       /* powers of m, kg and s in its unit */
  double offset;                /* s: the time at which it holds, less that of the snapshot */
  bool constant;                /* the same in every snapshot of a run */
  double *value[GX_MAX_TENSOR]; /* by component, [n], borrowed */
};

/* Records of the same n points; points along each direction, first fastest, where they are a lattice. */
struct gx_record_set {
  size_t n;
  size_t shape[GX_MAX_DIM]; /* of particles n, 1, 1 */
  int count;
  struct gx_record record[GX_SNAPSHOT_RECORDS];
};

struct gx_snapshot {
  int dim;
  double step;     /* number of steps taken */
  double time, dt; /* s */
  /* position (current, not wrapped), displacement, velocity, deformation_gradient, first_piola_stress, cauchy_stress, volume, body_force
   * (per unit mass, where there is one), displacement_error, velocity_error, stress_error (Cauchy; where an exact solution is known),
   * reference_position and mass, which are constant */
  struct gx_record_set particles;
  /* At the vertices of the cells, those on all faces of the domain: velocity, acceleration, density and momentum (per volume), and on
   * a moving mesh displacement. The fields are sums over the grid's functions, with m_i / int N_i and m_i v_i / int N_i as coefficients
   * of density and momentum. n = 0: no grid. */
  struct gx_record_set vertices;
  double spacing[GX_MAX_DIM]; /* of vertices at rest, m; the first is at 0 */
  bool moving;                /* vertices move with the material, by their displacement */
};

/* Makes snapshots of a run. */
struct gx_snapshot_maker;

/* All is borrowed; cells: per direction. NULL when memory runs out. */
struct gx_snapshot_maker *gx_snapshot_create(struct gx_space *space, const struct gx_clock *clock, struct gx_measure *measure,
                                             const int *cells);
void gx_snapshot_free(struct gx_snapshot_maker *maker);
/* How many numbers a snapshot of a space is, constant records left out. */
double gx_snapshot_numbers(const struct gx_space *space, const int *cells);
/* The state of which the measure has just taken a sample; valid until the next call, or until the run goes on. */
const struct gx_snapshot *gx_snapshot_take(struct gx_snapshot_maker *maker, double step, double time, double dt);

/* A record by its name; NULL: there is none. */
const struct gx_record *gx_snapshot_record(const struct gx_record_set *set, const char *name);
/* dim to the power rank */
int gx_snapshot_components(int dim, int rank);

#endif
