/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables as comma-separated values (RFC 4180). */
#include <gridcross/store.h>

#include <string.h>

static void write_text(const char *text, FILE *out)
{
  /* An empty text is quoted, so that it differs from null. */
  if (*text && !strpbrk(text, ",\"\r\n")) {
    fputs(text, out);
    return;
  }
  putc('"', out);
  for (const char *c = text; *c; c++) {
    if (*c == '"') putc('"', out);
    putc(*c, out);
  }
  putc('"', out);
}

void gx_csv_write(const struct gx_table *table, FILE *out)
{
  for (size_t c = 0; c < table->columns; c++) {
    if (c) putc(',', out);
    write_text(table->column[c].name, out);
  }
  putc('\n', out);
  for (size_t r = 0; r < table->rows; r++) {
    for (size_t c = 0; c < table->columns; c++) {
      struct gx_value value = gx_table_get(table, r, c);
      char number[GX_NUMBER_LENGTH];
      if (c) putc(',', out);
      if (value.type == GX_INTEGER) fprintf(out, "%ld", value.integer);
      if (value.type == GX_TEXT) write_text(value.text, out);
      if (value.type == GX_REAL) {
        gx_value_real(value.real, number);
        fputs(number, out);
      }
    }
    putc('\n', out);
  }
}
