/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Structs of numbers of which most are the same, not a number or zero, in little room: a bit a word, whether it differs from the word
 * before it (of the first: from zero), then the words that do. */
#ifndef GRIDCROSS_STORE_PACKING_H
#define GRIDCROSS_STORE_PACKING_H

#include <stddef.h>
#include <stdint.h>

/* Words of 8 bytes that hold the bits of so many words, and that packing them takes at most. */
#define GX_PACKING_BITS(words) (((words) + 63) / 64)
#define GX_PACKING_MOST(words) (GX_PACKING_BITS(words) + (words))

/* from: [words * 8] bytes; packed: [GX_PACKING_MOST(words)]. Returns how many words it takes. */
size_t gx_packing_pack(const void *from, size_t words, uint64_t *packed);
/* packed: [room] words of any origin; to: [words * 8] bytes. Returns how many words were packed there; 0: more than room. */
size_t gx_packing_unpack(const uint64_t *packed, size_t room, void *to, size_t words);

#endif
