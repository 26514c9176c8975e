/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables as comma-separated values (RFC 4180). */
#include <gridcross/store.h>

#include <string.h>

/* The stream is locked once a table: most cells are a comma or two. */
static void write_plain(const char *text, FILE *out)
{
  for (; *text; text++) putc_unlocked(*text, out);
}

static void write_text(const char *text, FILE *out)
{
  /* An empty text is quoted, so that it differs from null. */
  if (*text && !strpbrk(text, ",\"\r\n")) {
    write_plain(text, out);
    return;
  }
  putc_unlocked('"', out);
  for (const char *c = text; *c; c++) {
    if (*c == '"') putc_unlocked('"', out);
    putc_unlocked(*c, out);
  }
  putc_unlocked('"', out);
}

static void write_value(struct gx_value value, FILE *out)
{
  char number[GX_NUMBER_LENGTH];
  if (value.type == GX_NULL) return;
  if (value.type == GX_TEXT) {
    write_text(value.text, out);
    return;
  }
  if (value.type == GX_INTEGER)
    gx_value_integer(value.integer, number);
  else
    gx_value_real(value.real, number);
  write_plain(number, out);
}

void gx_csv_write_head(const struct gx_table *table, size_t columns, FILE *out)
{
  flockfile(out);
  for (size_t c = 0; c < columns; c++) {
    if (c) putc_unlocked(',', out);
    write_text(table->column[c].name, out);
  }
  putc_unlocked('\n', out);
  funlockfile(out);
}

void gx_csv_write_rows(const struct gx_table *table, size_t columns, size_t rows, FILE *out)
{
  flockfile(out);
  for (size_t r = 0; r < rows; r++) {
    for (size_t c = 0; c < columns; c++) {
      if (c) putc_unlocked(',', out);
      write_value(gx_table_get(table, r, c), out);
    }
    putc_unlocked('\n', out);
  }
  funlockfile(out);
}

void gx_csv_write(const struct gx_table *table, FILE *out)
{
  gx_csv_write_head(table, table->columns, out);
  gx_csv_write_rows(table, table->columns, table->rows, out);
}
