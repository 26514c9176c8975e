/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of spaces, and what they keep over steps. */
#include <gridcross/space.h>

#include "../core/family.h"
#include "space_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_space_kind gx_##member;
GX_FAMILY(gx_space_kind, gx_space, GX_SPACE_FAMILY)

void gx_space_image(struct gx_space *space, struct gx_image *image)
{
  GX_IMAGE(image, space->left_cells);
  gx_particles_image(space->particles, image);
  if (space->kind->image) space->kind->image(space, image);
}
