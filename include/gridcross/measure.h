/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures: error norms, energies, crossings. They observe a run and never change it. */
#ifndef GRIDCROSS_MEASURE_H
#define GRIDCROSS_MEASURE_H

#include <gridcross/clock.h>
#include <gridcross/space.h>

struct gx_measure_name {
  const char *name, *unit;
};
extern const struct gx_measure_name gx_measure_quantity[GX_QUANTITIES]; /* "displacement", "m"; ... */
enum gx_norm { GX_INF, GX_RMS, GX_L2N, GX_NORMS };                      /* max |e|; sqrt(mean |e|^2); ||e||_2 / N */

enum gx_measure_level { GX_MEASURE_FINAL, GX_MEASURE_MAX, GX_MEASURE_ALL }; /* output.measures */

/* One end of step. NaN: not measured. */
struct gx_sample {
  double time;                           /* s */
  double error[GX_QUANTITIES][GX_NORMS]; /* m, m/s, Pa (l2n the same) */
  double kinetic, kinetic_nodes;         /* J: of particles, of nodes */
  double elastic, work;                  /* J: strain energy, work of the body force since t = 0 */
  double defect;                         /* J: energy defect of the step that ended here */
  double momentum[GX_MAX_DIM];           /* kg m/s: sum m v of particles */
  double angular[GX_MAX_DIM];            /* kg m^2/s: sum m x cross v, about the origin; in 2-D the last component alone */
  double crossings;                      /* changes of cell so far */
  double jump[GX_NORMS];                 /* m: of the particles' jump errors, summed up so far */
  double jump_step;                      /* m: largest jump error of the step that ended here, with its sign; 0: no crossing */
};

/* One particle at the end of a step, by component. */
struct gx_probe {
  double u[GX_MAX_DIM], v[GX_MAX_DIM], a[GX_MAX_DIM]; /* displacement, velocity, acceleration; m, m/s, m/s^2 */
  double jump[GX_MAX_DIM];                            /* jump errors summed up, m; NaN: not measured */
  double u_error[GX_MAX_DIM], v_error[GX_MAX_DIM];    /* less the exact ones; NaN: unknown */
};

struct gx_measured {
  struct gx_sample last;
  double max_error[GX_QUANTITIES][GX_NORMS];
  double max_defect;
  double max_jump[GX_NORMS];
  double last_jump, estimated_jump; /* m: jump error of the last crossing, steffen2010 eq. 86, and minus eq. 85; NaN: none */
  double drift;                     /* max |E - E0 - work| / E0; NaN when E0 = 0 */
  /* Largest change over the run of linear momentum, relative to the largest sqrt(sum m sum m v^2), and of angular momentum,
   * relative to the largest sqrt(sum m |x - xc|^2 sum m v^2), xc the centre of mass: bounds of sum m |v| and
   * sum m |x - xc| |v| that do not vanish for a body that vibrates at rest. NaN: the problem does not keep it, or nothing moves. */
  double momentum_change, angular_change;
  double probe_change;       /* m/s^2: largest change of the probe's acceleration over a step within one cell; NaN: no probe */
  double probe_displacement; /* m: largest, of the place asked for, from the nearest particle by its F; NaN: no probe */
};

struct gx_measure;

/* Observes a space that a clock advances. cells: per direction, of the grid whose crossings are counted; NULL: particles do not
 * move through a grid. NULL when memory runs out; all is borrowed. */
struct gx_measure *gx_measure_create(struct gx_space *space, const struct gx_clock *clock, const int *cells,
                                     enum gx_measure_level level);
void gx_measure_free(struct gx_measure *measure);
/* Measures jump errors from now on; before the first sample, of a space with cells and a field. -1 when memory runs out. */
int gx_measure_jumps(struct gx_measure *measure);
/* The problem keeps linear or angular momentum: how far a run changes them is measured from now on, where energies are; before
 * the first sample. */
void gx_measure_momentum(struct gx_measure *measure, bool linear, bool angular);
/* After each step of dt when jump errors are measured, before anything else. */
void gx_measure_step(struct gx_measure *measure, double dt);
/* Follows one particle from now on, the nearest to the reference coordinates `place`; before the first sample. -1 when memory runs
 * out. */
int gx_measure_follow(struct gx_measure *measure, size_t particle, const double *place);
/* Where it was at the last sample. */
const struct gx_probe *gx_measure_probe(const struct gx_measure *measure);
/* What the stepper must call for the work of the body force. */
struct gx_work_observer gx_measure_work(struct gx_measure *measure);
/* Takes the sample at time t: the start, then ends of steps, every one of them unless only the last matters. Where the space can do
 * without, particles stay as they were: whoever looks at them settles them. */
enum gx_status gx_measure_take(struct gx_measure *measure, struct gx_stepper *stepper, double t, double dt);
/* Brings the particles up to date with the last sample, before the next step. */
void gx_measure_settle(struct gx_measure *measure);
/* Error of one component at the last sample, made anew from the particles, which have not moved on since: of a vector dim, of Cauchy
 * stress dim * dim, row-major; of a problem with an exact solution. error: [n] */
void gx_measure_error(struct gx_measure *measure, enum gx_quantity quantity, int component, double *error);
/* Norms of the difference between the last samples of two measures of the same particles, likewise. */
void gx_measure_difference(struct gx_measure *measure, struct gx_measure *other, double error[GX_QUANTITIES][GX_NORMS]);
/* Of everything measured so far, between samples. */
void gx_measure_image(struct gx_measure *measure, struct gx_image *image);
/* What was measured so far. */
const struct gx_measured *gx_measure_result(const struct gx_measure *measure);

#endif
