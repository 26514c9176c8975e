/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the cases of a study on several threads. A case shares nothing with another, its result is stored by index, and teams give
 * equal bits, so the number of threads changes no bit of any result. */
#include <gridcross/study.h>

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

#include <gsl/gsl_errno.h>

#include "../core/team.h"

struct pool {
  const struct gx_study *study;
  struct gx_result *results;
  const struct gx_progress *progress;
  pthread_mutex_t lock;
  size_t next, done;
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

static void *work(void *argument)
{
  const struct worker *self = argument;
  struct pool *pool = self->pool;
  struct gx_team *team = gx_team_create(self->threads);
  pthread_mutex_lock(&pool->lock);
  while (pool->next < pool->study->count) {
    size_t i = pool->next++;
    pthread_mutex_unlock(&pool->lock);
    pool->results[i] = gx_case_run_by(&pool->study->cases[i], team);
    gx_case_time(&pool->study->cases[i], team, pool->study->repeats, &pool->results[i]);
    pthread_mutex_lock(&pool->lock);
    pool->done++;
    if (pool->progress) pool->progress->done(pool->progress->context, pool->done, pool->study->count);
  }
  pthread_mutex_unlock(&pool->lock);
  gx_team_free(team);
  return NULL;
}

void gx_study_run(const struct gx_study *study, size_t threads, const struct gx_progress *progress, struct gx_result *results)
{
  struct pool pool = {.study = study, .results = results, .progress = progress, .lock = PTHREAD_MUTEX_INITIALIZER};
  gsl_set_error_handler_off(); /* a matrix that cannot be factored is a result */
  size_t workers = threads < study->count ? threads : study->count, started = 1;
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
}
