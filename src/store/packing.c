/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words that repeat the one before them take a bit each. */
#include "packing.h"

#include <stdbool.h>
#include <string.h>

size_t gx_packing_pack(const void *from, size_t words, uint64_t *packed)
{
  const char *at = from;
  uint64_t before = 0, *next = packed + GX_PACKING_BITS(words);
  for (size_t first = 0; first < words; first += 64) {
    const size_t last = words - first < 64 ? words : first + 64;
    uint64_t bits = 0;
    for (size_t i = first; i < last; i++) {
      uint64_t word;
      memcpy(&word, at + 8 * i, sizeof word);
      const bool differs = word != before;
      *next = word;
      next += differs;
      bits |= (uint64_t)differs << (i - first);
      before = word;
    }
    packed[first / 64] = bits;
  }
  return (size_t)(next - packed);
}

size_t gx_packing_unpack(const uint64_t *packed, size_t room, void *to, size_t words)
{
  char *at = to;
  uint64_t word = 0;
  size_t next = GX_PACKING_BITS(words);
  if (room < next) return 0;
  for (size_t i = 0; i < words; i++) {
    if (packed[i / 64] >> i % 64 & 1) {
      if (next == room) return 0;
      word = packed[next++];
    }
    memcpy(at + 8 * i, &word, sizeof word);
  }
  return next;
}
