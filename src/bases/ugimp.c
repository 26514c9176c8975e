/* SPDX-License-Identifier: GPL-3.0-or-later */
/* uGIMP: generalized interpolation with particle domains of fixed width (Bardenhagen & Kober 2004; berzins2022 §2). */
#include <gridcross/basis.h>

#include "gimp.h"

GX_CLONES static long evaluate(const struct gx_axis *axis, size_t n, const double *restrict x, const double *restrict half,
                               int *restrict first, double *restrict S, double *restrict D)
{
  gx_gimp_evaluate(axis, n, x, half, first, S, D);
  return -1;
}

const struct gx_basis gx_ugimp = {
    .name = "ugimp",
    .help = "GIMP, particle domains of fixed width",
    .source = "Bardenhagen & Kober 2004; berzins2022",
    .has_domain = true,
    .layout = gx_gimp_layout,
    .site = gx_gimp_site,
    .evaluate = evaluate,
};
