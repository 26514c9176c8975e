/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Threads inside a case: a team works off the parts of a task. What is a part does not depend on the number of threads, so that
 * equal tasks give equal bits for any team. */
#ifndef GRIDCROSS_CORE_TEAM_H
#define GRIDCROSS_CORE_TEAM_H

#include <stddef.h>

/* Wherever a team is borrowed, NULL is the caller alone. */
struct gx_team;

/* Does one part; parts run at once and in any order. worker: in [0, size), no two at once are equal: whose scratch to use. */
typedef void gx_team_task(void *context, size_t part, size_t worker);

/* As many threads as asked for, the caller among them, or as many as there can be. NULL: there can be the caller alone. */
struct gx_team *gx_team_create(size_t threads);
void gx_team_free(struct gx_team *team);
/* Threads, the caller among them. */
size_t gx_team_size(const struct gx_team *team);
/* Returns when all parts, below 2^32, are done. By one thread at a time, not from within a task. Allocates nothing. */
void gx_team_run(struct gx_team *team, size_t parts, gx_team_task *task, void *context);
/* Processor time that the threads besides the caller have spent in tasks, s. */
double gx_team_seconds(const struct gx_team *team);

/* Where part `part` of n entries begins, and where the one before it ends: equal shares of whole cache lines of doubles. */
static inline size_t gx_team_bound(size_t n, size_t parts, size_t part)
{
  const size_t line = 8, lines = (n + line - 1) / line, bound = (lines / parts * part + lines % parts * part / parts) * line;
  return bound < n ? bound : n;
}

#endif
