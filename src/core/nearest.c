/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The candidate that a misspelt word most likely means, by edit distance: insert, delete, replace, swap neighbours. */
#include "nearest.h"

#include <ctype.h>
#include <string.h>

enum { LONGEST = GX_NEAREST_LENGTH - 1 }; /* longer words get no suggestion, so that cost stays bounded */

static int least(int a, int b)
{
  return a < b ? a : b;
}

static int edits(const char *a, int length_a, const char *b, int length_b)
{
  int row[3][LONGEST + 1];
  for (int j = 0; j <= length_b; j++) row[0][j] = j;
  for (int i = 1; i <= length_a; i++) {
    int *now = row[i % 3], *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];
    now[0] = i;
    for (int j = 1; j <= length_b; j++) {
      int ai = tolower((unsigned char)a[i - 1]), bj = tolower((unsigned char)b[j - 1]);
      now[j] = least(last[j - 1] + (ai != bj), 1 + least(last[j], now[j - 1]));
      if (i > 1 && j > 1 && ai == tolower((unsigned char)b[j - 2]) && bj == tolower((unsigned char)a[i - 2]))
        now[j] = least(now[j], before[j - 2] + 1);
    }
  }
  return row[length_a % 3][length_b];
}

void gx_nearest_try(struct gx_nearest *nearest, const char *candidate)
{
  size_t length_a = strlen(nearest->word), length_b = strlen(candidate);
  if (length_a > LONGEST || length_b > LONGEST) return;
  int distance = edits(nearest->word, (int)length_a, candidate, (int)length_b);
  if (distance > (least((int)length_a, (int)length_b) + 1) / 3) return;
  if (*nearest->best && distance >= nearest->distance) return;
  memcpy(nearest->best, candidate, length_b + 1);
  nearest->distance = distance;
}
