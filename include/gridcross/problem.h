/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems: material, boundary, body force and exact solution. */
#ifndef GRIDCROSS_PROBLEM_H
#define GRIDCROSS_PROBLEM_H

#include <stdbool.h>

#include <gridcross/material.h>
#include <gridcross/particles.h>

struct gx_problem_options {
  int dim;
  double amplitude; /* A, m */
  double mode;      /* wavenumber m of sin(2 pi m X) */
  struct gx_moduli moduli;
  bool active[GX_MAX_DIM];    /* directions that move */
  double phase[GX_MAX_DIM];   /* rad */
  double interpolation_error; /* oscillator: added to v in every drift, m/s */
  /* model problems of steffen2010 §5 */
  int knot;              /* that the first step meets half way, from 1; 0: starts at x = 0 */
  double dt;             /* of that step, s */
  double jump;           /* J of eq. 87, 1/s^2 */
  bool corrected;        /* g of eq. 87 integrates to 0, else as printed */
  double particle_width; /* m */
};

/* A problem posed at given reference points; tables of sin and cos are made once. */
struct gx_posed {
  const struct gx_problem *problem;
  struct gx_problem_options options;
  double speed; /* longitudinal wave speed c, m/s */
  size_t n;
  double *sine[GX_MAX_DIM];   /* [n] sin(2 pi m X_d), owned */
  double *cosine[GX_MAX_DIM]; /* [n] cos(2 pi m X_d), owned */
};

struct gx_problem {
  const char *name;
  const char *help;
  const char *source;
  const struct gx_material *material;
  int max_dim;
  const char *space; /* space that holds its equations; NULL: a continuum, method.space chooses */
  /* which problem.* parameters apply */
  bool has_mode, has_directions, has_poisson, has_interpolation_error, has_knots, has_jump;
  bool periodic; /* default boundary */
  double cycles; /* one period is cycles/c seconds (c: wave speed, domain length 1); 0: none */
  /* Exact displacement, velocity, deformation gradient and acceleration d2u/dt2 (m/s^2, [dim][n]) at time t; any output may be
   * NULL. Arrays as in gx_particles. */
  void (*exact)(const struct gx_posed *posed, double t, double *const *u, double *const *v, double *const *F, double *const *a);
  /* Body force per unit mass at the reference points at time t, m/s^2; NULL: none. b: [dim][n]. */
  void (*body)(const struct gx_posed *posed, double t, double *const *b);
};

extern const struct gx_problem *const gx_problem_family[];
const struct gx_problem *gx_problem_find(const char *name);

/* X: [dim][n] reference positions. NULL when memory runs out. */
struct gx_posed *gx_problem_pose(const struct gx_problem *problem, const struct gx_problem_options *options, size_t n,
                                 double *const *X);
void gx_problem_free(struct gx_posed *posed);

#endif
