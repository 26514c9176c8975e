/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preconditioned conjugate gradients (Hestenes & Stiefel 1952) for all vector components side by side. With K the mass of a full box
 * and s_i = sqrt(K_ii / M_ii), zero where no particle is, the preconditioner is s K^-1 s: density is smooth beside a cell and so
 * scales away, and what is left to iterate on is the quadrature of the particles and the edge of a body. It starts from zero, so
 * that results do not depend on what was solved before. */
#include "mass_cg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../core/aligned.h"
#include "../core/kernel.h"
#include "../core/vector.h"
#include "mass_band.h"
#include "mass_kronecker.h"
#include "stencil.h"

struct gx_mass_cg {
  const struct gx_grid *grid;
  struct gx_mass_kronecker *box;
  const struct gx_weights *weights; /* borrowed */
  const double *m;                  /* borrowed */
  void *block;
  double *box_diagonal, *scale;                                          /* [stored] */
  double *r[GX_MAX_DIM], *z[GX_MAX_DIM], *p[GX_MAX_DIM], *q[GX_MAX_DIM]; /* [stored] */
  double *value[GX_MAX_DIM];                                             /* [n] */
};

static bool allocate(struct gx_mass_cg *cg, size_t n)
{
  const size_t dim = (size_t)cg->grid->dim, stored = cg->grid->stored;
  double *at = gx_aligned_zeros(((4 * dim + 2) * stored + dim * n) * sizeof *at, &cg->block);
  if (!at) return false;
  cg->box_diagonal = at;
  cg->scale = at + stored;
  at += 2 * stored;
  for (size_t d = 0; d < dim; d++) {
    double **nodal[] = {&cg->r[d], &cg->z[d], &cg->p[d], &cg->q[d]};
    for (int k = 0; k < 4; k++, at += stored) *nodal[k] = at;
    cg->value[d] = at;
    at += n;
  }
  return true;
}

struct gx_mass_cg *gx_mass_cg_create(const struct gx_grid *grid, const struct gx_basis *basis, size_t n)
{
  static const int no_lattice[GX_MAX_DIM];
  struct gx_mass_cg *cg = calloc(1, sizeof *cg);
  if (!cg) return NULL;
  cg->grid = grid;
  cg->box = gx_mass_kronecker_create(grid, no_lattice);
  if (!cg->box || !allocate(cg, n) || gx_mass_kronecker_factor_box(cg->box, basis)) {
    gx_mass_cg_free(cg);
    return NULL;
  }
  gx_mass_kronecker_diagonal(cg->box, cg->box_diagonal);
  return cg;
}

void gx_mass_cg_free(struct gx_mass_cg *cg)
{
  if (!cg) return;
  gx_mass_kronecker_free(cg->box);
  free(cg->block);
  free(cg);
}

/* diagonal[i] += sum_p m_p S_ip^2 */
GX_CORE void add_diagonal(const int dim, const struct gx_weights *w, const double *m, double *restrict diagonal)
{
  for (size_t p = 0; p < w->n; p++) {
    struct gx_stencil stencil;
    gx_stencil_load(dim, w->support, w, p, false, &stencil);
    GX_STENCIL_ROWS(dim, w->support)
    {
      const struct gx_stencil_row row = gx_stencil_row(dim, w, &stencil, k1, k2, false);
      for (int k = 0; k < w->support; k++) {
        double S = row.W * stencil.S[0][k];
        diagonal[row.node + (size_t)k] += m[p] * (S * S);
      }
    }
  }
}

int gx_mass_cg_prepare(struct gx_mass_cg *cg, const struct gx_weights *weights, const double *m)
{
  const struct gx_grid *grid = cg->grid;
  cg->weights = weights;
  cg->m = m;
  memset(cg->scale, 0, grid->stored * sizeof *cg->scale);
  GX_FOR_DIM(grid->dim, add_diagonal(dim, weights, m, cg->scale))
  gx_grid_fold(grid, cg->scale);
  const double most = gx_vector_max(grid->stored, cg->scale), trace = GX_MASS_TRACE * most;
  double least = 0;
  for (size_t i = 0; i < grid->stored; i++) {
    least = fmin(least, cg->scale[i]);
    cg->scale[i] = cg->scale[i] > trace ? sqrt(cg->box_diagonal[i] / cg->scale[i]) : 0;
  }
  return least < GX_MASS_NEGATIVE * most ? -1 : 0;
}

GX_CLONES static void multiply(size_t n, const double *restrict factor, double *restrict value)
{
  for (size_t i = 0; i < n; i++) value[i] *= factor[i];
}

/* z = s K^-1 s r, spread */
static void precondition(struct gx_mass_cg *cg, int d)
{
  const size_t stored = cg->grid->stored;
  memcpy(cg->z[d], cg->r[d], stored * sizeof *cg->z[d]);
  multiply(stored, cg->scale, cg->z[d]);
  gx_mass_kronecker_solve(cg->box, d, cg->z[d]);
  multiply(stored, cg->scale, cg->z[d]);
  gx_grid_spread(cg->grid, cg->z[d]);
}

/* q = M p, folded; at functions that are held z and so p are 0, whatever q is */
static void apply(struct gx_mass_cg *cg)
{
  const struct gx_grid *grid = cg->grid;
  gx_transfer_gather(cg->weights, cg->p, cg->value);
  for (int d = 0; d < grid->dim; d++) memset(cg->q[d], 0, grid->stored * sizeof *cg->q[d]);
  gx_transfer_scatter(cg->weights, cg->m, cg->value, NULL, cg->q);
  for (int d = 0; d < grid->dim; d++) gx_grid_fold(grid, cg->q[d]);
}

/* p <- z + beta p */
GX_CLONES static void turn(size_t n, double beta, const double *restrict z, double *restrict p)
{
  for (size_t i = 0; i < n; i++) p[i] = z[i] + beta * p[i];
}

/* What remains of r z of each component, and where it began. */
struct progress {
  double rz[GX_MAX_DIM], first[GX_MAX_DIM];
};

static bool goes_on(const struct progress *progress, int d)
{
  const double least = GX_MASS_CG_TOLERANCE * GX_MASS_CG_TOLERANCE;
  return progress->rz[d] > least * progress->first[d];
}

static bool begin(struct gx_mass_cg *cg, double *const *field, struct progress *progress)
{
  const size_t stored = cg->grid->stored, bytes = stored * sizeof **field;
  bool any = false;
  for (int d = 0; d < cg->grid->dim; d++) {
    memcpy(cg->r[d], field[d], bytes);
    precondition(cg, d);
    memcpy(cg->p[d], cg->z[d], bytes);
    progress->rz[d] = progress->first[d] = gx_vector_dot(stored, cg->r[d], cg->z[d]);
    if (!isfinite(progress->rz[d]))
      progress->rz[d] = progress->first[d] = 0; /* the field is left */
    else
      memset(field[d], 0, bytes);
    any = any || goes_on(progress, d);
  }
  return any;
}

/* One iteration. Returns -1 when the curvature along a direction is not positive or a number overflows, else whether any component
 * goes on. */
static int iterate(struct gx_mass_cg *cg, double *const *field, struct progress *progress)
{
  const size_t stored = cg->grid->stored;
  int any = 0;
  apply(cg);
  for (int d = 0; d < cg->grid->dim; d++) {
    if (!goes_on(progress, d)) continue;
    double curvature = gx_vector_dot(stored, cg->p[d], cg->q[d]);
    if (!(curvature > 0)) return -1;
    double alpha = progress->rz[d] / curvature;
    gx_vector_add(stored, alpha, cg->p[d], field[d]);
    gx_vector_add(stored, -alpha, cg->q[d], cg->r[d]);
    precondition(cg, d);
    double rz = gx_vector_dot(stored, cg->r[d], cg->z[d]);
    if (!isfinite(rz)) return -1;
    turn(stored, rz / progress->rz[d], cg->z[d], cg->p[d]);
    progress->rz[d] = rz;
    any |= goes_on(progress, d);
  }
  return any;
}

int gx_mass_cg_solve(struct gx_mass_cg *cg, double *const *field)
{
  struct progress progress;
  int iterations = 0, any = begin(cg, field, &progress);
  while (any > 0 && iterations < GX_MASS_CG_MOST) {
    any = iterate(cg, field, &progress);
    iterations++;
  }
  return any ? -1 : iterations;
}
