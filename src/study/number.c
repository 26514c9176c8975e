/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as run files write them. Stricter than strtod and than YAML 1.1, where 010 is 8 and 1_000 a number. */
#include "number.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char *skip_sign(const char *s)
{
  return s + (*s == '-' || *s == '+');
}

static const char *skip_digits(const char *s)
{
  while (isdigit((unsigned char)*s)) s++;
  return s;
}

/* Whether text is decimal; whole: without fraction and exponent. */
static bool decimal(const char *text, bool *whole)
{
  const char *start = skip_sign(text), *s = skip_digits(start);
  long digits = s - start;
  *whole = !*s;
  if (digits > 1 && *start == '0') return false;
  if (*s == '.') {
    const char *fraction = s + 1;
    s = skip_digits(fraction);
    digits += s - fraction;
  }
  if (digits == 0) return false;
  if (*s == 'e' || *s == 'E') {
    const char *exponent = skip_sign(s + 1);
    s = skip_digits(exponent);
    if (s == exponent) return false;
  }
  return !*s;
}

/* What is wrong with a text that is not decimal. */
static const char *explain(const char *text)
{
  const char *s = skip_sign(text);
  const char *word = s + (*s == '.');
  if (!strcasecmp(word, "nan") || !strcasecmp(word, "inf") || !strcasecmp(word, "infinity"))
    return "is not finite; give a finite number";
  if (*s == '0' && s[1] && strchr("xXoObB", s[1])) return "is not decimal; write it in decimal digits";
  const char *end = s + strspn(s, "0123456789.");
  if (end == s) return "is not a number";
  if (*end == 'd' || *end == 'D') {
    const char *exponent = skip_sign(end + 1);
    if (*exponent && !*skip_digits(exponent)) return "is not a number; write the exponent with e, as in 1e-3";
  }
  if ((*end == '_' || *end == ',') && isdigit((unsigned char)end[1]))
    return "is not a number; write its digits without separators";
  if (*s == '0' && isdigit((unsigned char)s[1])) return "has a leading zero; remove it";
  return "is not a number";
}

const char *gx_number_integer(const char *text, long *number)
{
  bool whole;
  if (!decimal(text, &whole)) return explain(text);
  if (!whole) return "is not a whole number; write digits only";
  errno = 0;
  *number = strtol(text, NULL, 10);
  return errno ? "is too large" : NULL;
}

const char *gx_number_real(const char *text, double *number)
{
  bool whole;
  if (!decimal(text, &whole)) return explain(text);
  errno = 0;
  *number = strtod(text, NULL) + 0.0;
  if (!isfinite(*number)) return "is too large";
  if (errno == ERANGE && *number == 0) return "is too small to be told from 0";
  return NULL;
}
