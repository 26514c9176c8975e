/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Leaves out of a case what the parameter table would fill in. */
#include "recipe.h"

#include <stdbool.h>
#include <string.h>

#include <gridcross/parameter.h>

void gx_recipe_quote(const char *text, FILE *out)
{
  putc('"', out);
  for (const char *c = text; *c; c++)
    if (*c == '"' || *c == '\\')
      fprintf(out, "\\%c", *c);
    else if ((unsigned char)*c < ' ' || *c == 0x7F)
      fprintf(out, "\\x%02X", (unsigned char)*c);
    else
      putc(*c, out);
  putc('"', out);
}

static bool is_choice(const struct gx_parameter *parameter, const char *text)
{
  for (int i = 0; parameter->choice && parameter->choice(i); i++)
    if (!strcmp(parameter->choice(i), text)) return true;
  return false;
}

/* Whether the parameter table knows such a value; a study may come from another version. */
static bool is_known(int id, struct gx_value value)
{
  const struct gx_parameter *parameter = &gx_parameters[id];
  if (value.type == GX_NULL) return id != GX_PROBLEM_NAME;
  if (value.type != parameter->type) return false;
  if (value.type == GX_TEXT) return !parameter->choice || is_choice(parameter, value.text);
  return gx_value_number(value) >= parameter->least && gx_value_number(value) <= parameter->most;
}

static bool resolves_to(const struct gx_value *given, const struct gx_value *wanted)
{
  struct gx_value value[GX_PARAMETERS];
  memcpy(value, given, sizeof value);
  gx_parameter_resolve(value);
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (gx_value_compare(value[id], wanted[id])) return false;
  return true;
}

/* From the last on: what is left of rivals and of defaults that follow is what stands first. */
static void shorten(struct gx_value value[GX_PARAMETERS])
{
  struct gx_value wanted[GX_PARAMETERS];
  memcpy(wanted, value, sizeof wanted);
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (!is_known(id, value[id])) return;
  for (int id = GX_PARAMETERS - 1; id > GX_PROBLEM_NAME; id--) {
    struct gx_value kept = value[id];
    value[id] = (struct gx_value){0};
    if (!resolves_to(value, wanted)) value[id] = kept;
  }
}

static void write_value(int id, struct gx_value value, FILE *out)
{
  char number[GX_NUMBER_LENGTH];
  if (value.type == GX_INTEGER) {
    fprintf(out, "%ld", value.integer);
  } else if (value.type == GX_REAL) {
    gx_value_real(value.real, number);
    fputs(number, out);
  } else if (is_choice(&gx_parameters[id], value.text)) {
    fputs(value.text, out);
  } else {
    gx_recipe_quote(value.text, out);
  }
}

void gx_recipe_write(const struct gx_table *table, size_t row, const char *first, const char *other, FILE *out)
{
  struct gx_value value[GX_PARAMETERS];
  for (int id = 0; id < GX_PARAMETERS; id++) {
    long c = gx_table_find(table, gx_parameters[id].path);
    value[id] = c < 0 ? (struct gx_value){0} : gx_table_get(table, row, (size_t)c);
  }
  shorten(value);
  const char *section = NULL;
  for (int id = 0; id < GX_PARAMETERS; id++) {
    const char *path = gx_parameters[id].path, *key = strchr(path, '.') + 1;
    if (value[id].type == GX_NULL) continue;
    if (section && !strncmp(section, path, (size_t)(key - path)))
      fprintf(out, ", %s: ", key);
    else
      fprintf(out, "%s%s%.*s: {%s: ", section ? "}\n" : "", section ? other : first, (int)(key - path - 1), path, key);
    write_value(id, value[id], out);
    section = path;
  }
  if (section) fputs("}\n", out);
}
