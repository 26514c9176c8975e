/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two elastic disks that fly at each other along the diagonal of the unit square, meet, and bounce (Sulsky, Chen & Schreyer 1994, §4.1;
 * here neo-Hookean, in plane strain). Nothing but the grid knows of contact: bodies feel each other where they share a node. */
#include <math.h>
#include <stddef.h>

#include <gridcross/problem.h>

extern const struct gx_material gx_neo_hookean;

static const double radius = 0.2, centre[] = {0.2, 0.8}, speed = 0.1; /* m, along each direction m and m/s */

static double square_from(const double *X, double at)
{
  return (X[0] - at) * (X[0] - at) + (X[1] - at) * (X[1] - at);
}

static bool second(const struct gx_problem_options *options, const double *X)
{
  (void)options;
  return square_from(X, centre[1]) < square_from(X, centre[0]);
}

static bool inside(const struct gx_problem_options *options, const double *X)
{
  return square_from(X, centre[second(options, X)]) <= radius * radius * (1 + 1e-12);
}

static void initial(const struct gx_posed *posed, double *const *u, double *const *v, double *const *F)
{
  const int dim = posed->options.dim;
  for (size_t p = 0; p < posed->n; p++) {
    bool other = second(&posed->options, (double[]){posed->X[0][p], posed->X[1][p]});
    for (int d = 0; d < dim; d++) {
      u[d][p] = 0;
      v[d][p] = other ? -speed : speed;
      for (int e = 0; e < dim; e++) F[d * dim + e][p] = d == e;
    }
  }
}

const struct gx_problem gx_colliding_disks = {
    .name = "colliding-disks",
    .help = "two elastic disks meet head on, bounce and part; plane strain",
    .source = "Sulsky, Chen & Schreyer 1994, doi:10.1016/0045-7825(94)90112-0",
    .material = &gx_neo_hookean,
    .standard = (const char *const[]){"problem.dimension=2", "problem.modulus=1000", "problem.poisson=0.3",
                                      "problem.density=1000", "mesh.cells=20", NULL},
    .min_dim = 2,
    .max_dim = 2,
    .has_poisson = true,
    .boundaries = 1u << GX_BOUNDARY_FREE | 1u << GX_BOUNDARY_FIXED,
    .boundary = GX_BOUNDARY_FREE,
    .end = 3.6,
    .meets = "two bodies on one grid of the reference configuration never meet",
    .inside = inside,
    .second = second,
    .initial = initial,
};
