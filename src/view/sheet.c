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

bool gx_sheet_least_is_best(const char *column)
{
  return gx_sheet_error_like(column) || !strcmp(column, "result.seconds") || !strcmp(column, "result.ns_per_particle_step");
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
