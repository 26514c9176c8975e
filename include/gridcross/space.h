/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spaces: what turns particle state into rates. A clock knows a space by this interface alone. */
#ifndef GRIDCROSS_SPACE_H
#define GRIDCROSS_SPACE_H

#include <stdbool.h>
#include <stddef.h>

#include <gridcross/basis.h>
#include <gridcross/particles.h>
#include <gridcross/problem.h>

struct gx_team;

struct gx_space_options {
  int cells[GX_MAX_DIM];
  bool periodic;
  unsigned held[GX_MAX_DIM]
               [2]; /* bounded: bit e of [d][0], [d][1]: component e is zero at the low, the high end of direction d */
  const struct gx_basis *basis;
  int degree;
  bool consistent;      /* mass matrix: consistent, else lumped (row sums) */
  bool reconstructed;   /* method.quadrature: integrals over reconstructed fields, else sums over particles */
  bool pic;             /* particle velocity from the grid, else by increments (FLIP) */
  bool apic;            /* with pic: and its affine part about each particle */
  double flip;          /* blend: flip * FLIP + (1 - flip) * PIC */
  bool particle_motion; /* method.position: particle */
  bool each_step;       /* method.projection: nodal velocity re-projected from particles */
  bool stress_rate;     /* stress integrated by rate, else P(F) */
  /* collocation */
  bool reference;         /* method.frame: sites at X, else at x */
  bool symmetric;         /* method.closure: mirrored at fixed ends, else the papers' */
  bool papers_divergence; /* method.divergence: the factor F left out, as in the papers */
  struct gx_team *team;   /* threads for the parts of a step, borrowed; NULL: none but the caller */
};

/* What clocks are made of. */
enum gx_primitive {
  GX_END,
  GX_WEIGHTS,    /* W: weights at the current positions */
  GX_PROJECT,    /* P: nodal mass and velocity */
  GX_ACCELERATE, /* A: nodal acceleration */
  GX_KICK,       /* K: velocities by coefficient * dt */
  GX_STRAIN,     /* G: F and stress by coefficient * dt */
  GX_DRIFT,      /* X: positions by coefficient * dt */
  /* for clocks that use the weights of two positions in one step; the first three on fixed grids alone */
  GX_WEIGHTS_FROZEN, /* weights at the current positions, particle domains as they were */
  GX_STRETCH,        /* weights again if particle domains follow F */
  GX_STRAIN_BACK,    /* F and stress by coefficient * dt with the gradient at the end: F <- (I - span grad v)^-1 F */
  GX_MASS,           /* nodal mass; nodal velocity is kept */
  GX_KICK_NODES,     /* nodal velocities only, by coefficient * dt */
  GX_OPEN,           /* keeps y = x + span S v */
  GX_CLOSE           /* x <- y + span S v */
};

enum { GX_MAX_STATE = 48 }; /* in 3-D u, v, F, P and nodal velocity are 27 */

/* The arrays that a space advances in time, the components of displacement first; what a Runge–Kutta engine combines. */
struct gx_state {
  int count;
  double *array[GX_MAX_STATE];
  size_t length[GX_MAX_STATE];
};

enum gx_field { GX_FIELD_VELOCITY, GX_FIELD_ACCELERATION };

struct gx_space;

enum gx_quantity { GX_DISPLACEMENT, GX_VELOCITY, GX_STRESS, GX_QUANTITIES };

/* What measures need to know of all particles at the end of a step, right after an acceleration at its time. */
struct gx_survey {
  /* asked */
  double t;         /* s */
  double ahead;     /* s that velocities are behind */
  bool energies;    /* momentum, kinetic, elastic and defect; elastic where the material has an energy */
  bool first_order; /* of the defect */
  double *kept;     /* [gx_space.surveyed] what one survey leaves for the next; zeros before the first */
  /* found */
  double square[GX_QUANTITIES]; /* sum over particles of the squared error against the exact solution */
  double most[GX_QUANTITIES];   /* the largest of them */
  double momentum[GX_MAX_DIM];  /* sum m v, kg m/s */
  double kinetic, elastic;      /* sum m v^2 / 2, sum V0 W, J */
  double defect;                /* W: sum m (v - v0)/4 (a - a0), first order: sum m v0/2 (a - a0); v0, a0: at the last survey */
};

struct gx_space_kind {
  const char *name;
  const char *help;
  const char *source;
  bool fixed_grid;  /* particles move through the grid: projection each step by default, crossings counted, a field */
  bool collocation; /* strong form on splines: method.degree, frame, closure, divergence; no basis, mass or transfer */
  bool nodal;       /* collocation by way of the grid's nodes */
  bool of_problem;  /* the equations of certain problems, not a choice of method.space */
  /* Builds the space on particles and a posed problem (both borrowed, particles already in their initial state). */
  enum gx_status (*create)(const struct gx_space_kind *kind, struct gx_space **space, const struct gx_space_options *options,
                           struct gx_particles *particles, const struct gx_posed *posed, struct gx_outcome *outcome);
  void (*free)(struct gx_space *space);
  /* The primitives above: weights, projection, acceleration at time t; then kick, strain and drift in that order, each by its own
   * time span in s, where 0 skips it. */
  enum gx_status (*weights)(struct gx_space *space);
  enum gx_status (*project)(struct gx_space *space);
  enum gx_status (*accelerate)(struct gx_space *space, double t);
  void (*advance)(struct gx_space *space, double kick, double strain, double drift);
  /* GX_WEIGHTS_FROZEN ... GX_CLOSE; span: coefficient * dt. */
  enum gx_status (*twofold)(struct gx_space *space, enum gx_primitive primitive, double span);
  /* Runge–Kutta view: the state, and its time derivatives after W, P, A. What APIC keeps of the last kick is not in it, having no
   * rate. rate: [state.count] arrays. */
  void (*state)(struct gx_space *space, struct gx_state *state);
  void (*rates)(struct gx_space *space, double *const *rate);
  /* Of what it keeps over steps besides particles, without what weights, projection and acceleration make anew; NULL: nothing. */
  void (*image)(struct gx_space *space, struct gx_image *image);
  /* Kinetic energy of the carrier of velocity: nodes with their row-sum mass, J. */
  double (*kinetic)(const struct gx_space *space);
  /* Potential energy, J; NULL: strain energy sum V0 W(F) where the material has one. */
  double (*potential)(const struct gx_space *space);
  /* spin += angular momentum of the affine part of velocities that are brought `ahead` seconds by the nodal acceleration,
   * kg m^2/s: what gx_particles does not show. spin: [GX_MAX_DIM]; NULL: there is none. */
  void (*spin)(struct gx_space *space, double ahead, double *spin);
  /* Power of the body force of the last acceleration at velocities that it brings `ahead` seconds on, W. Returns false, or is NULL:
   * sum m b v of the particles, settled. */
  bool (*power)(struct gx_space *space, double ahead, double *power);
  /* Brings particles up to date with a state that lives on nodes; NULL: nothing to do. */
  void (*settle)(struct gx_space *space);
  /* Finds all this without settling the particles, where gx_space.surveyed is not 0. NULL: cannot. */
  void (*survey)(struct gx_space *space, struct gx_survey *survey);
  /* Acceleration of the particles after accelerate. a: [dim][n], m/s^2. */
  void (*particle_acceleration)(struct gx_space *space, double *const *a);
  /* The field sum_i value_i N_i of the present nodal velocity or acceleration at n points of the grid's own coordinate: x where the
   * grid is fixed, X where it moves along. N_i are the basis functions; those averaged over particle domains (GIMP) are the hats
   * that they average. point: [dim][n], in [0, 1] unless periodic; value: [dim][n]. NULL: no function on a grid. */
  void (*field)(const struct gx_space *space, enum gx_field which, size_t n, double *const *point, double *const *value);
};

/* What every space starts with. */
struct gx_space {
  const struct gx_space_kind *kind;
  struct gx_particles *particles; /* borrowed */
  const struct gx_posed *posed;   /* borrowed */
  struct gx_outcome *outcome;     /* borrowed: filled when a primitive fails */
  bool through_cells;             /* particles move through cells: crossings are counted */
  size_t left_cells;              /* quadrature reconstructed: most cells at once that were left to sums over their particles */
  const double *edge;             /* [edges] ascending, where cells of its own end, m, borrowed; NULL: the cells of mesh.cells */
  size_t edges;
  size_t surveyed; /* numbers that a survey keeps; 0: there is none of this space */
};

extern const struct gx_space_kind *const gx_space_family[];
const struct gx_space_kind *gx_space_find(const char *name);
/* Of a space and its particles. Loaded, it has no weights yet: see gx_stepper_image. */
void gx_space_image(struct gx_space *space, struct gx_image *image);

#endif
