/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of materials. */
#include <gridcross/material.h>

#include "../core/family.h"
#include "material_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_material gx_##member;
GX_FAMILY(gx_material, gx_material, GX_MATERIAL_FAMILY)
