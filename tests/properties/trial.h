/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random cases of every space in a box, with particles in a random state: built from the choices of a property, and built again seen
 * otherwise, with the same particles mirrored, moved by whole cells, in another order or disturbed. */
#ifndef GRIDCROSS_TESTS_PROPERTIES_TRIAL_H
#define GRIDCROSS_TESTS_PROPERTIES_TRIAL_H

#include "property.h"

#include "rig.h"

/* The choices of every trial, in the order of trial_choice; parameters by their paths. A property may give other ranges. */
extern const char *const trial_layouts[], *const trial_ends[], *const trial_states[];
extern const char *const trial_grids[]; /* spaces with a grid, for those who ask for them alone */
#define TRIAL_CHOICES                                                                                                            \
  {"problem.dimension", 1, 3, NULL}, {"mesh.cells", 1, 10, NULL}, {"mesh.particles_per_cell", 1, 5, NULL},                       \
      {"layout", 0, 2, trial_layouts}, {"method.space", 0, 0, NULL}, {"method.basis", 0, 0, NULL},                               \
      {"method.degree", 1, GX_MAX_DEGREE, NULL}, {"method.mass", 0, 0, NULL}, {"method.quadrature", 0, 0, NULL},                 \
      {"method.transfer", 0, 0, NULL}, {"damping", 0, 4, NULL}, {"method.clock", 0, 0, NULL}, {"method.position", 0, 0, NULL},   \
      {"method.projection", 0, 0, NULL}, {"method.stress", 0, 0, NULL}, {"ends", 0, 2, trial_ends}, {"poisson", 0, 4, NULL},     \
      {"cfl", 1, 8, NULL}, {"steps", 1, 6, NULL}, {"state", 0, 2, trial_states},                                                 \
  {                                                                                                                              \
    "seed", 0, 99999, NULL                                                                                                       \
  }
enum trial_choice {
  TRIAL_DIMENSION,
  TRIAL_CELLS,
  TRIAL_PER_CELL,
  TRIAL_LAYOUT,
  TRIAL_SPACE,
  TRIAL_BASIS,
  TRIAL_DEGREE,
  TRIAL_MASS,
  TRIAL_QUADRATURE,
  TRIAL_TRANSFER,
  TRIAL_DAMPING, /* quarters of PIC in a blend */
  TRIAL_CLOCK,
  TRIAL_POSITION,
  TRIAL_PROJECTION,
  TRIAL_STRESS,
  TRIAL_ENDS,
  TRIAL_POISSON, /* tenths */
  TRIAL_CFL,     /* twentieths */
  TRIAL_STEPS,
  TRIAL_STATE,
  TRIAL_SEED
};

/* How the same particles are seen: the default is as they are. */
struct trial_view {
  bool mirrored[GX_MAX_DIM];
  int shift[GX_MAX_DIM]; /* whole cells */
  bool shuffled;
  double disturbance;                 /* of everything that particles carry, relative to its size */
  int draw;                           /* which of the random ones */
  const char *transfer;               /* another one; NULL: that of the case */
  double flip;                        /* with it */
  double body;                        /* edge of a cube in the middle of the box that particles fill; 0: all of it */
  const struct gx_material *material; /* another one; NULL: neo-Hookean */
};

struct trial {
  struct gx_case one;
  struct rig rig;
  struct trial_view view;
  size_t *slot; /* [n] where a particle of the plain view stands */
  uint64_t seed;
};

/* Resolved parameters of a case, limited in 2-D and 3-D to what is quick. */
struct gx_case trial_case(const struct property_choice *choice, const int *value);
/* Builds it; view NULL: plain. Other than GX_OK: refused, or not to be started from that state. To be freed in any case. */
enum gx_status trial_build(struct trial *trial, const struct property_choice *choice, const int *value,
                           const struct trial_view *view);
/* One step; at the end of all, trial_settle. */
enum gx_status trial_step(struct trial *trial);
void trial_settle(struct trial *trial);
/* All of it: build, the steps of the case, settle. */
enum gx_status trial_run(struct trial *trial, const struct property_choice *choice, const int *value,
                         const struct trial_view *view);
void trial_free(struct trial *trial);
/* Of a run that ended so: as judged where it ended well, broken by an internal failure, silent where the method failed or was refused. */
enum property_verdict trial_judge(const struct trial *trial, enum gx_status status, struct property_finding *finding);

/* Largest difference of the two runs' particles, brought to the same view: of velocity relative to the speed of the case, of
 * displacement to a cell's width, of F. */
double trial_distance(const struct trial *a, const struct trial *b);
/* Roundings in sequence behind a particle after a step, at most: sums over particles or points, of weights. */
double trial_roundings(const struct trial *trial);
/* What the roundings of a run grow to by its end, and the tolerance of solves with the full mass matrix in 2-D and 3-D: as a disturbance of
 * everything that particles carry does, measured by twins that are disturbed by far more: the worst of them. plain: settled after the
 * steps of the case. NAN: a twin did not end. */
double trial_sensitivity(const struct trial *plain, const struct property_choice *choice, const int *value);

#endif
