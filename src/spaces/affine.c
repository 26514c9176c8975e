/* SPDX-License-Identifier: GPL-3.0-or-later */
/* With the moments S (g - x) of each direction in the place of its derivatives, the sums of B and of the affine momentum are those
 * of a gradient and of a force. */
#include "affine.h"

#include <stdlib.h>
#include <string.h>

#include "../bases/locate.h"
#include "../core/aligned.h"
#include "../core/kernel.h"
#include "../core/tensor.h"
#include "../core/vector.h"
#include "mesh.h"

struct gx_affine {
  bool gradient;                /* hats on a grid at rest: C is kept, else B */
  bool moves;                   /* nodes do: g = X + u */
  struct gx_weights weights;    /* of the mesh, with moments S (g - x), m, in the place of D */
  double *site[GX_MAX_DIM];     /* [axis.stored] g at rest, in widths of a cell */
  double *state[GX_MAX_TENSOR]; /* [n] what particles keep: C, 1/s, or B, m^2/s */
  double *own[GX_MAX_DIM];      /* [n] sum w (g - x)^2 of one direction at rest, m^2 */
  /* scratch, [n], and of nodes, [grid.stored] */
  double *T[GX_MAX_TENSOR], *spread[GX_MAX_TENSOR], *value[GX_MAX_DIM], *shift[GX_MAX_DIM];
  double *product[GX_MAX_DIM];
  void *block;
};

static double *hand_out(double **array, int count, size_t length, double *at)
{
  for (int i = 0; i < count; i++, at += length) array[i] = at;
  return at;
}

struct gx_affine *gx_affine_create(const struct gx_mesh *mesh)
{
  const struct gx_grid *grid = &mesh->grid;
  const int dim = grid->dim, tensor = dim * dim;
  const size_t n = mesh->space.particles->n, support = (size_t)mesh->blocks.whole.support;
  size_t sites = 0;
  for (int d = 0; d < dim; d++) sites += (size_t)grid->axis[d].stored;
  struct gx_affine *affine = calloc(1, sizeof *affine);
  if (!affine) return NULL;
  double *at = gx_aligned_zeros(
      (n * (size_t)(3 * tensor + 3 * dim) + n * support * (size_t)dim + grid->stored * (size_t)dim + sites) * sizeof *at,
      &affine->block);
  if (!at) {
    gx_affine_free(affine);
    return NULL;
  }
  affine->moves = !mesh->space.kind->fixed_grid;
  affine->gradient = support == 2 && !affine->moves;
  affine->weights = mesh->blocks.whole;
  at = hand_out(affine->state, tensor, n, at);
  at = hand_out(affine->T, tensor, n, at);
  at = hand_out(affine->spread, tensor, n, at);
  at = hand_out(affine->own, dim, n, at);
  at = hand_out(affine->value, dim, n, at);
  at = hand_out(affine->shift, dim, n, at);
  at = hand_out(affine->weights.D, dim, n * support, at);
  at = hand_out(affine->product, dim, grid->stored, at);
  for (int d = 0; d < dim; d++) {
    at = hand_out(&affine->site[d], 1, (size_t)grid->axis[d].stored, at);
    for (int k = 0; k < grid->axis[d].stored; k++) affine->site[d][k] = mesh->options.basis->site(&grid->axis[d], k);
  }
  return affine;
}

void gx_affine_free(struct gx_affine *affine)
{
  if (!affine) return;
  free(affine->block);
  free(affine);
}

/* own is held above the round-off of its square: it vanishes with the moments on hats' nodes and at the ends of open knots. */
GX_CLONES static void take_moments(const struct gx_axis *axis, const struct gx_weights *weights, int d, const double *restrict x,
                                   const double *restrict site, double *restrict moment, double *restrict own)
{
  const size_t n = weights->n;
  const double h = axis->h, least = 1e-12 * h * h, *restrict S = weights->S[d];
  const int *restrict first = weights->first[d];
  for (size_t p = 0; p < n; p++) {
    double s = gx_locate(axis->periodic, axis->cells, x[p]), sum = 0;
    for (int k = 0; k < weights->support; k++) {
      double arm = (site[first[p] + k] - s) * h;
      moment[(size_t)k * n + p] = S[(size_t)k * n + p] * arm;
      sum += S[(size_t)k * n + p] * arm * arm;
    }
    own[p] = sum > least ? sum : least;
  }
}

void gx_affine_weigh(struct gx_mesh *mesh, const double *const *x)
{
  struct gx_affine *affine = mesh->affine;
  for (int d = 0; d < mesh->grid.dim; d++)
    take_moments(&mesh->grid.axis[d], &mesh->blocks.whole, d, x[d], affine->site[d], affine->weights.D[d], affine->own[d]);
}

GX_CLONES static void multiply(size_t n, const double *restrict a, const double *restrict b, double *restrict product)
{
  for (size_t i = 0; i < n; i++) product[i] = a[i] * b[i];
}

/* sum += sign a b */
GX_CLONES static void add_product(size_t n, double sign, const double *restrict a, const double *b, double *restrict sum)
{
  for (size_t i = 0; i < n; i++) sum[i] += sign * a[i] * b[i];
}

/* correlation_b += sum_i w f_i u_ib - (sum_i w f_i)(sum_i w u_ib), f a nodal field whose sum at particles is `mean`; that of u is in
 * shift. */
static void add_correlation(struct gx_mesh *mesh, const double *f, const double *mean, double *const *correlation)
{
  struct gx_affine *affine = mesh->affine;
  for (int b = 0; b < mesh->grid.dim; b++) multiply(mesh->grid.stored, f, mesh->u[b], affine->product[b]);
  gx_transfer_gather(&mesh->blocks.whole, affine->product, affine->value);
  for (int b = 0; b < mesh->grid.dim; b++) {
    gx_vector_add(mesh->blocks.whole.n, 1, affine->value[b], correlation[b]);
    add_product(mesh->blocks.whole.n, -1, mean, affine->shift[b], correlation[b]);
  }
}

/* spread = D. Overwrites T. */
static void take_spread(struct gx_mesh *mesh)
{
  struct gx_affine *affine = mesh->affine;
  const int dim = mesh->grid.dim;
  const size_t n = mesh->blocks.whole.n;
  for (int k = 0; k < dim * dim; k++) memset(affine->spread[k], 0, n * sizeof(double));
  for (int d = 0; d < dim; d++) memcpy(affine->spread[d * dim + d], affine->own[d], n * sizeof(double));
  if (!affine->moves) return;
  gx_transfer_gather(&mesh->blocks.whole, mesh->u, affine->shift);
  gx_transfer_gather_gradient(&affine->weights, mesh->u, affine->T); /* sum w u (g - X)^T */
  for (int a = 0; a < dim; a++) {
    for (int b = 0; b < dim; b++) {
      gx_vector_add(n, 1, affine->T[a * dim + b], affine->spread[a * dim + b]);
      gx_vector_add(n, 1, affine->T[b * dim + a], affine->spread[a * dim + b]);
    }
    add_correlation(mesh, mesh->u[a], affine->shift[a], affine->spread + a * dim);
  }
}

/* T <- T A^-1 with `inverse`, else T A. */
GX_CORE void right_points(const int dim, size_t n, const bool inverse, double *const *A, double *const *T)
{
  for (size_t p = 0; p < n; p++) {
    double a[GX_MAX_TENSOR], c[GX_MAX_TENSOR], t[GX_MAX_TENSOR], out[GX_MAX_TENSOR];
    gx_tensor_load(dim, A, p, a);
    gx_tensor_load(dim, T, p, t);
    double J = inverse ? gx_tensor_cofactor(dim, a, c) : 1;
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++) {
        double sum = 0; /* A^-1 = c^T / J */
        for (int k = 0; k < dim; k++) sum += t[i * dim + k] * (inverse ? c[j * dim + k] : a[k * dim + j]);
        out[i * dim + j] = sum / J;
      }
    gx_tensor_store(dim, T, p, out);
  }
}

GX_CLONES static void multiply_right(int dimension, size_t n, bool inverse, double *const *A, double *const *T)
{
  if (inverse)
    GX_FOR_DIM(dimension, right_points(dim, n, true, A, T))
  else
    GX_FOR_DIM(dimension, right_points(dim, n, false, A, T))
}

/* What particles keep of a nodal field: B or C. */
static void take(struct gx_mesh *mesh, double *const *field, double *const *state)
{
  struct gx_affine *affine = mesh->affine;
  const int dim = mesh->grid.dim;
  gx_transfer_gather_gradient(affine->gradient ? &mesh->blocks.whole : &affine->weights, field, state);
  if (!affine->moves) return;
  double *const *mean = affine->spread; /* scratch here */
  gx_transfer_gather(&mesh->blocks.whole, mesh->u, affine->shift);
  gx_transfer_gather(&mesh->blocks.whole, field, mean);
  for (int a = 0; a < dim; a++) add_correlation(mesh, field[a], mean[a], state + a * dim);
}

void gx_affine_gather(struct gx_mesh *mesh)
{
  take(mesh, mesh->v, mesh->affine->state);
}

void gx_affine_image(struct gx_mesh *mesh, struct gx_image *image)
{
  gx_image_reals(image, mesh->grid.dim * mesh->grid.dim, mesh->affine->state, mesh->space.particles->n);
}

/* The part of g - x that nodes have moved by, u_i - sum w u: momentum_i += sum_p w m C (u_i - shift). C in T. */
static void scatter_moved(struct gx_mesh *mesh, double *const *momentum)
{
  struct gx_affine *affine = mesh->affine;
  const int dim = mesh->grid.dim;
  for (int b = 0; b < dim; b++) {
    double *column[GX_MAX_DIM];
    for (int a = 0; a < dim; a++) {
      column[a] = affine->T[a * dim + b];
      memset(affine->product[a], 0, mesh->grid.stored * sizeof(double));
    }
    gx_transfer_scatter(&mesh->blocks.whole, mesh->space.particles->m, column, NULL, affine->product);
    for (int a = 0; a < dim; a++) add_product(mesh->grid.stored, 1, affine->product[a], mesh->u[b], momentum[a]);
  }
  for (int a = 0; a < dim; a++) {
    memset(affine->value[a], 0, mesh->blocks.whole.n * sizeof(double));
    for (int b = 0; b < dim; b++)
      add_product(mesh->blocks.whole.n, -1, affine->T[a * dim + b], affine->shift[b], affine->value[a]);
  }
  gx_transfer_scatter(&mesh->blocks.whole, mesh->space.particles->m, affine->value, NULL, momentum);
}

void gx_affine_scatter(struct gx_mesh *mesh, double *const *momentum)
{
  struct gx_affine *affine = mesh->affine;
  const int dim = mesh->grid.dim;
  const size_t n = mesh->blocks.whole.n;
  if (!affine->gradient) take_spread(mesh);
  for (int k = 0; k < dim * dim; k++) memcpy(affine->T[k], affine->state[k], n * sizeof(double));
  if (!affine->gradient) multiply_right(dim, n, true, affine->spread, affine->T);
  if (affine->moves) scatter_moved(mesh, momentum);
  for (int k = 0; k < dim * dim; k++)
    for (size_t p = 0; p < n; p++) affine->T[k][p] *= mesh->space.particles->m[p];
  gx_transfer_scatter_force(&affine->weights, affine->T, NULL, momentum);
}

/* B += v (sum_i w g_i - x)^T: particles that started from u_p and not from sum_i w u_i keep that distance from their nodes. */
static void add_distance(struct gx_mesh *mesh, double ahead, double *const *B)
{
  struct gx_affine *affine = mesh->affine;
  const struct gx_particles *particles = mesh->space.particles;
  const int dim = mesh->grid.dim;
  const size_t n = particles->n;
  gx_transfer_gather(&mesh->blocks.whole, mesh->u, affine->shift);
  gx_transfer_gather(&mesh->blocks.whole, mesh->a, affine->value);
  for (int a = 0; a < dim; a++)
    for (int b = 0; b < dim; b++)
      for (size_t p = 0; p < n; p++)
        B[a * dim + b][p] += (particles->v[a][p] + ahead * affine->value[a][p]) * (affine->shift[b][p] - particles->u[b][p]);
}

void gx_affine_spin(struct gx_space *space, double ahead, double *spin)
{
  struct gx_mesh *mesh = (struct gx_mesh *)space;
  struct gx_affine *affine = mesh->affine;
  const int dim = mesh->grid.dim;
  const size_t n = mesh->blocks.whole.n;
  if (!affine) return;
  if (affine->gradient) take_spread(mesh);
  double *const *B = affine->T;
  for (int k = 0; k < dim * dim; k++) memset(B[k], 0, n * sizeof(double));
  if (ahead != 0) take(mesh, mesh->a, B);
  for (int k = 0; k < dim * dim; k++)
    for (size_t p = 0; p < n; p++) B[k][p] = affine->state[k][p] + ahead * B[k][p];
  if (affine->gradient) multiply_right(dim, n, false, affine->spread, B);
  if (affine->moves) add_distance(mesh, ahead, B);
  for (int d = 0; d < dim; d++) /* sum w m (g - x)_d v_e, as in gx_momentum_of */
    for (int e = 0; e < dim; e++)
      if (e != d) spin[3 - d - e] += ((e - d + 3) % 3 == 1 ? 1 : -1) * gx_vector_dot(n, space->particles->m, B[e * dim + d]);
}
