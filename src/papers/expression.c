/* SPDX-License-Identifier: GPL-3.0-or-later */
/* column{path=value path=value}^power * number / ... */
#include "expression.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_LENGTH = 96 };

struct reader {
  const char *at;
  const struct gx_table *study;
  struct gx_expression *result;
  int columns; /* read so far */
};

__attribute__((format(printf, 2, 3))) static int ill_formed(struct reader *reader, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(reader->result->reason, sizeof reader->result->reason, format, arguments);
  va_end(arguments);
  return -1;
}

/* Takes characters up to one of `ends`. */
static int take_word(struct reader *reader, const char *ends, char word[WORD_LENGTH])
{
  size_t length = strcspn(reader->at, ends);
  if (!length || length >= WORD_LENGTH) return ill_formed(reader, "no name at '%.40s'", reader->at);
  memcpy(word, reader->at, length);
  word[length] = '\0';
  reader->at += length;
  return 0;
}

/* Numbers that lists make (geom, lin) equal their decimal text only to round-off. */
static bool equals(struct gx_value value, const char *text)
{
  char *end;
  if (value.type == GX_TEXT) return !strcmp(value.text, text);
  double wanted = strtod(text, &end), found = value.type == GX_REAL ? value.real : (double)value.integer;
  return value.type != GX_NULL && end != text && !*end && fabs(found - wanted) <= 1e-12 * fabs(wanted);
}

/* Strikes out the rows that have another value: {path=value ...}. */
static int select_rows(struct reader *reader, bool *out)
{
  reader->at++;
  while (*reader->at != '}') {
    char path[WORD_LENGTH], text[WORD_LENGTH];
    if (take_word(reader, "= }", path)) return -1;
    if (*reader->at++ != '=') return ill_formed(reader, "'%s' has no value", path);
    if (take_word(reader, " }", text)) return -1;
    reader->at += strspn(reader->at, " ");
    if (!*reader->at) return ill_formed(reader, "no closing brace");
    long column = gx_table_find(reader->study, path);
    if (column < 0) return ill_formed(reader, "no column '%s'", path);
    for (size_t row = 0; row < reader->study->rows; row++)
      out[row] = out[row] || !equals(gx_table_get(reader->study, row, (size_t)column), text);
  }
  reader->at++;
  return 0;
}

/* How the case ended that lacks a result. */
static void explain(struct reader *reader, size_t row)
{
  long status = gx_table_find(reader->study, "result.status"), reason = gx_table_find(reader->study, "result.reason");
  if (status < 0 || reason < 0) return;
  struct gx_value how = gx_table_get(reader->study, row, (size_t)status), why = gx_table_get(reader->study, row, (size_t)reason);
  if (how.type != GX_TEXT || !strcmp(how.text, gx_status_name(GX_OK))) return;
  snprintf(reader->result->because, GX_REASON_LENGTH, "our case ended %s%s%.160s", how.text, why.type == GX_TEXT ? ": " : "",
           why.type == GX_TEXT ? why.text : "");
}

static int read_column(struct reader *reader, struct gx_value *value)
{
  char name[WORD_LENGTH];
  bool *out = calloc(reader->study->rows + 1, sizeof *out);
  size_t count = 0, found = 0;
  const char *start = reader->at;
  int failed = !out ? ill_formed(reader, "out of memory") : take_word(reader, "{^ ", name);
  if (!failed && *reader->at == '{') failed = select_rows(reader, out);
  for (size_t row = 0; row < reader->study->rows && !failed; row++) {
    if (out[row]) continue;
    found = row;
    count++;
  }
  free(out);
  if (failed) return -1;
  long column = gx_table_find(reader->study, name);
  if (column < 0) return ill_formed(reader, "no column '%s'", name);
  if (count != 1) return ill_formed(reader, "%zu cases for '%.*s'", count, (int)(reader->at - start), start);
  *value = gx_table_get(reader->study, found, (size_t)column);
  reader->result->row = reader->columns++ ? -1 : (long)found;
  if (value->type == GX_INTEGER) *value = (struct gx_value){.type = GX_REAL, .real = (double)value->integer};
  if (value->type == GX_NULL) explain(reader, found);
  return 0;
}

static int read_factor(struct reader *reader, struct gx_value *value)
{
  char *end;
  value->real = strtod(reader->at, &end);
  if (end != reader->at) {
    value->type = GX_REAL;
    reader->at = end;
  } else if (read_column(reader, value))
    return -1;
  if (*reader->at != '^') return 0;
  double power = strtod(reader->at + 1, &end);
  if (end == reader->at + 1) return ill_formed(reader, "no power at '%.40s'", reader->at);
  reader->at = end;
  if (value->type == GX_TEXT) return ill_formed(reader, "a text has no power");
  if (value->type == GX_REAL) value->real = pow(value->real, power);
  return 0;
}

struct gx_expression gx_expression_value(const char *text, const struct gx_table *study)
{
  struct gx_expression result = {.row = -1, .value.type = GX_NULL};
  struct reader reader = {.at = text, .study = study, .result = &result};
  if (read_factor(&reader, &result.value)) return result;
  while (*reader.at) {
    struct gx_value factor;
    char sign = reader.at[1];
    if (strncmp(reader.at, " * ", 3) != 0 && strncmp(reader.at, " / ", 3) != 0) {
      ill_formed(&reader, "neither ' * ' nor ' / ' at '%.40s'", reader.at);
      return result;
    }
    reader.at += 3;
    if (read_factor(&reader, &factor)) return result;
    if (result.value.type == GX_TEXT || factor.type == GX_TEXT) {
      ill_formed(&reader, "a text cannot be multiplied");
      return result;
    }
    if (factor.type == GX_NULL) result.value.type = GX_NULL;
    if (result.value.type == GX_REAL)
      result.value.real = sign == '*' ? result.value.real * factor.real : result.value.real / factor.real;
  }
  if (result.value.type == GX_REAL && !isfinite(result.value.real)) result.value.type = GX_NULL;
  return result;
}
