/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Settings: reading the value of one parameter, a scalar, a list or a range. */
#include "setting.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../core/nearest.h"
#include "number.h"

enum { MOST_IN_RANGE = 1000000, MOST_IN_RANGES = 4 * MOST_IN_RANGE };

static bool report_choice(struct gx_errors *errors, struct gx_place place, const struct gx_parameter *parameter, const char *text)
{
  struct gx_nearest nearest = {.word = text};
  char list[256] = "";
  for (int i = 0; parameter->choice(i); i++) {
    gx_nearest_try(&nearest, parameter->choice(i));
    size_t used = strlen(list);
    snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", parameter->choice(i));
  }
  if (*nearest.best)
    gx_errors_add(errors, place, "%s: unknown value %s; did you mean '%s'?", parameter->path, gx_errors_quote(text).text,
                  nearest.best);
  else
    gx_errors_add(errors, place, "%s: unknown value %s; choose from %s", parameter->path, gx_errors_quote(text).text, list);
  return false;
}

static bool read_text(struct gx_settings *settings, const struct gx_parameter *parameter, const struct gx_yaml *node,
                      struct gx_value *value)
{
  for (int i = 0; parameter->choice && parameter->choice(i); i++)
    if (!strcmp(parameter->choice(i), node->text)) {
      value->text = parameter->choice(i);
      return true;
    }
  if (parameter->choice) return report_choice(settings->errors, node->place, parameter, node->text);
  struct gx_study *study = settings->study;
  char **texts = realloc(study->texts, (study->text_count + 1) * sizeof *texts);
  char *copy = strdup(node->text);
  if (texts) study->texts = texts;
  if (!texts || !copy) {
    free(copy);
    settings->errors->out_of_memory = true;
    return false;
  }
  study->texts[study->text_count++] = copy;
  value->text = copy;
  return true;
}

static bool report_range(struct gx_errors *errors, struct gx_place place, const struct gx_parameter *parameter, const char *text)
{
  char most[64] = "";
  if (parameter->most < INFINITY)
    snprintf(most, sizeof most, " and %s %.15g", parameter->below_most ? "below" : "at most", parameter->most);
  gx_errors_add(errors, place, "%s: %s is out of range; it must be %s %.15g%s", parameter->path, gx_errors_quote(text).text,
                parameter->above_least ? "above" : "at least", parameter->least, most);
  return false;
}

static bool read_number(struct gx_errors *errors, const struct gx_parameter *parameter, const struct gx_yaml *node,
                        struct gx_value *value)
{
  if (!node->plain) {
    gx_errors_add(errors, node->place, "%s: %s is text; write the number without quotes", parameter->path,
                  gx_errors_quote(node->text).text);
    return false;
  }
  double number;
  const char *wrong = gx_number_real(node->text, &number);
  if (!wrong && parameter->type == GX_INTEGER) wrong = gx_number_integer(node->text, &value->integer);
  if (wrong) {
    gx_errors_add(errors, node->place, "%s: %s %s", parameter->path, gx_errors_quote(node->text).text, wrong);
    return false;
  }
  if (parameter->type == GX_REAL) value->real = number;
  bool low = parameter->above_least ? number <= parameter->least : number < parameter->least;
  bool high = parameter->below_most ? number >= parameter->most : number > parameter->most;
  return low || high ? report_range(errors, node->place, parameter, node->text) : true;
}

/* key: where to report a value that is not there. */
static bool read_scalar(struct gx_settings *settings, const struct gx_parameter *parameter, struct gx_place key,
                        const struct gx_yaml *node, struct gx_value *value)
{
  if (node->kind == GX_YAML_REFUSED) return false;
  if (node->kind != GX_YAML_SCALAR) {
    gx_errors_add(settings->errors, node->place, "%s: expected a %s here, not a %s", parameter->path,
                  parameter->type == GX_TEXT ? "word" : "number", node->kind == GX_YAML_LIST ? "list" : "mapping");
    return false;
  }
  if (gx_yaml_is_empty(node)) {
    gx_errors_add(settings->errors, key, "%s has no value; give one or remove the key", parameter->path);
    return false;
  }
  *value = (struct gx_value){.type = parameter->type};
  if (parameter->type == GX_TEXT) return read_text(settings, parameter, node, value);
  return read_number(settings->errors, parameter, node, value);
}

static bool take_items(struct gx_settings *settings, struct gx_setting *setting, size_t room)
{
  if (room <= SIZE_MAX / sizeof *setting->item) setting->item = gx_arena_take(&settings->arena, room * sizeof *setting->item);
  settings->errors->out_of_memory |= !setting->item;
  return setting->item;
}

static void read_list(struct gx_settings *settings, struct gx_setting *setting, const struct gx_yaml *list)
{
  const struct gx_parameter *parameter = &gx_parameters[setting->id];
  if (!list->count) {
    gx_errors_add(settings->errors, list->place, "%s: the list is empty; give at least one value", parameter->path);
    return;
  }
  if (!take_items(settings, setting, list->count)) return;
  for (const struct gx_yaml *node = list->first; node && !gx_errors_full(settings->errors); node = node->next) {
    struct gx_item *item = &setting->item[setting->count];
    if (read_scalar(settings, parameter, node->place, node, &item->value)) {
      item->place = node->place;
      setting->count++;
    }
  }
}

static double as_real(struct gx_value value)
{
  return value.type == GX_INTEGER ? (double)value.integer : value.real;
}

/* Fourteen digits, so that a range gives the numbers that one would write, whatever the library's pow. */
static double fourteen_digits(double x)
{
  char text[32];
  snprintf(text, sizeof text, "%.14g", x);
  return strtod(text, NULL);
}

static double between(bool geom, double a, double b, double s)
{
  if (!geom) return a * (1 - s) + b * s;
  double ratio = b / a;
  bool safe = ratio > 0 && isfinite(ratio);
  return safe ? a * pow(ratio, s) : pow(a, 1 - s) * pow(b, s);
}

static void fill_range(struct gx_settings *settings, struct gx_setting *setting, const struct gx_yaml *place, bool geom,
                       struct gx_value first, struct gx_value last, size_t n)
{
  double a = as_real(first), b = as_real(last);
  settings->ranged += n;
  if (settings->ranged > MOST_IN_RANGES) {
    gx_errors_add(settings->errors, place->place, "%s: the ranges of this file have more than %d values together",
                  gx_parameters[setting->id].path, MOST_IN_RANGES);
    settings->uncertain = true;
    return;
  }
  if (!take_items(settings, setting, n)) return;
  for (size_t i = 0; i < n; i++) {
    double x = fourteen_digits(between(geom, a, b, (double)i / (double)(n - 1)));
    struct gx_value value = i == 0 ? first : i == n - 1 ? last : (struct gx_value){.type = GX_REAL, .real = x};
    if (first.type == GX_INTEGER && value.type == GX_REAL) {
      if (fabs(x - nearbyint(x)) > 1e-9) {
        gx_errors_add(settings->errors, place->place,
                      "%s: value %zu of the range would be %.6g, not a whole number; list the values",
                      gx_parameters[setting->id].path, i + 1, x);
        return;
      }
      value = (struct gx_value){.type = GX_INTEGER, .integer = (long)nearbyint(x)};
    }
    setting->item[setting->count++] = (struct gx_item){.value = value, .place = place->place};
  }
}

static bool read_range_count(struct gx_errors *errors, const char *path, const struct gx_yaml *node, long *n)
{
  if (node->kind == GX_YAML_REFUSED) return false;
  bool scalar = node->kind == GX_YAML_SCALAR && node->plain;
  const char *wrong = scalar ? gx_number_integer(node->text, n) : "is not a number";
  if (!wrong && *n >= 2 && *n <= MOST_IN_RANGE) return true;
  if (wrong)
    gx_errors_add(errors, node->place, "%s: the count of a range %s", path, wrong);
  else
    gx_errors_add(errors, node->place, "%s: a range has 2 to %d values, not %ld", path, MOST_IN_RANGE, *n);
  return false;
}

/* {geom: [first, last, n]} or {lin: [first, last, n]} */
static void read_range(struct gx_settings *settings, struct gx_setting *setting, const struct gx_yaml *mapping)
{
  struct gx_errors *errors = settings->errors;
  const struct gx_parameter *parameter = &gx_parameters[setting->id];
  const struct gx_yaml *kind = mapping->first, *range = kind ? kind->next : NULL;
  bool known = kind && kind->kind == GX_YAML_SCALAR && (!strcmp(kind->text, "geom") || !strcmp(kind->text, "lin"));
  if (!known || mapping->count != 2) {
    gx_errors_add(errors,
                  known  ? kind->next->next->place
                  : kind ? kind->place
                         : mapping->place,
                  "%s: a range is {geom: [first, last, n]} or {lin: [first, last, n]}", parameter->path);
    return;
  }
  if (parameter->type == GX_TEXT) {
    gx_errors_add(errors, kind->place, "%s: only numbers have ranges; list the words", parameter->path);
    return;
  }
  if (range->kind == GX_YAML_REFUSED) return;
  if (range->kind != GX_YAML_LIST || range->count != 3) {
    gx_errors_add(errors, range->place, "%s: %s takes three numbers: [first, last, n]", parameter->path, kind->text);
    return;
  }
  bool geom = *kind->text == 'g';
  struct gx_value end[2];
  const struct gx_yaml *node = range->first;
  bool good = true;
  for (int i = 0; i < 2; i++, node = node->next) {
    bool read = read_scalar(settings, parameter, node->place, node, &end[i]);
    if (read && geom && !(as_real(end[i]) > 0)) {
      gx_errors_add(errors, node->place, "%s: the ends of geom must be above 0", parameter->path);
      read = false;
    }
    good = good && read;
  }
  long n = 0;
  if (read_range_count(errors, parameter->path, node, &n) && good)
    fill_range(settings, setting, mapping, geom, end[0], end[1], (size_t)n);
}

struct gx_setting *gx_setting_read(struct gx_settings *settings, enum gx_parameter_id id, struct gx_place key,
                                   const struct gx_yaml *value)
{
  const struct gx_parameter *parameter = &gx_parameters[id];
  struct gx_errors *errors = settings->errors;
  size_t count = errors->count;
  struct gx_setting *setting = gx_arena_take(&settings->arena, sizeof *setting);
  if (!setting) {
    errors->out_of_memory = true;
    return NULL;
  }
  *setting = (struct gx_setting){.id = id, .place = key, .listed = value->kind != GX_YAML_SCALAR};
  if (value->kind == GX_YAML_LIST)
    read_list(settings, setting, value);
  else if (value->kind == GX_YAML_MAPPING)
    read_range(settings, setting, value);
  else if (take_items(settings, setting, 1) && read_scalar(settings, parameter, key, value, &setting->item->value)) {
    setting->item->place = value->place;
    setting->count = 1;
  }
  setting->bad = errors->count > count || !setting->count || (value->kind == GX_YAML_LIST && setting->count < value->count);
  if (setting->bad && (parameter->choice || id == GX_PROBLEM_DIMENSION)) {
    settings->uncertain = settings->uncertain || !setting->count;
    settings->incomplete = true;
  }
  if (setting->listed) settings->varied[id] = true;
  return setting;
}

struct gx_setting *gx_setting_find(const struct gx_layer *layer, enum gx_parameter_id id)
{
  struct gx_setting *setting = layer->first;
  while (setting && setting->id != id) setting = setting->next;
  return setting;
}

int gx_setting_rival(enum gx_parameter_id id, int i)
{
  static const int rivals[GX_PARAMETERS][3] = {
      [GX_TIME_DT] = {GX_TIME_CFL},
      [GX_TIME_CFL] = {GX_TIME_DT},
      [GX_TIME_END] = {GX_TIME_PERIODS, GX_TIME_STEPS},
      [GX_TIME_PERIODS] = {GX_TIME_END, GX_TIME_STEPS},
      [GX_TIME_STEPS] = {GX_TIME_END, GX_TIME_PERIODS},
  };
  return rivals[id][i] ? rivals[id][i] : -1; /* 0 is problem.name, nobody's rival */
}
