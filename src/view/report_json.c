/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes JSON (RFC 8259) with every character escaped that means something to HTML or ends a line of JavaScript. */
#include "report_json.h"

#include <math.h>
#include <string.h>

#include "../core/utf8.h"
#include "sheet.h"

static void write_text(const char *text, FILE *out)
{
  putc('"', out);
  for (const char *c = text; *c;) {
    unsigned long point = 0xFFFD;
    int length = gx_utf8_length(c, &point);
    bool line_end = point == 0x2028 || point == 0x2029;
    if (!length || point < 0x20 || point == 0x7F || line_end || strchr("<>&\"\\'", (int)(point < 0x80 ? point : 'a')))
      fprintf(out, "\\u%04lx", length ? point : 0xFFFDul);
    else
      fwrite(c, 1, (size_t)length, out);
    c += length ? length : 1;
  }
  putc('"', out);
}

static void lead(struct gx_report_json *json, const char *key)
{
  if (json->filled) putc(',', json->out);
  json->filled = true;
  if (!key) return;
  write_text(key, json->out);
  putc(':', json->out);
}

void gx_report_json_open(struct gx_report_json *json, const char *key, char bracket)
{
  lead(json, key);
  putc(bracket, json->out);
  json->filled = false;
}

void gx_report_json_close(struct gx_report_json *json, char bracket)
{
  putc(bracket, json->out);
  json->filled = true;
}

void gx_report_json_text(struct gx_report_json *json, const char *key, const char *text)
{
  lead(json, key);
  if (text)
    write_text(text, json->out);
  else
    fputs("null", json->out);
}

void gx_report_json_number(struct gx_report_json *json, const char *key, double number)
{
  char text[GX_NUMBER_LENGTH];
  lead(json, key);
  snprintf(text, sizeof text, "%.6g", number);
  gx_sheet_shorten(text);
  fputs(isfinite(number) ? text : "null", json->out);
}

void gx_report_json_integer(struct gx_report_json *json, const char *key, long number)
{
  lead(json, key);
  fprintf(json->out, "%ld", number);
}

void gx_report_json_escape(const char *text, FILE *out)
{
  for (const char *c = text; *c;) {
    unsigned long point = 0xFFFD;
    int length = gx_utf8_length(c, &point);
    if (!length)
      fputs("\xEF\xBF\xBD", out);
    else if (strchr("<>&\"'", (int)(point < 0x80 ? point : 'a')))
      fprintf(out, "&#%lu;", point);
    else if (point < 0x20 || point == 0x7F)
      putc(' ', out);
    else
      fwrite(c, 1, (size_t)length, out);
    c += length ? length : 1;
  }
}
