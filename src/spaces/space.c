/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of spaces. */
#include <gridcross/space.h>

#include "../core/family.h"
#include "space_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_space_kind gx_##member;
GX_FAMILY(gx_space_kind, gx_space, GX_SPACE_FAMILY)
