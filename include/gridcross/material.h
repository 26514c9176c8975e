/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials: first Piola–Kirchhoff stress, its rate, and strain energy from the deformation gradient. */
#ifndef GRIDCROSS_MATERIAL_H
#define GRIDCROSS_MATERIAL_H

#include <stddef.h>

#include <gridcross/particles.h>

struct gx_moduli {
  double young;   /* E, Pa */
  double lambda;  /* first Lamé parameter, Pa */
  double mu;      /* shear modulus, Pa */
  double density; /* reference density, kg/m^dim */
};

/* E and Poisson's ratio to Lamé parameters: lambda = E nu/((1+nu)(1-2nu)), mu = E/(2(1+nu)). */
struct gx_moduli gx_material_moduli(double young, double poisson, double density);

/* Tensors as in gx_particles: dim*dim arrays of n entries, row-major. Without piola there is no stress, without energy no strain
 * energy. */
struct gx_material {
  const char *name;
  const char *help;
  const char *source;
  /* P(F). Returns the index of a particle with det F <= 0 or not finite, or -1. */
  long (*piola)(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *const *P);
  /* dP/dt at F for dF/dt = rate_F. */
  void (*piola_rate)(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *const *rate_F,
                     double *const *rate_P);
  /* Strain energy per reference volume, Pa. */
  void (*energy)(const struct gx_moduli *moduli, int dim, size_t n, double *const *F, double *W);
  /* Sum of that over the points, of which each has J > 0; NULL: by the points. */
  double (*total)(const struct gx_moduli *moduli, int dim, size_t n, double *const *F);
  /* Longitudinal wave speed at F = I, m/s. */
  double (*wave_speed)(const struct gx_moduli *moduli);
};

extern const struct gx_material *const gx_material_family[];
const struct gx_material *gx_material_find(const char *name);

/* Cauchy stress sigma = P F^T / det F; sigma may not alias P or F. */
void gx_material_cauchy(int dim, size_t n, double *const *F, double *const *P, double *const *sigma);

#endif
