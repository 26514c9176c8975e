/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Norms add up squares of pieces whose exact solution and stresses are made on the spot: to keep those of every particle would take
 * more memory than the particles, and more time to fetch than to make. */
#include "errors.h"

#include <math.h>
#include <string.h>

#include "../core/kernel.h"
#include "../core/vector.h"

enum { PIECE = GX_VECTOR_PIECE, ROW = PIECE + 8 }; /* rows a cache line apart: not all in the same set */

typedef double row[ROW];

/* The quantities of a piece of the particles, by component. */
struct values {
  double *of[GX_QUANTITIES][GX_MAX_TENSOR];
};

/* Where those are that the particles do not have. */
struct room {
  row u[GX_MAX_DIM], v[GX_MAX_DIM], F[GX_MAX_TENSOR], P[GX_MAX_TENSOR], stress[GX_MAX_TENSOR];
};

static void rows(int count, row *room, double **array)
{
  for (int k = 0; k < count; k++) array[k] = room[k];
}

static void part(int count, double *const *array, size_t from, double **piece)
{
  for (int k = 0; k < count; k++) piece[k] = array[k] + from;
}

static bool is_in(unsigned wanted, enum gx_quantity quantity)
{
  return wanted >> quantity & 1;
}

/* wanted: bits of quantities */
static void find_values(const struct gx_errors_state *state, size_t from, size_t n, unsigned wanted, struct room *room,
                        struct values *values)
{
  const struct gx_particles *particles = state->space->particles;
  const int dim = particles->dim;
  double *F[GX_MAX_TENSOR], *P[GX_MAX_TENSOR];
  part(dim, particles->u, from, values->of[GX_DISPLACEMENT]);
  part(dim, state->v, from, values->of[GX_VELOCITY]);
  if (!is_in(wanted, GX_STRESS)) return;
  part(dim * dim, particles->F, from, F);
  part(dim * dim, particles->P, from, P);
  rows(dim * dim, room->stress, values->of[GX_STRESS]);
  gx_material_cauchy(dim, n, F, P, values->of[GX_STRESS]);
}

static void find_exact(const struct gx_errors_state *state, size_t from, size_t n, unsigned wanted, struct room *room,
                       struct values *values)
{
  const struct gx_posed posed = gx_problem_part(state->space->posed, from, n);
  const int dim = posed.options.dim;
  double *F[GX_MAX_TENSOR], *P[GX_MAX_TENSOR];
  rows(dim, room->u, values->of[GX_DISPLACEMENT]);
  rows(dim, room->v, values->of[GX_VELOCITY]);
  rows(dim * dim, room->stress, values->of[GX_STRESS]);
  rows(dim * dim, room->F, F);
  rows(dim * dim, room->P, P);
  posed.problem->exact(&posed, state->t, is_in(wanted, GX_DISPLACEMENT) ? values->of[GX_DISPLACEMENT] : NULL,
                       is_in(wanted, GX_VELOCITY) ? values->of[GX_VELOCITY] : NULL, is_in(wanted, GX_STRESS) ? F : NULL, NULL);
  if (!is_in(wanted, GX_STRESS)) return;
  posed.problem->material->piola(&posed.options.moduli, dim, n, F, P);
  gx_material_cauchy(dim, n, F, P, values->of[GX_STRESS]);
}

/* Norms under way. */
struct norms {
  double parts[GX_VECTOR_LANES], most; /* of squares */
};

/* Half of the partial sums: as many as compilers compare at once everywhere. */
enum { HALF = GX_VECTOR_LANES / 2 };
typedef double lanes __attribute__((vector_size(HALF * sizeof(double))));
typedef long long truths __attribute__((vector_size(HALF * sizeof(double))));

/* Squares of some points from p on are summed and compared; lanes past them count 0. */
GX_CORE void add_some(const int components, const bool differ, size_t some, size_t p, const double *const *value,
                      const double *const *exact, lanes *sum, lanes *most)
{
  lanes square = {0};
  for (int k = 0; k < components; k++) {
    lanes error = {0}, less = {0};
    memcpy(&error, value[k] + p, some * sizeof(double));
    if (differ) memcpy(&less, exact[k] + p, some * sizeof(double));
    error -= less;
    square += error * error;
  }
  *sum += square;
  const truths larger = square > *most;
  *most = (lanes)(((truths)square & larger) | ((truths)*most & ~larger));
}

GX_CORE void add_points(const int components, const bool differ, size_t n, double *const *value, double *const *exact,
                        struct norms *norms)
{
  const double *in[GX_MAX_TENSOR], *less[GX_MAX_TENSOR];
  const size_t whole = n - n % GX_VECTOR_LANES;
  lanes sum[2], most[2] = {{0}, {0}};
  for (int k = 0; k < components; k++) {
    in[k] = value[k];
    less[k] = differ ? exact[k] : NULL;
  }
  memcpy(sum, norms->parts, sizeof sum);
  for (size_t p = 0; p < whole; p += GX_VECTOR_LANES)
    for (size_t h = 0; h < 2; h++) add_some(components, differ, HALF, p + h * HALF, in, less, &sum[h], &most[h]);
  for (size_t p = whole, h = 0; p < n; p += HALF, h++)
    add_some(components, differ, n - p < HALF ? n - p : HALF, p, in, less, &sum[h], &most[h]);
  memcpy(norms->parts, sum, sizeof sum);
  for (int k = 0; k < HALF; k++) norms->most = fmax(norms->most, fmax(most[0][k], most[1][k]));
}

/* Adds a piece of so many components. exact: NULL: 0 */
GX_CLONES static void add_piece(struct norms *norms, size_t n, int components, double *const *value, double *const *exact)
{
#define ADD(count)                                                                                                               \
  case count:                                                                                                                    \
    if (exact)                                                                                                                   \
      add_points(count, true, n, value, exact, norms);                                                                           \
    else                                                                                                                         \
      add_points(count, false, n, value, exact, norms);                                                                          \
    break;
  switch (components) {
    ADD(1)
    ADD(2)
    ADD(3)
    ADD(4)
    ADD(9)
  }
#undef ADD
}

void gx_errors_finish(double square, double most, size_t n, double *error)
{
  error[GX_INF] = sqrt(most);
  error[GX_RMS] = sqrt(square / (double)n);
  error[GX_L2N] = sqrt(square) / (double)n;
}

static void finish(const struct norms *norms, size_t n, double *error)
{
  gx_errors_finish(gx_vector_total(norms->parts), norms->most, n, error);
}

/* other: NULL: the exact solution */
static void compare(const struct gx_errors_state *state, const struct gx_errors_state *other,
                    double error[GX_QUANTITIES][GX_NORMS])
{
  const struct gx_particles *particles = state->space->particles;
  const int dim = particles->dim;
  const unsigned stress = 1u << GX_STRESS, all = (1u << GX_QUANTITIES) - 1;
  const unsigned wanted = state->space->posed->problem->material->piola ? all : all & ~stress;
  struct norms norms[GX_QUANTITIES] = {{{0}, 0}};
  struct room room, other_room;
  struct values values, other_values;
  for (size_t from = 0; from < particles->n; from += PIECE) {
    const size_t n = gx_vector_piece(particles->n, from);
    find_values(state, from, n, wanted, &room, &values);
    if (other)
      find_values(other, from, n, wanted, &other_room, &other_values);
    else
      find_exact(state, from, n, wanted, &other_room, &other_values);
    for (int q = 0; q < GX_QUANTITIES; q++)
      if (is_in(wanted, (enum gx_quantity)q))
        add_piece(&norms[q], n, q == GX_STRESS ? dim * dim : dim, values.of[q], other_values.of[q]);
  }
  for (int q = 0; q < GX_QUANTITIES; q++)
    if (is_in(wanted, (enum gx_quantity)q)) finish(&norms[q], particles->n, error[q]);
}

static void no_errors(double error[GX_QUANTITIES][GX_NORMS])
{
  for (int q = 0; q < GX_QUANTITIES; q++)
    for (int k = 0; k < GX_NORMS; k++) error[q][k] = NAN;
}

void gx_errors_norms(const struct gx_errors_state *state, double error[GX_QUANTITIES][GX_NORMS])
{
  no_errors(error);
  if (state->space->posed->problem->exact) compare(state, NULL, error);
}

void gx_errors_difference(const struct gx_errors_state *state, const struct gx_errors_state *other,
                          double error[GX_QUANTITIES][GX_NORMS])
{
  no_errors(error);
  compare(state, other, error);
}

void gx_errors_component(const struct gx_errors_state *state, enum gx_quantity quantity, int component, double *error)
{
  const size_t all = state->space->particles->n;
  struct room room, exact_room;
  struct values values, exact;
  for (size_t from = 0; from < all; from += PIECE) {
    const size_t n = gx_vector_piece(all, from);
    find_values(state, from, n, 1u << quantity, &room, &values);
    find_exact(state, from, n, 1u << quantity, &exact_room, &exact);
    for (size_t p = 0; p < n; p++) error[from + p] = values.of[quantity][component][p] - exact.of[quantity][component][p];
  }
}

void gx_errors_of_vectors(size_t n, int dim, double *const *vector, double error[GX_NORMS])
{
  struct norms norms = {{0}, 0};
  double *piece[GX_MAX_DIM];
  for (size_t from = 0; from < n; from += PIECE) {
    part(dim, vector, from, piece);
    add_piece(&norms, gx_vector_piece(n, from), dim, piece, NULL);
  }
  finish(&norms, n, error);
}
