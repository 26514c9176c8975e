/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory that is taken in pieces and freed at once, so that no error path can leak. */
#ifndef GRIDCROSS_CORE_ARENA_H
#define GRIDCROSS_CORE_ARENA_H

#include <stddef.h>

struct gx_arena_block;

/* Starts as {0}. */
struct gx_arena {
  struct gx_arena_block *block;
};

/* Zeroed, aligned for any type; NULL when memory runs out. */
void *gx_arena_take(struct gx_arena *arena, size_t bytes);
/* A copy of length bytes, ended by NUL; NULL when memory runs out. */
char *gx_arena_text(struct gx_arena *arena, const char *text, size_t length);
void gx_arena_free(struct gx_arena *arena);

#endif
