/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of bases. */
#include <gridcross/basis.h>

#include "../core/family.h"
#include "basis_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_basis gx_##member;
GX_FAMILY(gx_basis, gx_basis, GX_BASIS_FAMILY)
