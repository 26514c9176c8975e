/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes of a table, by splitting its rows into groups of equal values. */
#include "axes.h"

#include <stdlib.h>
#include <string.h>

bool gx_axes_parameter(const struct gx_table *table, size_t column)
{
  const char *name = table->column[column].name;
  return strcmp(name, "case") != 0 && strncmp(name, "result.", 7) != 0;
}

bool gx_axes_vary(const struct gx_table *table, size_t column)
{
  for (size_t r = 1; r < table->rows; r++)
    if (gx_value_compare(gx_table_get(table, 0, column), gx_table_get(table, r, column))) return true;
  return false;
}

struct entry {
  struct gx_value value;
  size_t row, first; /* first: row where this value appears first */
};

static int by_value(const void *left, const void *right)
{
  const struct entry *a = left, *b = right;
  int order = gx_value_compare(a->value, b->value);
  return order ? order : (a->row > b->row) - (a->row < b->row);
}

/* Null, numbers ascending, texts as they first appear. */
static int by_appearance(const void *left, const void *right)
{
  const struct entry *a = left, *b = right;
  if (a->value.type != GX_TEXT || b->value.type != GX_TEXT) return gx_value_compare(a->value, b->value);
  return (a->first > b->first) - (a->first < b->first);
}

long gx_axes_rank(const struct gx_table *table, size_t column, size_t *rank)
{
  struct entry *entry = malloc((table->rows + 1) * sizeof *entry);
  if (!entry) return -1;
  for (size_t r = 0; r < table->rows; r++) entry[r] = (struct entry){.value = gx_table_get(table, r, column), .row = r};
  qsort(entry, table->rows, sizeof *entry, by_value);
  for (size_t i = 0; i < table->rows; i++)
    entry[i].first = i && !gx_value_compare(entry[i - 1].value, entry[i].value) ? entry[i - 1].first : entry[i].row;
  qsort(entry, table->rows, sizeof *entry, by_appearance);
  long distinct = 0;
  for (size_t i = 0; i < table->rows; i++) {
    if (!i || gx_value_compare(entry[i - 1].value, entry[i].value)) distinct++;
    rank[entry[i].row] = (size_t)distinct - 1;
  }
  free(entry);
  return distinct;
}

long gx_axes_values(const struct gx_table *table, size_t column, size_t *first)
{
  size_t *rank = calloc(table->rows + 1, sizeof *rank);
  long distinct = rank ? gx_axes_rank(table, column, rank) : -1;
  for (size_t r = table->rows; r-- > 0 && distinct >= 0;) first[rank[r]] = r;
  free(rank);
  return distinct;
}

struct pair {
  size_t group, rank, row;
};

static int by_group(const void *left, const void *right)
{
  const struct pair *a = left, *b = right;
  if (a->group != b->group) return a->group > b->group ? 1 : -1;
  return (a->rank > b->rank) - (a->rank < b->rank);
}

long gx_axes_refine(size_t rows, size_t *group, const size_t *rank)
{
  struct pair *pair = malloc((rows + 1) * sizeof *pair);
  if (!pair) return -1;
  for (size_t r = 0; r < rows; r++) pair[r] = (struct pair){.group = group[r], .rank = rank[r], .row = r};
  qsort(pair, rows, sizeof *pair, by_group);
  long groups = 0;
  for (size_t i = 0; i < rows; i++) {
    if (!i || by_group(&pair[i - 1], &pair[i])) groups++;
    group[pair[i].row] = (size_t)groups - 1;
  }
  free(pair);
  return groups;
}

/* Whether the column differs between studies and never within one. */
static bool tells_studies_apart(const struct gx_table *table, size_t column)
{
  long study = gx_table_find(table, "study");
  bool varies = false;
  if (study < 0 || (size_t)study == column) return false;
  for (size_t r = 1; r < table->rows; r++) {
    bool same_study = !gx_value_compare(gx_table_get(table, r - 1, (size_t)study), gx_table_get(table, r, (size_t)study));
    bool same_value = !gx_value_compare(gx_table_get(table, r - 1, column), gx_table_get(table, r, column));
    if (same_study && !same_value) return false;
    varies = varies || !same_value;
  }
  return varies;
}

static bool is_among(size_t column, const size_t *axis, long count)
{
  for (long i = 0; i < count; i++)
    if (axis[i] == column) return true;
  return false;
}

long gx_axes_find(const struct gx_table *table, size_t chosen, size_t *axis)
{
  size_t *group = calloc(table->rows + 1, sizeof *group), *trial = malloc((table->rows + 1) * sizeof *trial);
  size_t *rank = malloc((table->rows + 1) * sizeof *rank);
  long groups = 1, count = (long)chosen;
  if (!group || !trial || !rank) count = -1;
  for (size_t i = 0; i < chosen && count >= 0; i++) {
    if (gx_axes_rank(table, axis[i], rank) < 0) count = -1;
    if (count >= 0 && (groups = gx_axes_refine(table->rows, group, rank)) < 0) count = -1;
  }
  for (size_t c = 0; c < table->columns && count >= 0; c++) {
    if (!gx_axes_parameter(table, c) || !gx_axes_vary(table, c)) continue; /* most columns of a study hold one value */
    memcpy(trial, group, table->rows * sizeof *trial);
    long split = gx_axes_rank(table, c, rank) < 0 ? -1 : gx_axes_refine(table->rows, trial, rank);
    if (split < 0) count = -1;
    if (split <= groups && (split < 0 || is_among(c, axis, count) || !tells_studies_apart(table, c))) continue;
    axis[count++] = c;
    groups = split;
    memcpy(group, trial, table->rows * sizeof *group);
  }
  free(group);
  free(trial);
  free(rank);
  return count;
}
