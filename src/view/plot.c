/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The family of figures. */
#include <gridcross/plot.h>

#include "../core/family.h"
#include "plot_family.h"

#define GX_FAMILY_DECLARE(member) extern const struct gx_plot_kind gx_##member;
GX_FAMILY(gx_plot_kind, gx_plot, GX_PLOT_FAMILY)
