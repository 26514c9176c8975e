/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory that is taken in pieces and freed at once. */
#include "arena.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "large.h"

enum { FIRST_BLOCK = 1 << 12, LARGEST_BLOCK = 1 << 16 }; /* each twice the one before: tiny cases take little */

struct gx_arena_block {
  struct gx_arena_block *older;
  size_t used, room;
  alignas(max_align_t) unsigned char memory[];
};

void *gx_arena_take(struct gx_arena *arena, size_t bytes)
{
  const size_t unit = alignof(max_align_t);
  if (bytes > SIZE_MAX / 2) return NULL;
  bytes = (bytes + unit - 1) / unit * unit;
  struct gx_arena_block *block = arena->block;
  if (!block || block->room - block->used < bytes) {
    size_t room = !block ? FIRST_BLOCK : block->room < LARGEST_BLOCK ? 2 * block->room : LARGEST_BLOCK;
    if (room < bytes) room = bytes;
    block = gx_large_zeros(sizeof *block + room);
    if (!block) return NULL;
    *block = (struct gx_arena_block){.older = arena->block, .room = room};
    arena->block = block;
  }
  void *piece = block->memory + block->used;
  block->used += bytes;
  return piece;
}

char *gx_arena_text(struct gx_arena *arena, const char *text, size_t length)
{
  char *copy = gx_arena_take(arena, length + 1);
  if (copy) memcpy(copy, text, length);
  return copy;
}

void gx_arena_free(struct gx_arena *arena)
{
  while (arena->block) {
    struct gx_arena_block *older = arena->block->older;
    free(arena->block);
    arena->block = older;
  }
}
