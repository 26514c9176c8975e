/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A Gauss point is a particle that never errs: it has the exact X, u and F of the material at its place and the mass w rho there.
 * On a fixed grid that material is found by Newton's method for X + u(X, t) = x. */
#include "integral.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/tensor.h"

enum { BLOCK = 1024 }; /* points found at once */

static enum gx_status allocate(struct gx_integral *integral, const struct gx_space *like, const struct gx_space_options *options,
                               struct gx_outcome *outcome)
{
  int per_cell = options->basis->has_degree ? options->degree + 2 : 3;
  int dim = like->particles->dim;
  struct gx_particles *points = gx_particles_points(dim, options->cells, per_cell);
  integral->points = points;
  if (!points) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the budget's integrals");
  double *block = malloc(points->n * (size_t)(dim + 1) * sizeof *block);
  integral->w = block;
  if (!block) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the budget's integrals");
  memcpy(integral->w, points->V0, points->n * sizeof *block);
  for (int d = 0; d < dim; d++) {
    integral->x[d] = block + (size_t)(d + 1) * points->n;
    memcpy(integral->x[d], points->X[d], points->n * sizeof *block);
  }
  struct gx_space_options consistent = *options;
  consistent.consistent = true;
  consistent.reconstructed = false; /* the points are where integrals are taken */
  return gx_mesh_create(&integral->mesh, sizeof *integral->mesh, like->kind, &consistent, points, like->posed, outcome);
}

enum gx_status gx_integral_create(struct gx_integral **out, const struct gx_space *like, const struct gx_space_options *options,
                                  struct gx_outcome *outcome)
{
  struct gx_integral *integral = calloc(1, sizeof *integral);
  if (!integral) return gx_status_set(outcome, GX_FAILED, -1, "out of memory for the budget's integrals");
  integral->moves = like->kind->fixed_grid;
  enum gx_status status = allocate(integral, like, options, outcome);
  if (status == GX_OK)
    *out = integral;
  else
    gx_integral_free(integral);
  return status;
}

void gx_integral_free(struct gx_integral *integral)
{
  if (!integral) return;
  if (integral->mesh) gx_mesh_free(&integral->mesh->space);
  gx_particles_free(integral->points);
  gx_problem_free(integral->posed);
  free(integral->w);
  free(integral);
}

/* The points from `from` on: their fields, as arrays of a block. */
struct part {
  size_t n;
  double *x[GX_MAX_DIM], *X[GX_MAX_DIM], *u[GX_MAX_DIM], *F[GX_MAX_TENSOR];
};

static struct part part_of(struct gx_integral *integral, size_t from)
{
  const struct gx_particles *points = integral->points;
  struct part part = {.n = points->n - from < BLOCK ? points->n - from : BLOCK};
  for (int d = 0; d < points->dim; d++) {
    part.x[d] = integral->x[d] + from;
    part.X[d] = points->X[d] + from;
    part.u[d] = points->u[d] + from;
  }
  for (int k = 0; k < points->dim * points->dim; k++) part.F[k] = points->F[k] + from;
  return part;
}

/* X <- X - F^-1 (X + u - x), by at most a tenth of the domain; returns the longest correction. */
GX_CORE double correct(const int dim, const struct part *part)
{
  const double most = 0.1;
  double longest = 0;
  for (size_t p = 0; p < part->n; p++) {
    double F[GX_MAX_TENSOR], C[GX_MAX_TENSOR];
    gx_tensor_load(dim, part->F, p, F);
    double J = gx_tensor_cofactor(dim, F, C);
    for (int d = 0; d < dim; d++) {
      double step = 0;
      for (int e = 0; e < dim; e++) step += C[e * dim + d] * (part->X[e][p] + part->u[e][p] - part->x[e][p]) / J;
      step = fmax(-most, fmin(most, step));
      longest = fmax(longest, fabs(step));
      part->F[d * dim + d][p] = step; /* kept until every component is known */
    }
    for (int d = 0; d < dim; d++) part->X[d][p] -= part->F[d * dim + d][p];
  }
  return longest;
}

/* Starts from the X of the last placement, or x. */
static enum gx_status find_material(struct gx_integral *integral, const struct part *part, double t)
{
  enum { MOST = 100 };
  const struct gx_posed *like = integral->mesh->space.posed;
  int dimension = integral->points->dim;
  double longest = 1;
  for (int i = 0; i < MOST && longest > 1e-13; i++) {
    struct gx_posed *posed = gx_problem_pose(like->problem, &like->options, part->n, part->X);
    if (!posed) return gx_status_set(integral->mesh->space.outcome, GX_FAILED, -1, "out of memory for the budget's integrals");
    posed->problem->exact(posed, t, part->u, NULL, part->F, NULL);
    gx_problem_free(posed);
    GX_FOR_DIM(dimension, longest = correct(dim, part))
  }
  if (longest <= 1e-13) return GX_OK;
  return gx_status_set(integral->mesh->space.outcome, GX_FAILED, -1, "no material found at points of the grid at t = %.6g s", t);
}

/* All but X of the points, which are those of time t. */
static enum gx_status settle(struct gx_integral *integral, double t)
{
  struct gx_particles *points = integral->points;
  const struct gx_posed *like = integral->mesh->space.posed;
  if (integral->moves) memset(points->lattice, 0, sizeof points->lattice);
  gx_problem_free(integral->posed);
  integral->posed = gx_problem_pose(like->problem, &like->options, points->n, points->X);
  if (!integral->posed)
    return gx_status_set(integral->mesh->space.outcome, GX_FAILED, -1, "out of memory for the budget's integrals");
  if (integral->moves) integral->posed->problem->exact(integral->posed, t, NULL, NULL, points->F, NULL);
  for (size_t p = 0; p < points->n; p++) {
    double J = integral->moves ? gx_particles_jacobian(points, p) : 1;
    points->m[p] = like->options.moduli.density * integral->w[p] / J;
    for (int d = 0; d < points->dim; d++) points->u[d][p] = integral->x[d][p] - points->X[d][p];
  }
  integral->time = t;
  GX_TRY(gx_mesh_weigh(integral->mesh, points->u, NULL));
  return gx_mesh_assemble(integral->mesh, NULL, NULL);
}

/* On a grid that moves along nothing moves under the points. */
enum gx_status gx_integral_place(struct gx_integral *integral, double t)
{
  if (integral->posed && (!integral->moves || integral->time == t)) return GX_OK;
  for (size_t from = 0; from < integral->points->n && integral->moves; from += BLOCK) {
    const struct part part = part_of(integral, from);
    GX_TRY(find_material(integral, &part, t));
  }
  return settle(integral, t);
}

void gx_integral_image(struct gx_integral *integral, struct gx_image *image)
{
  bool placed = integral->posed;
  if (!integral->moves) return;
  GX_IMAGE(image, placed);
  GX_IMAGE(image, integral->time);
  gx_image_reals(image, integral->points->dim, integral->points->X, integral->points->n);
  if (image->loading && !image->failed && placed && settle(integral, integral->time) != GX_OK) image->failed = true;
}

enum gx_status gx_integral_project(struct gx_integral *integral, bool lumped, double *const *value, double *const *field)
{
  struct gx_mass *consistent = integral->mesh->consistent;
  if (lumped) integral->mesh->consistent = NULL;
  enum gx_status status = gx_mesh_project(integral->mesh, value, field);
  integral->mesh->consistent = consistent;
  return status;
}

double gx_integral_norm(const struct gx_integral *integral, double *const *value)
{
  double sum = 0;
  for (int d = 0; d < integral->points->dim; d++)
    for (size_t p = 0; p < integral->points->n; p++) sum += integral->w[p] * value[d][p] * value[d][p];
  return sqrt(sum);
}
