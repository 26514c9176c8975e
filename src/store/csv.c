/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables as comma-separated values (RFC 4180). */
#include <gridcross/store.h>

#include <stdlib.h>
#include <string.h>

/* What is written next. */
struct piece {
  FILE *out;
  size_t used;
  char text[1 << 13];
};

/* A value of the row above: most are met again. */
struct cell {
  struct gx_value value;
  bool quoted;
  size_t length;
  char number[GX_NUMBER_LENGTH];
};

static void flush(struct piece *piece)
{
  fwrite(piece->text, 1, piece->used, piece->out);
  piece->used = 0;
}

static void put(struct piece *piece, const char *text, size_t length)
{
  if (length > sizeof piece->text - piece->used) flush(piece);
  if (length > sizeof piece->text) {
    fwrite(text, 1, length, piece->out);
    return;
  }
  memcpy(piece->text + piece->used, text, length);
  piece->used += length;
}

static void put_character(struct piece *piece, char character)
{
  if (piece->used == sizeof piece->text) flush(piece);
  piece->text[piece->used++] = character;
}

static void put_quoted(struct piece *piece, const char *text)
{
  put_character(piece, '"');
  for (const char *c = text; *c; c++) {
    if (*c == '"') put_character(piece, '"');
    put_character(piece, *c);
  }
  put_character(piece, '"');
}

static bool is_same(struct gx_value a, struct gx_value b)
{
  if (a.type != b.type) return false;
  if (a.type == GX_TEXT) return a.text == b.text;
  return a.type == GX_INTEGER ? a.integer == b.integer : !memcmp(&a.real, &b.real, sizeof a.real);
}

static void fill(struct cell *cell, struct gx_value value)
{
  cell->value = value;
  cell->quoted = false;
  if (value.type == GX_TEXT) /* an empty text is quoted, so that it differs from null */
    cell->quoted = !*value.text || strpbrk(value.text, ",\"\r\n");
  else if (value.type == GX_INTEGER)
    gx_value_integer(value.integer, cell->number);
  else
    gx_value_real(value.real, cell->number);
  cell->length = strlen(value.type == GX_TEXT ? value.text : cell->number);
}

/* cell: what the row above has there. */
static void put_value(struct piece *piece, struct gx_value value, struct cell *cell)
{
  if (value.type == GX_NULL) return;
  if (!is_same(value, cell->value)) fill(cell, value);
  if (cell->quoted)
    put_quoted(piece, value.text);
  else
    put(piece, value.type == GX_TEXT ? value.text : cell->number, cell->length);
}

void gx_csv_write_head(const struct gx_table *table, size_t columns, FILE *out)
{
  struct piece piece = {.out = out, .used = 0};
  for (size_t c = 0; c < columns; c++) {
    struct cell cell = {0};
    if (c) put_character(&piece, ',');
    put_value(&piece, (struct gx_value){.type = GX_TEXT, .text = table->column[c].name}, &cell);
  }
  put_character(&piece, '\n');
  flush(&piece);
}

void gx_csv_write_rows(const struct gx_table *table, size_t columns, size_t rows, FILE *out)
{
  struct piece piece;
  struct cell *above = calloc(columns + 1, sizeof *above), none = {0}; /* without memory: slower */
  piece.out = out;
  piece.used = 0;
  for (size_t r = 0; r < rows; r++) {
    const struct gx_value *value = table->value + r * table->columns;
    for (size_t c = 0; c < columns; c++) {
      if (c) put_character(&piece, ',');
      put_value(&piece, value[c], above ? &above[c] : &none);
    }
    put_character(&piece, '\n');
  }
  flush(&piece);
  free(above);
}

void gx_csv_write(const struct gx_table *table, FILE *out)
{
  gx_csv_write_head(table, table->columns, out);
  gx_csv_write_rows(table, table->columns, table->rows, out);
}
