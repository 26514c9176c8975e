/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A team of POSIX threads. Nobody waits for one that has taken no part: it may not even be running. Those without work look for it
 * a while before they sleep: the tasks of a step follow each other sooner than a sleeper wakes. */
#include "team.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <time.h>

enum { PATIENCE = 4000 }; /* looks before sleep, tens of microseconds */

struct helper {
  struct gx_team *team;
  size_t worker;
  _Atomic double seconds; /* of processor time in tasks */
  pthread_t thread;
};

struct gx_team {
  size_t helpers;
  /* the task under way; nobody looks who has not taken a part of it */
  gx_team_task *task;
  void *context;
  size_t parts;
  _Atomic uint64_t open; /* number of the task, then, in the lower half, of its parts that nobody has taken */
  atomic_size_t done;    /* parts */
  atomic_bool over;
  /* of those who sleep */
  pthread_mutex_t lock;
  pthread_cond_t call, finished;
  struct helper helper[];
};

static double seconds_now(void)
{
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void pause_a_moment(void)
{
#if defined __x86_64__ || defined __i386__
  __builtin_ia32_pause();
#endif
}

static bool is_open(struct gx_team *team)
{
  return (uint32_t)atomic_load(&team->open) > 0;
}

/* Whether it got one. Whoever has a part keeps the task from ending, and the next from beginning. */
static bool take_part(struct gx_team *team, size_t *part)
{
  uint64_t open = atomic_load(&team->open);
  while ((uint32_t)open > 0)
    if (atomic_compare_exchange_weak(&team->open, &open, open - 1)) {
      *part = team->parts - (uint32_t)open;
      return true;
    }
  return false;
}

static void work(struct gx_team *team, size_t worker)
{
  size_t part;
  while (take_part(team, &part)) {
    const size_t parts = team->parts;
    team->task(team->context, part, worker);
    if (atomic_fetch_add(&team->done, 1) + 1 < parts) continue;
    pthread_mutex_lock(&team->lock);
    pthread_cond_signal(&team->finished);
    pthread_mutex_unlock(&team->lock);
  }
}

static void wait_for_work(struct gx_team *team)
{
  for (int look = 0; look < PATIENCE; look++) {
    if (is_open(team)) return;
    pause_a_moment();
  }
  pthread_mutex_lock(&team->lock);
  while (!is_open(team) && !atomic_load(&team->over)) pthread_cond_wait(&team->call, &team->lock);
  pthread_mutex_unlock(&team->lock);
}

static void *help(void *argument)
{
  struct helper *self = argument;
  struct gx_team *team = self->team;
  while (wait_for_work(team), !atomic_load(&team->over)) {
    double before = seconds_now();
    work(team, self->worker);
    atomic_store(&self->seconds, atomic_load(&self->seconds) + (seconds_now() - before));
  }
  return NULL;
}

struct gx_team *gx_team_create(size_t threads)
{
  if (threads < 2 || threads > 4096) return NULL;
  struct gx_team *team = calloc(1, sizeof *team + (threads - 1) * sizeof *team->helper);
  if (!team) return NULL;
  pthread_mutex_init(&team->lock, NULL);
  pthread_cond_init(&team->call, NULL);
  pthread_cond_init(&team->finished, NULL);
  for (; team->helpers < threads - 1; team->helpers++) {
    struct helper *helper = &team->helper[team->helpers];
    helper->team = team;
    helper->worker = team->helpers + 1;
    if (pthread_create(&helper->thread, NULL, help, helper)) break;
  }
  if (team->helpers) return team;
  gx_team_free(team);
  return NULL;
}

void gx_team_free(struct gx_team *team)
{
  if (!team) return;
  pthread_mutex_lock(&team->lock);
  atomic_store(&team->over, true);
  pthread_cond_broadcast(&team->call);
  pthread_mutex_unlock(&team->lock);
  for (size_t i = 0; i < team->helpers; i++) pthread_join(team->helper[i].thread, NULL);
  pthread_cond_destroy(&team->finished);
  pthread_cond_destroy(&team->call);
  pthread_mutex_destroy(&team->lock);
  free(team);
}

size_t gx_team_size(const struct gx_team *team)
{
  return team ? team->helpers + 1 : 1;
}

static void wait_for_parts(struct gx_team *team)
{
  for (int look = 0; look < PATIENCE; look++) {
    if (atomic_load(&team->done) == team->parts) return;
    pause_a_moment();
  }
  pthread_mutex_lock(&team->lock);
  while (atomic_load(&team->done) < team->parts) pthread_cond_wait(&team->finished, &team->lock);
  pthread_mutex_unlock(&team->lock);
}

void gx_team_run(struct gx_team *team, size_t parts, gx_team_task *task, void *context)
{
  if (!team || parts < 2) {
    for (size_t part = 0; part < parts; part++) task(context, part, 0);
    return;
  }
  team->task = task;
  team->context = context;
  team->parts = parts;
  atomic_store(&team->done, 0);
  pthread_mutex_lock(&team->lock);
  atomic_store(&team->open, ((atomic_load(&team->open) >> 32) + 1) << 32 | parts);
  pthread_cond_broadcast(&team->call);
  pthread_mutex_unlock(&team->lock);
  work(team, 0);
  wait_for_parts(team);
}

double gx_team_seconds(const struct gx_team *team)
{
  double seconds = 0;
  for (size_t i = 0; team && i < team->helpers; i++) seconds += atomic_load(&team->helper[i].seconds);
  return seconds;
}
