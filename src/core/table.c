/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of a study. */
#include <gridcross/table.h>

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct gx_table *gx_table_create(size_t columns, size_t rows)
{
  if (columns && rows > SIZE_MAX / 2 / sizeof(struct gx_value) / columns) return NULL;
  struct gx_table *table = calloc(1, sizeof *table);
  if (!table) return NULL;
  table->columns = columns;
  table->rows = rows;
  table->column = calloc(columns + 1, sizeof *table->column);
  table->value = calloc(columns * rows + 1, sizeof *table->value);
  if (!table->column || !table->value) {
    table->columns = 0;
    gx_table_free(table);
    return NULL;
  }
  return table;
}

void gx_table_free(struct gx_table *table)
{
  if (!table) return;
  for (size_t c = 0; c < table->columns; c++) {
    free(table->column[c].name);
    free(table->column[c].unit);
  }
  for (size_t i = 0; i < table->text_count; i++) free(table->texts[i]);
  free(table->texts);
  free(table->column);
  free(table->value);
  free(table);
}

void gx_table_clear(struct gx_table *table)
{
  for (size_t i = 0; i < table->text_count; i++) free(table->texts[i]);
  table->text_count = 0;
  memset(table->value, 0, table->columns * table->rows * sizeof *table->value);
}

int gx_table_column(struct gx_table *table, size_t column, const char *name, const char *unit, enum gx_type type)
{
  struct gx_column *c = &table->column[column];
  char *own_name = strdup(name), *own_unit = strdup(unit);
  if (!own_name || !own_unit) {
    free(own_name);
    free(own_unit);
    return -1;
  }
  free(c->name);
  free(c->unit);
  *c = (struct gx_column){.name = own_name, .unit = own_unit, .type = type};
  return 0;
}

int gx_table_column_like(struct gx_table *table, size_t column, const struct gx_column *like)
{
  int failed = gx_table_column(table, column, like->name, like->unit, like->type);
  if (!failed) table->column[column].width = like->width;
  return failed;
}

static const char *keep_text(struct gx_table *table, const char *text)
{
  if (table->text_count == table->text_room) {
    size_t room = table->text_room ? 2 * table->text_room : 64;
    char **grown = realloc(table->texts, room * sizeof *grown);
    if (!grown) return NULL;
    table->texts = grown;
    table->text_room = room;
  }
  char *copy = strdup(text);
  if (copy) table->texts[table->text_count++] = copy;
  return copy;
}

/* Most texts are those of the row above. */
static const char *find_text(struct gx_table *table, size_t row, size_t column, const char *text)
{
  struct gx_value above = {.type = GX_NULL};
  if (row) above = gx_table_get(table, row - 1, column);
  return above.type == GX_TEXT && !strcmp(above.text, text) ? above.text : keep_text(table, text);
}

int gx_table_set(struct gx_table *table, size_t row, size_t column, struct gx_value value)
{
  if (value.type == GX_TEXT && !(value.text = find_text(table, row, column, value.text))) return -1;
  table->value[row * table->columns + column] = value;
  return 0;
}

struct gx_value gx_table_get(const struct gx_table *table, size_t row, size_t column)
{
  return table->value[row * table->columns + column];
}

int gx_table_copy(struct gx_table *table, size_t column, const struct gx_table *from, size_t source)
{
  const struct gx_column *c = &from->column[source];
  int failed = gx_table_column(table, column, c->name, c->unit, c->type);
  for (size_t r = 0; r < from->rows && !failed; r++) failed = gx_table_set(table, r, column, gx_table_get(from, r, source));
  return failed;
}

void gx_table_keep(struct gx_table *table, const bool *keep)
{
  size_t kept = 0;
  for (size_t r = 0; r < table->rows; r++)
    if (keep[r])
      memmove(&table->value[table->columns * kept++], &table->value[table->columns * r], table->columns * sizeof *table->value);
  table->rows = kept;
}

long gx_table_find(const struct gx_table *table, const char *name)
{
  for (size_t c = 0; c < table->columns; c++)
    if (table->column[c].name && !strcmp(table->column[c].name, name)) return (long)c;
  return -1;
}
