/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Passes over particles in blocks: each particle is visited once with its own weights, blocks that may be scattered at once share no
 * node, and sums have the same bits for any team. */
#include <stdatomic.h>
#include <string.h>

#include "../points.h"
#include "spaces/blocks.h"

enum { N = 3000, CELLS = 7 };

struct setting {
  struct points points;
  double *X[GX_MAX_DIM], *u[GX_MAX_DIM], *half[GX_MAX_DIM], m[N];
  struct gx_blocks blocks;
};

static const double low[GX_MAX_DIM] = {0, 0, 0}, high[GX_MAX_DIM] = {1, 1, 1};

/* Particles anywhere, in no order. */
static struct setting *create(int dim, int degree, bool whole, struct gx_team *team)
{
  struct setting *setting = calloc(1, sizeof *setting);
  double *x[GX_MAX_DIM];
  uint64_t seed = 59;
  for (int d = 0; d < dim; d++) {
    double **arrays[] = {&setting->X[d], &setting->u[d], &setting->half[d], &x[d]};
    for (int i = 0; i < 4; i++) *arrays[i] = malloc(N * sizeof(double));
    for (int p = 0; p < N; p++) {
      setting->X[d][p] = check_random(&seed, 0, 1);
      setting->u[d][p] = check_random(&seed, 0, 1) - setting->X[d][p];
      x[d][p] = setting->X[d][p] + setting->u[d][p];
      setting->half[d][p] = 0.25 / CELLS;
    }
  }
  for (int p = 0; p < N; p++) setting->m[p] = check_random(&seed, 0.1, 1);
  setting->points = points_at(gx_basis_find("bspline"), dim, CELLS, false, degree, N, x, setting->half);
  for (int d = 0; d < dim; d++) free(x[d]);
  assert_int_equal(gx_blocks_init(&setting->blocks, &setting->points.grid, gx_basis_find("bspline"), N, setting->X, whole, team),
                   0);
  assert_int_equal(gx_blocks_place(&setting->blocks, setting->u, low, high).d, -1);
  return setting;
}

static void destroy(struct setting *setting)
{
  for (int d = 0; d < setting->points.grid.dim; d++) {
    free(setting->X[d]);
    free(setting->u[d]);
    free(setting->half[d]);
  }
  gx_blocks_free(&setting->blocks);
  points_free(&setting->points);
  free(setting);
}

struct visits {
  struct setting *setting;
  atomic_int seen[N];
  atomic_int wrong;
};

static void visit(void *context, struct gx_block *block)
{
  struct visits *visits = context;
  const struct gx_weights *all = &visits->setting->points.weights, *own = &block->weights;
  for (size_t p = 0; p < block->n; p++) {
    atomic_fetch_add(&visits->seen[block->from + p], 1);
    for (int d = 0; d < all->dim; d++) {
      bool same = own->first[d][p] == all->first[d][block->from + p];
      for (int k = 0; k < all->support; k++) {
        same = same && own->S[d][(size_t)k * own->n + p] == all->S[d][(size_t)k * N + block->from + p];
        same = same && own->D[d][(size_t)k * own->n + p] == all->D[d][(size_t)k * N + block->from + p];
      }
      atomic_fetch_add(&visits->wrong, !same);
    }
  }
}

static void test_each_particle_is_visited_once(void **unused)
{
  (void)unused;
  struct gx_team *team = gx_team_create(3);
  for (int dim = 1; dim <= GX_MAX_DIM; dim++)
    for (int degree = 1; degree <= 4; degree++) {
      struct setting *setting = create(dim, degree, true, team);
      void (*const passes[])(struct gx_blocks *, gx_blocks_visit *, void *) = {gx_blocks_each, gx_blocks_each_apart};
      for (int i = 0; i < 2; i++) {
        struct visits visits = {.setting = setting};
        passes[i](&setting->blocks, visit, &visits);
        for (int p = 0; p < N; p++) assert_int_equal(atomic_load(&visits.seen[p]), 1);
        assert_int_equal(atomic_load(&visits.wrong), 0);
      }
      for (int d = 0; d < dim; d++) /* kept for all, where asked for */
        assert_memory_equal(setting->blocks.whole.S[d], setting->points.weights.S[d],
                            N * (size_t)setting->points.weights.support * sizeof(double));
      destroy(setting);
    }
  gx_team_free(team);
}

static void test_slabs_scattered_at_once_share_no_node(void **unused)
{
  (void)unused;
  for (int dim = 2; dim <= GX_MAX_DIM; dim++)
    for (int degree = 1; degree <= 6; degree++) {
      struct setting *setting = create(dim, degree, false, NULL);
      const struct gx_blocks *blocks = &setting->blocks;
      const struct gx_weights *weights = &setting->points.weights;
      int end = -1; /* last node layer of the slab before the last */
      int before = -1;
      for (size_t slab = 0; slab < blocks->slabs; slab++) {
        int lowest = CELLS * 9, highest = -1;
        for (size_t i = blocks->start[slab]; i < blocks->start[slab + 1]; i++) {
          int first = weights->first[dim - 1][blocks->order[i]];
          lowest = first < lowest ? first : lowest;
          highest = first > highest ? first : highest;
          assert_true(i == blocks->start[slab] || blocks->order[i - 1] < blocks->order[i]);
        }
        assert_true(highest >= 0 && lowest > end);
        end = before;
        before = highest + weights->support - 1;
      }
      assert_int_equal(blocks->start[blocks->slabs], N);
      destroy(setting);
    }
}

struct scatter {
  struct setting *setting;
  double *total;
};

static void scatter(void *context, struct gx_block *block)
{
  struct scatter *scatter = context;
  gx_transfer_scatter(&block->weights, scatter->setting->m + block->from, NULL, scatter->total, NULL);
}

static void test_sums_do_not_depend_on_the_team(void **unused)
{
  (void)unused;
  for (int dim = 2; dim <= GX_MAX_DIM; dim++) {
    double *alone = NULL;
    for (size_t threads = 1; threads <= 7; threads += 2) {
      struct gx_team *team = gx_team_create(threads);
      struct setting *setting = create(dim, 2, false, team);
      size_t stored = setting->points.grid.stored;
      struct scatter context = {setting, calloc(stored, sizeof(double))};
      gx_blocks_each_apart(&setting->blocks, scatter, &context);
      if (alone) assert_memory_equal(alone, context.total, stored * sizeof(double));
      if (alone) free(context.total);
      if (!alone) {
        alone = context.total;
        double *plain = calloc(stored, sizeof(double));
        gx_transfer_scatter(&setting->points.weights, setting->m, NULL, plain, NULL);
        for (size_t i = 0; i < stored; i++) NEAR(alone[i], plain[i], 1e-12);
        free(plain);
      }
      destroy(setting);
      gx_team_free(team);
    }
    free(alone);
  }
}

/* The first direction that has one, the lowest particle; those on the very ends are within. */
static void test_strays_are_told(void **unused)
{
  (void)unused;
  struct gx_team *team = gx_team_create(2);
  for (int dim = 1; dim <= GX_MAX_DIM; dim++) {
    struct setting *setting = create(dim, 2, false, team);
    for (int p = 3; p <= 4; p++) {
      setting->X[dim - 1][p] = p == 3 ? low[dim - 1] : high[dim - 1];
      setting->u[dim - 1][p] = 0;
    }
    struct gx_blocks_stray stray = gx_blocks_place(&setting->blocks, setting->u, low, high);
    assert_int_equal(stray.d, -1);
    setting->u[dim - 1][7] = 3;
    stray = gx_blocks_place(&setting->blocks, setting->u, low, high);
    assert_true(stray.d == dim - 1 && stray.particle == 7 && !stray.wide);
    setting->u[0][N - 1] = NAN;
    setting->u[0][N - 9] = -2;
    stray = gx_blocks_place(&setting->blocks, setting->u, low, high);
    assert_true(stray.d == 0 && stray.particle == (dim == 1 ? 7 : N - 9) && !stray.wide);
    destroy(setting);
  }
  gx_team_free(team);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_each_particle_is_visited_once),
      cmocka_unit_test(test_slabs_scattered_at_once_share_no_node),
      cmocka_unit_test(test_sums_do_not_depend_on_the_team),
      cmocka_unit_test(test_strays_are_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
