/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A word at a time, each by steps that can be undone: two streams that differ in one word never meet again. */
#include "checksum.h"

#include <string.h>

static uint64_t stir(uint64_t sum, uint64_t word)
{
  sum = (sum ^ word) * UINT64_C(0xff51afd7ed558ccd); /* odd */
  return sum ^ sum >> 32;
}

uint64_t gx_checksum(uint64_t before, const void *bytes, size_t length)
{
  const unsigned char *at = bytes;
  uint64_t sum = before, word;
  for (; length >= sizeof word; at += sizeof word, length -= sizeof word) {
    memcpy(&word, at, sizeof word);
    sum = stir(sum, word);
  }
  if (!length) return sum;
  word = 0;
  memcpy(&word, at, length);
  return stir(stir(sum, word), length);
}
