/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Printing and ordering values. */
#include <gridcross/value.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "decimal.h"

void gx_value_real(double value, char text[GX_NUMBER_LENGTH])
{
  if (gx_decimal_print(value, text)) return;
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(text, GX_NUMBER_LENGTH, "%.*g", digits, value);
    if (strtod(text, NULL) == value) return;
  }
}

void gx_value_integer(long value, char text[GX_NUMBER_LENGTH])
{
  char digit[GX_NUMBER_LENGTH];
  int digits = 0;
  unsigned long rest = value < 0 ? 0 - (unsigned long)value : (unsigned long)value;
  do digit[digits++] = (char)('0' + rest % 10);
  while (rest /= 10);
  if (value < 0) *text++ = '-';
  while (digits) *text++ = digit[--digits];
  *text = '\0';
}

double gx_value_number(struct gx_value value)
{
  return value.type == GX_INTEGER ? (double)value.integer : value.type == GX_REAL ? value.real : NAN;
}

struct gx_value gx_value_from(double number)
{
  return isfinite(number) ? (struct gx_value){.type = GX_REAL, .real = number} : (struct gx_value){.type = GX_NULL};
}

static int kind(struct gx_value value)
{
  return value.type == GX_NULL ? 0 : value.type == GX_TEXT ? 2 : 1;
}

int gx_value_compare(struct gx_value a, struct gx_value b)
{
  if (kind(a) != kind(b)) return kind(a) - kind(b);
  if (kind(a) == 0) return 0;
  if (kind(a) == 2) return strcmp(a.text, b.text);
  if (a.type == GX_INTEGER && b.type == GX_INTEGER) return (a.integer > b.integer) - (a.integer < b.integer);
  return (gx_value_number(a) > gx_value_number(b)) - (gx_value_number(a) < gx_value_number(b));
}
