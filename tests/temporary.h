/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files and directories of a test's own. */
#ifndef GRIDCROSS_TESTS_TEMPORARY_H
#define GRIDCROSS_TESTS_TEMPORARY_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEMPORARY_ROOM = 48 };

/* What mkstemp and mkdtemp make a name of: six letters at its end are theirs to choose. */
static inline void temporary_pattern(char path[TEMPORARY_ROOM], const char *name)
{
  char chosen[7] = "";
  memset(chosen, 'X', sizeof chosen - 1);
  snprintf(path, TEMPORARY_ROOM, "/tmp/gridcross-%s-%s", name, chosen);
}

/* A descriptor, or less than 0. */
static inline int temporary_file(char path[TEMPORARY_ROOM], const char *name)
{
  temporary_pattern(path, name);
  return mkstemp(path);
}

static inline bool temporary_directory(char path[TEMPORARY_ROOM], const char *name)
{
  temporary_pattern(path, name);
  return mkdtemp(path);
}

#endif
