/* SPDX-License-Identifier: GPL-3.0-or-later */
/* cpGIMP: generalized interpolation whose particle domains stretch with the diagonal of F. */
#include <gridcross/basis.h>

#include "gimp.h"

GX_CLONES static long evaluate(const struct gx_axis *axis, size_t n, const double *restrict x, const double *restrict half,
                               int *restrict first, double *restrict S, double *restrict D)
{
  if (gx_gimp_evaluate(axis, n, x, half, first, S, D))
    for (size_t p = 0; p < n; p++)
      if (!(half[p] > 0 && half[p] * axis->cells <= gx_gimp_widest)) return (long)p;
  return -1;
}

const struct gx_basis gx_cpgimp = {
    .name = "cpgimp",
    .help = "GIMP, particle domains stretched by F; at most one cell wide",
    .source = "Wallstedt & Guilkey 2008; berzins2021, berzins2022",
    .has_domain = true,
    .deforms = true,
    .layout = gx_gimp_layout,
    .site = gx_gimp_site,
    .evaluate = evaluate,
};
