/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the cases of a study on several threads. A case shares nothing with another, and its result is stored by index, so the
 * number of threads changes no bit of any result. */
#include <gridcross/study.h>

#include <pthread.h>
#include <stdlib.h>

#include <gsl/gsl_errno.h>

struct pool {
  const struct gx_study *study;
  struct gx_result *results;
  const struct gx_progress *progress;
  pthread_mutex_t lock;
  size_t next, done;
};

static void *work(void *argument)
{
  struct pool *pool = argument;
  pthread_mutex_lock(&pool->lock);
  while (pool->next < pool->study->count) {
    size_t i = pool->next++;
    pthread_mutex_unlock(&pool->lock);
    pool->results[i] = gx_case_run(&pool->study->cases[i]);
    gx_case_time(&pool->study->cases[i], pool->study->repeats, &pool->results[i]);
    pthread_mutex_lock(&pool->lock);
    pool->done++;
    if (pool->progress) pool->progress->done(pool->progress->context, pool->done, pool->study->count);
  }
  pthread_mutex_unlock(&pool->lock);
  return NULL;
}

void gx_study_run(const struct gx_study *study, size_t threads, const struct gx_progress *progress, struct gx_result *results)
{
  struct pool pool = {.study = study, .results = results, .progress = progress, .lock = PTHREAD_MUTEX_INITIALIZER};
  gsl_set_error_handler_off(); /* a matrix that cannot be factored is a result */
  if (threads > study->count) threads = study->count;
  size_t helpers = threads > 1 ? threads - 1 : 0, started = 0;
  pthread_t *thread = calloc(helpers + 1, sizeof *thread);
  /* Fewer threads than asked for is slower but right, so neither failure is an error. */
  while (thread && started < helpers && !pthread_create(&thread[started], NULL, work, &pool)) started++;
  work(&pool);
  for (size_t i = 0; i < started; i++) pthread_join(thread[i], NULL);
  free(thread);
  pthread_mutex_destroy(&pool.lock);
}
