/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables for people. */
#include "sheet.h"

#include <stdlib.h>
#include <string.h>

bool gx_sheet_error_like(const char *column)
{
  static const char *const prefix[] = {"result.displacement.", "result.velocity.",       "result.stress.",
                                       "result.energy.",       "result.frequency.error", "result.budget."};
  for (size_t i = 0; i < sizeof prefix / sizeof *prefix; i++)
    if (!strncmp(column, prefix[i], strlen(prefix[i]))) return true;
  return false;
}

const char *gx_sheet_leaf(const char *path)
{
  const char *dot = strrchr(path, '.');
  return dot ? dot + 1 : path;
}

void gx_sheet_shorten(char *text)
{
  char *sign = strpbrk(text, "eE");
  if (!sign || !sign[1]) return;
  char *digits = sign + 2, *kept = digits;
  while (*kept == '0' && kept[1]) kept++;
  memmove(digits, kept, strlen(kept) + 1);
  if (sign[1] == '+') memmove(sign + 1, sign + 2, strlen(sign + 2) + 1);
}

const char *gx_sheet_text(const char *column, struct gx_value value, char buffer[GX_NUMBER_LENGTH])
{
  if (value.type == GX_TEXT) return value.text;
  if (value.type == GX_NULL) return "-";
  if (value.type == GX_INTEGER) {
    gx_value_integer(value.integer, buffer);
  } else if (strncmp(column, "result.", 7) != 0) {
    gx_value_real(value.real, buffer);
    gx_sheet_shorten(buffer);
  } else {
    snprintf(buffer, GX_NUMBER_LENGTH, gx_sheet_error_like(column) && value.real != 0 ? "%.2e" : "%.4g", value.real);
    gx_sheet_shorten(buffer);
  }
  return buffer;
}

const char *gx_sheet_label(const struct gx_table *table, size_t column, size_t row, char text[GX_SHEET_LABEL])
{
  char buffer[GX_NUMBER_LENGTH];
  const char *name = table->column[column].name;
  struct gx_value value = gx_table_get(table, row, column);
  if (value.type == GX_NULL)
    text[0] = '\0';
  else if (value.type == GX_TEXT)
    snprintf(text, GX_SHEET_LABEL, "%s", value.text);
  else
    snprintf(text, GX_SHEET_LABEL, "%s %s", gx_sheet_leaf(name), gx_sheet_text(name, value, buffer));
  return text;
}

int gx_sheet_width(const char *text)
{
  int width = 0;
  for (; *text; text++) width += ((unsigned char)*text & 0xC0) != 0x80;
  return width;
}

void gx_sheet_pad(const char *text, int width, bool right, FILE *out)
{
  int fill = width - gx_sheet_width(text);
  if (right && fill > 0) fprintf(out, "%*s", fill, "");
  fputs(text, out);
  if (!right && fill > 0) fprintf(out, "%*s", fill, "");
}

/* Column names without the prefix that all results share. */
static const char *heading(const char *name)
{
  return strncmp(name, "result.", 7) ? name : name + 7;
}

static int column_width(const struct gx_table *table, size_t c)
{
  const struct gx_column *column = &table->column[c];
  char buffer[GX_NUMBER_LENGTH];
  int width = 0;
  for (size_t r = 0; r < table->rows; r++) {
    struct gx_value value = gx_table_get(table, r, c);
    int w = value.type == GX_NULL ? 0 : gx_sheet_width(gx_sheet_text(column->name, value, buffer));
    if (w > width) width = w;
  }
  if (!width) return 0;
  int name = gx_sheet_width(heading(column->name)), unit = gx_sheet_width(column->unit);
  width = name > width ? name : width;
  return unit > width ? unit : width;
}

enum { NAMES = -2, UNITS = -1 }; /* lines before row 0 */

static void print_line(const struct gx_table *table, const int *width, long row, size_t last, FILE *out)
{
  const char *gap = "";
  for (size_t c = 0; c <= last; c++) {
    const struct gx_column *column = &table->column[c];
    char buffer[GX_NUMBER_LENGTH];
    bool right = column->type != GX_TEXT;
    if (!width[c]) continue;
    const char *text = row == NAMES   ? heading(column->name)
                       : row == UNITS ? column->unit
                                      : gx_sheet_text(column->name, gx_table_get(table, (size_t)row, c), buffer);
    bool blank = c == last && !right && row >= 0 && gx_table_get(table, (size_t)row, c).type == GX_NULL;
    if (blank) continue;
    fputs(gap, out);
    gx_sheet_pad(text, c == last && !right ? 0 : width[c], right, out);
    gap = "  ";
  }
  putc('\n', out);
}

int gx_sheet_print(const struct gx_table *table, FILE *out)
{
  int *width = calloc(table->columns + 1, sizeof *width);
  size_t last = 0;
  bool units = false;
  if (!width) return -1;
  for (size_t c = 0; c < table->columns; c++) {
    width[c] = column_width(table, c);
    if (!width[c]) continue;
    last = c;
    units = units || *table->column[c].unit;
  }
  for (long row = NAMES; row < (long)table->rows; row++)
    if (row != UNITS || units) print_line(table, width, row, last, out);
  free(width);
  return 0;
}
