/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the cases of a study on several threads. A case shares nothing with another, its result is told by its index, and teams give
 * equal bits, so the number of threads changes no bit of any result. */
#include <gridcross/study.h>

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

#include "../core/team.h"

struct pool {
  const struct gx_study *study;
  const struct gx_study_means *means;
  atomic_bool *cancel;
  pthread_mutex_t lock;
  size_t next, done, total;
};

/* Runs one case after the other, with a team of so many threads. */
struct worker {
  struct pool *pool;
  size_t threads;
  pthread_t thread;
};

/* Whether a case has particles enough for a team. */
static bool has_room_for_a_team(const struct gx_study *study)
{
  for (size_t i = 0; i < study->count; i++) {
    const struct gx_value *dimension = &study->cases[i].value[GX_PROBLEM_DIMENSION];
    if (dimension->type == GX_INTEGER && dimension->integer > 1) return true;
  }
  return false;
}

static bool is_skipped(const struct pool *pool, size_t index)
{
  return pool->means->skip && pool->means->skip[index];
}

/* Whether there is one more to run; under the lock. */
static bool take(struct pool *pool, size_t *index)
{
  while (pool->next < pool->study->count && is_skipped(pool, pool->next)) pool->next++;
  if (atomic_load(pool->cancel) || pool->next == pool->study->count) return false;
  *index = pool->next++;
  return true;
}

/* Returns whether the sink has its result. */
static bool run_one(struct pool *pool, size_t index, const struct gx_case_means *means)
{
  const struct gx_case *one = &pool->study->cases[index];
  struct gx_result result = gx_case_run_by(one, means);
  gx_case_time(one, means, pool->study->repeats, &result);
  bool whole = result.outcome.status != GX_CANCELLED && !pool->means->sink.done(pool->means->sink.context, index, &result);
  if (!whole) atomic_store(pool->cancel, true); /* also where an observer failed */
  gx_case_free(&result);
  return whole;
}

static void *work(void *argument)
{
  const struct worker *self = argument;
  struct pool *pool = self->pool;
  const struct gx_progress *progress = pool->means->progress;
  struct gx_team *team = gx_team_create(self->threads);
  const struct gx_case_means means = {.team = team, .cancel = pool->cancel, .observer = pool->means->observer};
  size_t index;
  pthread_mutex_lock(&pool->lock);
  while (take(pool, &index)) {
    pthread_mutex_unlock(&pool->lock);
    bool done = run_one(pool, index, &means);
    pthread_mutex_lock(&pool->lock);
    pool->done += done;
    if (done && progress) progress->done(progress->context, pool->done, pool->total);
  }
  pthread_mutex_unlock(&pool->lock);
  gx_team_free(team);
  return NULL;
}

int gx_study_run(const struct gx_study *study, const struct gx_study_means *means)
{
  atomic_bool nobody = false;
  struct pool pool = {
      .study = study, .means = means, .cancel = means->cancel ? means->cancel : &nobody, .lock = PTHREAD_MUTEX_INITIALIZER};
  gx_status_quiet_gsl(); /* a matrix that cannot be factored is a result */
  for (size_t i = 0; i < study->count; i++) pool.total += !is_skipped(&pool, i);
  size_t threads = means->threads, workers = threads < pool.total ? threads : pool.total, started = 1;
  if (workers < 1) workers = 1;
  struct worker alone = {.pool = &pool, .threads = 1}, *worker = calloc(workers, sizeof *worker);
  bool shared = has_room_for_a_team(study);
  for (size_t i = 0; worker && i < workers; i++)
    worker[i] = (struct worker){.pool = &pool, .threads = shared ? threads / workers + (i < threads % workers) : 1};
  /* Fewer threads than asked for is slower but right, so neither failure is an error. */
  while (worker && started < workers && !pthread_create(&worker[started].thread, NULL, work, &worker[started])) started++;
  work(worker ? &worker[0] : &alone);
  for (size_t i = 1; worker && i < started; i++) pthread_join(worker[i].thread, NULL);
  free(worker);
  pthread_mutex_destroy(&pool.lock);
  return pool.done == pool.total ? 0 : -1;
}
