/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables as JSON (RFC 8259). */
#include <gridcross/store.h>

#include <math.h>

#include "../core/utf8.h"

static void write_text(const char *text, FILE *out)
{
  putc('"', out);
  for (const char *c = text; *c;) {
    unsigned long point = 0;
    const int length = gx_utf8_length(c, &point);
    if (*c == '"' || *c == '\\')
      fprintf(out, "\\%c", *c);
    else if (*c == '\n')
      fputs("\\n", out);
    else if (!length || point < 0x20) /* a byte that is none of UTF-8 becomes U+FFFD */
      fprintf(out, "\\u%04lx", length ? point : 0xFFFDul);
    else
      fwrite(c, 1, (size_t)length, out);
    c += length ? length : 1;
  }
  putc('"', out);
}

static void write_value(struct gx_value value, FILE *out)
{
  char number[GX_NUMBER_LENGTH];
  if (value.type == GX_INTEGER) {
    gx_value_integer(value.integer, number);
    fputs(number, out);
  } else if (value.type == GX_TEXT) {
    write_text(value.text, out);
  } else if (value.type == GX_REAL && isfinite(value.real)) {
    gx_value_real(value.real, number);
    fputs(number, out);
  } else {
    fputs("null", out);
  }
}

static void write_row(const struct gx_table *table, size_t columns, size_t row, FILE *out)
{
  putc('{', out);
  for (size_t c = 0; c < columns; c++) {
    if (c) fputs(", ", out);
    write_text(table->column[c].name, out);
    fputs(": ", out);
    write_value(gx_table_get(table, row, c), out);
  }
  putc('}', out);
}

void gx_json_write_object(const struct gx_table *table, size_t row, FILE *out)
{
  write_row(table, table->columns, row, out);
}

void gx_json_write_rows(const struct gx_table *table, size_t columns, bool first, FILE *out)
{
  if (first) putc('[', out);
  for (size_t r = 0; r < table->rows; r++) {
    fputs(r || !first ? ",\n " : "\n ", out);
    write_row(table, columns, r, out);
  }
}

void gx_json_write_end(FILE *out)
{
  fputs("\n]\n", out);
}

void gx_json_write(const struct gx_table *table, FILE *out)
{
  gx_json_write_rows(table, table->columns, true, out);
  gx_json_write_end(out);
}
