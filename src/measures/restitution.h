/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Restitution of two bodies that meet: the speed at which their centres of mass part, over that at which they approached, both along
 * the line of the centres. */
#ifndef GRIDCROSS_MEASURES_RESTITUTION_H
#define GRIDCROSS_MEASURES_RESTITUTION_H

#include <gridcross/space.h>

struct gx_restitution;

/* At the start, of a space on a grid whose problem has two bodies. NULL when memory runs out. */
struct gx_restitution *gx_restitution_create(const struct gx_space *space);
void gx_restitution_free(struct gx_restitution *restitution);
/* Now. NaN unless they have parted: their centres recede, and no node feels both, since a plane across the line of the centres
 * keeps them farther apart than a basis function is wide. NaN too when they did not approach at the start. */
double gx_restitution_value(const struct gx_restitution *restitution);

#endif
