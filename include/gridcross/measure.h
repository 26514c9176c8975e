/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures: error norms, energies, crossings. They observe a run and never change it. */
#ifndef GRIDCROSS_MEASURE_H
#define GRIDCROSS_MEASURE_H

#include <gridcross/clock.h>
#include <gridcross/space.h>

enum gx_quantity { GX_DISPLACEMENT, GX_VELOCITY, GX_STRESS, GX_QUANTITIES };
enum gx_norm { GX_INF, GX_RMS, GX_L2N, GX_NORMS }; /* max |e|; sqrt(mean |e|^2); ||e||_2 / N */

enum gx_measure_level { GX_MEASURE_FINAL, GX_MEASURE_MAX, GX_MEASURE_ALL }; /* output.measures */

/* One end of step. NaN: not measured. */
struct gx_sample {
  double time;                           /* s */
  double error[GX_QUANTITIES][GX_NORMS]; /* m, m/s, Pa (l2n the same) */
  double kinetic, kinetic_nodes;         /* J: of particles, of nodes */
  double elastic, work;                  /* J: strain energy, work of the body force since t = 0 */
  double defect;                         /* J: energy defect of the step that ended here */
  double crossings;                      /* changes of cell so far */
};

struct gx_measured {
  struct gx_sample last;
  double max_error[GX_QUANTITIES][GX_NORMS];
  double max_defect;
  double drift; /* max |E - E0 - work| / E0; NaN when E0 = 0 */
};

#endif
