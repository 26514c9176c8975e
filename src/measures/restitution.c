/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which particles are of which body is told by their reference positions, once. */
#include "restitution.h"

#include <math.h>
#include <stdlib.h>

#include "../spaces/mesh.h"

struct gx_restitution {
  const struct gx_space *space;
  double approach;   /* m/s, at the start */
  unsigned char *of; /* [n] 0 or 1: the body of a particle */
};

/* The two bodies, along the line from the centre of the first to that of the second. */
struct pair {
  double normal[GX_MAX_DIM];
  double parting; /* speed, m/s */
  double gap;     /* between planes across the line, m */
};

static struct pair look(const struct gx_restitution *restitution)
{
  const struct gx_particles *particles = restitution->space->particles;
  const int dim = particles->dim;
  double mass[2] = {0}, x[2][GX_MAX_DIM] = {{0}}, v[2][GX_MAX_DIM] = {{0}}, length = 0, reach[2] = {-INFINITY, -INFINITY};
  struct pair pair = {.parting = 0};
  for (size_t p = 0; p < particles->n; p++) {
    int body = restitution->of[p];
    mass[body] += particles->m[p];
    for (int d = 0; d < dim; d++) {
      x[body][d] += particles->m[p] * (particles->X[d][p] + particles->u[d][p]);
      v[body][d] += particles->m[p] * particles->v[d][p];
    }
  }
  for (int d = 0; d < dim; d++) {
    pair.normal[d] = x[1][d] / mass[1] - x[0][d] / mass[0];
    length += pair.normal[d] * pair.normal[d];
  }
  for (int d = 0; d < dim; d++) {
    pair.normal[d] /= sqrt(length);
    pair.parting += pair.normal[d] * (v[1][d] / mass[1] - v[0][d] / mass[0]);
  }
  for (size_t p = 0; p < particles->n; p++) {
    double along = 0;
    for (int d = 0; d < dim; d++) along += pair.normal[d] * (particles->X[d][p] + particles->u[d][p]);
    int body = restitution->of[p];
    reach[body] = fmax(reach[body], body ? -along : along);
  }
  pair.gap = -reach[1] - reach[0];
  return pair;
}

struct gx_restitution *gx_restitution_create(const struct gx_space *space)
{
  const struct gx_particles *particles = space->particles;
  const struct gx_posed *posed = space->posed;
  struct gx_restitution *restitution = calloc(1, sizeof *restitution);
  if (!restitution) return NULL;
  *restitution = (struct gx_restitution){.space = space, .of = malloc(particles->n)};
  if (!restitution->of) {
    free(restitution);
    return NULL;
  }
  for (size_t p = 0; p < particles->n; p++) {
    double X[GX_MAX_DIM] = {0};
    for (int d = 0; d < particles->dim; d++) X[d] = particles->X[d][p];
    restitution->of[p] = posed->problem->second(&posed->options, X);
  }
  restitution->approach = -look(restitution).parting;
  return restitution;
}

void gx_restitution_free(struct gx_restitution *restitution)
{
  if (!restitution) return;
  free(restitution->of);
  free(restitution);
}

double gx_restitution_value(const struct gx_restitution *restitution)
{
  const struct gx_axis *axis = &((const struct gx_mesh *)restitution->space)->grid.axis[0];
  const struct pair pair = look(restitution);
  double steepest = 0;
  for (int d = 0; d < restitution->space->particles->dim; d++) steepest = fmax(steepest, fabs(pair.normal[d]));
  bool parted = pair.parting > 0 && pair.gap * steepest > axis->support * axis->h;
  return parted && restitution->approach > 0 ? pair.parting / restitution->approach : NAN;
}
