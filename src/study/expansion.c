/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expansion: every combination of the settings' values, resolved, told apart by a hash, equal ones dropped. */
#include "expansion.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../core/large.h"

enum { MOST_CASES = 1000000 };

/* Parameters that advance together: one list, or a zip. */
struct wheel {
  size_t count, at;
  struct gx_setting *setting; /* one of them */
};

/* One entry of `cases` over the base. */
struct combination {
  struct gx_setting *held[GX_PARAMETERS]; /* NULL: default */
  int wheel_of[GX_PARAMETERS];            /* -1: constant */
  struct wheel wheel[GX_PARAMETERS];      /* slowest first */
  int wheels;
};

struct expansion {
  struct gx_settings *settings;
  struct gx_study *study;
  struct gx_value standard[GX_PARAMETERS];
  struct gx_setting *held[GX_PARAMETERS]; /* first setting that a case holds */
  bool applied[GX_PARAMETERS];            /* in a case that holds a setting */
  struct {
    double real;
    char text[32];
  } printed[GX_PARAMETERS]; /* reals as last hashed: printing them would be most of the work */
  struct {
    uint64_t before, after; /* equal: of nothing yet */
    struct gx_value value;
  } hashed[GX_PARAMETERS]; /* the hash before and after a value: cases begin alike */
  uint64_t *hash;          /* of each case */
  size_t *slot;            /* [slots] hash table of case indices + 1 */
  size_t slots;
};

static bool is_later(struct gx_place a, struct gx_place b)
{
  if (a.set != b.set) return a.set > b.set;
  return a.line != b.line ? a.line > b.line : a.column > b.column;
}

/* The later of the two changed what the other expects. */
static void report_zip(struct gx_errors *errors, struct gx_setting *a, struct gx_setting *b)
{
  struct gx_setting *late = is_later(a->place, b->place) ? a : b, *early = late == a ? b : a;
  if (a->bad || b->bad) return;
  gx_errors_add(errors, late->place, "zip: %s has %zu values here, but %s has %zu; give equally many",
                gx_parameters[late->id].path, late->count, gx_parameters[early->id].path, early->count);
  late->bad = true;
}

/* Lists become wheels, in the order in which the file names them; those of a zip share one. */
static void place_wheels(struct gx_settings *settings, struct combination *combination)
{
  int wheel_of_zip[GX_PARAMETERS + 1] = {0}; /* number of the wheel + 1 */
  for (size_t i = 0; i < settings->ordered; i++) {
    enum gx_parameter_id id = settings->order[i];
    struct gx_setting *setting = combination->held[id];
    if (!setting || !setting->listed) continue;
    int with = settings->zip[id] ? wheel_of_zip[settings->zip[id]] - 1 : -1;
    struct wheel *wheel = with < 0 ? NULL : &combination->wheel[with];
    if (wheel && wheel->count != setting->count) {
      report_zip(settings->errors, wheel->setting, setting);
      wheel = NULL;
    }
    if (!wheel) {
      with = combination->wheels++;
      combination->wheel[with] = (struct wheel){.count = setting->count, .setting = setting};
      wheel_of_zip[settings->zip[id]] = with + 1;
    }
    combination->wheel_of[id] = with;
  }
}

static void combine(struct gx_settings *settings, const struct gx_layer *layer, struct combination *combination)
{
  *combination = (struct combination){.wheels = 0};
  for (struct gx_setting *setting = settings->base.first; setting; setting = setting->next)
    combination->held[setting->id] = setting;
  for (struct gx_setting *setting = layer->first; setting; setting = setting->next) {
    for (int i = 0, rival; (rival = gx_setting_rival(setting->id, i)) >= 0; i++) combination->held[rival] = NULL;
    combination->held[setting->id] = setting;
  }
  for (int id = 0; id < GX_PARAMETERS; id++) {
    combination->wheel_of[id] = -1;
    if (combination->held[id] && !combination->held[id]->count) combination->held[id] = NULL;
  }
  place_wheels(settings, combination);
}

static bool turn(struct combination *combination)
{
  for (int w = combination->wheels - 1; w >= 0; w--) {
    struct wheel *wheel = &combination->wheel[w];
    if (++wheel->at < wheel->count) return true;
    wheel->at = 0;
  }
  return false;
}

static struct gx_item *item_of(const struct combination *combination, int id)
{
  int wheel = combination->wheel_of[id];
  return &combination->held[id]->item[wheel < 0 ? 0 : combination->wheel[wheel].at];
}

static uint64_t hash_text(uint64_t hash, const char *text)
{
  for (; *text; text++) hash = (hash ^ (unsigned char)*text) * UINT64_C(0x100000001b3);
  return hash;
}

static bool same_value(struct gx_value a, struct gx_value b)
{
  if (a.type != b.type) return false;
  switch (a.type) {
  case GX_INTEGER:
    return a.integer == b.integer;
  case GX_REAL:
    return a.real == b.real;
  case GX_TEXT:
    return a.text == b.text || !strcmp(a.text, b.text);
  default:
    return true;
  }
}

/* FNV-1a of the lines "path=value", null values left out. */
static uint64_t hash_case(struct expansion *expansion, const struct gx_value *value)
{
  uint64_t hash = UINT64_C(0xcbf29ce484222325);
  for (int id = 0; id < GX_PARAMETERS; id++) {
    char integer[GX_NUMBER_LENGTH];
    const char *text = NULL;
    const uint64_t before = hash;
    if (value[id].type == GX_NULL) continue;
    if (expansion->hashed[id].before == before && expansion->hashed[id].after != before &&
        same_value(expansion->hashed[id].value, value[id])) {
      hash = expansion->hashed[id].after;
      continue;
    }
    switch (value[id].type) {
    case GX_NULL:
      break;
    case GX_INTEGER:
      gx_value_integer(value[id].integer, integer);
      text = integer;
      break;
    case GX_REAL:
      if (!*expansion->printed[id].text || expansion->printed[id].real != value[id].real)
        snprintf(expansion->printed[id].text, sizeof expansion->printed[id].text, "%.17g", value[id].real + 0.0); /* no -0 */
      expansion->printed[id].real = value[id].real;
      text = expansion->printed[id].text;
      break;
    case GX_TEXT:
      text = value[id].text;
      break;
    }
    hash = hash_text(hash, gx_parameters[id].path);
    hash = hash_text(hash, "=");
    hash = hash_text(hash, text);
    hash = hash_text(hash, "\n");
    expansion->hashed[id].before = before;
    expansion->hashed[id].after = hash;
    expansion->hashed[id].value = value[id];
  }
  return hash;
}

/* 16 digits */
static void print_id(uint64_t hash, char id[GX_ID_LENGTH])
{
  for (int i = GX_ID_LENGTH - 2; i >= 0; i--, hash >>= 4) id[i] = "0123456789abcdef"[hash & 15];
  id[GX_ID_LENGTH - 1] = '\0';
}

static bool same_case(const struct gx_value *a, const struct gx_value *b)
{
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (!same_value(a[id], b[id])) return false;
  return true;
}

/* At once: moving a study that grows costs more than expanding it. */
static bool make_room(struct expansion *expansion, size_t cases)
{
  for (expansion->slots = 64; expansion->slots < 2 * cases;) expansion->slots *= 2;
  expansion->study->cases = gx_large_zeros((cases + 1) * sizeof *expansion->study->cases);
  expansion->hash = gx_large_zeros((cases + 1) * sizeof *expansion->hash);
  expansion->slot = gx_large_zeros(expansion->slots * sizeof *expansion->slot);
  return expansion->study->cases && expansion->hash && expansion->slot;
}

static void keep(struct expansion *expansion, const struct gx_value *value)
{
  struct gx_study *study = expansion->study;
  uint64_t hash = hash_case(expansion, value);
  size_t s = (size_t)hash & (expansion->slots - 1);
  for (; expansion->slot[s]; s = (s + 1) & (expansion->slots - 1)) {
    size_t i = expansion->slot[s] - 1;
    if (expansion->hash[i] == hash && same_case(study->cases[i].value, value)) {
      study->duplicates++;
      return;
    }
  }
  struct gx_case *one = &study->cases[study->count];
  print_id(hash, one->id);
  memcpy(one->value, value, sizeof one->value);
  one->points = NULL;
  expansion->hash[study->count] = hash;
  expansion->slot[s] = ++study->count;
}

/* Resolves and keeps the case that the wheels stand at. */
static void take_case(struct expansion *expansion, const struct combination *combination)
{
  struct gx_value value[GX_PARAMETERS] = {{.type = GX_NULL}};
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (combination->held[id]) value[id] = item_of(combination, id)->value;
  gx_parameter_own(value);
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (value[id].type == GX_NULL) value[id] = expansion->standard[id];
  gx_parameter_resolve(value);
  for (int id = 0; id < GX_PARAMETERS; id++) {
    if (!combination->held[id]) continue;
    if (!expansion->held[id]) expansion->held[id] = combination->held[id];
    if (value[id].type != GX_NULL) expansion->applied[id] = true;
  }
  bool fits = true;
  for (int id = 0; id < GX_PARAMETERS; id++) {
    char objection[GX_OBJECTION_LENGTH];
    if (!combination->held[id] || gx_parameter_fits((enum gx_parameter_id)id, value, objection)) continue;
    struct gx_item *item = item_of(combination, id);
    if (!item->refused) gx_errors_add(expansion->settings->errors, item->place, "%s: %s", gx_parameters[id].path, objection);
    item->refused = true;
    fits = false;
    if (id == GX_PROBLEM_DIMENSION) break; /* which others are judged by */
  }
  if (fits) keep(expansion, value);
}

static void find_axes(const struct gx_settings *settings, struct gx_study *study)
{
  for (size_t i = 0; i < settings->ordered; i++) {
    enum gx_parameter_id id = settings->order[i];
    size_t same = 1;
    if (!settings->varied[id]) continue;
    while (same < study->count && same_value(study->cases[0].value[id], study->cases[same].value[id])) same++;
    if (same < study->count) study->axis[study->axes++] = id;
  }
}

/* Every case has a problem, as far as errors reported before let one tell. */
static bool check_problem(struct gx_settings *settings)
{
  static const char message[] = "problem.name is required; 'gridcross list problems' names them";
  bool complete = true;
  if (gx_setting_find(&settings->base, GX_PROBLEM_NAME)) return true;
  if (!settings->cases) {
    if (!settings->name_excused) gx_errors_add(settings->errors, settings->base.place, message);
    return false;
  }
  for (const struct gx_layer *layer = settings->cases; layer; layer = layer->next) {
    if (gx_setting_find(layer, GX_PROBLEM_NAME)) continue;
    if (!settings->name_excused) gx_errors_add(settings->errors, layer->place, message);
    complete = false;
  }
  return complete;
}

/* How many cases there can be; 0: too many, after a message. */
static size_t count_cases(struct gx_settings *settings, const struct gx_layer *layers)
{
  double cases = 0;
  struct gx_place place = {.line = 1, .column = 1};
  for (const struct gx_layer *layer = layers; layer; layer = layer->next) {
    struct combination combination;
    double count = 1;
    combine(settings, layer, &combination);
    for (int w = 0; w < combination.wheels; w++) count *= (double)combination.wheel[w].count;
    if (combination.wheels && cases <= MOST_CASES && cases + count > MOST_CASES) place = combination.wheel[0].setting->place;
    cases += count;
  }
  if (cases > MOST_CASES)
    gx_errors_add(settings->errors, place, "the lists multiply to %.15g cases; at most %d are allowed", cases, MOST_CASES);
  return cases <= MOST_CASES ? (size_t)cases : 0;
}

void gx_expansion_run(struct gx_settings *settings)
{
  struct expansion expansion = {.settings = settings, .study = settings->study};
  struct gx_errors *errors = settings->errors;
  const struct gx_layer nothing = {.first = NULL}, *layers = settings->cases ? settings->cases : &nothing;
  if (!check_problem(settings) || settings->uncertain || gx_errors_full(errors)) return;
  const size_t most = count_cases(settings, layers);
  if (!most) return;
  if (!make_room(&expansion, most)) errors->out_of_memory = true;
  for (int id = 0; id < GX_PARAMETERS; id++) expansion.standard[id] = gx_parameter_default((enum gx_parameter_id)id);
  for (const struct gx_layer *layer = layers; layer && !errors->out_of_memory; layer = layer->next) {
    struct combination combination;
    combine(settings, layer, &combination);
    do take_case(&expansion, &combination);
    while (!errors->out_of_memory && turn(&combination));
  }
  free(expansion.hash);
  free(expansion.slot);
  for (int id = 0; id < GX_PARAMETERS; id++)
    if (expansion.held[id] && !expansion.applied[id] && !settings->incomplete)
      gx_errors_add(errors, expansion.held[id]->place, "%s applies to no case; remove it (%s)", gx_parameters[id].path,
                    gx_parameters[id].help);
  find_axes(settings, settings->study);
}
