/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of clocks. */
#include <gridcross/clock.h>

#include "../core/family.h"
#include "clock_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_clock gx_##member;
GX_FAMILY(gx_clock, gx_clock, GX_CLOCK_FAMILY)
