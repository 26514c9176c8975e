/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables as JSON (RFC 8259). */
#include <gridcross/store.h>

#include <math.h>

static void write_text(const char *text, FILE *out)
{
  putc('"', out);
  for (const char *c = text; *c; c++) {
    if (*c == '"' || *c == '\\')
      fprintf(out, "\\%c", *c);
    else if (*c == '\n')
      fputs("\\n", out);
    else if ((unsigned char)*c < 0x20)
      fprintf(out, "\\u%04x", (unsigned char)*c);
    else
      putc(*c, out);
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
