/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of a study: the same columns in the same order for every study (case, parameters, results). */
#ifndef GRIDCROSS_TABLE_H
#define GRIDCROSS_TABLE_H

#include <stdbool.h>

#include <gridcross/value.h>

struct gx_column {
  char *name;        /* owned; "mesh.cells", "result.status" */
  char *unit;        /* owned; "" when none */
  enum gx_type type; /* of its non-null values */
  size_t width;      /* bytes that its texts have at most; 0: any number, or no texts */
};

struct gx_table {
  size_t columns, rows;
  struct gx_column *column; /* [columns], owned */
  struct gx_value *value;   /* [rows][columns] row-major, owned; texts owned by the table */
  char **texts;             /* texts that values point to, owned */
  size_t text_count, text_room;
};

/* A table of null values; NULL when memory runs out. Columns are named with gx_table_column. */
struct gx_table *gx_table_create(size_t columns, size_t rows);
/* All values are null again; columns and memory stay. */
void gx_table_clear(struct gx_table *table);
void gx_table_free(struct gx_table *table);
/* Copies name and unit; width is 0. Returns 0, or -1 when memory runs out. */
int gx_table_column(struct gx_table *table, size_t column, const char *name, const char *unit, enum gx_type type);
/* A column like another one, without its values. Returns 0, or -1 when memory runs out. */
int gx_table_column_like(struct gx_table *table, size_t column, const struct gx_column *like);
/* Stores a value; copies text. Returns 0, or -1 when memory runs out. */
int gx_table_set(struct gx_table *table, size_t row, size_t column, struct gx_value value);
struct gx_value gx_table_get(const struct gx_table *table, size_t row, size_t column);
/* Copies a column, name and values, from a table with as many rows. Returns 0, or -1 when memory runs out. */
int gx_table_copy(struct gx_table *table, size_t column, const struct gx_table *from, size_t source);
/* Drops the other rows. keep: [rows]. */
void gx_table_keep(struct gx_table *table, const bool *keep);
/* Index of the column, or -1. */
long gx_table_find(const struct gx_table *table, const char *name);

#endif
