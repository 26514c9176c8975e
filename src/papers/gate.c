/* SPDX-License-Identifier: GPL-3.0-or-later */
/* "5%", "5% of 1.567", "factor 2 of 3e-4", "below 1", "above 1", "between 1 2", "show". */
#include "gate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Takes a number and the blanks after it. */
static bool take_number(const char **text, double *number)
{
  char *end;
  *number = strtod(*text, &end);
  if (end == *text || !isfinite(*number)) return false;
  *text = end + strspn(end, " ");
  return true;
}

static bool take_word(const char **text, const char *word)
{
  size_t length = strlen(word);
  if (strncmp(*text, word, length) != 0) return false;
  *text += length;
  *text += strspn(*text, " ");
  return true;
}

/* [of TARGET] */
static int read_target(struct gx_gate *gate, const char *text)
{
  gate->target = NAN;
  gate->own_target = take_word(&text, "of ");
  if (gate->own_target && !take_number(&text, &gate->target)) return -1;
  return *text ? -1 : 0;
}

static int read_range(struct gx_gate *gate, const char *text, bool from, bool to)
{
  gate->kind = GX_GATE_RANGE;
  gate->least = -INFINITY;
  gate->most = INFINITY;
  if (from && !take_number(&text, &gate->least)) return -1;
  if (to && !take_number(&text, &gate->most)) return -1;
  return *text || gate->least > gate->most ? -1 : 0;
}

int gx_gate_read(struct gx_gate *gate, const char *text)
{
  *gate = (struct gx_gate){.target = NAN};
  if (!strcmp(text, "show")) return 0;
  if (take_word(&text, "below ")) return read_range(gate, text, false, true);
  if (take_word(&text, "above ")) return read_range(gate, text, true, false);
  if (take_word(&text, "between ")) return read_range(gate, text, true, true);
  if (take_word(&text, "factor ")) {
    gate->kind = GX_GATE_FACTOR;
    if (!take_number(&text, &gate->tolerance) || gate->tolerance < 1) return -1;
  } else {
    gate->kind = GX_GATE_RELATIVE;
    if (!take_number(&text, &gate->tolerance) || gate->tolerance < 0 || !take_word(&text, "%")) return -1;
    gate->tolerance /= 100;
  }
  return read_target(gate, text);
}

bool gx_gate_met(const struct gx_gate *gate, double value)
{
  switch (gate->kind) {
  case GX_GATE_SHOW:
    return true;
  case GX_GATE_RELATIVE:
    return fabs(value - gate->target) <= gate->tolerance * fabs(gate->target);
  case GX_GATE_FACTOR:
    return value >= gate->target / gate->tolerance && value <= gate->target * gate->tolerance;
  case GX_GATE_RANGE:
    return value >= gate->least && value <= gate->most;
  }
  return false;
}
