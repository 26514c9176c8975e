/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Gauss points of a step's start move with the material, so that what the step adds to their velocity can be compared with the
 * exact change whatever the number of its stages. */
#include "truncation.h"

#include <stdlib.h>
#include <string.h>

#include "../core/large.h"
#include "../core/vector.h"

struct vector_field {
  double *component[GX_MAX_DIM];
};

struct gx_truncation {
  struct gx_integral *integral;
  struct gx_posed *posed;                   /* at X; NULL: the integral's */
  struct vector_field X;                    /* [n] of the points when the step started */
  struct vector_field x;                    /* where they are in the grid, at the stage at hand */
  struct vector_field value;                /* scratch */
  struct vector_field exact;                /* scratch */
  struct vector_field nodal, change, ideal; /* velocity of the grid, its change, the change by exact accelerations */
  double *block;
};

struct gx_truncation *gx_truncation_create(struct gx_integral *integral)
{
  struct gx_truncation *truncation = calloc(1, sizeof *truncation);
  size_t n = integral->points->n, dim = (size_t)integral->points->dim;
  double *at = truncation ? gx_large_zeros(7 * dim * n * sizeof *at) : NULL;
  if (!at) {
    free(truncation);
    return NULL;
  }
  *truncation = (struct gx_truncation){.integral = integral, .block = at};
  struct vector_field *fields[] = {&truncation->X,     &truncation->x,      &truncation->value, &truncation->exact,
                                   &truncation->nodal, &truncation->change, &truncation->ideal};
  for (size_t k = 0; k < sizeof fields / sizeof *fields; k++)
    for (size_t d = 0; d < dim; d++, at += n) fields[k]->component[d] = at;
  return truncation;
}

void gx_truncation_free(struct gx_truncation *truncation)
{
  if (!truncation) return;
  gx_problem_free(truncation->posed);
  free(truncation->block);
  free(truncation);
}

int gx_truncation_open(struct gx_truncation *truncation, bool leaves)
{
  const struct gx_integral *integral = truncation->integral;
  size_t n = integral->points->n;
  gx_problem_free(truncation->posed);
  truncation->posed = NULL;
  for (int d = 0; d < integral->points->dim; d++) {
    memset(truncation->change.component[d], 0, n * sizeof(double));
    memset(truncation->ideal.component[d], 0, n * sizeof(double));
    memcpy(truncation->X.component[d], integral->points->X[d], n * sizeof(double));
  }
  if (!leaves || !integral->moves) return 0;
  const struct gx_posed *posed = integral->posed;
  truncation->posed = gx_problem_pose(posed->problem, &posed->options, n, truncation->X.component);
  return truncation->posed ? 0 : -1;
}

double gx_truncation_acceleration(struct gx_truncation *truncation, double t, double *const *field)
{
  const struct gx_integral *integral = truncation->integral;
  double **value = truncation->value.component, **exact = truncation->exact.component;
  gx_mesh_gather(integral->mesh, field, value, NULL);
  integral->posed->problem->exact(integral->posed, t, NULL, NULL, NULL, exact);
  for (int d = 0; d < integral->points->dim; d++) gx_vector_add(integral->points->n, -1, exact[d], value[d]);
  return gx_integral_norm(integral, value);
}

static const struct gx_posed *posed_of(const struct gx_truncation *truncation)
{
  return truncation->posed ? truncation->posed : truncation->integral->posed;
}

void gx_truncation_add(struct gx_truncation *truncation, const struct gx_space *space, double t, double span)
{
  const struct gx_posed *posed = posed_of(truncation);
  bool moves = truncation->integral->moves;
  double **x = moves ? truncation->x.component : truncation->X.component;
  double **exact = truncation->exact.component, **value = truncation->value.component;
  int dim = truncation->integral->points->dim;
  posed->problem->exact(posed, t, moves ? x : NULL, NULL, NULL, exact);
  for (int d = 0; d < dim && moves; d++) gx_vector_add(posed->n, 1, truncation->X.component[d], x[d]);
  space->kind->field(space, GX_FIELD_ACCELERATION, posed->n, x, value);
  for (int d = 0; d < dim; d++) {
    gx_vector_add(posed->n, span, exact[d], truncation->ideal.component[d]);
    gx_vector_add(posed->n, span, value[d], truncation->change.component[d]);
  }
}

void gx_truncation_velocity(struct gx_truncation *truncation, double *const *field)
{
  gx_mesh_gather(truncation->integral->mesh, field, truncation->nodal.component, NULL);
}

struct gx_truncation_errors gx_truncation_close(struct gx_truncation *truncation, double start, double end)
{
  const struct gx_integral *integral = truncation->integral;
  const struct gx_posed *posed = posed_of(truncation);
  double **before = truncation->exact.component, **after = truncation->value.component;
  double **nodal = truncation->nodal.component, **change = truncation->change.component, **ideal = truncation->ideal.component;
  posed->problem->exact(posed, start, NULL, before, NULL, NULL);
  posed->problem->exact(posed, end, NULL, after, NULL, NULL);
  for (int d = 0; d < integral->points->dim; d++)
    for (size_t p = 0; p < integral->points->n; p++) {
      nodal[d][p] += change[d][p] - after[d][p];
      change[d][p] -= after[d][p] - before[d][p];
      ideal[d][p] -= after[d][p] - before[d][p];
    }
  return (struct gx_truncation_errors){gx_integral_norm(integral, nodal), gx_integral_norm(integral, change),
                                       gx_integral_norm(integral, ideal)};
}
