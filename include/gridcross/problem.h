/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems: material, boundary, body force and exact solution. */
#ifndef GRIDCROSS_PROBLEM_H
#define GRIDCROSS_PROBLEM_H

#include <stdbool.h>

#include <gridcross/material.h>
#include <gridcross/particles.h>

/* Ends of the domain. fixed: walls, the component normal to them is zero; clamped: every component is zero at the low end of the
 * first direction, the other ends are free; free: nothing is held, and a particle must not leave. */
enum gx_boundary { GX_BOUNDARY_PERIODIC, GX_BOUNDARY_FIXED, GX_BOUNDARY_CLAMPED, GX_BOUNDARY_FREE, GX_BOUNDARIES };
extern const char *const gx_problem_boundary[GX_BOUNDARIES + 1]; /* names, NULL-ended */

enum gx_shape { GX_SHAPE_BOX, GX_SHAPE_DISK, GX_SHAPE_RING, GX_SHAPE_POINTS };

/* A body that a run file describes. In 1-D a disk is an interval, in 3-D a ball, a ring a shell. */
struct gx_body {
  enum gx_shape shape; /* points: the particles are given, not filled in */
  double centre[GX_MAX_DIM];
  double size[GX_MAX_DIM];     /* edges of a box, m */
  double radius, inner_radius; /* m */
};

struct gx_problem_options {
  int dim;
  double amplitude; /* A, m */
  double mode;      /* wavenumber m of sin(2 pi m X) */
  struct gx_moduli moduli;
  bool active[GX_MAX_DIM];    /* directions that move */
  double phase[GX_MAX_DIM];   /* rad */
  double interpolation_error; /* oscillator: added to v in every drift, m/s */
  struct gx_body body;
  double velocity[GX_MAX_DIM]; /* of a body that flies freely, m/s */
  double spin;                 /* its angular velocity, about z, rad/s */
  double rotation;             /* G, largest angle of a vortex, rad */
  double gravity;              /* along -y, m/s^2 */
  /* model problems of steffen2010 §5 */
  int knot;              /* that the first step meets half way, from 1; 0: starts at x = 0 */
  double dt;             /* of that step, s */
  double jump;           /* J of eq. 87, 1/s^2 */
  bool corrected;        /* g of eq. 87 integrates to 0, else as printed */
  double particle_width; /* m */
};

/* A problem posed at given reference points. */
struct gx_posed {
  const struct gx_problem *problem;
  struct gx_problem_options options;
  double speed; /* longitudinal wave speed c, m/s */
  size_t n;
  double *X[GX_MAX_DIM];      /* [n] the points, m, owned */
  double *sine[GX_MAX_DIM];   /* waves: [n] sin(2 pi m X_d), owned */
  double *cosine[GX_MAX_DIM]; /* [n] cos(2 pi m X_d), owned */
};

struct gx_problem {
  const char *name;
  const char *help;
  const char *source;
  const struct gx_material *material;
  int min_dim, max_dim;        /* min_dim 0: 1 */
  const char *space;           /* space that holds its equations; NULL: a continuum, method.space chooses */
  const char *const *standard; /* defaults of its own, "mesh.cells=20", NULL-ended; NULL: the parameter table's */
  /* which problem.* and body.* parameters apply */
  bool has_amplitude, has_mode, has_directions, has_poisson, has_interpolation_error, has_knots, has_jump, has_body, has_flight,
      has_spin, has_rotation, has_gravity;
  unsigned boundaries;       /* bit b: admits boundary b; 0: has no ends */
  enum gx_boundary boundary; /* the default */
  bool waves;                /* sin(2 pi m X) is what it is about: posed with tables of it, a frequency can be fitted */
  double cycles;             /* one period is cycles/c seconds (c: wave speed, domain length 1); 0: none */
  double end;                /* without period: default time from start to end, s */
  const char *meets;         /* why particles must move through a fixed grid; NULL: they need not */
  /* Refuses options that make no sense, with the reason; NULL: all do. */
  enum gx_status (*check)(const struct gx_problem_options *options, struct gx_outcome *outcome);
  /* Whether a reference point belongs to the body; NULL: the body fills the domain. */
  bool (*inside)(const struct gx_problem_options *options, const double *X);
  /* Of two bodies: whether a reference point is of the second; NULL: there is one. */
  bool (*second)(const struct gx_problem_options *options, const double *X);
  /* Exact displacement, velocity, deformation gradient and acceleration d2u/dt2 (m/s^2, [dim][n]) at time t; any output may be
   * NULL. Arrays as in gx_particles. NULL: unknown, then `initial` gives the state at t = 0. */
  void (*exact)(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F, double *const *a);
  void (*initial)(const struct gx_posed *posed, double *const *u, double *const *v, double *const *F);
  /* Body force per unit mass at the reference points at time t, m/s^2; NULL: none. b: [dim][n]. */
  void (*body)(const struct gx_posed *posed, double t, double *const *b);
  /* In 1-D: the angle, rad, linear in time, on whose cosine alone the body force of a point depends; NULL: it depends on time in
   * another way. */
  double (*body_angle)(const struct gx_posed *posed, double t);
};

extern const struct gx_problem *const gx_problem_family[];
const struct gx_problem *gx_problem_find(const char *name);

/* X: [dim][n] reference positions. NULL when memory runs out. */
struct gx_posed *gx_problem_pose(const struct gx_problem *problem, const struct gx_problem_options *options, size_t n,
                                 double *const *X);
/* The state that a run starts from: the exact one at time t with the velocity of t_velocity, else the initial one. */
void gx_problem_begin(const struct gx_posed *posed, double t, double t_velocity, double *const *u, double *const *v,
                      double *const *F);
void gx_problem_free(struct gx_posed *posed);
/* n of the points, from the one given: as posed, whose tables it borrows. */
struct gx_posed gx_problem_part(const struct gx_posed *posed, size_t from, size_t n);

#endif
