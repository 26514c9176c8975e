/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Potential energy of a space whose particles are settled. */
#ifndef GRIDCROSS_MEASURES_POTENTIAL_H
#define GRIDCROSS_MEASURES_POTENTIAL_H

#include <gridcross/space.h>

/* The space's own or the strain energy, J. volume: gx_particles_volume of the particles. */
double gx_potential_of(const struct gx_space *space, double volume);

#endif
