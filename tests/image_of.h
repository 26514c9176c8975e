/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images kept in memory. */
#ifndef GRIDCROSS_TESTS_IMAGE_OF_H
#define GRIDCROSS_TESTS_IMAGE_OF_H

#include <stdlib.h>
#include <string.h>

#include <gridcross/image.h>

struct image_memory {
  unsigned char *bytes; /* owned */
  size_t length, room, at;
};

static inline int image_save(void *context, void *bytes, size_t length)
{
  struct image_memory *memory = context;
  if (memory->length + length > memory->room) {
    memory->room = 2 * memory->room + length;
    memory->bytes = realloc(memory->bytes, memory->room);
  }
  memcpy(memory->bytes + memory->length, bytes, length);
  memory->length += length;
  return 0;
}

static inline int image_load(void *context, void *bytes, size_t length)
{
  struct image_memory *memory = context;
  if (length > memory->length - memory->at) return -1;
  memcpy(bytes, memory->bytes + memory->at, length);
  memory->at += length;
  return 0;
}

/* An image that is saved to memory from its beginning, or loaded from there. */
static inline struct gx_image image_of(struct image_memory *memory, bool loading)
{
  memory->at = 0;
  if (!loading) memory->length = 0;
  return (struct gx_image){.context = memory, .loading = loading, .move = loading ? image_load : image_save};
}

#endif
