/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Facts of parameters, from their table. */
#include "facts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void add(char facts[GX_FACTS_LENGTH], const char *a, const char *b, const char *c)
{
  size_t used = strlen(facts);
  snprintf(facts + used, GX_FACTS_LENGTH - used, "%s%s%s", a, b, c);
}

static void add_range(char facts[GX_FACTS_LENGTH], const struct gx_parameter *p)
{
  char number[GX_NUMBER_LENGTH];
  add(facts, p->type == GX_INTEGER ? "integer" : "number", "", "");
  gx_value_real(p->least, number);
  if (isfinite(p->least)) add(facts, p->above_least ? " > " : " >= ", number, "");
  gx_value_real(p->most, number);
  if (isfinite(p->most)) add(facts, isfinite(p->least) ? "," : "", p->below_most ? " < " : " <= ", number);
}

const char *gx_facts_text(const struct gx_parameter *p, char facts[GX_FACTS_LENGTH])
{
  strcpy(facts, "(");
  for (int i = 0; p->choice && p->choice(i); i++) add(facts, i ? ", " : "", p->choice(i), "");
  if (p->type != GX_TEXT)
    add_range(facts, p);
  else if (!p->choice)
    add(facts, "text", "", "");
  if (*p->unit) add(facts, "; ", p->unit, "");
  if (p->standard) add(facts, "; default ", p->standard, "");
  add(facts, ")", "", "");
  return facts;
}
