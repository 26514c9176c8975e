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
  const struct gx_source *source;
  atomic_bool *cancel;
  pthread_mutex_t lock;
  pthread_cond_t freed;
  size_t idle; /* threads that work on no case, of all that were asked for */
  bool drained;
  size_t taken, done, total; /* total: 0 if nobody knows */
};

/* Threads for the next case: one, or its share of those that are idle where its particles can be shared out. */
static size_t threads_for(const struct pool *pool, size_t index, double share)
{
  const struct gx_value *dimension = &pool->study->cases[index].value[GX_PROBLEM_DIMENSION];
  if (dimension->type != GX_INTEGER || dimension->integer < 2) return 1;
  size_t threads = (size_t)((double)pool->idle * share + 0.5);
  return threads < 1 ? 1 : threads > pool->idle ? pool->idle : threads;
}

/* Waits for an idle thread and takes one more case. Returns its threads, 0: there is none; under the lock. */
static size_t take(struct pool *pool, size_t *index)
{
  double share = 0;
  while (!pool->idle && !pool->drained) pthread_cond_wait(&pool->freed, &pool->lock);
  if (!pool->drained) pool->drained = atomic_load(pool->cancel) || !pool->source->take(pool->source->context, index, &share);
  if (pool->drained) return 0;
  size_t threads = threads_for(pool, *index, share);
  pool->idle -= threads;
  pool->taken++;
  return threads;
}

/* Returns whether the sink has its result. */
static bool run_one(struct pool *pool, size_t index, size_t threads)
{
  const struct gx_case *one = &pool->study->cases[index];
  struct gx_team *team = threads > 1 ? gx_team_create(threads) : NULL;
  const struct gx_case_means means = {.team = team, .cancel = pool->cancel, .observer = pool->means->observer};
  struct gx_result result = gx_case_run_by(one, &means);
  gx_case_time(one, &means, pool->study->repeats, &result);
  gx_team_free(team);
  bool whole = result.outcome.status != GX_CANCELLED && !pool->means->sink.done(pool->means->sink.context, index, &result);
  if (!whole) atomic_store(pool->cancel, true); /* also where an observer failed */
  gx_case_free(&result);
  return whole;
}

static void *work(void *argument)
{
  struct pool *pool = argument;
  const struct gx_progress *progress = pool->means->progress;
  pthread_mutex_lock(&pool->lock);
  for (size_t index, threads; (threads = take(pool, &index));) {
    pthread_mutex_unlock(&pool->lock);
    bool done = run_one(pool, index, threads);
    pthread_mutex_lock(&pool->lock);
    pool->idle += threads;
    pool->done += done;
    if (done && progress) progress->done(progress->context, pool->done, pool->total);
    pthread_cond_broadcast(&pool->freed);
  }
  pthread_cond_broadcast(&pool->freed);
  pthread_mutex_unlock(&pool->lock);
  return NULL;
}

/* threads: at least 1, the caller among them. */
static void work_by(struct pool *pool, size_t threads)
{
  pthread_t *helper = threads > 1 ? calloc(threads - 1, sizeof *helper) : NULL;
  size_t started = 0;
  /* Fewer threads than asked for is slower but right, so neither failure is an error. */
  while (helper && started < threads - 1 && !pthread_create(&helper[started], NULL, work, pool)) started++;
  work(pool);
  for (size_t i = 0; i < started; i++) pthread_join(helper[i], NULL);
  free(helper);
}

int gx_study_run(const struct gx_study *study, const struct gx_study_means *means)
{
  atomic_bool nobody = false;
  const size_t threads = means->threads ? means->threads : 1;
  struct gx_queue *queue = means->source ? NULL : gx_queue_create(study, means->skip, threads > 1);
  if (!means->source && !queue) return -1;
  const struct gx_source source = means->source ? *means->source : gx_queue_source(queue);
  struct pool pool = {.study = study,
                      .means = means,
                      .source = &source,
                      .cancel = means->cancel ? means->cancel : &nobody,
                      .lock = PTHREAD_MUTEX_INITIALIZER,
                      .freed = PTHREAD_COND_INITIALIZER,
                      .idle = threads,
                      .total = queue ? gx_queue_count(queue) : 0};
  gx_status_quiet_gsl(); /* a matrix that cannot be factored is a result */
  work_by(&pool, queue && pool.total < threads ? pool.total : threads);
  pthread_cond_destroy(&pool.freed);
  pthread_mutex_destroy(&pool.lock);
  gx_queue_free(queue);
  const bool all = means->source ? pool.done == pool.taken && !atomic_load(pool.cancel) : pool.done == pool.total;
  return all ? 0 : -1;
}
