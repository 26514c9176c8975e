/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A team of POSIX threads. Those without work look for it a while before they sleep: parts of a step follow each other sooner than
 * a sleeper wakes. */
#include "team.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <time.h>

enum { PATIENCE = 4000 }; /* looks before sleep, tens of microseconds */

struct helper {
  struct gx_team *team;
  size_t worker;
  double seconds; /* of processor time in tasks */
  pthread_t thread;
};

struct gx_team {
  size_t helpers;
  /* the task under way */
  gx_team_task *task;
  void *context;
  size_t parts;
  atomic_size_t next;   /* part that nobody has taken */
  atomic_size_t busy;   /* helpers that have not finished */
  atomic_size_t called; /* tasks so far */
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

static void work(struct gx_team *team, size_t worker)
{
  size_t part;
  while ((part = atomic_fetch_add(&team->next, 1)) < team->parts) team->task(team->context, part, worker);
}

/* Returns the number of tasks called, once there is one more than seen. */
static size_t wait_for_call(struct gx_team *team, size_t seen)
{
  for (int look = 0; look < PATIENCE; look++) {
    if (atomic_load(&team->called) != seen) return atomic_load(&team->called);
    pause_a_moment();
  }
  pthread_mutex_lock(&team->lock);
  while (atomic_load(&team->called) == seen) pthread_cond_wait(&team->call, &team->lock);
  pthread_mutex_unlock(&team->lock);
  return atomic_load(&team->called);
}

static void call(struct gx_team *team)
{
  pthread_mutex_lock(&team->lock);
  atomic_fetch_add(&team->called, 1);
  pthread_cond_broadcast(&team->call);
  pthread_mutex_unlock(&team->lock);
}

static void *help(void *argument)
{
  struct helper *self = argument;
  struct gx_team *team = self->team;
  for (size_t seen = 0;;) {
    seen = wait_for_call(team, seen);
    if (atomic_load(&team->over)) return NULL;
    double before = seconds_now();
    work(team, self->worker);
    self->seconds += seconds_now() - before;
    if (atomic_fetch_sub(&team->busy, 1) > 1) continue;
    pthread_mutex_lock(&team->lock);
    pthread_cond_signal(&team->finished);
    pthread_mutex_unlock(&team->lock);
  }
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
    *helper = (struct helper){.team = team, .worker = team->helpers + 1};
    if (pthread_create(&helper->thread, NULL, help, helper)) break;
  }
  if (team->helpers) return team;
  gx_team_free(team);
  return NULL;
}

void gx_team_free(struct gx_team *team)
{
  if (!team) return;
  atomic_store(&team->over, true);
  call(team);
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

static void wait_for_helpers(struct gx_team *team)
{
  for (int look = 0; look < PATIENCE; look++) {
    if (!atomic_load(&team->busy)) return;
    pause_a_moment();
  }
  pthread_mutex_lock(&team->lock);
  while (atomic_load(&team->busy)) pthread_cond_wait(&team->finished, &team->lock);
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
  atomic_store(&team->next, 0);
  atomic_store(&team->busy, team->helpers);
  call(team);
  work(team, 0);
  wait_for_helpers(team);
}

double gx_team_seconds(const struct gx_team *team)
{
  double seconds = 0;
  for (size_t i = 0; team && i < team->helpers; i++) seconds += team->helper[i].seconds;
  return seconds;
}
