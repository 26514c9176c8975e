/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives a target every file of the directories and files that are named, once, in the order of their names; then each of them cut in half
 * and with its bits flipped one a byte. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"

enum { LARGEST = 1 << 20, FLIPS = 8 };

static size_t files;

/* The input in memory of just that size, so that tools see it overrun. */
static void give(const uint8_t *data, size_t size)
{
  uint8_t *copy = malloc(size ? size : 1);
  if (!copy) abort();
  memcpy(copy, data, size);
  LLVMFuzzerTestOneInput(copy, size);
  free(copy);
}

static void give_file(const char *path)
{
  static uint8_t bytes[LARGEST];
  FILE *in = fopen(path, "rb");
  if (!in) {
    perror(path);
    exit(1);
  }
  const size_t size = fread(bytes, 1, LARGEST, in);
  fclose(in);
  files++;
  give(bytes, size);
  give(bytes, size / 2);
  for (size_t i = 0; i < FLIPS && size; i++) {
    const size_t at = i * (size - 1) / (FLIPS - 1);
    bytes[at] ^= (uint8_t)(1 << i % 8);
    give(bytes, size);
    bytes[at] ^= (uint8_t)(1 << i % 8);
  }
}

static int by_name(const struct dirent **a, const struct dirent **b)
{
  return strcmp((*a)->d_name, (*b)->d_name);
}

static int is_shown(const struct dirent *entry)
{
  return entry->d_name[0] != '.';
}

int main(int arguments, char **argument)
{
  for (int i = 1; i < arguments; i++) {
    struct dirent **entry;
    const int count = scandir(argument[i], &entry, is_shown, by_name);
    if (count < 0) give_file(argument[i]);
    for (int k = 0; k < count; k++) {
      char path[1024];
      snprintf(path, sizeof path, "%s/%s", argument[i], entry[k]->d_name);
      give_file(path);
      free(entry[k]);
    }
    if (count >= 0) free(entry);
  }
  fprintf(stderr, "%zu files\n", files);
  return files ? 0 : 1;
}
